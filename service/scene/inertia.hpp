#pragma once
// Which 3x3 matrices are the inertia tensor of a rigid body about its centre of mass.

#include <optional>
#include <string>

#include <Eigen/Core>

#include "adstar/vec3.hpp"
#include "service/scene/fleet.hpp"

namespace adstar::scene {

/// Principal moments (perhaps drawn), or a tensor.
struct Inertia {
  RangedVector principal;
  std::optional<Eigen::Matrix3d> tensor;

  Eigen::Matrix3d value(Draws& draws) const;
};

/// Of what is fixed, everything is checked here; of what is drawn, each draw must be checked.
std::optional<Inertia> read_inertia(const Value& value);

/// What keeps a symmetric tensor from being that of a rigid body.
enum class InertiaFault { none, not_positive, out_of_range, triangle };

/// Of a tensor whose numbers are finite. Never allocates.
InertiaFault fault_of_inertia(const Sym3<double>& J) noexcept;

struct Flaw {
  std::string got, expected, remedy;
};

/// Nothing if `J` (symmetric) is positive definite and its principal moments obey the triangle
/// inequality.
std::optional<Flaw> flaw_of_inertia(const Eigen::Matrix3d& J);

}  // namespace adstar::scene
