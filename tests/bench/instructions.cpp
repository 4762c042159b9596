// What a scene pays for the models that it does not name, in instructions: one free rigid body for 20,000 steps, by each
// way in a run of its own, counted by tests/bench/instructions.sh.
//   step     advance() of a rigid body, as a library user calls it from a loop of its own
//   fleet    100 of the same body in a scene, through the service's fleet, each stepped alone
//   scene    one of them, so that all that a beat costs for itself falls on it
//   nothing  neither: what both runs have besides

#include <cstdio>
#include <cstring>

#include "adstar/propagator.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace {

using namespace adstar;

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr int kSteps = 20'000, kFleet = 100;

scene::Spacecraft craft() {
  return scene::parse(
             "[simulation]\nstep = \"10ms\"\n[[spacecraft]]\nname = \"sat1\"\n"
             "inertia_body_kg_m2 = [0.9144, 1.098, 1.66]\n"
             "angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]\n",
             "bench.toml")
      .spacecraft.front();
}

/// As another file would call it.
[[gnu::noinline]] StepReport plain_step(const RigidBody<double>& body, State<double>& state,
                                        std::int64_t t_ns) {
  return advance<CoadjointRk4, double>(body, state, {}, t_ns, kStep_ns);
}

}  // namespace

int main(int argc, char** argv) {
  const char* const way = argc > 1 ? argv[1] : "";
  const scene::Spacecraft one = craft();
  const RigidBody<double> body(one.inertia_body_kg_m2);
  State<double> state = one.initial;
  const bool many = std::strcmp(way, "fleet") == 0;
  runtime::Fleet fleet(std::vector<scene::Spacecraft>(many ? kFleet : 1, one), "coadjoint_rk4",
                       StepLimits{}, runtime::Lanewise::alone);
  int unresolved = 0;
  if (std::strcmp(way, "step") == 0) {
    for (int n = 0; n < kSteps; ++n) {
      unresolved += plain_step(body, state, n * kStep_ns).resolved() ? 0 : 1;
    }
  } else if (many || std::strcmp(way, "scene") == 0) {
    for (int n = 0; n < (many ? kSteps / kFleet : kSteps); ++n) {
      unresolved += static_cast<int>(fleet.step(n * kStep_ns, kStep_ns));
    }
    state = fleet.vehicles()[0].state;
  } else if (std::strcmp(way, "nothing") != 0) {
    std::fprintf(stderr, "usage: instructions_bench step|fleet|scene|nothing\n");
    return 2;
  }
  std::printf("%.17g\n", state.q_IB.w);
  return unresolved;
}
