#pragma once
// How a translation unit of one instruction set hands its kernels to the rest of the program.

#include <cstddef>

#include "adstar/batch/fleet_view.hpp"

namespace adstar::batch {

struct NamedKernels {
  const char* scheme;
  Kernels kernels;
};

struct Table {
  const NamedKernels* entries;
  std::size_t count;
};

extern const Table kSse2Table, kAvx2Table, kAvx512Table;

}  // namespace adstar::batch
