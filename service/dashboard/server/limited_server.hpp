#pragma once
// The library's server with an end to every wait: it counts a read's time byte by byte, so that a client that sends
// its head slowly would hold a thread, and the end of the program, as long as it likes.
// The time that a connection waits for a thread counts, so that many who say nothing are let go together.
//
// One request a connection: what a refused one leaves unread is never taken for another.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <httplib.h>
#include <sys/socket.h>

namespace adstar::dashboard {

class LimitedServer final : public httplib::Server {
 public:
  /// From its coming to the last byte of its request; what is there then is read all the same.
  static constexpr std::chrono::seconds kRequestPatience{2};
  /// For a client that takes nothing of its answer.
  static constexpr std::chrono::seconds kAnswerPatience{2};

  /// Once `ending` is true nothing more is read, and nothing waits for a client.
  LimitedServer(const std::atomic<bool>& ending, std::size_t threads);

  /// Once it is bound: as many as the system allows may connect at once. With the queue of 5 that Debian's library is
  /// compiled with, a browser whose packet is dropped hears nothing for a second, then for two more.
  void lengthen_queue() { ::listen(svr_sock_, SOMAXCONN); }

 private:
  bool process_and_close_socket(socket_t socket) override;

  const std::atomic<bool>& ending_;
};

}  // namespace adstar::dashboard
