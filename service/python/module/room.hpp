#pragma once
// Whether the arrays of a run fit in memory, before there are any.

#include <cstddef>

#include <pybind11/pybind11.h>

#include "service/propagation/plan.hpp"

namespace adstar::python {

/// MemoryError for rows that there is no room for: memory is granted all the same, and the process killed when it has
/// filled what there is. `available_bytes` is a function of Python.
void require_room(const propagation::Plan& plan, std::size_t spacecraft, double bytes_an_instant,
                  const pybind11::function& available_bytes);

}  // namespace adstar::python
