#pragma once
// Datagrams that no DDS sends: noise, RTPS headers with nonsense behind them, genuine announcements
// with bits turned over.

#include <arpa/inet.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <netinet/in.h>
#include <random>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace adstar::testing {

using Datagram = std::vector<std::uint8_t>;

/// A UDP socket that cannot leave loopback.
class LoopbackSocket {
 public:
  LoopbackSocket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const timeval patience{0, 200'000};
    const int yes = 1;
    setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    setsockopt(fd_, SOL_SOCKET, SO_REUSEPORT, &yes, sizeof yes);
    if (setsockopt(fd_, SOL_SOCKET, SO_BINDTODEVICE, "lo", 2) != 0) {
      std::perror("SO_BINDTODEVICE lo");
      std::abort();
    }
  }
  ~LoopbackSocket() { close(fd_); }
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  /// Hears what participants of the domain announce (RTPS 2.3, 9.6.1.1).
  void hear_announcements(std::uint32_t domain) {
    sockaddr_in any = address(static_cast<std::uint16_t>(7400 + 250 * domain));
    any.sin_addr.s_addr = htonl(INADDR_ANY);
    ip_mreq group{};
    inet_pton(AF_INET, "239.255.0.1", &group.imr_multiaddr);
    inet_pton(AF_INET, "127.0.0.1", &group.imr_interface);
    if (bind(fd_, reinterpret_cast<sockaddr*>(&any), sizeof any) != 0 ||
        setsockopt(fd_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0) {
      std::perror("joining the announcements");
      std::abort();
    }
  }

  Datagram receive() {
    Datagram datagram(65536);
    const ssize_t size = recv(fd_, datagram.data(), datagram.size(), 0);
    datagram.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return datagram;
  }

  void send(const Datagram& datagram, std::uint16_t port) {
    const sockaddr_in target = address(port);
    sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&target),
           sizeof target);
  }

 private:
  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    return address;
  }
  int fd_;
};

/// So many announcements of the domain's participants, or what came within 20 s.
inline std::vector<Datagram> announcements(std::uint32_t domain, std::size_t count) {
  LoopbackSocket socket;
  socket.hear_announcements(domain);
  std::vector<Datagram> heard;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (heard.size() < count && std::chrono::steady_clock::now() < until) {
    if (Datagram datagram = socket.receive(); !datagram.empty()) {
      heard.push_back(std::move(datagram));
    }
  }
  return heard;
}

inline std::uint8_t byte(std::mt19937_64& random) { return static_cast<std::uint8_t>(random()); }

/// "RTPS", a version, a prefix, then submessages of any kind whose lengths may lie.
inline Datagram nonsense_submessages(std::mt19937_64& random) {
  Datagram datagram{'R', 'T', 'P', 'S', 2, static_cast<std::uint8_t>(random() % 6), 1, 16};
  for (int i = 0; i < 12; ++i) {
    datagram.push_back(byte(random));
  }
  constexpr std::uint8_t kKinds[] = {0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d, 0x0e, 0x0f, 0x12,
                                     0x13, 0x15, 0x16, 0x30, 0x31, 0x32, 0x33, 0x34, 0x80, 0xff};
  for (std::uint64_t n = random() % 4; n > 0; --n) {
    datagram.push_back(kKinds[random() % std::size(kKinds)]);
    datagram.push_back(byte(random));
    const std::size_t size = random() % 96;
    const std::size_t claimed = random() % 4 == 0 ? random() % 65536 : size;
    datagram.push_back(static_cast<std::uint8_t>(claimed));
    datagram.push_back(static_cast<std::uint8_t>(claimed >> 8));
    for (std::size_t k = 0; k < size; ++k) {
      datagram.push_back(random() % 3 == 0 ? byte(random) : std::uint8_t{0});
    }
  }
  return datagram;
}

inline Datagram noise(std::mt19937_64& random) {
  Datagram datagram(random() % 2000);
  for (std::uint8_t& each : datagram) {
    each = byte(random);
  }
  return datagram;
}

/// Behind the header; a few bytes turned, doubled, cut.
inline Datagram mutated(const Datagram& original, std::mt19937_64& random) {
  Datagram datagram = original;
  for (std::uint64_t n = 1 + random() % 6; n > 0 && datagram.size() > 24; --n) {
    const std::size_t place = 20 + random() % (datagram.size() - 20);
    switch (random() % 4) {
      case 0:
        datagram[place] = byte(random);
        break;
      case 1:
        datagram[place] = random() % 2 == 0 ? 0xff : 0x00;
        break;
      case 2:
        datagram[place] = static_cast<std::uint8_t>(datagram[place] ^ (1U << (random() % 8)));
        break;
      default:
        if (random() % 8 == 0) {
          datagram.resize(place);
        }
    }
  }
  return datagram;
}

/// One of them, drawn.
inline Datagram hostile_datagram(const std::vector<Datagram>& genuine, std::mt19937_64& random) {
  const std::uint64_t kind = random() % 8;
  return kind == 0  ? noise(random)
         : kind < 4 ? nonsense_submessages(random)
                    : mutated(genuine[random() % genuine.size()], random);
}

}  // namespace adstar::testing
