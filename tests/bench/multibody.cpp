// Constrained bodies: error, momentum and cost of both formulations side by side, over a long run, and by length
// of the chain. cmake --build build/release --target multibody_figures; the argument is the length of the long run.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/mechanisms.hpp"

namespace {

using namespace adstar;
using multibody::Formulation;
using test::Flight;

constexpr Formulation kBoth[] = {Formulation::se3, Formulation::direct_product};
const char* name_of(Formulation f) { return f == Formulation::se3 ? "se3" : "direct_product"; }

template <class Action>
double seconds_of(Action action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Drift {
  double p, H;
};
Drift drift(const Flight<double>& flight) {
  const auto now = multibody::total_momentum(flight.assembly, flight.state);
  const auto start =
      multibody::total_momentum(flight.assembly, multibody::make_state(flight.assembly));
  double each = 0;
  for (const auto& body : flight.state.bodies) {
    each = std::max(each, norm(body.p_I.value()));
  }
  return {norm(now.p_I.value() - start.p_I.value()) / each,
          norm(now.H_I.value() - start.H_I.value()) / norm(start.H_I.value())};
}

template <class Tableau>
void compare(const char* tableau, const Flight<double>& truth, std::int64_t h_ns) {
  for (const Formulation formulation : kBoth) {
    for (const bool project : {true, false}) {
      Flight<double> flight(test::four_bodies(), {formulation, {}});
      const double energy = flight.energy();
      const std::int64_t steps = 10'000'000'000 / h_ns;
      multibody::AssemblyLimits limits;
      limits.project = project;
      const double cost = seconds_of(
          [&] { flight.run<Tableau>(steps, h_ns, nullptr, multibody::NoLoad{}, limits); });
      multibody::observe(flight.assembly, flight.work, flight.state);
      double gap = 0;
      for (const auto& joint : flight.work.joints) {
        gap = std::max(gap, norm(joint.d));
      }
      const Drift d = drift(flight);
      std::printf("%-8s %-14s %-9s %5.3g  %8.1e  %8.1e  %8.1e  %8.1e  %8.1e  %6.2f\n", tableau,
                  name_of(formulation), project ? "projected" : "left", 1e-9 * double(h_ns),
                  test::distance(flight.state, truth.state), d.H, d.p, flight.energy() / energy - 1,
                  gap, 1e6 * cost / double(steps));
    }
  }
}

/// Median of the time of a step [µs].
double step_us(int links, Formulation formulation) {
  Flight<double> flight(test::tether<double>(links), {formulation, {}});
  std::vector<double> all;
  for (int i = 0; i < 200; ++i) {
    all.push_back(seconds_of([&] { flight.run<Rk4>(1, 1'000'000); }));
  }
  std::nth_element(all.begin(), all.begin() + 100, all.end());
  return 1e6 * all[100];
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t long_run = argc > 1 ? std::atoll(argv[1]) : 100'000;
  std::printf(
      "Four bodies on three spherical joints, free, 10 s: error [m, rad] against dop853 at 1 ms\n");
  std::printf(
      "tableau  formulation    joints    h [s]  error     H drift   p drift   energy    gap [m]   "
      "us a step\n");
  Flight<double> truth(test::four_bodies());
  truth.run<Dop853>(10'000, 1'000'000);
  for (const std::int64_t h_ns : {20'000'000, 10'000'000, 5'000'000}) {
    compare<Rk4>("rk4", truth, h_ns);
  }
  for (const std::int64_t h_ns : {50'000'000, 20'000'000}) {
    compare<Dop853>("dop853", truth, h_ns);
  }

  std::printf("\nThe same over %lld steps of 10 ms, rk4, projected\n",
              static_cast<long long>(long_run));
  for (const Formulation formulation : kBoth) {
    Flight<double> flight(test::four_bodies(), {formulation, {}});
    const double energy = flight.energy();
    const double cost = seconds_of([&] { flight.run<Rk4>(long_run, 10'000'000); });
    const Drift d = drift(flight);
    std::printf(
        "%-14s H drift %.1e, p drift %.1e, energy %.1e, worst gap %.1e, %s, %.2f us a step\n",
        name_of(formulation), d.H, d.p, flight.energy() / energy - 1, flight.worst.gap,
        flight.worst.resolved() ? "resolved" : "UNRESOLVED", 1e6 * cost / double(long_run));
  }

  std::printf(
      "\nA tether of rods on spherical joints, rk4, 1 ms, projected: us a step\n links      se3  "
      "direct_product\n");
  for (const int links : {2, 10, 50, 100, 200, 400}) {
    std::printf("%6d %8.1f %8.1f\n", links, step_us(links, Formulation::se3),
                step_us(links, Formulation::direct_product));
  }
}
