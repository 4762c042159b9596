// A fleet whose step does nothing: the gate needs vehicles to hand torques to, for every input anew, and no steppers.

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {
namespace {

class NoStep final : public Stepper {
 public:
  std::size_t step(Vehicles /*vehicles*/, std::int64_t /*t_ns*/,
                   std::int64_t /*h_ns*/) noexcept override {
    return 0;
  }
  void replace_body(std::size_t /*vehicle*/, const RigidBody<double>& /*body*/) noexcept override {}
};

}  // namespace

Fleet::Fleet(const std::vector<scene::Spacecraft>& spacecraft, std::string_view /*scheme*/,
             const StepLimits& /*limits*/, Lanewise /*lanewise*/, std::size_t /*threads*/)
    : stepper_(std::make_unique<NoStep>()) {
  for (const scene::Spacecraft& craft : spacecraft) {
    vehicles_.push_back({craft.initial, craft.torques, 0,
                         RigidBody<double>(craft.inertia_body_kg_m2), craft.initial.H_I.value(),
                         0});
  }
}

}  // namespace adstar::runtime
