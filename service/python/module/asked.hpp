#pragma once
// What Python hands over, checked and in the units of the core; what is wrong is a std::invalid_argument (ValueError)
// that says what, and what to give instead.

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include "adstar/attitude.hpp"
#include "adstar/torques/table.hpp"
#include "service/propagation/plan.hpp"

namespace adstar::python {

namespace py = pybind11;

/// Contiguous doubles, converted where they are not.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// 73 years: so far differences of times are safe.
inline constexpr std::int64_t kFarthestNs = std::int64_t{1} << 61;

/// How Python's callers write a request: "step_s=0.01".
const propagation::Words& words();

/// Of a time [s] that steps are counted by: positive, whole nanoseconds to round-off.
std::int64_t whole_nanoseconds(const char* name, double seconds);
std::optional<std::int64_t> whole_nanoseconds(const char* name, std::optional<double> seconds);

/// Three finite numbers.
Vec3<double> vector_of(const char* name, const Doubles& values);
/// w, x, y, z of any length but zero.
Quat<double> quaternion_of(const char* name, const Doubles& values);
/// Principal moments (3,), or the tensor (3, 3), of a rigid body.
Eigen::Matrix3d inertia_of(const char* name, const Doubles& values);

/// Knots of a torque: times (n,) [s], strictly rising once they are rounded to nanoseconds, and torques (n, 3).
Table<double> table_of(const Doubles& time_s, const Doubles& torque_n_m, const std::string& frame,
                       const std::string& interpolation, const std::string& after_end);

}  // namespace adstar::python
