#include "service/python/module/asked.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "service/report/numbers.hpp"
#include "service/scene/complaints.hpp"
#include "service/scene/decimal.hpp"
#include "service/scene/inertia.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::python {
namespace {

constexpr double kNanosecondsASecond = 1e9;
[[noreturn]] void refuse(std::string_view name, const std::string& got, std::string_view expected,
                         std::string_view remedy) {
  throw std::invalid_argument(
      fmt::format("{}: got {}, expected {}; try {}", name, got, expected, remedy));
}

std::string shape_of(const Doubles& values) {
  std::string text = "an array of shape (";
  for (py::ssize_t i = 0; i < values.ndim(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", values.shape(i));
  }
  return text + (values.ndim() == 1 ? ",)" : ")");
}

template <std::size_t N>
std::array<double, N> numbers_of(const char* name, const Doubles& values, const char* example) {
  if (values.ndim() != 1 || values.shape(0) != N) {
    refuse(name, shape_of(values), fmt::format("{} numbers", N), example);
  }
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    numbers[i] = values.data()[i];
    if (!std::isfinite(numbers[i])) {
      refuse(name, fmt::format("{} at [{}]", numbers[i], i), "finite numbers", example);
    }
  }
  return numbers;
}

/// Which of the words it is.
std::size_t choice(const char* name, const std::string& got,
                   const std::array<std::string_view, 2>& known) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (got == known[i]) {
      return i;
    }
  }
  refuse(name, scene::in_quotes(got), scene::joined(known),
         scene::nearest_plausible(got, known).value_or(known.front()));
}

/// Nearest; nothing when it is out of range or no number.
std::optional<std::int64_t> nearest_nanosecond(double seconds) {
  const double ns = seconds * kNanosecondsASecond;
  return std::fabs(ns) < static_cast<double>(kFarthestNs)
             ? std::optional(static_cast<std::int64_t>(std::llround(ns)))
             : std::nullopt;
}

}  // namespace

const propagation::Words& words() {
  static const propagation::Words python{"duration_s", "step_s", "every_s",
                                         "scheme",     "=",      report::seconds_text};
  return python;
}

std::int64_t whole_nanoseconds(const char* name, double seconds) {
  const auto ns = nearest_nanosecond(seconds);
  if (!ns || *ns <= 0) {
    refuse(name, fmt::format("{}", seconds), "seconds, at least 1e-9 and below 2e9", "0.01");
  }
  // As it is written, 0.1 is a tenth, though no double is.
  if (const auto written = scene::exact_ns(scene::number_text(seconds), scene::kSecond)) {
    return *written;
  }
  // Or worked out: what is lost on the way through doubles, and no more.
  const double exact = seconds * kNanosecondsASecond;
  const double lost = 1e-3 + 4 * std::numeric_limits<double>::epsilon() * exact;
  if (std::fabs(exact - static_cast<double>(*ns)) > lost) {
    refuse(name, fmt::format("{}", seconds), "whole nanoseconds", report::seconds_text(*ns));
  }
  return *ns;
}

std::optional<std::int64_t> whole_nanoseconds(const char* name, std::optional<double> seconds) {
  return seconds ? std::optional(whole_nanoseconds(name, *seconds)) : std::nullopt;
}

Vec3<double> vector_of(const char* name, const Doubles& values) {
  const auto v = numbers_of<3>(name, values, "(0.0, 0.0, 0.01)");
  return {v[0], v[1], v[2]};
}

Quat<double> quaternion_of(const char* name, const Doubles& values) {
  constexpr const char* kExample = "(1.0, 0.0, 0.0, 0.0): w, x, y, z";
  const auto q = numbers_of<4>(name, values, kExample);
  if (q == std::array<double, 4>{}) {
    refuse(name, "a quaternion of norm 0", "one that can be normalised", kExample);
  }
  return {q[0], q[1], q[2], q[3]};
}

Eigen::Matrix3d inertia_of(const char* name, const Doubles& values) {
  constexpr const char* kExample = "(0.9144, 1.098, 1.66)";
  Eigen::Matrix3d J;
  if (values.ndim() == 2 && values.shape(0) == 3 && values.shape(1) == 3) {
    J = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
  } else if (values.ndim() == 1 && values.shape(0) == 3) {
    J = Eigen::Map<const Eigen::Vector3d>(values.data()).asDiagonal();
  } else {
    refuse(name, shape_of(values), "principal moments (3,), or the tensor (3, 3)", kExample);
  }
  if (!J.allFinite()) {
    refuse(name, "a number that is not finite", "kg m^2", kExample);
  }
  if (J != J.transpose()) {
    refuse(name, "a tensor that is not symmetric", "a symmetric one", "0.5 * (J + J.T)");
  }
  if (const auto flaw = scene::flaw_of_inertia(J)) {
    refuse(name, flaw->got, flaw->expected, flaw->remedy);
  }
  return J;
}

Table<double> table_of(const Doubles& time_s, const Doubles& torque_n_m, const std::string& frame,
                       const std::string& interpolation, const std::string& after_end) {
  /// Beyond it a line between two knots can be steeper than a double.
  constexpr double kMostTorque = 1e100;
  const py::ssize_t knots = time_s.ndim() == 1 ? time_s.shape(0) : 0;
  if (knots == 0) {
    refuse("time_s", shape_of(time_s), "times (n,), at least one", "numpy.array([0.0])");
  }
  if (torque_n_m.ndim() != 2 || torque_n_m.shape(0) != knots || torque_n_m.shape(1) != 3) {
    refuse("torque_n_m", shape_of(torque_n_m), fmt::format("shape ({}, 3), a row a time", knots),
           "numpy.column_stack((x, y, z))");
  }
  Table<double> table{
      choice("frame", frame, {"body", "inertial"}) == 0 ? Frame::body : Frame::inertial,
      choice("interpolation", interpolation, {"hold", "linear"}) == 0 ? Interpolation::hold
                                                                      : Interpolation::linear,
      choice("after_end", after_end, {"zero", "hold"}) == 0 ? AfterEnd::zero : AfterEnd::hold,
      {},
      {}};
  for (py::ssize_t i = 0; i < knots; ++i) {
    const auto ns = nearest_nanosecond(time_s.data()[i]);
    if (!ns) {
      refuse(fmt::format("time_s[{}]", i), fmt::format("{}", time_s.data()[i]),
             "seconds, within 2e9", "0.0");
    }
    if (!table.time_ns.empty() && *ns <= table.time_ns.back()) {
      refuse(
          fmt::format("time_s[{}]", i), fmt::format("{}", time_s.data()[i]),
          fmt::format("a time after the {} before it, a nanosecond at least", time_s.data()[i - 1]),
          "numpy.argsort(time_s)");
    }
    const double* const row = torque_n_m.data() + 3 * i;
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(row[k]) <= kMostTorque)) {
        refuse(fmt::format("torque_n_m[{}, {}]", i, k), fmt::format("{}", row[k]),
               "a finite number in N m", "0.0");
      }
    }
    table.time_ns.push_back(*ns);
    table.torque_n_m.push_back({row[0], row[1], row[2]});
  }
  return table;
}

}  // namespace adstar::python
