#pragma once
// What a batch kernel sees of a fleet: plain numbers, so that its translation unit instantiates
// nothing that the rest of the program also has.

#include <cstddef>
#include <cstdint>

namespace adstar::batch {

/// One body's constants, a cache line: two rows of four.
struct alignas(64) PackedBody {
  double J_inverse_xx = 0, J_inverse_yy = 0, J_inverse_zz = 0;
  double largest_inverse_moment = 0;
  double J_inverse_xy = 0, J_inverse_xz = 0, J_inverse_yz = 0;
  double is_diagonal = 1;  ///< 1 or 0
};

/// What acts on one body over one step without an edge: linear in time in each frame [N m, N m/s].
struct alignas(64) PackedTorque {
  double body_start[3] = {};
  double impulse_bound = 0;  ///< of ∫|tau| dt over the step [N m s]
  double body_slope[3] = {};
  double unused_1 = 0;
  double inertial_start[3] = {};
  double unused_2 = 0;
  double inertial_slope[3] = {};
  double unused_3 = 0;
};

/// One harmonic torque: amplitude sin(rate t + phase) per axis [N m, rad/s, rad].
struct PackedHarmonic {
  double amplitude[3] = {};
  double frame = 0;  ///< 1 body, 2 inertial, 0 no torque at all
  double rate[3] = {};
  double unused_1 = 0;
  double phase[3] = {};
  double unused_2 = 0;
};

/// Largest |rate t + phase| that a kernel takes [rad]: beyond it sincos reduces in another way.
inline constexpr double kLargestAngle = 1e8;

/// Harmonic torques that a body may have in a kernel; one with more is stepped alone.
inline constexpr std::size_t kHarmonics = 4;

struct alignas(64) PackedHarmonics {
  PackedHarmonic at[kHarmonics];
};

/// Doubles of a State<double>, in its order: q_IB w x y z; then value and carry of each component of
/// H_I and impulse_I, and of work.
inline constexpr std::size_t kStateNumbers = 18;

struct FleetView {
  double* states = nullptr;            ///< the first State<double>
  std::size_t stride = kStateNumbers;  ///< doubles from one to the next
  const PackedBody* bodies = nullptr;  ///< one a member
};

/// A step of all members listed in `members`; those that a kernel cannot take stay as they are.
struct Work {
  const std::uint32_t* members = nullptr;
  const PackedTorque* torques = nullptr;  ///< one an entry of `members`; a free step needs none
  const PackedHarmonics* harmonics = nullptr;  ///< the same; for the varying step only
  std::size_t most_harmonics = 0;              ///< of any entry
  std::size_t count = 0;
  double t_s = 0;  ///< simulation time at the step's beginning
  double h_s = 0;
  double angle_limit_rad = 0;     ///< StepLimits::substep_angle_rad
  std::uint32_t* left = nullptr;  ///< out: members not stepped, room for `count`
};

/// Steps the members; returns how many it left.
using Kernel = std::size_t (*)(const FleetView& fleet, const Work& work) noexcept;

/// One scheme on one instruction set.
struct Kernels {
  Kernel free = nullptr;     ///< no torque
  Kernel body = nullptr;     ///< a torque constant in the body: body_start alone
  Kernel ramps = nullptr;    ///< all of PackedTorque
  Kernel varying = nullptr;  ///< and PackedHarmonics
};

}  // namespace adstar::batch
