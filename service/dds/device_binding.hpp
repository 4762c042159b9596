#pragma once
// Loopback means loopback. Cyclone's sockets bind the wildcard address whatever interface it is
// told to use, so a datagram that arrives on any other interface would reach them. SO_BINDTODEVICE
// closes that (Linux 5.7 and later allow it without privileges).

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace adstar::dds {

/// A socket of this process: file descriptor and inode, so that a reused descriptor is not mistaken
/// for an old one.
using SocketId = std::pair<int, ino_t>;

/// The UDP sockets (IPv4 and IPv6) that this process has open.
std::vector<SocketId> open_udp_sockets();

/// Binds every open UDP socket but `spared` to the interface and reads the binding back. Returns
/// how many are bound. Throws Error: a socket that listens to the world must not go unnoticed.
std::size_t bind_udp_sockets(const std::string& interface, const std::vector<SocketId>& spared);

/// Datagrams that the kernel dropped because nobody read these sockets in time. `spared` are not counted.
std::uint64_t datagrams_dropped(const std::vector<SocketId>& spared);

/// Throws Error with the names that exist when there is no such interface.
void require_interface(const std::string& interface);

}  // namespace adstar::dds
