#pragma once
// What a service manager is told (sd_notify(3): datagrams to the socket that NOTIFY_SOCKET names): ready, ending, and that
// the tick is alive, fed by the tick itself: a tick that hangs is not vouched for. Without that variable nothing is sent.

#include <cstdint>
#include <string>
#include <string_view>

namespace adstar::adstard {

class Supervisor {
 public:
  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID. `longest_turn_ns`: what the tick may take for a turn of its
  /// loop in good order, the sleep to the next beat in it.
  explicit Supervisor(std::int64_t longest_turn_ns);
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  void ready(std::string_view status);
  void tell(std::string_view status);
  void stopping();

  /// Every few milliseconds: `turns` of the tick's loop. Says that it lives twice within the watchdog's time, unless
  /// it has not turned for that long and its longest turn.
  void look(std::uint64_t turns, std::int64_t now_ns);
  /// The same where there is no tick yet.
  void look(std::int64_t now_ns) { look(turns_ + 1, now_ns); }

 private:
  void send(std::string_view message);

  int socket_ = -1;
  std::string address_;             ///< sun_path; an abstract one begins with '\0'
  std::int64_t feed_every_ns_ = 0;  ///< 0: nobody watches
  std::int64_t next_feed_ns_ = 0;
  std::int64_t longest_turn_ns_;
  std::uint64_t turns_ = 0;
  std::int64_t turned_ns_ = 0;  ///< when it was last seen to turn
};

}  // namespace adstar::adstard
