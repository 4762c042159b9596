// The digest of a fleet sees all that a fleet carries: states, wheels, coils, linked bodies and their joints.

#include "service/runtime/step_digests.hpp"

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"
#include "tests/support/linked_craft.hpp"

namespace adstar::runtime {
namespace {

TEST(DigestOf, sees_the_last_bit_of_all_that_a_fleet_carries) {
  Fleet fleet({test::make_craft(1), test::with_wheels(test::make_craft(0)),
               test::in_space(test::make_craft(0)), test::linked_craft()},
              "coadjoint_rk4", StepLimits{});
  std::vector<Vehicle>& vehicles = fleet.vehicles();
  const std::uint64_t digest = digest_of(vehicles);
  const auto seen = [&](double& number) {
    const double kept = number;
    number = std::nextafter(number, 1e300);
    const std::uint64_t other = digest_of(vehicles);
    number = kept;
    return other != digest;
  };
  EXPECT_TRUE(seen(vehicles[0].state.q_IB.w));
  EXPECT_TRUE(seen(vehicles[0].state.H_I.z.carry));
  EXPECT_TRUE(seen(vehicles[1].wheels->spinning[1].h.carry));
  EXPECT_TRUE(seen(std::get<Magnetorquer<double>>(vehicles[2].torques[0]).settled.dipole_A_m2.z));
  EXPECT_TRUE(seen(vehicles[3].linked->state.bodies[2].q_IB.z));
  EXPECT_TRUE(seen(vehicles[3].linked->state.coordinates[0][0]));
  EXPECT_EQ(digest_of(vehicles), digest);
}

}  // namespace
}  // namespace adstar::runtime
