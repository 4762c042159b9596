#pragma once
// The batch kernels that this program carries, one set an instruction set, and which of them this
// processor runs. All give the same bits; the wider is the faster.

#include <cstddef>
#include <optional>
#include <string_view>

#include "adstar/batch/fleet_view.hpp"

namespace adstar::batch {

/// Ascending in width.
enum class InstructionSet { sse2, avx2, avx512 };
inline constexpr InstructionSet kInstructionSets[] = {InstructionSet::sse2, InstructionSet::avx2,
                                                      InstructionSet::avx512};

const char* name_of(InstructionSet set) noexcept;

/// Doubles side by side in a register.
std::size_t width_of(InstructionSet set) noexcept;

/// Whether this processor, and the system on it, runs that set.
bool runs_here(InstructionSet set) noexcept;

/// Null when the scheme steps bodies one by one only.
const Kernels* find_kernels(std::string_view scheme, InstructionSet set) noexcept;

/// The widest set that runs here, has the scheme, and that `bodies` fill at least once.
std::optional<InstructionSet> best_for(std::string_view scheme, std::size_t bodies) noexcept;

}  // namespace adstar::batch
