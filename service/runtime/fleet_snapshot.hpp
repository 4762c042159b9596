#pragma once
// The fleet's state at one step, copied by the tick and read at leisure by another thread: for the
// state's hash and for checkpoints.

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "adstar/bodies/rigid_body.hpp"
#include "service/runtime/cache_line.hpp"
#include "service/runtime/fleet.hpp"
#include "service/runtime/model_memory.hpp"

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

/// All of a fleet that changes.
struct FleetState {
  std::vector<VehicleState> vehicles;
  std::vector<Sum<double>> wheel_momenta;  ///< h of all wheels, vehicle by vehicle [N m s]
  std::vector<std::uint64_t> memory;       ///< of the other models, vehicle by vehicle
};

/// Room for it, in the fleet's shape.
inline FleetState blank_state(const std::vector<Vehicle>& vehicles) {
  FleetState state;
  state.vehicles.resize(vehicles.size());
  std::size_t wheels = 0, words = 0;
  for (const Vehicle& vehicle : vehicles) {
    wheels += vehicle.wheels == nullptr ? 0 : vehicle.wheels->spinning.size();
    words += memory_words(vehicle);
  }
  state.wheel_momenta.resize(wheels);
  state.memory.resize(words);
  return state;
}

/// Into a state of that shape.
inline void copy_state(const std::vector<Vehicle>& vehicles, FleetState& state) noexcept {
  std::size_t wheel = 0;
  std::uint64_t* words = state.memory.data();
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    state.vehicles[i] = state_of(vehicles[i]);
    words = save_memory(vehicles[i], words);
    if (vehicles[i].wheels != nullptr) {
      for (const SpinningWheel<double>& spinning : vehicles[i].wheels->spinning) {
        state.wheel_momenta[wheel++] = spinning.h;
      }
    }
  }
}

inline FleetState state_of(const Fleet& fleet) {
  FleetState state = blank_state(fleet.vehicles());
  copy_state(fleet.vehicles(), state);
  return state;
}

/// False, and the fleet is as it was, for the state of another one. Not for the tick: a body that was changed is
/// prepared anew.
inline bool restore(Fleet& fleet, const FleetState& saved) {
  const FleetState shape = blank_state(fleet.vehicles());
  if (saved.vehicles.size() != shape.vehicles.size() ||
      saved.wheel_momenta.size() != shape.wheel_momenta.size() ||
      saved.memory.size() != shape.memory.size()) {
    return false;
  }
  std::size_t wheel = 0;
  const std::uint64_t* words = saved.memory.data();
  for (std::size_t i = 0; i < saved.vehicles.size(); ++i) {
    Vehicle& vehicle = fleet.vehicles()[i];
    const VehicleState& state = saved.vehicles[i];
    if (state.inertia_B != vehicle.body.inertia()) {
      fleet.set_body(i, RigidBody<double>(matrix_of(state.inertia_B)));
    }
    vehicle.state = state.state;
    vehicle.flags = static_cast<std::uint32_t>(state.flags);
    vehicle.H_0 = state.H_0;
    vehicle.E_0 = state.E_0;
    words = load_memory(vehicle, words);
    share_accounts(vehicle);
    if (vehicle.wheels != nullptr) {
      for (SpinningWheel<double>& spinning : vehicle.wheels->spinning) {
        spinning.h = saved.wheel_momenta[wheel++];
      }
    }
  }
  return true;
}

/// Where a run is. A reset sets its steps back; how often that was comes first.
struct Instant {
  std::uint64_t resets = 0;
  std::uint64_t step = 0;
  friend auto operator<=>(const Instant&, const Instant&) = default;
};

/// One snapshot at a time: the writer leaves out what the reader has no time for.
///
/// What the reader has is its processor's, and what nobody has touched for a second is far away. A large fleet is taken at
/// one step, into memory that was brought near, and handed over in parts (decisions/0024-hand-over-in-parts.md).
class FleetSnapshot {
 public:
  explicit FleetSnapshot(const Fleet& fleet)
      : taken_(blank_state(fleet.vehicles())), state_(taken_) {}

  /// Of a whole one.
  std::size_t words() const noexcept {
    return taken_.vehicles.size() * (sizeof(VehicleState) / 8) +
           taken_.wheel_momenta.size() * (sizeof(Sum<double>) / 8) + taken_.memory.size();
  }

  /// The tick's, in the beats before take(): one of the parts of what it writes to.
  void prepare(std::size_t part, std::size_t parts) const noexcept {
    bring_near(taken_.vehicles, part, parts);
    bring_near(taken_.wheel_momenta, part, parts);
    bring_near(taken_.memory, part, parts);
  }

  /// The tick's. False when the last one is still being read.
  bool take(const std::vector<Vehicle>& vehicles, Instant at, std::size_t parts) noexcept {
    if (full_.load(std::memory_order_acquire)) {
      return false;
    }
    copy_state(vehicles, taken_);
    at_ = at;
    part_ = 0;
    parts_ = parts;
    return true;
  }

  /// The tick's: at most so many of the parts that are left.
  void hand_over(std::size_t parts) noexcept {
    for (; part_ < parts_ && parts > 0; --parts) {
      copy_part(taken_.vehicles, state_.vehicles);
      copy_part(taken_.wheel_momenta, state_.wheel_momenta);
      copy_part(taken_.memory, state_.memory);
      if (++part_ == parts_) {
        full_.store(true, std::memory_order_release);
      }
    }
  }

  /// The reader's: whether there is one; then the rest may be read until done().
  bool ready() const noexcept { return full_.load(std::memory_order_acquire); }
  Instant at() const noexcept { return at_; }
  const FleetState& state() const noexcept { return state_; }
  void done() noexcept { full_.store(false, std::memory_order_release); }

 private:
  template <class Value>
  void copy_part(const std::vector<Value>& from, std::vector<Value>& to) const noexcept {
    const std::size_t first = from.size() * part_ / parts_;
    const std::size_t last = from.size() * (part_ + 1) / parts_;
    std::copy(from.data() + first, from.data() + last, to.data() + first);
  }

  FleetState taken_, state_;
  std::size_t part_ = 0, parts_ = 0;
  Instant at_;
  std::atomic<bool> full_{false};
};

}  // namespace adstar::runtime
