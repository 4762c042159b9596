#include "service/batch/kernels.hpp"

#include "service/batch/named_kernels.hpp"

namespace adstar::batch {
namespace {

struct Entry {
  const char* name;
  std::size_t width;
  const Table& table;
};

const Entry& entry(InstructionSet set) noexcept {
  static const Entry kEntries[] = {
      {"SSE2", 2, kSse2Table}, {"AVX2", 4, kAvx2Table}, {"AVX-512", 8, kAvx512Table}};
  return kEntries[static_cast<std::size_t>(set)];
}

}  // namespace

const char* name_of(InstructionSet set) noexcept { return entry(set).name; }

std::size_t width_of(InstructionSet set) noexcept { return entry(set).width; }

bool runs_here(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::sse2:
      return true;  // of every x86-64
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") != 0;
  }
  return false;
}

const Kernels* find_kernels(std::string_view scheme, InstructionSet set) noexcept {
  const Table& table = entry(set).table;
  for (std::size_t i = 0; i < table.count; ++i) {
    if (scheme == table.entries[i].scheme) {
      return &table.entries[i].kernels;
    }
  }
  return nullptr;
}

std::optional<InstructionSet> best_for(std::string_view scheme, std::size_t bodies) noexcept {
  std::optional<InstructionSet> best;
  for (const InstructionSet set : kInstructionSets) {
    if (runs_here(set) && bodies >= width_of(set) && find_kernels(scheme, set) != nullptr) {
      best = set;
    }
  }
  return best;
}

}  // namespace adstar::batch
