#pragma once
// The kernels of every scheme that takes lanes, for one instruction set: included by the one
// translation unit that is compiled for it, and by nothing else.
//
// What such a unit instantiates must carry the instruction set in its name, or the linker may give
// its code to the rest of the program (service/decisions/0008; tests/unit/batch_symbols.cmake).

#include "adstar/batch/step.hpp"
#include "adstar/integrators/coadjoint.hpp"
#include "adstar/integrators/coadjoint_float.hpp"
#include "service/batch/named_kernels.hpp"

namespace adstar::batch {

template <class Arch, class... Scheme>
struct TableOf {
  static constexpr NamedKernels kEntries[] = {{Scheme::kName, kernels<Scheme, Arch>()}...};
  static constexpr Table table() { return {kEntries, sizeof...(Scheme)}; }
};

/// To add a scheme: one line here. tests/unit/batch_test.cpp names those that are missing.
template <class Arch>
using KernelTable = TableOf<Arch,                //
                            CoadjointRk4,        //
                            CoadjointRk4Float,   //
                            CoadjointMidpoint2,  //
                            CoadjointMidpoint2Float>;

}  // namespace adstar::batch
