#include "service/dds/device_binding.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <linux/sock_diag.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/stat.h>

#include <fmt/format.h>

#include "service/dds/error.hpp"

namespace adstar::dds {
namespace {

int int_option(int fd, int option) {
  int value = -1;
  socklen_t size = sizeof value;
  return getsockopt(fd, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

bool is_udp(int fd) {
  const int family = int_option(fd, SO_DOMAIN);
  return (family == AF_INET || family == AF_INET6) && int_option(fd, SO_PROTOCOL) == IPPROTO_UDP;
}

std::string bound_device(int fd) {
  std::array<char, IFNAMSIZ> name{};
  socklen_t size = name.size();
  if (getsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, name.data(), &size) != 0) {
    return {};
  }
  return {name.data(), strnlen(name.data(), name.size())};
}

}  // namespace

std::vector<SocketId> open_udp_sockets() {
  std::vector<SocketId> sockets;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    struct stat info {};
    if (fd >= 0 && fstat(fd, &info) == 0 && S_ISSOCK(info.st_mode) && is_udp(fd)) {
      sockets.emplace_back(fd, info.st_ino);
    }
  }
  return sockets;
}

std::size_t bind_udp_sockets(const std::string& interface, const std::vector<SocketId>& spared) {
  std::size_t bound = 0;
  for (const SocketId& socket : open_udp_sockets()) {
    if (std::find(spared.begin(), spared.end(), socket) != spared.end()) {
      continue;
    }
    const int fd = socket.first;
    // A socket that is bound already may not be bound again without privileges, and need not.
    if (bound_device(fd) != interface &&
        setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, interface.data(),
                   static_cast<socklen_t>(interface.size())) != 0) {
      throw Error(
          fmt::format("cannot confine a DDS socket to interface '{}' (SO_BINDTODEVICE: {}): it "
                      "would be reachable from every "
                      "network of this machine; Linux 5.7 or the capability CAP_NET_RAW allows it",
                      interface, std::strerror(errno)));
    }
    if (bound_device(fd) != interface) {
      throw Error(
          fmt::format("a DDS socket was confined to interface '{}', but reads back '{}': it may be "
                      "reachable from other "
                      "networks of this machine; run on a kernel that supports SO_BINDTODEVICE",
                      interface, bound_device(fd)));
    }
    ++bound;
  }
  return bound;
}

std::uint64_t datagrams_dropped(const std::vector<SocketId>& spared) {
  std::uint64_t dropped = 0;
  for (const SocketId& socket : open_udp_sockets()) {
    std::array<std::uint32_t, SK_MEMINFO_VARS> account{};
    socklen_t size = sizeof account;
    if (std::find(spared.begin(), spared.end(), socket) == spared.end() &&
        getsockopt(socket.first, SOL_SOCKET, SO_MEMINFO, account.data(), &size) == 0) {
      dropped += account[SK_MEMINFO_DROPS];
    }
  }
  return dropped;
}

void require_interface(const std::string& interface) {
  if (if_nametoindex(interface.c_str()) != 0) {
    return;
  }
  std::string known;
  const std::unique_ptr<struct if_nameindex, decltype(&if_freenameindex)> list(if_nameindex(),
                                                                               &if_freenameindex);
  for (const struct if_nameindex* i = list.get(); i != nullptr && i->if_index != 0; ++i) {
    known += (known.empty() ? "" : ", ") + std::string(i->if_name);
  }
  throw Error(fmt::format("no network interface '{}'; try one of: {}", interface,
                          known.empty() ? "none is visible here" : known));
}

}  // namespace adstar::dds
