#pragma once
// Cache lines that are to be written, brought near ahead.

#include <cstddef>
#include <vector>

namespace adstar::runtime {

inline constexpr std::size_t kLineBytes = 64;

/// The line of this address, which another processor has read, is to be ours when it is written: many are on their way
/// at once. Never faults.
inline void claim(const void* address) noexcept {
#if defined(__x86_64__)
  asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(address)));
#else
  __builtin_prefetch(address, 1);
#endif
}

/// Reads a part of what was not touched for long. Of 464 kB that nobody had touched for a second the copy took 0.5 to 1.8 ms,
/// and 0.1 ms where this was done in the beats before; asking ahead (claim) had little effect.
template <class Value>
void bring_near(const std::vector<Value>& values, std::size_t part, std::size_t parts) noexcept {
  const auto* const bytes = reinterpret_cast<const volatile char*>(values.data());
  const std::size_t size = values.size() * sizeof(Value);
  for (std::size_t i = size * part / parts; i < size * (part + 1) / parts; i += kLineBytes) {
    static_cast<void>(bytes[i]);
  }
}

}  // namespace adstar::runtime
