// Torques of time, asked at all nodes of a step together: the bits of asking at each.
#include "adstar/segment.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"

namespace adstar::detail {
namespace {

std::vector<Torque<double>> every_kind() {
  return {Constant<double>{Frame::body, {0.1, -0.2, 0.3}},
          Harmonic<double>{Frame::body, {0.02, 0, -0.01}, {0.5, 0.3, 2}, {0, 1, 2}},
          Harmonic<double>{Frame::inertial, {0, 0.3, 0.1}, {1e9, 0.7, 0.1}, {0.1, 0, 0}},
          Table<double>{Frame::inertial,
                        Interpolation::linear,
                        AfterEnd::zero,
                        {0, 10'000'000'000},
                        {{1, 2, 3}, {-3, 0, 1}}}};
}

template <class Nodes>
void expect_the_bits_of_each(const std::vector<Torque<double>>& torques, std::int64_t t_ns) {
  const std::span<const Torque<double>> all(torques);
  const Segment<double> segment = make_segment(all, t_ns);
  const double t_s = seconds<double>(t_ns), begun = 0.125, h = 0.3;
  const NodeTorques<Nodes, double> together(segment, all, t_s, begun, h);
  const Quat<double> q;
  const Rotation<double> none;
  for (int i = 0; i < Nodes::kStages; ++i) {
    const double since = h * Nodes::c[i].template as<double>();
    const TorqueSample<double> got = together(Stage<double>{since, {}, q, none, i});
    const TorqueSample<double> each = torque_at(segment, all, t_s, begun + since);
    EXPECT_EQ(got.body, each.body) << "node " << i;
    EXPECT_EQ(got.inertial, each.inertial) << "node " << i;
  }
}

TEST(NodeTorques, have_the_bits_of_torques_asked_one_by_one) {
  for (const std::int64_t t_ns : {0LL, 1'234'567'891LL, 86'400'000'000'000LL}) {
    expect_the_bits_of_each<Midpoint2>(every_kind(), t_ns);
    expect_the_bits_of_each<Rk4>(every_kind(), t_ns);
    expect_the_bits_of_each<Fehlberg8>(every_kind(), t_ns);
    expect_the_bits_of_each<Dop853>(every_kind(), t_ns);
  }
}

TEST(NodeTorques, number_every_stage_of_the_schemes_that_have_them) {
  // A scheme that gave two stages the same number would feel the torque of another instant.
  const Quat<double> q;
  const RigidBody<double> body(Eigen::Vector3d(1, 2, 3).asDiagonal());
  const auto numbers_of = [&]<class Scheme>(Scheme) {
    std::vector<int> numbers;
    State<double> state = make_state(q, Vec3<double>{0.1, 0.2, 0.3});
    Scheme::step(body, state, 0.01, rateless_body_torque([&](const Stage<double>& stage) {
                   EXPECT_EQ(stage.time_s,
                             0.01 * Scheme::Nodes::c[stage.number].template as<double>());
                   numbers.push_back(stage.number);
                   return TorqueSample<double>{};
                 }));
    return numbers;
  };
  const auto rising = [](int count) {
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i) {
      numbers.push_back(i);
    }
    return numbers;
  };
  EXPECT_EQ(numbers_of(CoadjointRk4{}), rising(4));
  EXPECT_EQ(numbers_of(CoadjointFehlberg8{}), rising(12));
  EXPECT_EQ(numbers_of(ProjectedDopri5{}), rising(6));
  EXPECT_EQ(numbers_of(ProjectedDop853{}), rising(12));
}

}  // namespace
}  // namespace adstar::detail
