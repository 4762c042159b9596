#include "service/dashboard/server/limited_server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace adstar::dashboard {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// When the connection that this thread serves had come.
thread_local Clock::time_point came;

/// The library's threads, and beside each task when it came.
class StampedQueue final : public httplib::TaskQueue {
 public:
  explicit StampedQueue(std::size_t threads) : pool_(threads) {}

  void enqueue(std::function<void()> task) override {
    pool_.enqueue([task = std::move(task), now = Clock::now()] {
      came = now;
      task();
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
};

class Connection final : public httplib::Stream {
 public:
  Connection(int socket, const std::atomic<bool>& ending) : socket_(socket), ending_(ending) {}

  bool is_readable() const override { return at_ < filled_ || is_ready(POLLIN, 0ms); }
  bool is_writable() const override { return may_write(); }
  int socket() const override { return socket_; }
  // Everybody is on loopback.
  void get_remote_ip_and_port(std::string& ip, int& port) const override { unknown(ip, port); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { unknown(ip, port); }

  ssize_t read(char* to, std::size_t size) override {
    if (at_ == filled_) {
      if (!may_read()) {
        return -1;
      }
      const ssize_t count = recv(socket_, block_.data(), block_.size(), MSG_DONTWAIT);
      if (count <= 0) {
        return count;
      }
      at_ = 0;
      filled_ = static_cast<std::size_t>(count);
    }
    const std::size_t taken = std::min(size, filled_ - at_);
    std::memcpy(to, block_.data() + at_, taken);
    at_ += taken;
    return static_cast<ssize_t>(taken);
  }

  ssize_t write(const char* from, std::size_t size) override {
    return may_write() ? send(socket_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL) : -1;
  }

 private:
  static constexpr auto kGlance = 50ms;  ///< between two looks at `ending_`

  static void unknown(std::string& ip, int& port) {
    ip.clear();
    port = 0;
  }

  bool is_ready(short event, Clock::duration patience) const {
    pollfd looked{socket_, event, 0};
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(patience);
    return poll(&looked, 1, static_cast<int>(std::max<std::int64_t>(wait.count(), 0))) > 0;
  }
  /// What is there is read though its time is over: it came while the connection waited for a thread.
  bool may_read() const {
    while (!ending_) {
      const Clock::duration left = deadline_ - Clock::now();
      if (is_ready(POLLIN, std::min<Clock::duration>(kGlance, left))) {
        return true;
      }
      if (left <= 0s) {
        return false;
      }
    }
    return false;
  }
  /// What fits at once is written even at the end.
  bool may_write() const {
    const auto deadline = Clock::now() + LimitedServer::kAnswerPatience;
    do {
      if (is_ready(POLLOUT, kGlance)) {
        return true;
      }
    } while (!ending_ && Clock::now() < deadline);
    return false;
  }

  int socket_;
  const std::atomic<bool>& ending_;
  Clock::time_point deadline_ = came + LimitedServer::kRequestPatience;
  std::array<char, 4096> block_;
  std::size_t at_ = 0, filled_ = 0;  ///< of the block
};

}  // namespace

LimitedServer::LimitedServer(const std::atomic<bool>& ending, std::size_t threads)
    : ending_(ending) {
  new_task_queue = [threads] { return new StampedQueue(threads); };
}

bool LimitedServer::process_and_close_socket(socket_t socket) {
  Connection connection(socket, ending_);
  constexpr bool kCloses = true;
  bool closed = false;
  const bool done = process_request(connection, kCloses, closed, nullptr);
  shutdown(socket, SHUT_RDWR);
  close(socket);
  return done;
}

}  // namespace adstar::dashboard
