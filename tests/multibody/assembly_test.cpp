// What an assembly refuses, in whose name, and what to do about it; and what a step says when it cannot follow.
#include "adstar/multibody/assembly.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/multibody/mechanisms.hpp"

namespace adstar {
namespace {

using multibody::Assembly;
using multibody::JointKind;
using multibody::kGround;
using test::Flight;
using test::Mechanism;
using test::V;

/// What is said of four bodies on spherical joints after a change.
std::string refusal(const std::function<void(Mechanism<double>&)>& change) {
  auto m = test::four_bodies();
  change(m);
  try {
    const Assembly<double> assembly(m.bodies, m.joints);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expect_refusal(const std::function<void(Mechanism<double>&)>& change,
                    std::initializer_list<const char*> words) {
  const std::string text = refusal(change);
  for (const char* word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
  }
}

TEST(AnAssembly, takes_four_bodies_on_three_joints) {
  EXPECT_EQ(refusal([](auto&) {}), "");
}

TEST(AnAssembly, refuses_bodies_that_cannot_be) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refusal([](auto& m) { m.bodies[1].mass_kg = -2; }, {"body 'b1'", "-2 kg", "positive"});
  expect_refusal([&](auto& m) { m.bodies[1].mass_kg = nan; }, {"body 'b1'", "finite"});
  expect_refusal([](auto& m) { m.bodies[2].inertia_B(0, 0) = 1; },
                 {"body 'b2'", "above the sum", "centre of mass"});
  expect_refusal([](auto& m) { m.bodies[2].inertia_B(0, 1) = 0.1; }, {"body 'b2'", "symmetric"});
  expect_refusal([](auto& m) { m.bodies[2].inertia_B(0, 0) = 0; }, {"body 'b2'", "rod"});
  expect_refusal([](auto& m) { m.bodies[2].name = "b1"; }, {"body 'b1'", "twice"});
  expect_refusal([](auto& m) { m.bodies[2].name = "ground"; }, {"'ground'", "inertial frame"});
  expect_refusal([&](auto& m) { m.bodies[3].x_I.y = nan; }, {"body 'b3'", "finite"});
  expect_refusal([](auto& m) { m.bodies.clear(), m.joints.clear(); }, {"needs a body"});
}

TEST(AnAssembly, refuses_joints_that_cannot_be) {
  expect_refusal([](auto& m) { m.joints[1].body_b = 1; }, {"joint 'j1'", "b1", "to itself"});
  expect_refusal([](auto& m) { m.joints[1].body_a = m.joints[1].body_b = kGround; },
                 {"joint 'j1'", "the ground", "to itself"});
  expect_refusal([](auto& m) { m.joints[1].body_b = 9; }, {"joint 'j1'", "no body 9"});
  expect_refusal([](auto& m) { m.joints[1].name = "j0"; }, {"joint 'j0'", "twice"});
  expect_refusal([](auto& m) { m.joints[1].name = ""; }, {"needs a name"});
  expect_refusal([](auto& m) { m.joints[1].laws[2].damping = -1; }, {"joint 'j1'", "-1"});
  expect_refusal(
      [](auto& m) {
        m.joints[1].laws[0].stops = true;
        m.joints[1].laws[0].lower = 2;
        m.joints[1].laws[0].upper = 1;
      },
      {"joint 'j1'", "stops are at 2 and 1"});
  expect_refusal([](auto& m) { m.joints[1].a.q_BF.w = 2; }, {"joint 'j1'", "unit quaternion"});
}

TEST(AnAssembly, refuses_a_body_that_hangs_on_nothing) {
  expect_refusal([](auto& m) { m.joints.pop_back(); }, {"body 'b3'", "hangs on nothing", "'b0'"});
  expect_refusal(
      [](auto& m) {
        m.joints[1].body_a = kGround;
        m.joints[1].a.point_B = m.bodies[2].x_I + rotate(m.bodies[2].q_IB, m.joints[1].b.point_B);
      },
      {"body 'b0'", "hangs on nothing", "the ground"});
}

TEST(AnAssembly, refuses_a_start_that_its_joints_forbid) {
  expect_refusal([](auto& m) { m.bodies[3].x_I.x += 0.01; },
                 {"joint 'j2'", "spherical", "translation along", "open by", " m ", "place()"});
  expect_refusal([](auto& m) { m.bodies[3].v_I.x += 0.01; },
                 {"joint 'j2'", "opens at", "m/s", "place()"});
  auto m = test::four_bodies(JointKind::revolute);
  m.bodies[3].omega_B.x += 0.1;
  EXPECT_THROW(Assembly<double>(m.bodies, m.joints), std::invalid_argument);
  m = test::four_bodies(JointKind::revolute);
  m.joints[1].b.q_BF = {0, 1, 0, 0};  // the axis the other way round
  EXPECT_THROW(Assembly<double>(m.bodies, m.joints), std::invalid_argument);
}

TEST(AnAssembly, finds_bodies_by_name) {
  const auto m = test::four_bodies();
  EXPECT_EQ(multibody::place_of(m.bodies, "b2"), 2);
  EXPECT_EQ(multibody::place_of(m.bodies, "ground"), kGround);
  EXPECT_THROW(multibody::place_of(m.bodies, "b9"), std::invalid_argument);
}

// ---- what a step says -----------------------------------------------------------------------------

TEST(AStep, is_split_until_no_body_turns_too_far) {
  Flight<double> fast(test::four_bodies()), fine(test::four_bodies());
  fast.run<Rk4>(2, 1'000'000'000);
  EXPECT_TRUE(fast.worst.resolved());
  EXPECT_GE(fast.worst.parts, 4);
  fine.run<Rk4>(20'000, 100'000);
  EXPECT_LT(test::distance(fast.state, fine.state), 0.3);
}

TEST(AStep, that_cannot_follow_the_turn_says_so) {
  Flight<double> flight(test::four_bodies());
  multibody::AssemblyLimits limits;
  limits.substeps = 2;
  const auto report = multibody::advance<Rk4>(flight.assembly, flight.work, flight.state,
                                              5'000'000'000, nullptr, multibody::NoLoad{}, limits);
  EXPECT_FALSE(report.resolved());
  EXPECT_TRUE(report.unresolved_angle || report.lost);
  EXPECT_EQ(report.parts, 2);
}

TEST(AStep, takes_a_stiff_spring_in_parts_or_says_so) {
  auto m = test::four_bodies();
  m.joints[0].laws[0].stiffness = 1e4;
  Flight<double> flight(m);
  flight.run<Rk4>(20, 10'000'000);
  EXPECT_TRUE(flight.worst.resolved());
  EXPECT_GT(flight.worst.parts, 3);
  m.joints[0].laws[0].stiffness = 1e12;
  m.joints[0].laws[0].rest = flight.assembly.starts().empty() ? 0 : 0.3;
  Flight<double> stiffer(m);
  stiffer.run<Rk4>(1, 10'000'000);
  EXPECT_TRUE(stiffer.worst.unresolved_stiffness);
}

TEST(AStep, of_what_has_come_to_rest_is_not_split) {
  auto m = test::four_bodies();
  for (auto& joint : m.joints) {
    for (auto& law : joint.laws) {
      law = {5, 0.1, 2, false, 0, 0, 0, 0};
    }
  }
  for (auto& start : m.starts) {
    start.rate = {};
  }
  m.bodies[0].omega_B = {};
  m.bodies[0].v_I = {};
  m.place();
  multibody::centre(m.bodies);
  for (const auto formulation :
       {multibody::Formulation::se3, multibody::Formulation::direct_product}) {
    Flight<double> flight(m, {formulation, {}});
    flight.run<Rk4>(4'000, 10'000'000);
    EXPECT_TRUE(flight.worst.resolved());
    EXPECT_LT(multibody::energy(flight.assembly, flight.state).kinetic, 1e-20);
    flight.worst = {};
    flight.run<Rk4>(100, 10'000'000);
    EXPECT_TRUE(flight.worst.resolved());
    EXPECT_LT(flight.worst.parts, 8);
  }
}

TEST(AStep, with_no_finite_load_leaves_the_state_as_it_was) {
  Flight<double> flight(test::four_bodies());
  const auto before = flight.state;
  flight.run<Rk4>(1, 10'000'000, nullptr, [](const multibody::LoadStage<double>&) {
    multibody::BodyLoad<double> load;
    load.force_I.x = std::numeric_limits<double>::quiet_NaN();
    return load;
  });
  EXPECT_TRUE(flight.worst.lost);
  EXPECT_EQ(flight.state, before);
}

TEST(ASingleBody, is_an_assembly_too_and_moves_as_a_free_body) {
  Mechanism<double> m;
  m.add_body("alone", 2, {0.9144, 1.098, 1.66});
  m.bodies[0].omega_B = {0.45549, 0.82623, 0.03476};
  m.bodies[0].v_I = {1, 2, 3};
  Flight<double> flight(m);
  const auto H = flight.state.bodies[0].H_I, p = flight.state.bodies[0].p_I;
  flight.run<Rk4>(100, 10'000'000);
  EXPECT_EQ(flight.state.bodies[0].H_I, H);
  EXPECT_EQ(flight.state.bodies[0].p_I, p);
  const RigidBody<double> body(Eigen::Matrix3d(m.bodies[0].inertia_B));
  auto state = make_state(Quat<double>{}, body.momentum(m.bodies[0].omega_B));
  for (int n = 0; n < 100; ++n) {
    CoadjointRk4::step(body, state, 0.01, NoTorque{});
  }
  EXPECT_LT(angle_between(state.q_IB, flight.state.bodies[0].q_IB), 1e-14);
  EXPECT_LT(norm(flight.point(0) - V{1, 2, 3}), 1e-14);
}

}  // namespace
}  // namespace adstar
