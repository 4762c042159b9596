#pragma once
// Runs a program as a user would, and hears what it says. Output goes to memory files, so that no
// pipe ever fills, and can be read while the program runs. Every wait has a deadline.

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace adstar::testing {

struct ProcessOptions {
  std::string directory;                 ///< to run in; empty: here
  std::vector<std::string> environment;  ///< "NAME=value", added to ours
};

/// A program in the background; killed when it goes out of scope.
class Process {
 public:
  explicit Process(const std::vector<std::string>& argv, const ProcessOptions& options = {})
      : out_(memfd_create("out", MFD_CLOEXEC)), err_(memfd_create("err", MFD_CLOEXEC)) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out_, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_, STDERR_FILENO);
    if (!options.directory.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions, options.directory.c_str());
    }
    std::vector<char*> arguments = pointers(argv), environment = pointers(options.environment);
    environment.pop_back();
    for (char** variable = environ; *variable != nullptr; ++variable) {
      environment.push_back(*variable);
    }
    environment.push_back(nullptr);
    const int error =
        posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      throw std::runtime_error("cannot start " + argv[0] + ": " + std::strerror(error));
    }
  }

  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  ~Process() {
    if (!exit_code_) {
      kill(pid_, SIGKILL);
      int status = 0;
      waitpid(pid_, &status, 0);
    }
    close(out_);
    close(err_);
  }

  pid_t pid() const { return pid_; }
  void send(int signal) const { kill(pid_, signal); }

  /// So far.
  std::string out() const { return text_of(out_); }
  std::string err() const { return text_of(err_); }

  /// Nothing while it runs; 128 + n when signal n ended it.
  std::optional<int> exit_code() {
    int status = 0;
    if (!exit_code_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return exit_code_;
  }

  /// The exit code; throws when it still runs at the deadline.
  int wait(std::chrono::milliseconds deadline = std::chrono::seconds(60)) {
    const auto until = std::chrono::steady_clock::now() + deadline;
    while (!exit_code()) {
      if (std::chrono::steady_clock::now() > until) {
        throw std::runtime_error("still running at the deadline; it said:\n" + out() + err());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return *exit_code_;
  }

 private:
  static std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> result;
    for (const std::string& word : words) {
      result.push_back(const_cast<char*>(word.c_str()));
    }
    result.push_back(nullptr);
    return result;
  }

  static std::string text_of(int fd) {
    std::string text;
    char block[4096];
    ssize_t n = 0;
    while ((n = pread(fd, block, sizeof block, static_cast<off_t>(text.size()))) > 0) {
      text.append(block, static_cast<std::size_t>(n));
    }
    return text;
  }

  pid_t pid_ = 0;
  int out_, err_;
  std::optional<int> exit_code_;
};

struct Outcome {
  int code = 0;
  std::string out, err;
};

/// Runs it to its end.
inline Outcome run(const std::vector<std::string>& argv, const ProcessOptions& options = {},
                   std::chrono::milliseconds deadline = std::chrono::seconds(60)) {
  Process process(argv, options);
  const int code = process.wait(deadline);
  return {code, process.out(), process.err()};
}

}  // namespace adstar::testing
