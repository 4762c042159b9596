#pragma once
// The service manager's end of sd_notify(3), in a directory of its own.

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace adstar::test {

class NotifySocket {
 public:
  NotifySocket() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "adstar-notify.XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
    path_ = (directory_ / "socket").string();
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot bind " + path_);
    }
  }
  ~NotifySocket() {
    close(socket_);
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  const std::string& path() const { return path_; }

  /// The next message; empty when none came in time.
  std::string next(int patience_ms) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, patience_ms) <= 0) {
      return {};
    }
    char text[512];
    const ssize_t length = recv(socket_, text, sizeof text, 0);
    return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : std::string();
  }

 private:
  std::filesystem::path directory_;
  std::string path_;
  int socket_ = -1;
};

}  // namespace adstar::test
