#pragma once
// The fleet's state at one step, copied by the tick and read at leisure by another thread: for the
// state's hash and for checkpoints.

#include <atomic>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// All of a vehicle that changes, and what its residuals are counted from.
struct VehicleState {
  State<double> state;
  std::uint64_t flags = 0;
  Vec3<double> H_0;
  double E_0 = 0;
};
static_assert(std::is_trivially_copyable_v<VehicleState>);
static_assert(sizeof(VehicleState) == 23 * 8, "no holes: its bytes are compared");

inline VehicleState state_of(const Vehicle& vehicle) noexcept {
  return {vehicle.state, vehicle.flags, vehicle.H_0, vehicle.E_0};
}

inline void restore(Vehicle& vehicle, const VehicleState& saved) noexcept {
  vehicle.state = saved.state;
  vehicle.flags = static_cast<std::uint32_t>(saved.flags);
  vehicle.H_0 = saved.H_0;
  vehicle.E_0 = saved.E_0;
}

/// One snapshot at a time: the writer leaves out what the reader has no time for.
class FleetSnapshot {
 public:
  explicit FleetSnapshot(std::size_t vehicles) : vehicles_(vehicles) {}

  /// The tick's. False when the last one is still being read.
  bool offer(const std::vector<Vehicle>& vehicles, std::uint64_t step) noexcept {
    if (full_.load(std::memory_order_acquire)) {
      return false;
    }
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      vehicles_[i] = state_of(vehicles[i]);
    }
    step_ = step;
    full_.store(true, std::memory_order_release);
    return true;
  }

  /// The reader's: whether there is one; then the rest may be read until done().
  bool ready() const noexcept { return full_.load(std::memory_order_acquire); }
  std::uint64_t step() const noexcept { return step_; }
  const std::vector<VehicleState>& vehicles() const noexcept { return vehicles_; }
  void done() noexcept { full_.store(false, std::memory_order_release); }

 private:
  std::vector<VehicleState> vehicles_;
  std::uint64_t step_ = 0;
  std::atomic<bool> full_{false};
};

}  // namespace adstar::runtime
