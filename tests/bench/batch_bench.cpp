// Nanoseconds a step of one vehicle of a fleet, one by one and over the lanes of each instruction
// set, and beside it what must be zero: vehicles whose bits differ from those stepped one by one.
//
// "fleet/LOAD/LANES/VEHICLES" is the service's step: sorting, guard, kernels, and what is left;
// "fleet_float/..." the same with float stages. "attitude_error_rad" is the step's own, after 100 s,
// against coadjoint_rk4 at a sixteenth of it. "hour_at_1_khz" steps eight satellites at 1 deg/s and says
// how far stages in float have parted from double's.

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "service/batch/kernels.hpp"
#include "service/runtime/fleet.hpp"
#include "tests/support/random_motion.hpp"

namespace {

using namespace adstar;
using runtime::Fleet;
using runtime::Lanewise;
using Torques = std::vector<Torque<double>>;

constexpr std::int64_t kStep = 10'000'000;
constexpr double kAttitudeSpan_s = 100;

struct Load {
  const char* name;
  Torques torques;
  bool full_tensor;
  double speed_rad_s;
};

struct Choice {
  const char* name;
  Lanewise lanewise;
  bool runs;
};

std::vector<Choice> choices() {
  using batch::InstructionSet;
  return {{"alone", Lanewise::alone, true},
          {"sse2", Lanewise::sse2, batch::runs_here(InstructionSet::sse2)},
          {"avx2", Lanewise::avx2, batch::runs_here(InstructionSet::avx2)},
          {"avx512", Lanewise::avx512, batch::runs_here(InstructionSet::avx512)}};
}

std::vector<Load> loads() {
  const Vec3<double> size{1e-4, -2e-4, 1e-4};
  const Torque<double> harmonic =
      Harmonic<double>{Frame::body, {1e-4, 2e-4, 0}, {0.5, 0.3, 0}, {0, 1.57, 0}};
  return {{"free", {}, false, 0.5},
          {"free_full_tensor", {}, true, 0.5},
          {"free_fast", {}, false, 10},
          {"free_split", {}, false, 100},
          {"constant_body", {Constant<double>{Frame::body, size}}, false, 0.5},
          {"constant_inertial", {Constant<double>{Frame::inertial, size}}, false, 0.5},
          {"harmonic_body", {harmonic}, false, 0.5}};
}

std::vector<scene::Spacecraft> crafts(const Load& load, std::size_t vehicles) {
  test::Generator random(1);
  std::vector<scene::Spacecraft> all(vehicles);
  for (scene::Spacecraft& craft : all) {
    const Eigen::Vector3d moments(0.9144 + test::uniform(random, 0, 0.1), 1.098, 1.66);
    craft.inertia_body_kg_m2 = load.full_tensor
                                   ? test::rotated_inertia(moments, test::unit_quaternion(random))
                                   : Eigen::Matrix3d(moments.asDiagonal());
    const RigidBody<double> body(craft.inertia_body_kg_m2);
    const Quat<double> q = test::unit_quaternion(random);
    craft.initial =
        make_state(q, rotate(q, body.momentum(load.speed_rad_s * test::unit_vector(random))));
    craft.torques = load.torques;
  }
  return all;
}

void run(Fleet& fleet, std::int64_t steps, std::int64_t h_ns) {
  for (std::int64_t n = 0; n < steps; ++n) {
    fleet.step(n * h_ns, h_ns);
  }
}

double attitude_error(const Load& load, const char* scheme) {
  const auto steps = static_cast<std::int64_t>(kAttitudeSpan_s * 1e9) / kStep;
  Fleet coarse(crafts(load, 8), scheme, StepLimits{});
  Fleet fine(crafts(load, 8), "coadjoint_rk4", StepLimits{});
  run(coarse, steps, kStep);
  run(fine, 16 * steps, kStep / 16);
  double worst = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    worst = std::max(worst,
                     angle_between(coarse.vehicles()[i].state.q_IB, fine.vehicles()[i].state.q_IB));
  }
  return worst;
}

double differing(const Load& load, const char* scheme, Lanewise lanewise, std::size_t vehicles) {
  Fleet lanes(crafts(load, vehicles), scheme, StepLimits{}, lanewise);
  Fleet alone(crafts(load, vehicles), scheme, StepLimits{}, Lanewise::alone);
  run(lanes, 200, kStep);
  run(alone, 200, kStep);
  double count = 0;
  for (std::size_t i = 0; i < vehicles; ++i) {
    count += std::memcmp(&lanes.vehicles()[i].state, &alone.vehicles()[i].state,
                         sizeof(State<double>)) == 0
                 ? 0
                 : 1;
  }
  return count;
}

void fleet_step(benchmark::State& bench, const Load& load, const char* scheme, Lanewise lanewise) {
  const auto vehicles = static_cast<std::size_t>(bench.range(0));
  const std::vector<scene::Spacecraft> start = crafts(load, vehicles);
  Fleet fleet(start, scheme, StepLimits{}, lanewise);
  std::int64_t n = 0;
  for (auto _ : bench) {
    fleet.step(n++ * kStep, kStep);
    benchmark::ClobberMemory();
    if (n == 4096) {  // or a torque would spin them up until their steps are split
      bench.PauseTiming();
      for (std::size_t i = 0; i < vehicles; ++i) {
        fleet.vehicles()[i].state = start[i].initial;
      }
      n = 0;
      bench.ResumeTiming();
    }
  }
  bench.counters["ns_a_vehicle"] = benchmark::Counter(
      static_cast<double>(vehicles) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  bench.counters["differing"] = differing(load, scheme, lanewise, vehicles);
  bench.counters["attitude_error_rad"] = attitude_error(load, scheme);
}

void hour_at_1_khz(benchmark::State& bench) {
  constexpr std::int64_t kMs = 1'000'000;
  const Load slow{"slow", {}, true, 0.01745};
  Fleet in_float(crafts(slow, 8), "coadjoint_rk4_float", StepLimits{});
  Fleet in_double(crafts(slow, 8), "coadjoint_rk4", StepLimits{});
  for (auto _ : bench) {
    run(in_float, 3'600'000, kMs);
  }
  run(in_double, 3'600'000, kMs);
  double worst = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    worst = std::max(worst, angle_between(in_float.vehicles()[i].state.q_IB,
                                          in_double.vehicles()[i].state.q_IB));
  }
  bench.counters["apart_rad"] = worst;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("compiler", ADSTAR_COMPILER);
  static const std::vector<Load> kLoads = loads();
  for (const auto& [group, scheme] :
       {std::pair{"fleet/", "coadjoint_rk4"}, std::pair{"fleet_float/", "coadjoint_rk4_float"}}) {
    for (const Load& load : kLoads) {
      for (const Choice& choice : choices()) {
        const std::string name = std::string(group) + load.name + "/" + choice.name;
        if (!choice.runs) {
          benchmark::AddCustomContext(name, "skipped: not on this processor");
          continue;
        }
        auto* const bench =
            benchmark::RegisterBenchmark(name.c_str(), fleet_step, load, scheme, choice.lanewise)
                ->Arg(1000);
        if (&load == &kLoads.front()) {
          bench->Arg(1)->Arg(8)->Arg(100)->Arg(10000);
        }
      }
    }
  }
  benchmark::RegisterBenchmark("hour_at_1_khz", hour_at_1_khz)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
