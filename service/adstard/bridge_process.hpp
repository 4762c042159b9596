#pragma once
// adstar-bridge as a child process: started, watched, restarted with back-off, stopped.
//
// The program is opened once, and each bridge is that very file: an upgrade puts another in its place, which does not know
// this daemon's shared memory.

#include <cstdint>
#include <string>
#include <sys/types.h>

#include "service/runtime/records.hpp"

namespace adstar::adstard {

struct BridgeCommand {
  std::string program;  ///< path of adstar-bridge
  int segment_fd = -1;
  int scene_fd = -1;
  std::string scene_file;
  std::string service;
  runtime::CommanderId instance;
  std::int64_t started_utc_ns = 0;
  bool standby = false;
  std::string run;  ///< directory; empty: none
};

/// adstar-bridge beside the running program.
std::string bridge_beside_this_program();

class BridgeProcess {
 public:
  explicit BridgeProcess(BridgeCommand command);
  ~BridgeProcess();
  BridgeProcess(const BridgeProcess&) = delete;
  BridgeProcess& operator=(const BridgeProcess&) = delete;

  /// Throws std::system_error. Call from the main thread: the bridge dies with the thread that
  /// started it.
  void start();

  /// True as long as it runs. Once it has ended: how() says how, and exit_code() its code or -1.
  bool alive();
  const std::string& how() const noexcept { return how_; }
  int exit_code() const noexcept { return exit_code_; }

  /// For one that no longer does its work; alive() then tells its end.
  void kill_now() const;

  /// Restarts it if it has ended and its back-off is over; true when it did. `now_ns` is monotonic.
  bool restart_when_due(std::int64_t now_ns);
  std::uint64_t restarts() const noexcept { return restarts_; }

  /// Waits for it to end by itself, then makes it. Call after stop_requested was set.
  void finish(int patience_ms);

 private:
  BridgeCommand command_;
  int program_fd_;
  pid_t pid_ = -1;
  std::string how_;
  int exit_code_ = -1;
  std::uint64_t restarts_ = 0;
  std::int64_t started_ns_ = 0;
  std::int64_t restart_at_ns_ = 0;
  std::int64_t backoff_ns_ = 0;
};

}  // namespace adstar::adstard
