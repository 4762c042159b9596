#pragma once
// Plays adstard for one adstar-bridge: makes the segment, starts the bridge, looks at what it does.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <spawn.h>
#include <string>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "service/dds/participant.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/dds_domain.hpp"

namespace adstar::testing {

/// Polls until it holds; false after the deadline.
template <class Condition>
bool eventually(Condition&& holds, std::chrono::milliseconds deadline = std::chrono::seconds(20)) {
  const auto until = std::chrono::steady_clock::now() + deadline;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// A domain and a partition that no other test process uses at the same time. No socket of another program may have the
/// ports of these domains (kMostSafeDomain).
inline dds::ParticipantOptions private_corner(std::string interface = "lo") {
  const auto pid = static_cast<std::uint32_t>(getpid());
  return {20 + pid % (scene::kMostSafeDomain - 19), std::move(interface),
          fmt::format("test.{}", pid)};
}

/// Two spacecraft, three actuators.
inline std::string two_spacecraft(const dds::ParticipantOptions& where) {
  constexpr const char* kBody = R"(
[[spacecraft]]
name = "{}"
inertia_body_kg_m2 = [0.9, 1.1, 1.6]
)";
  constexpr const char* kActuator = R"(
[[spacecraft.torque]]
model = "commanded"
name = "{}"
frame = "body"
max_torque_n_m = [1.0, 1.0, 1.0]
)";
  return fmt::format(
             "[simulation]\nstep = \"10ms\"\n[service]\nname = \"fly\"\n[dds]\ndomain = "
             "{}\npartition = \"{}\"\n"
             "interface = \"{}\"\n",
             where.domain, where.partition, where.interface) +
         fmt::format(kBody, "sat1") + fmt::format(kActuator, "body") + fmt::format(kBody, "sat2") +
         fmt::format(kActuator, "wheels") + fmt::format(kActuator, "jets");
}

inline std::string fleet(const dds::ParticipantOptions& where, std::size_t count) {
  return fmt::format(
      "[simulation]\nstep = \"10ms\"\n[dds]\ndomain = {}\npartition = \"{}\"\ninterface = \"{}\"\n"
      "[[spacecraft]]\nname = \"f{{:05}}\"\ncount = {}\ninertia_body_kg_m2 = [0.9, 1.1, 1.6]\n",
      where.domain, where.partition, where.interface, count);
}

class BridgeUnderTest {
 public:
  static constexpr std::int64_t kStarted = 1'000'000;

  BridgeUnderTest(const std::string& scene, std::size_t spacecraft)
      : segment_(runtime::MappedSegment::create(spacecraft)),
        scene_fd_(memfd_create("scene", MFD_CLOEXEC)) {
    if (write(scene_fd_, scene.data(), scene.size()) != static_cast<ssize_t>(scene.size())) {
      std::perror("writing the scene");
      std::abort();
    }
  }
  ~BridgeUnderTest() {
    if (pid_ > 0) {
      kill_hard();
    }
    close(scene_fd_);
  }
  BridgeUnderTest(const BridgeUnderTest&) = delete;
  BridgeUnderTest& operator=(const BridgeUnderTest&) = delete;

  void start(pid_t claimed_parent = getpid()) {
    const std::vector<std::string> words{ADSTAR_BRIDGE,
                                         "--segment-fd",
                                         "40",
                                         "--scene-fd",
                                         "41",
                                         "--scene-file",
                                         "test.toml",
                                         "--service",
                                         "fly",
                                         "--instance",
                                         "00000000000000aa00000000000000bb",
                                         "--started-utc-ns",
                                         std::to_string(kStarted),
                                         "--parent",
                                         std::to_string(claimed_parent)};
    std::vector<char*> argv;
    for (const std::string& word : words) {
      argv.push_back(const_cast<char*>(word.c_str()));
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, segment_.fd(), 40);
    posix_spawn_file_actions_adddup2(&actions, scene_fd_, 41);
    if (posix_spawn(&pid_, ADSTAR_BRIDGE, &actions, nullptr, argv.data(), environ) != 0) {
      pid_ = -1;
    }
    posix_spawn_file_actions_destroy(&actions);
  }

  bool is(runtime::BridgeState state) {
    return segment_->bridge_state.load() == static_cast<std::uint32_t>(state);
  }
  bool becomes(runtime::BridgeState state) {
    return eventually([&] { return is(state); });
  }

  /// Waits for the end: the exit code, minus the signal that killed it, or -1000 when it goes on.
  int exit_code() {
    int status = 0;
    if (!eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; })) {
      return -1000;
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  void signal(int number) { kill(pid_, number); }
  void kill_hard() {
    signal(SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  void ask_to_stop() {
    segment_->stop_requested.store(1);
    runtime::wake_bridge(*segment_);
  }

  runtime::MappedSegment& segment() { return segment_; }
  pid_t pid() const { return pid_; }

 private:
  runtime::MappedSegment segment_;
  int scene_fd_;
  pid_t pid_ = -1;
};

}  // namespace adstar::testing
