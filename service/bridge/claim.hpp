#pragma once
// Who of two daemons of one service is the primary.

#include <cstdint>
#include <tuple>

#include "service/runtime/records.hpp"

namespace adstar::bridge {

/// A term, and the process that flies in it.
struct Claim {
  std::uint64_t term = 0;
  runtime::CommanderId instance;
};

/// The higher term; of equal ones, the lower process.
inline bool goes_before(const Claim& a, const Claim& b) noexcept {
  return a.term != b.term ? a.term > b.term
                          : std::tie(a.instance.high, a.instance.low) <
                                std::tie(b.instance.high, b.instance.low);
}

}  // namespace adstar::bridge
