// The paper's body against values that share nothing with the library (README.md beside this file).
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::kEpsilon;
using V = Vec3<double>;

struct Row {
  Quat<double> q_IB;
  V Pi_B;
};

std::map<std::string, Row> reference() {
  std::ifstream file(ADSTAR_SOURCE_DIR "/tests/reference/reference.csv");
  std::string line;
  std::getline(file, line);
  std::map<std::string, Row> rows;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) {
      cell.push_back(text);
    }
    const auto number = [&](std::size_t i) { return std::stod(cell.at(i)); };
    rows[cell.at(0)] = {{number(2), number(3), number(4), number(5)},
                        {number(6), number(7), number(8)}};
  }
  return rows;
}

/// The run of one row, in body axes turned by Q against the row's: v' = Q v.
struct Case {
  std::string name;
  Quat<double> Q;
};

constexpr std::int64_t kEnd = 100'000'000'000;

State<double> run(const Case& c, std::int64_t h_ns) {
  const Eigen::Vector3d moments(0.9144, 1.098, 1.66);
  const bool turned = !(c.Q == Quat<double>{});
  const Eigen::Matrix3d J =
      turned ? test::rotated_inertia(moments, c.Q) : Eigen::Matrix3d(moments.asDiagonal());
  const RigidBody<double> body(J);
  const Quat<double> q_IB = {c.Q.w, -c.Q.x, -c.Q.y, -c.Q.z};
  const V Pi_B = rotate(c.Q, V{0.9144 * 0.45549, 1.098 * 0.82623, 1.66 * 0.03476});
  State<double> state = make_state(q_IB, rotate(q_IB, Pi_B));
  if (!turned) {
    state = make_state(q_IB, Pi_B);
  }
  // tau' = Q tau, one harmonic for every axis of the row's frame: each has one frequency and phase.
  std::vector<Torque<double>> torques;
  if (c.name == "paper_forced") {
    const auto along = [&](const V& axis, double amplitude, double frequency, double phase) {
      torques.emplace_back(Harmonic<double>{Frame::body,
                                            amplitude * rotate(c.Q, axis),
                                            {frequency, frequency, frequency},
                                            {phase, phase, phase}});
    };
    along({1, 0, 0}, 0.02, 0.5, 0);
    along({0, 1, 0}, 0.015, 0.3, 1.5707963267948966);
    torques.emplace_back(Constant<double>{Frame::body, rotate(c.Q, V{0, 0, 0.01})});
  }
  for (std::int64_t t = 0; t < kEnd; t += h_ns) {
    EXPECT_TRUE(
        advance<CoadjointRk4>(body, state, std::span<const Torque<double>>(torques), t, h_ns)
            .resolved());
  }
  return state;
}

double attitude_error(const Case& c, std::int64_t h_ns) {
  return angle_between(reference().at(c.name).q_IB, run(c, h_ns).q_IB * c.Q);
}

class Reference : public testing::TestWithParam<Case> {};

TEST(ReferenceValues, are_there_and_are_attitudes) {
  const auto rows = reference();
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& [name, row] : rows) {
    EXPECT_NEAR(squared_norm(row.q_IB), 1, 4 * kEpsilon) << name;
  }
}

TEST_P(Reference, is_met_within_a_nanoradian_at_10_ms) {
  const State<double> end = run(GetParam(), 10'000'000);
  const Row expected = reference().at(GetParam().name);
  EXPECT_LT(angle_between(expected.q_IB, end.q_IB * GetParam().Q), 1e-9);
  EXPECT_LT(norm(rotate_inverse(GetParam().Q, body_momentum(end)) - expected.Pi_B), 1e-9);
}

TEST_P(Reference, is_approached_with_order_four) {
  const double coarse = attitude_error(GetParam(), 12'500'000),
               fine = attitude_error(GetParam(), 6'250'000);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.15) << "errors " << coarse << " and " << fine;
}

TEST_P(Reference, has_the_inertial_momentum_that_the_torque_leaves) {
  const State<double> end = run(GetParam(), 10'000'000);
  const Row expected = reference().at(GetParam().name);
  const V H_I = rotate(expected.q_IB, expected.Pi_B);
  EXPECT_LT(norm(end.H_I.value() - H_I), GetParam().name == "paper_free" ? 2e-15 : 1e-11);
}

const Quat<double> kTurned = normalised(Quat<double>{0.7, -0.4, 0.5, 0.3});

INSTANTIATE_TEST_SUITE_P(Paper, Reference,
                         testing::Values(Case{"paper_free", {}}, Case{"paper_forced", {}},
                                         Case{"paper_free", kTurned},
                                         Case{"paper_forced", kTurned}),
                         [](const testing::TestParamInfo<Case>& test) {
                           return test.param.name +
                                  (test.param.Q == Quat<double>{} ? "_diagonal" : "_full_tensor");
                         });

}  // namespace
}  // namespace adstar
