#pragma once

#include <cstdint>

namespace adstar::scene {

/// A domain has ports from 7400 + 250 domain on (RTPS 2.3, 9.6.1.1). From 32768 on Linux hands them to any socket that
/// asks for none in particular (net.ipv4.ip_local_port_range), and a participant in such a domain may find its own taken.
inline constexpr std::uint32_t kMostSafeDomain = 101;

}  // namespace adstar::scene
