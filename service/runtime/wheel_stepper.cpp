#include "service/runtime/wheel_stepper.hpp"

#include <stdexcept>
#include <string>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/runtime/vehicle_step.hpp"

namespace adstar::runtime {
namespace {

template <class Scheme>
class WheelStepper final : public Stepper {
 public:
  explicit WheelStepper(const StepLimits& limits) : limits_(limits) {}

  std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    std::size_t unresolved = 0;
    for (Vehicle& vehicle : vehicles) {
      const StepReport report = advance<Scheme, double>(vehicle.wheels->hub, vehicle.state,
                                                        std::span(vehicle.wheels->spinning),
                                                        vehicle.torques, t_ns, h_ns, limits_);
      unresolved += note(vehicle, report) ? 0 : 1;
    }
    return unresolved;
  }

  /// The hub is the vehicle's own.
  void replace_body(std::size_t, const RigidBody<double>&) noexcept override {}

 private:
  StepLimits limits_;
};

}  // namespace

std::unique_ptr<Stepper> make_wheel_stepper(std::string_view scheme, const StepLimits& limits) {
  std::unique_ptr<Stepper> stepper;
  with_scheme(scheme, [&](auto s) {
    if constexpr (TakesWheels<decltype(s)>) {
      stepper = std::make_unique<WheelStepper<decltype(s)>>(limits);
    }
  });
  if (stepper == nullptr) {
    throw std::invalid_argument("scheme '" + std::string(scheme) + "' does not carry wheels");
  }
  return stepper;
}

}  // namespace adstar::runtime
