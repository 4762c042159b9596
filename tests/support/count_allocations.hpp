#pragma once
// Counts every heap request of the process. Link count_allocations.cpp; glibc only, and not under
// sanitizers.

#include <cstdint>

namespace adstar::test {

std::uint64_t allocation_count();

}  // namespace adstar::test
