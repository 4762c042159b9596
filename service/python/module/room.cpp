#include "service/python/module/room.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "service/bag/size.hpp"
#include "service/propagation/fly.hpp"
#include "service/report/numbers.hpp"

namespace adstar::python {

namespace py = pybind11;

namespace {

/// Steps between rows that take half of the memory, in one digit.
std::uint64_t every_that_fits(const propagation::Plan& plan, double bytes_an_instant,
                              double available) {
  const auto steps = static_cast<double>(plan.steps);
  const double rows = std::max(2.0, available / 2 / bytes_an_instant);
  const double every = std::ceil(steps / (rows - 1));
  const double digit = std::pow(10.0, std::floor(std::log10(every)));
  return static_cast<std::uint64_t>(std::min(std::ceil(every / digit) * digit, steps));
}

}  // namespace

void require_room(const propagation::Plan& plan, std::size_t spacecraft, double bytes_an_instant,
                  const py::function& available_bytes) {
  /// Asking takes longer than such a run, and arrays are not all that a process needs.
  constexpr double kAlwaysThere = 16e6;
  const std::uint64_t instants = propagation::rows_of(plan);
  const double bytes = static_cast<double>(instants) * bytes_an_instant;
  if (bytes <= kAlwaysThere) {
    return;
  }
  const auto available = available_bytes().cast<double>();
  if (bytes <= available) {
    return;
  }
  const auto size = [](double b) {
    constexpr double kMost = 9e18;
    return bag::format_size(static_cast<std::uint64_t>(std::min(b, kMost)));
  };
  const auto every_s = [&](std::uint64_t steps) {
    return report::seconds_text(static_cast<std::int64_t>(steps) * plan.step_ns);
  };
  std::string message;
  if (2 * bytes_an_instant > available) {
    message = fmt::format(
        "spacecraft: got {}, for which even two rows take {}, expected at most the {} of memory "
        "that are free; try {} (no every_s fits)",
        report::counted(spacecraft), size(2 * bytes_an_instant), size(available),
        spacecraft > 1 ? "fewer spacecraft, or more memory" : "more memory");
  } else {
    message = fmt::format(
        "every_s: got {}, for which {} rows take {}, expected at most the {} of memory that are "
        "free; try {}",
        every_s(plan.every), report::counted(instants), size(bytes), size(available),
        every_s(every_that_fits(plan, bytes_an_instant, available)));
  }
  PyErr_SetString(PyExc_MemoryError, message.c_str());
  throw py::error_already_set();
}

}  // namespace adstar::python
