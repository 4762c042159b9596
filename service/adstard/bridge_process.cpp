#include "service/adstard/bridge_process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <time.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

extern char** environ;

namespace adstar::adstard {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kFirstBackoff = 10 * kMillisecond;
constexpr std::int64_t kLongestBackoff = 500 * kMillisecond;
constexpr std::int64_t kGoodRun =
    5000 * kMillisecond;  // ran this long: the next back-off is short again

// Where the bridge finds what it inherits, well above what a library may have open.
constexpr int kSegmentFd = 100;
constexpr int kSceneFd = 101;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

void check(int error, const char* what) {
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), what);
  }
}

std::string describe(int status) {
  if (WIFEXITED(status)) {
    return fmt::format("ended with code {}", WEXITSTATUS(status));
  }
  return fmt::format("was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
}

/// Owns the attributes and file actions of one spawn.
struct SpawnPlan {
  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_t actions{};
  SpawnPlan() {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
  }
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

}  // namespace

std::string bridge_beside_this_program() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "adstar-bridge").string();
}

BridgeProcess::BridgeProcess(BridgeCommand command)
    : command_(std::move(command)),
      program_fd_(open(command_.program.c_str(), O_PATH | O_CLOEXEC)) {
  if (program_fd_ < 0) {
    throw std::system_error(errno, std::generic_category(), "starting " + command_.program);
  }
}

BridgeProcess::~BridgeProcess() {
  finish(0);
  close(program_fd_);
}

void BridgeProcess::start() {
  SpawnPlan plan;
  check(posix_spawn_file_actions_adddup2(&plan.actions, command_.segment_fd, kSegmentFd), "dup2");
  check(posix_spawn_file_actions_adddup2(&plan.actions, command_.scene_fd, kSceneFd), "dup2");
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  const sched_param ordinary{};
  posix_spawnattr_setsigmask(&plan.attributes, &none);
  posix_spawnattr_setsigdefault(&plan.attributes, &all);
  posix_spawnattr_setpgroup(&plan.attributes, 0);  // Ctrl-C reaches adstard alone
  posix_spawnattr_setschedpolicy(&plan.attributes, SCHED_OTHER);
  posix_spawnattr_setschedparam(&plan.attributes, &ordinary);
  check(posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                       POSIX_SPAWN_SETPGROUP |
                                                       POSIX_SPAWN_SETSCHEDULER),
        "posix_spawnattr_setflags");

  std::vector<std::string> arguments{
      command_.program,
      "--segment-fd",
      std::to_string(kSegmentFd),
      "--scene-fd",
      std::to_string(kSceneFd),
      "--scene-file",
      command_.scene_file,
      "--service",
      command_.service,
      "--instance",
      fmt::format("{:016x}{:016x}", command_.instance.high, command_.instance.low),
      "--started-utc-ns",
      std::to_string(command_.started_utc_ns),
      "--parent",
      std::to_string(getpid())};
  if (!command_.run.empty()) {
    arguments.insert(arguments.end(), {"--run", command_.run});
  }
  if (command_.standby) {
    arguments.push_back("--standby");
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  const std::string program = fmt::format("/proc/self/fd/{}", program_fd_);
  const int error =
      posix_spawn(&pid_, program.c_str(), &plan.actions, &plan.attributes, argv.data(), environ);
  if (error != 0) {
    pid_ = -1;
    throw std::system_error(error, std::generic_category(), "starting " + command_.program);
  }
  started_ns_ = monotonic_ns();
}

bool BridgeProcess::alive() {
  if (pid_ < 0) {
    return false;
  }
  int status = 0;
  const pid_t ended = waitpid(pid_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) {
    return true;
  }
  pid_ = -1;
  how_ = ended < 0 ? "is gone" : describe(status);
  exit_code_ = ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const std::int64_t now = monotonic_ns();
  backoff_ns_ = now - started_ns_ > kGoodRun || backoff_ns_ == 0
                    ? kFirstBackoff
                    : std::min(2 * backoff_ns_, kLongestBackoff);
  restart_at_ns_ = now + backoff_ns_;
  return false;
}

void BridgeProcess::kill_now() const {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
  }
}

bool BridgeProcess::restart_when_due(std::int64_t now_ns) {
  if (pid_ >= 0 || now_ns < restart_at_ns_) {
    return false;
  }
  start();
  ++restarts_;
  return true;
}

void BridgeProcess::finish(int patience_ms) {
  const std::int64_t patience_ends = monotonic_ns() + patience_ms * kMillisecond;
  while (alive() && monotonic_ns() < patience_ends) {
    const timespec nap{0, 5 * kMillisecond};
    nanosleep(&nap, nullptr);
  }
  if (alive()) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
    how_ = "did not end in time and was killed";
  }
}

}  // namespace adstar::adstard
