#include "service/runtime/batch_stepper.hpp"

#include <cstddef>
#include <span>

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

enum class Kind { free, body, ramps, alone };

bool has_edge_before(std::span<const Torque<double>> torques, std::int64_t t_ns,
                     std::int64_t end_ns) noexcept {
  for (const Torque<double>& torque : torques) {
    if (std::visit([&](const auto& model) { return model.next_edge_after(t_ns); }, torque) <
        end_ns) {
      return true;
    }
  }
  return false;
}

/// As run_segment() in adstar/propagator.hpp chooses the form of the step.
Kind classify(const Vehicle& vehicle, std::int64_t t_ns, std::int64_t h_ns,
              batch::PackedTorque& packed) noexcept {
  const std::span<const Torque<double>> torques(vehicle.torques);
  if (torques.empty()) {
    return Kind::free;
  }
  if (has_edge_before(torques, t_ns, t_ns + h_ns)) {
    return Kind::alone;
  }
  const auto segment = adstar::detail::make_segment(torques, t_ns);
  if (segment.varying) {
    return Kind::alone;
  }
  using adstar::detail::is_zero;
  const bool inertial = !is_zero(segment.inertial.start) || !is_zero(segment.inertial.slope);
  const bool level = is_zero(segment.body.slope) && is_zero(segment.inertial.slope);
  if (!inertial && level && is_zero(segment.body.start)) {
    return Kind::free;
  }
  packed.impulse_bound = adstar::detail::impulse_bound(segment, seconds<double>(h_ns));
  assign(packed.body_start, segment.body.start);
  if (!inertial && level) {
    return Kind::body;
  }
  assign(packed.body_slope, segment.body.slope);
  assign(packed.inertial_start, segment.inertial.start);
  assign(packed.inertial_slope, segment.inertial.slope);
  return Kind::ramps;
}

/// Numbers of vehicles, in memory made once.
class List {
 public:
  explicit List(std::size_t room) : members_(room) {}
  void clear() noexcept { size_ = 0; }
  void add(std::size_t member) noexcept { members_[size_++] = static_cast<std::uint32_t>(member); }
  const std::uint32_t* data() const noexcept { return members_.data(); }
  std::size_t size() const noexcept { return size_; }
  /// Where a kernel may write what it leaves: it never leaves more than it was given.
  std::uint32_t* end() noexcept { return members_.data() + size_; }
  void grow(std::size_t by) noexcept { size_ += by; }

 private:
  std::vector<std::uint32_t> members_;
  std::size_t size_ = 0;
};

template <class Scheme>
class BatchStepper final : public Stepper {
 public:
  BatchStepper(const std::vector<Vehicle>& vehicles, const batch::Kernels& kernels)
      : kernels_(kernels),
        torques_(vehicles.size()),
        free_(vehicles.size()),
        body_(vehicles.size()),
        ramps_(vehicles.size()),
        alone_(vehicles.size()) {
    bodies_.reserve(vehicles.size());
    packed_.reserve(vehicles.size());
    for (const Vehicle& vehicle : vehicles) {
      bodies_.emplace_back(vehicle.body);
      packed_.push_back(pack(vehicle.body));
    }
  }

  std::size_t step(std::vector<Vehicle>& vehicles, std::int64_t t_ns, std::int64_t h_ns,
                   const StepLimits& limits) noexcept override {
    sort(vehicles, t_ns, h_ns);
    const batch::FleetView fleet{&vehicles.data()->state.q_IB.w, sizeof(Vehicle) / sizeof(double),
                                 packed_.data(), torques_.data()};
    run(kernels_.free, free_, fleet, h_ns, limits);
    run(kernels_.body, body_, fleet, h_ns, limits);
    run(kernels_.ramps, ramps_, fleet, h_ns, limits);
    std::size_t unresolved = 0;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const std::uint32_t member = alone_.data()[i];
      unresolved +=
          step_vehicle<Scheme>(bodies_[member], vehicles[member], t_ns, h_ns, limits) ? 0 : 1;
    }
    return unresolved;
  }

 private:
  void sort(std::vector<Vehicle>& vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept {
    for (List* list : {&free_, &body_, &ramps_, &alone_}) {
      list->clear();
    }
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      vehicles[i].flags = 0;
      // A step of no length is none: the kernels would renormalise.
      switch (h_ns > 0 ? classify(vehicles[i], t_ns, h_ns, torques_[i]) : Kind::alone) {
        case Kind::free:
          free_.add(i);
          break;
        case Kind::body:
          body_.add(i);
          break;
        case Kind::ramps:
          ramps_.add(i);
          break;
        case Kind::alone:
          alone_.add(i);
          break;
      }
    }
  }

  void run(batch::Kernel kernel, const List& list, const batch::FleetView& fleet, std::int64_t h_ns,
           const StepLimits& limits) noexcept {
    if (list.size() > 0) {
      alone_.grow(kernel(fleet, {list.data(), list.size(), seconds<double>(h_ns),
                                 limits.substep_angle_rad, alone_.end()}));
    }
  }

  const batch::Kernels& kernels_;
  std::vector<BodyOf<Scheme, double>> bodies_;
  std::vector<batch::PackedBody> packed_;
  std::vector<batch::PackedTorque> torques_;
  List free_, body_, ramps_, alone_;
};

}  // namespace

std::unique_ptr<Stepper> make_batch_stepper(const std::vector<Vehicle>& vehicles,
                                            std::string_view scheme, batch::InstructionSet set) {
  std::unique_ptr<Stepper> stepper;
  const batch::Kernels* const kernels = batch::find_kernels(scheme, set);
  if (kernels != nullptr) {
    with_scheme(scheme, [&](auto s) {
      using Scheme = decltype(s);
      if constexpr (requires { Scheme::kTakesLanes; }) {
        stepper = std::make_unique<BatchStepper<Scheme>>(vehicles, *kernels);
      }
    });
  }
  return stepper;
}

}  // namespace adstar::runtime
