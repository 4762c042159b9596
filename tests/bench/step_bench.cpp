// Nanoseconds a step of one body, and beside it the attitude error that the step buys.
//
// The error is that of the scheme after 10 s of the timed motion at the timed step, against the
// same run at a sixteenth of the step: what separates them is the coarser run's own error.

#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "adstar/propagator.hpp"
#include "tests/support/random_motion.hpp"

namespace {

using namespace adstar;
using V = Vec3<double>;

struct Motion {
  const char* name;
  Eigen::Matrix3d J;
  V omega_B;
  std::vector<Torque<double>> torques;
};

constexpr std::int64_t kStep = 10'000'000;

State<double> start(const Motion& motion, const RigidBody<double>& body) {
  return make_state(Quat<double>{}, body.momentum(motion.omega_B));
}

State<double> ten_seconds(const Motion& motion, std::int64_t h_ns) {
  const RigidBody<double> body(motion.J);
  State<double> state = start(motion, body);
  for (std::int64_t t = 0; t < 10'000'000'000; t += h_ns) {
    advance<CoadjointRk4>(body, state, std::span<const Torque<double>>(motion.torques), t, h_ns);
  }
  return state;
}

/// The step as the service takes it: edges, guard, and the scheme.
void step(benchmark::State& bench, const Motion& motion) {
  const RigidBody<double> body(motion.J);
  State<double> state = start(motion, body);
  std::int64_t t = 0;
  for (auto _ : bench) {
    if (t ==
        1024 * kStep) {  // or a constant torque would spin the body up until its steps are split
      state = start(motion, body);
      t = 0;
    }
    advance<CoadjointRk4>(body, state, std::span<const Torque<double>>(motion.torques), t, kStep);
    t += kStep;
    benchmark::DoNotOptimize(state);
  }
  bench.counters["attitude_error_rad"] =
      angle_between(ten_seconds(motion, kStep).q_IB, ten_seconds(motion, kStep / 16).q_IB);
}

/// The scheme alone, on a free body.
void scheme_alone(benchmark::State& bench, const Motion& motion) {
  const RigidBody<double> body(motion.J);
  State<double> state = start(motion, body);
  for (auto _ : bench) {
    CoadjointRk4::step(body, state, 0.01, NoTorque{});
    benchmark::DoNotOptimize(state);
  }
}

std::vector<Motion> motions() {
  const Eigen::Matrix3d diagonal = Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal();
  const Eigen::Matrix3d full =
      test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1}));
  const V omega{0.45549, 0.82623, 0.03476}, slow{0.01, -0.02, 0.015};
  const Constant<double> constant{Frame::body, {0.02, -0.01, 0.01}};
  const Constant<double> inertial{Frame::inertial, {0.02, -0.01, 0.01}};
  const Harmonic<double> harmonic{Frame::body, {0.02, 0.015, 0}, {0.5, 0.3, 0}, {0, 1.57, 0}};
  Commanded<double> pulse;
  pulse.window[0] = {0, kNever, {0.02, -0.01, 0.01}};
  pulse.intervals = 1;
  return {{"free", diagonal, omega, {}},
          {"free/full_tensor", full, omega, {}},
          {"free/slow", diagonal, slow, {}},
          {"constant_body", diagonal, omega, {constant}},
          {"constant_body/full_tensor", full, omega, {constant}},
          {"constant_inertial", diagonal, omega, {inertial}},
          {"commanded_body", diagonal, omega, {pulse}},
          {"harmonic_body", diagonal, omega, {harmonic}},
          {"harmonic_body_and_constant", diagonal, omega, {harmonic, constant}}};
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("compiler", ADSTAR_COMPILER);
  static const std::vector<Motion> kMotions = motions();
  for (const Motion& motion : kMotions) {
    benchmark::RegisterBenchmark((std::string("step/") + motion.name).c_str(), step, motion);
  }
  benchmark::RegisterBenchmark("scheme_alone/free", scheme_alone, kMotions[0]);
  benchmark::RegisterBenchmark("scheme_alone/free/full_tensor", scheme_alone, kMotions[1]);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
