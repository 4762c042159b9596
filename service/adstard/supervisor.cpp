#include "service/adstard/supervisor.hpp"

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace adstar::adstard {
namespace {

/// 0 where the variable is not a number.
std::int64_t number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::strtoll(text, nullptr, 10);
}

}  // namespace

Supervisor::Supervisor(std::int64_t longest_turn_ns) : longest_turn_ns_(longest_turn_ns) {
  const char* const path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@') ||
      std::strlen(path) >= sizeof(sockaddr_un::sun_path)) {
    return;
  }
  address_ = path;
  if (address_[0] == '@') {
    address_[0] = '\0';
  }
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const std::int64_t watched = number_in("WATCHDOG_PID");
  if (watched == 0 || watched == getpid()) {
    constexpr std::int64_t kMicrosecond_ns = 1000;
    feed_every_ns_ = number_in("WATCHDOG_USEC") * kMicrosecond_ns / 2;
  }
}

Supervisor::~Supervisor() {
  if (socket_ >= 0) {
    close(socket_);
  }
}

void Supervisor::ready(std::string_view status) { send("READY=1\nSTATUS=" + std::string(status)); }

void Supervisor::tell(std::string_view status) { send("STATUS=" + std::string(status)); }

void Supervisor::stopping() { send("STOPPING=1"); }

void Supervisor::look(std::uint64_t turns, std::int64_t now_ns) {
  if (turns != turns_) {
    turns_ = turns;
    turned_ns_ = now_ns;
  }
  const bool alive = now_ns - turned_ns_ <= longest_turn_ns_ + feed_every_ns_;
  if (feed_every_ns_ > 0 && alive && now_ns >= next_feed_ns_) {
    next_feed_ns_ = now_ns + feed_every_ns_;
    send("WATCHDOG=1");
  }
}

/// Nobody is waited for: what the manager has no room for it does without.
void Supervisor::send(std::string_view message) {
  if (socket_ < 0) {
    return;
  }
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  [[maybe_unused]] const ssize_t sent =
      sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL,
             reinterpret_cast<const sockaddr*>(&to), length);
}

}  // namespace adstar::adstard
