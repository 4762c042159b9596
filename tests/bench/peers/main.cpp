// What it costs to hold an accuracy: this library's schemes beside what Debian packages, in one run.
//
// For every case, accuracy and method the cheapest of a row of steps that hold the accuracy at the
// end of the case is found first; that run is then timed. Peers integrate the plain equations on
// (q, omega) and conserve nothing; `momentum_error` (relative, in the inertial frame) shows it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include <benchmark/benchmark.h>

#include "service/trade/truth.hpp"
#include "tests/bench/peers/body_of_case.hpp"
#include "tests/bench/peers/method.hpp"

namespace {

using namespace adstar;
using namespace adstar::peers;

const Case kCases[] = {
    {"paper_free", {0.9144, 1.098, 1.66}, {0.45549, 0.82623, 0.03476}, 0, 100},
    {"paper_forced", {0.9144, 1.098, 1.66}, {0.45549, 0.82623, 0.03476}, 1, 100},
    {"weakly_forced_1h", {0.9144, 1.098, 1.66}, {0.45549, 0.82623, 0.03476}, 1e-5, 3600}};

/// Steps in 100 s: round ones, that come out in whole nanoseconds.
constexpr int kStepsIn100s[] = {
    1,    8,    10,   16,    20,    25,    32,    40,    50,    64,    80,    100,    125,   160,
    200,  250,  320,  400,   500,   625,   800,   1000,  1250,  1600,  2000,  2500,   3200,  4000,
    5000, 6250, 8000, 10000, 12500, 16000, 20000, 25000, 40000, 50000, 80000, 100000, 200000};

struct Errors {
  double attitude_rad, momentum;
};

Errors errors_of(const End& end, const trade::TrueState& truth) {
  using trade::Wide;
  const auto wide = [](double v) { return static_cast<Wide>(v); };
  const Quat<Wide> q = normalised(
      Quat<Wide>{wide(end.q_IB.w), wide(end.q_IB.x), wide(end.q_IB.y), wide(end.q_IB.z)});
  const Vec3<Wide> H = rotate(q, Vec3<Wide>{wide(end.Pi_B.x), wide(end.Pi_B.y), wide(end.Pi_B.z)});
  return {static_cast<double>(angle_between(truth.q_IB, q)),
          static_cast<double>(norm(H - truth.H_I) / norm(truth.H_I))};
}

/// Seconds that one run takes: the best of five, for choosing only.
double quick_cost_s(const Method& method, const Case& the_case, int steps) {
  using Clock = std::chrono::steady_clock;
  Clock::duration best = Clock::duration::max();
  for (int run = 0; run < 5; ++run) {
    const Clock::time_point begun = Clock::now();
    End end = method.run(the_case, steps);
    benchmark::DoNotOptimize(end);
    best = std::min(best, Clock::now() - begun);
  }
  return std::chrono::duration<double>(best).count();
}

/// The number of steps that holds the accuracy at the least cost. Not always the fewest: a long step that
/// its guard splits may cost more than a shorter one that is left whole.
std::optional<int> cheapest_steps(const Method& method, const Case& the_case,
                                  const trade::TrueState& truth, double accuracy_rad) {
  const auto holds = [&](int steps) {
    return errors_of(method.run(the_case, steps), truth).attitude_rad <= accuracy_rad;
  };
  if (method.exact) {
    return holds(1) ? std::optional<int>(1) : std::nullopt;
  }
  constexpr int kWorthATry = 64;  // times the fewest that hold
  std::optional<int> fewest, cheapest;
  double least_s = std::numeric_limits<double>::infinity();
  for (const int per_100s : kStepsIn100s) {
    const int steps = static_cast<int>(per_100s * the_case.horizon_s / 100);
    if (fewest && steps > kWorthATry * *fewest) {
      break;
    }
    if (!holds(steps)) {
      continue;
    }
    fewest = fewest.value_or(steps);
    const double cost_s = quick_cost_s(method, the_case, steps);
    if (cost_s < least_s) {
      least_s = cost_s;
      cheapest = steps;
    } else if (cost_s > 2 * least_s) {
      break;
    }
  }
  return cheapest;
}

void add(const Method& method, const Case& the_case, const trade::TrueState& truth,
         double accuracy_rad) {
  const std::optional<int> steps = cheapest_steps(method, the_case, truth, accuracy_rad);
  char goal[32];
  std::snprintf(goal, sizeof goal, "%.0e", accuracy_rad);
  const std::string name =
      std::string(the_case.name) + "/" + goal + "/" + method.name + (steps ? "" : "/not_held");
  if (!steps) {
    std::printf("%s\n", name.c_str());
    return;
  }
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& bench) {
    End end;
    for (auto _ : bench) {
      end = method.run(the_case, *steps);
      benchmark::DoNotOptimize(end);
    }
    const Errors errors = errors_of(end, truth);
    bench.counters["attitude_error_rad"] = errors.attitude_rad;
    bench.counters["momentum_error"] = errors.momentum;
    bench.counters["steps"] = *steps;
  })->Unit(benchmark::kMicrosecond);
}

std::vector<Method> all_methods() {
  std::vector<Method> all = own_schemes();
  const auto join = [&](std::vector<Method> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  join(odeint_methods());
#ifdef ADSTAR_PEER_GSL
  join(gsl_methods());
#endif
#ifdef ADSTAR_PEER_SUNDIALS
  join(sundials_methods());
#endif
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  static const std::vector<Method> kMethods = all_methods();
  for (const Case& the_case : kCases) {
    const trade::Truth truth = trade::find_truth(
        {spacecraft_of(the_case)}, {static_cast<std::int64_t>(the_case.horizon_s) * 1'000'000'000},
        1e-14, [](double) { return true; });
    for (const double accuracy_rad : {1e-6, 1e-9}) {
      for (const Method& method : kMethods) {
        if (!(method.free_only && the_case.torque_scale != 0)) {
          add(method, the_case, truth.spacecraft[0][0], accuracy_rad);
        }
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
