#pragma once
// A real adstard with its bridge, and a commander and telemetry reader on the same bus: three
// processes.

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "service/dds/convert.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/writer.hpp"
#include "service/run/hot_journal_file.hpp"
#include "service/run/run_directory.hpp"
#include "tests/integration/bridge_harness.hpp"

namespace adstar::testing {

/// A directory of this test's own, removed with it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "adstar.XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_, ignored)) {
      if (entry.path().filename() == "run.json") {
        forget_in_memory(entry.path().parent_path());
      }
    }
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  /// A run whose daemon was killed, and that nobody goes on with, would stay in memory.
  static void forget_in_memory(const std::filesystem::path& run) {
    try {
      run::HotJournalFile::remove(
          run::RunDirectory::open(run, run::RunDirectory::Use::look).facts());
    } catch (const std::exception&) {
      // It was no run yet.
    }
  }

  std::filesystem::path path_;
};

/// adstard on a scene, its stderr kept.
class Daemon {
 public:
  explicit Daemon(const std::string& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{directory_.write("scene.toml", scene).string()};
    words.insert(words.end(), more.begin(), more.end());
    start(words);
  }
  /// Goes on with a run.
  static std::unique_ptr<Daemon> resuming(const std::filesystem::path& run,
                                          const std::vector<std::string>& more = {}) {
    std::unique_ptr<Daemon> daemon(new Daemon);
    std::vector<std::string> words{"--resume", run.string()};
    words.insert(words.end(), more.begin(), more.end());
    daemon->start(words);
    return daemon;
  }
  ~Daemon() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void signal(int number) const { kill(pid_, number); }

  /// Waits for the end: the exit code, minus the signal that killed it, or -1000 when it goes on.
  int exit_code(std::chrono::seconds deadline = std::chrono::seconds(60)) {
    int status = 0;
    if (!eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, deadline)) {
      return -1000;
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  int stop() {
    signal(SIGINT);
    return exit_code();
  }

  /// The bridge that it runs now, 0 when there is none.
  pid_t bridge() const {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", pid_));
    pid_t child = 0;
    children >> child;
    return child;
  }

  std::string log() const {
    std::ostringstream text;
    text << std::ifstream(log_file()).rdbuf();
    return text.str();
  }
  pid_t pid() const { return pid_; }

 private:
  Daemon() = default;

  void start(std::vector<std::string> words) {
    words.insert(words.begin(), ADSTARD);
    std::vector<char*> argv;
    for (std::string& word : words) {
      argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, log_file().c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                     0644);
    if (posix_spawn(&pid_, ADSTARD, &actions, nullptr, argv.data(), environ) != 0) {
      std::perror("starting adstard");
      std::abort();
    }
    posix_spawn_file_actions_destroy(&actions);
  }

  std::string log_file() const { return (directory_.path() / "log").string(); }

  TemporaryDirectory directory_;
  pid_t pid_ = -1;
};

/// Commands and listens, as a user's program would.
class GroundStation {
 public:
  explicit GroundStation(const dds::ParticipantOptions& where)
      : participant_(where),
        commands_(participant_),
        answers_(participant_),
        attitude_(participant_),
        momentum_(participant_),
        status_(participant_) {}

  /// Takes everything that came; keeps the newest of each.
  void listen() {
    answers_.take([&](const adstar_CommandStatus& s, const dds_sample_info_t&) {
      answers[s.sequence_number].push_back(s);
    });
    attitude_.take([&](const adstar_AttitudeState& s, const dds_sample_info_t&) {
      attitude[std::string(dds::text_of(s.spacecraft))] = s;
    });
    momentum_.take([&](const adstar_MomentumState& s, const dds_sample_info_t&) {
      momentum[std::string(dds::text_of(s.spacecraft))] = s;
      ++momentum_samples;
      if (on_momentum) {
        on_momentum(s);
      }
    });
    status_.take([&](const adstar_ServiceStatus& s, const dds_sample_info_t&) { status = s; });
  }

  template <class Condition>
  bool until(Condition&& holds, std::chrono::milliseconds deadline = std::chrono::seconds(30)) {
    return eventually(
        [&] {
          listen();
          return holds();
        },
        deadline);
  }

  /// Once, whatever becomes of it.
  void write(const adstar_TorqueCommand& command) { commands_.write(command); }

  /// Writes until it is answered; the first answer.
  std::optional<adstar_CommandStatus> send(const adstar_TorqueCommand& command) {
    auto next = std::chrono::steady_clock::now();
    const bool answered = until([&] {
      if (std::chrono::steady_clock::now() >= next) {
        commands_.write(command);
        next = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
      }
      return !answers[command.sequence_number].empty();
    });
    if (!answered) {
      return std::nullopt;
    }
    return answers[command.sequence_number].front();
  }

  /// The final answer to a command that was sent.
  std::optional<adstar_CommandStatus> final_answer(std::uint64_t sequence) {
    const auto is_final = [](const adstar_CommandStatus& s) {
      return s.verdict != adstar_VERDICT_ACCEPTED;
    };
    if (!until([&] { return !answers[sequence].empty() && is_final(answers[sequence].back()); })) {
      return std::nullopt;
    }
    return answers[sequence].back();
  }

  adstar_TorqueCommand command(const std::string& spacecraft, std::array<double, 3> torque) {
    adstar_TorqueCommand c{};
    dds::set_text(c.spacecraft, spacecraft);
    dds::set_text(c.actuator, "body");
    c.commander = {0x1234, static_cast<std::uint64_t>(getpid())};
    c.sequence_number = ++sequence_;
    c.start_time_ns = runtime::kStartAtNextBeat;
    c.torque_n_m = {torque[0], torque[1], torque[2]};
    return c;
  }

  const dds::Participant& participant() const { return participant_; }

  std::map<std::uint64_t, std::vector<adstar_CommandStatus>> answers;
  std::map<std::string, adstar_AttitudeState> attitude;
  std::map<std::string, adstar_MomentumState> momentum;
  std::uint64_t momentum_samples = 0;
  std::function<void(const adstar_MomentumState&)> on_momentum;
  std::optional<adstar_ServiceStatus> status;

 private:
  dds::Participant participant_;
  dds::Writer<adstar_TorqueCommand> commands_;
  dds::Reader<adstar_CommandStatus> answers_;
  dds::Reader<adstar_AttitudeState> attitude_;
  dds::Reader<adstar_MomentumState> momentum_;
  dds::Reader<adstar_ServiceStatus> status_;
  std::uint64_t sequence_ = 0;
};

struct SceneOptions {
  std::string step = "10ms";
  double rate = 1;
  std::string duration = "endless";
  std::string frame = "body";
  double telemetry_hz = 50;
  std::string more = {};
};

/// The paper's body with one actuator.
inline std::string paper_scene(const dds::ParticipantOptions& where, const SceneOptions& o) {
  return fmt::format(R"([simulation]
step = "{}"
duration = "{}"
pace = "clock"
rate = {:f}
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[[spacecraft.torque]]
model = "commanded"
name = "body"
frame = "{}"
max_torque_n_m = [1.0, 1.0, 1.0]
[telemetry]
attitude_hz = {:f}
momentum_hz = {:f}
[service]
name = "fly"
[dds]
domain = {}
partition = "{}"
interface = "{}"
{})",
                     o.step, o.duration, o.rate, o.frame, o.telemetry_hz, o.telemetry_hz,
                     where.domain, where.partition, where.interface, o.more);
}

}  // namespace adstar::testing
