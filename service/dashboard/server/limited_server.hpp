#pragma once
// The library's server with an end to every wait: it counts a read's time byte by byte, so that a client that sends
// its head slowly would hold a thread, and the end of the program, as long as it likes.
//
// One request a connection: what a refused one leaves unread is never taken for another.

#include <atomic>
#include <chrono>
#include <httplib.h>

namespace adstar::dashboard {

class LimitedServer final : public httplib::Server {
 public:
  /// From its coming to the last byte of its request.
  static constexpr std::chrono::seconds kRequestPatience{2};
  /// For a client that takes nothing of its answer.
  static constexpr std::chrono::seconds kAnswerPatience{2};

  /// Once `ending` is true nothing more is read, and nothing waits for a client.
  explicit LimitedServer(const std::atomic<bool>& ending) : ending_(ending) {}

 private:
  bool process_and_close_socket(socket_t socket) override;

  const std::atomic<bool>& ending_;
};

}  // namespace adstar::dashboard
