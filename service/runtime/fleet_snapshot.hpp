#pragma once
// The fleet's state at one step, copied by the tick and read at leisure by another thread: for the
// state's hash and for checkpoints.

#include <atomic>
#include <compare>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "adstar/bodies/rigid_body.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// All of a vehicle that changes, and what its residuals are counted from.
struct VehicleState {
  State<double> state;
  std::uint64_t flags = 0;
  Vec3<double> H_0;
  double E_0 = 0;
  Sym3<double> inertia_B;
};
static_assert(std::is_trivially_copyable_v<VehicleState>);
static_assert(sizeof(VehicleState) == 29 * 8, "no holes: its bytes are compared");

inline VehicleState state_of(const Vehicle& vehicle) noexcept {
  return {vehicle.state, vehicle.flags, vehicle.H_0, vehicle.E_0, vehicle.body.inertia()};
}

inline bool same(const Sym3<double>& a, const Sym3<double>& b) noexcept {
  return a.xx == b.xx && a.yy == b.yy && a.zz == b.zz && a.xy == b.xy && a.xz == b.xz &&
         a.yz == b.yz;
}

inline std::vector<VehicleState> states_of(const Fleet& fleet) {
  std::vector<VehicleState> states;
  for (const Vehicle& vehicle : fleet.vehicles()) {
    states.push_back(state_of(vehicle));
  }
  return states;
}

/// May throw nothing but is not for the tick: a body that was changed is prepared anew.
inline void restore(Fleet& fleet, std::size_t index, const VehicleState& saved) {
  Vehicle& vehicle = fleet.vehicles()[index];
  if (const Sym3<double>& J = saved.inertia_B; !same(J, vehicle.body.inertia())) {
    Eigen::Matrix3d inertia;
    inertia << J.xx, J.xy, J.xz, J.xy, J.yy, J.yz, J.xz, J.yz, J.zz;
    fleet.set_body(index, RigidBody<double>(inertia));
  }
  vehicle.state = saved.state;
  vehicle.flags = static_cast<std::uint32_t>(saved.flags);
  vehicle.H_0 = saved.H_0;
  vehicle.E_0 = saved.E_0;
}

/// Where a run is. A reset sets its steps back; how often that was comes first.
struct Instant {
  std::uint64_t resets = 0;
  std::uint64_t step = 0;
  friend auto operator<=>(const Instant&, const Instant&) = default;
};

/// One snapshot at a time: the writer leaves out what the reader has no time for.
class FleetSnapshot {
 public:
  explicit FleetSnapshot(std::size_t vehicles) : vehicles_(vehicles) {}

  /// The tick's. False when the last one is still being read.
  bool offer(const std::vector<Vehicle>& vehicles, Instant at) noexcept {
    if (full_.load(std::memory_order_acquire)) {
      return false;
    }
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      vehicles_[i] = state_of(vehicles[i]);
    }
    at_ = at;
    full_.store(true, std::memory_order_release);
    return true;
  }

  /// The reader's: whether there is one; then the rest may be read until done().
  bool ready() const noexcept { return full_.load(std::memory_order_acquire); }
  Instant at() const noexcept { return at_; }
  const std::vector<VehicleState>& vehicles() const noexcept { return vehicles_; }
  void done() noexcept { full_.store(false, std::memory_order_release); }

 private:
  std::vector<VehicleState> vehicles_;
  Instant at_;
  std::atomic<bool> full_{false};
};

}  // namespace adstar::runtime
