// Ten million steps of a free body: what must not change does not, and what may not grow does not.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "adstar/so3.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

constexpr int kSteps = 10'000'000;
constexpr std::int64_t kStepNs = 10'000'000;

struct Worst {
  double momentum_ulp = 0;
  double defect_first_half = 0, defect_second_half = 0;
};

template <class Scheme>
Worst run(const BodyOf<Scheme, double>& body, State<double>& state) {
  Worst worst;
  const double size = norm(state.H_I.value());
  for (int n = 0; n < kSteps; ++n) {
    advance<Scheme>(body, state, std::span<const Torque<double>>{}, n * kStepNs, kStepNs);
    const double difference = std::fabs(norm(body_momentum(state)) - size);
    worst.momentum_ulp = std::max(worst.momentum_ulp, difference / test::ulp(size));
    if (n % 64 == 0) {
      const Eigen::Matrix3d R = rotation_matrix(state.q_IB);
      const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
      double& half = n < kSteps / 2 ? worst.defect_first_half : worst.defect_second_half;
      half = std::max(half, defect);
    }
  }
  return worst;
}

template <class Scheme = CoadjointRk4>
void expect_kept(const Eigen::Matrix3d& J, const Vec3<double>& omega_B) {
  const BodyOf<Scheme, double> body{RigidBody<double>(J)};
  const Quat<double> q = normalised(Quat<double>{1, 2, -1, 0.5});
  const State<double> start = make_state(q, rotate(q, body.momentum(omega_B)));
  State<double> state = start;
  const Worst worst = run<Scheme>(body, state);
  EXPECT_EQ(state.H_I, start.H_I);
  EXPECT_LE(worst.momentum_ulp, 16);
  EXPECT_LT(worst.defect_first_half, 5e-15);
  EXPECT_LT(worst.defect_second_half, 5e-15);
  EXPECT_LT(worst.defect_second_half, 1.5 * worst.defect_first_half) << "it grows";
  testing::Test::RecordProperty("momentum_ulp", std::to_string(worst.momentum_ulp));
  testing::Test::RecordProperty("defect", std::to_string(worst.defect_second_half * 1e15) + "e-15");
}

TEST(LongRun, of_the_papers_body_keeps_momentum_and_rotation) {
  expect_kept(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal(), {0.45549, 0.82623, 0.03476});
}

TEST(LongRun, with_a_full_tensor_keeps_momentum_and_rotation) {
  expect_kept(test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1})),
              {0.45549, 0.82623, 0.03476});
}

TEST(LongRun, with_stages_in_float_keeps_momentum_and_rotation) {
  expect_kept<CoadjointRk4Float>(
      test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1})),
      {0.45549, 0.82623, 0.03476});
}

TEST(LongRun, of_a_fast_spinner_keeps_momentum_and_rotation) {
  expect_kept(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal(), {30, -5, 12});
}

}  // namespace
}  // namespace adstar
