#include "service/runtime/batch_stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "adstar/batch/fleet_view.hpp"
#include "adstar/integrators/all.hpp"
#include "service/runtime/vehicle_step.hpp"

namespace adstar::runtime {
namespace {

static_assert(sizeof(State<double>) == batch::kStateNumbers * sizeof(double));
static_assert(sizeof(Vehicle) % sizeof(double) == 0);

batch::PackedBody pack(const RigidBody<double>& body) {
  const Sym3<double>& m = body.inverse_inertia();
  return {m.xx, m.yy, m.zz, body.inverse_moments()[0],
          m.xy, m.xz, m.yz, body.is_diagonal() ? 1.0 : 0.0};
}

void assign(double (&target)[3], const Vec3<double>& v) noexcept {
  target[0] = v.x;
  target[1] = v.y;
  target[2] = v.z;
}

using Segment = adstar::detail::Segment<double>;

constexpr Segment kNoTorque{};

enum class Kind { free, body, ramps, varying };

/// As run_segment() in adstar/propagator.hpp chooses the form of the step.
Kind kind_of(const Segment& segment) noexcept {
  if (segment.varying) {
    return Kind::varying;
  }
  using adstar::detail::is_zero;
  const bool inertial = !is_zero(segment.inertial.start) || !is_zero(segment.inertial.slope);
  const bool level = is_zero(segment.body.slope) && is_zero(segment.inertial.slope);
  if (inertial || !level) {
    return Kind::ramps;
  }
  return is_zero(segment.body.start) ? Kind::free : Kind::body;
}

/// Packs the harmonic torques; returns how many, or none when the kernels do not have them all: too
/// many, or a phase that sincos reduces another way before the step's end.
std::optional<std::size_t> pack(std::span<const Torque<double>> torques, double end_s,
                                batch::PackedHarmonics& packed) noexcept {
  std::size_t count = 0;
  const auto within = [&](double rate, double phase) {
    return std::fabs(rate) * end_s + std::fabs(phase) <= 0.99 * batch::kLargestAngle;
  };
  for (const Torque<double>& torque : torques) {
    const auto* const harmonic = std::get_if<Harmonic<double>>(&torque);
    if (harmonic == nullptr) {
      continue;
    }
    const Vec3<double>&rate = harmonic->angular_frequency_rad_s, &phase = harmonic->phase_rad;
    if (count == batch::kHarmonics || !within(rate.x, phase.x) || !within(rate.y, phase.y) ||
        !within(rate.z, phase.z)) {
      return std::nullopt;
    }
    batch::PackedHarmonic& to = packed.at[count++];
    assign(to.amplitude, harmonic->amplitude_n_m);
    assign(to.rate, rate);
    assign(to.phase, phase);
    to.frame = harmonic->frame == Frame::body ? 1 : 2;
  }
  for (std::size_t k = count; k < batch::kHarmonics; ++k) {
    packed.at[k].frame = 0;
  }
  return count;
}

/// Vehicles waiting for a kernel: few, so that their state is still in the cache when it runs, and a
/// multiple of every width, so that only the last of a step can leave lanes empty.
struct Queue {
  static constexpr std::size_t kRoom = 64;
  std::array<std::uint32_t, kRoom> members;
  std::array<batch::PackedTorque, kRoom> torques;
  std::array<batch::PackedHarmonics, kRoom> harmonics;
  std::size_t most_harmonics = 0;
  std::size_t size = 0;

  void put(std::uint32_t member, Kind kind, const Segment& segment, double h_s) noexcept {
    members[size] = member;
    batch::PackedTorque& torque = torques[size];
    ++size;
    if (kind == Kind::free) {
      return;
    }
    torque.impulse_bound = adstar::detail::impulse_bound(segment, h_s);
    assign(torque.body_start, segment.body.start);
    if (kind != Kind::body) {
      assign(torque.body_slope, segment.body.slope);
      assign(torque.inertial_start, segment.inertial.start);
      assign(torque.inertial_slope, segment.inertial.slope);
    }
  }
};

template <class Scheme>
class BatchStepper final : public Stepper {
 public:
  BatchStepper(std::span<const Vehicle> vehicles, const StepLimits& limits,
               const batch::Kernels& kernels)
      : limits_(limits_for<Scheme>(limits)),
        kernels_{kernels.free, kernels.body, kernels.ramps, kernels.varying} {
    bodies_.reserve(vehicles.size());
    packed_.reserve(vehicles.size());
    for (const Vehicle& vehicle : vehicles) {
      bodies_.emplace_back(vehicle.body);
      packed_.push_back(pack(vehicle.body));
    }
  }

  std::size_t step(Vehicles all, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    const std::span<Vehicle> vehicles(all.first, all.last);
    const Step step{vehicles, t_ns, h_ns, seconds<double>(t_ns), seconds<double>(h_ns)};
    std::size_t unresolved = 0;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      const auto member = static_cast<std::uint32_t>(i);
      const std::span<const Torque<double>> torques(vehicles[i].torques);
      if (h_ns <= 0) {
        unresolved += step_alone(step, member);  // no step at all: a kernel would renormalise
      } else if (torques.empty()) {
        unresolved += put(step, Kind::free, member, kNoTorque);
      } else if (adstar::detail::next_edge_after(torques, t_ns) < t_ns + h_ns) {
        unresolved += step_alone(step, member);
      } else {
        const Segment segment = adstar::detail::make_segment(torques, t_ns);
        // Of the attitude or the rate: no kernel has it.
        unresolved += segment.damped || segment.oriented
                          ? step_alone(step, member)
                          : put(step, kind_of(segment), member, segment);
      }
    }
    for (const Kind kind : {Kind::free, Kind::body, Kind::ramps, Kind::varying}) {
      unresolved += run(step, kind);
    }
    return unresolved;
  }

  void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept override {
    bodies_[vehicle] = BodyOf<Scheme, double>(body);
    packed_[vehicle] = pack(body);
  }

 private:
  struct Step {
    std::span<Vehicle> vehicles;
    std::int64_t t_ns, h_ns;
    double t_s, h_s;
  };

  Queue& queue_of(Kind kind) noexcept { return queues_[static_cast<std::size_t>(kind)]; }

  /// Steps it, or lets it wait. Like all below, returns how many could not be resolved.
  std::size_t put(const Step& step, Kind kind, std::uint32_t member,
                  const Segment& segment) noexcept {
    Queue& queue = queue_of(kind);
    if (kind == Kind::varying) {
      const auto harmonics =
          pack(step.vehicles[member].torques, step.t_s + step.h_s, queue.harmonics[queue.size]);
      if (!harmonics) {
        return step_alone(step, member);
      }
      queue.most_harmonics = std::max(queue.most_harmonics, *harmonics);
    }
    step.vehicles[member].flags = 0;
    queue.put(member, kind, segment, step.h_s);
    return queue.size == Queue::kRoom ? run(step, kind) : 0;
  }

  std::size_t step_alone(const Step& step, std::uint32_t member) noexcept {
    return step_vehicle<Scheme>(bodies_[member], step.vehicles[member], step.t_ns, step.h_ns,
                                limits_)
               ? 0
               : 1;
  }

  /// Empties the queue: by its kernel, and one by one what that leaves.
  std::size_t run(const Step& step, Kind kind) noexcept {
    Queue& queue = queue_of(kind);
    const batch::FleetView fleet{&step.vehicles.data()->state.q_IB.w,
                                 sizeof(Vehicle) / sizeof(double), packed_.data()};
    std::array<std::uint32_t, Queue::kRoom> left;
    const std::size_t count = kernels_[static_cast<std::size_t>(kind)](
        fleet,
        {queue.members.data(), queue.torques.data(), queue.harmonics.data(), queue.most_harmonics,
         queue.size, step.t_s, step.h_s, limits_.substep_angle_rad, left.data()});
    queue.size = queue.most_harmonics = 0;
    std::size_t unresolved = 0;
    for (std::size_t i = 0; i < count; ++i) {
      unresolved += step_alone(step, left[i]);
    }
    return unresolved;
  }

  StepLimits limits_;
  const batch::Kernel kernels_[4];  ///< by Kind
  std::vector<BodyOf<Scheme, double>> bodies_;
  std::vector<batch::PackedBody> packed_;
  Queue queues_[4];  ///< by Kind
};

}  // namespace

std::unique_ptr<Stepper> make_batch_stepper(std::span<const Vehicle> vehicles,
                                            std::string_view scheme, const StepLimits& limits,
                                            batch::InstructionSet set) {
  std::unique_ptr<Stepper> stepper;
  const batch::Kernels* const kernels = batch::find_kernels(scheme, set);
  if (kernels != nullptr) {
    with_scheme(scheme, [&](auto s) {
      using Scheme = decltype(s);
      if constexpr (requires { Scheme::kTakesLanes; }) {
        stepper = std::make_unique<BatchStepper<Scheme>>(vehicles, limits, *kernels);
      }
    });
  }
  return stepper;
}

}  // namespace adstar::runtime
