#include "service/scene/inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adstar/bodies/rigid_body.hpp"

namespace adstar::scene {
namespace {

constexpr double kTolerance = 1e-12;
/// Beyond these the products of moments in the kernels would leave the range of double.
constexpr double kLeastMoment = 1e-120, kMostMoment = 1e120;
constexpr std::string_view kShape = "3 principal moments, a 3x3 tensor or { min, max } in kg m^2";
constexpr std::string_view kExample = "[0.9144, 1.098, 1.66]";

std::optional<Eigen::Matrix3d> read_tensor(const Value& value) {
  Eigen::Matrix3d J;
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = read_vector(value.item(i), kExample);
    good = good && row.has_value();
    if (row) {
      J.row(static_cast<Eigen::Index>(i)) << row->x, row->y, row->z;
    }
  }
  if (!good) {
    return std::nullopt;
  }
  const double largest = J.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::fabs(J(i, j) - J(j, i)) > kTolerance * largest) {
        const auto element = [](Eigen::Index r, Eigen::Index c) {
          return '[' + std::to_string(r) + "][" + std::to_string(c) + ']';
        };
        value.refuse_as(element(j, i) + " = " + number_text(J(j, i)) + " but " + element(i, j) +
                            " = " + number_text(J(i, j)),
                        "a symmetric tensor", "the same value for both");
        good = false;
      }
      J(i, j) = J(j, i) = 0.5 * J(i, j) + 0.5 * J(j, i);
    }
  }
  return good ? std::optional(J) : std::nullopt;
}

bool is_diagonal(const Sym3<double>& J) noexcept {
  return J.xy == 0.0 && J.xz == 0.0 && J.yz == 0.0;
}

}  // namespace

InertiaFault fault_of_inertia(const Sym3<double>& J) noexcept {
  const auto m = principal_moments(J);
  // The rotations that find the moments of a full tensor leave them uncertain by a few roundings.
  const double noise =
      is_diagonal(J) ? 0.0 : 8.0 * std::numeric_limits<double>::epsilon() * std::fabs(m[2]);
  if (!(m[0] > noise)) {
    return InertiaFault::not_positive;
  }
  if (m[0] < kLeastMoment || m[2] > kMostMoment) {
    return InertiaFault::out_of_range;
  }
  return m[0] + m[1] < m[2] * (1.0 - kTolerance) ? InertiaFault::triangle : InertiaFault::none;
}

std::optional<Flaw> flaw_of_inertia(const Eigen::Matrix3d& J) {
  const Sym3<double> tensor{J(0, 0), J(1, 1), J(2, 2), J(1, 0), J(2, 0), J(2, 1)};
  const auto m = principal_moments(tensor);
  const std::string got = "principal moments " + number_text(m[0]) + ", " + number_text(m[1]) +
                          ", " + number_text(m[2]);
  switch (fault_of_inertia(tensor)) {
    case InertiaFault::not_positive:
      return Flaw{got, "a positive definite tensor (every principal moment above zero)",
                  "moments about the centre of mass such as " + std::string(kExample)};
    case InertiaFault::out_of_range:
      return Flaw{got, "moments from 1e-120 to 1e+120 kg m^2", "SI units"};
    case InertiaFault::triangle:
      return Flaw{got, "a largest moment up to the sum of the other two (triangle inequality)",
                  "a largest moment of at most " + number_text(m[0] + m[1])};
    case InertiaFault::none:
      break;
  }
  return std::nullopt;
}

Eigen::Matrix3d Inertia::value(Draws& draws) const {
  if (tensor) {
    return *tensor;
  }
  return to_eigen(principal.value(draws)).asDiagonal();
}

std::optional<Inertia> read_inertia(const Value& value) {
  if (!value) {
    return std::nullopt;
  }
  const Node& node = value.node();
  const bool vector = value.is(Node::Kind::array) && node.items.size() == 3;
  Inertia inertia;
  if (vector && std::all_of(node.items.begin(), node.items.end(),
                            [](const Node& item) { return item.kind == Node::Kind::array; })) {
    inertia.tensor = read_tensor(value);
    if (!inertia.tensor) {
      return std::nullopt;
    }
  } else if (vector || value.is(Node::Kind::table)) {
    const auto principal = read_ranged_vector(value, kExample);
    if (!principal) {
      return std::nullopt;
    }
    inertia.principal = *principal;
  } else {
    value.refuse(kShape, kExample);
    return std::nullopt;
  }
  if (!inertia.principal.drawn) {
    Draws none(0, 0);
    if (const auto flaw = flaw_of_inertia(inertia.value(none))) {
      value.refuse_as(flaw->got, flaw->expected, flaw->remedy);
      return std::nullopt;
    }
  }
  return inertia;
}

}  // namespace adstar::scene
