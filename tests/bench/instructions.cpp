// What a scene pays for the models that it does not name, in instructions: one free rigid body for 20,000 steps, by each
// way in a run of its own, counted by tests/bench/instructions.sh.
//   step     advance() of a rigid body, as a library user calls it
//   scene    the same body as a scene's only spacecraft, through the service's fleet
//   nothing  neither: what both runs have besides

#include <cstdio>
#include <cstring>

#include "adstar/propagator.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace {

using namespace adstar;

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr int kSteps = 20'000;

scene::Spacecraft craft() {
  return scene::parse(
             "[simulation]\nstep = \"10ms\"\n[[spacecraft]]\nname = \"sat1\"\n"
             "inertia_body_kg_m2 = [0.9144, 1.098, 1.66]\n"
             "angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]\n",
             "bench.toml")
      .spacecraft.front();
}

}  // namespace

int main(int argc, char** argv) {
  const char* const way = argc > 1 ? argv[1] : "";
  const scene::Spacecraft one = craft();
  const RigidBody<double> body(one.inertia_body_kg_m2);
  State<double> state = one.initial;
  runtime::Fleet fleet({one}, "coadjoint_rk4", StepLimits{}, runtime::Lanewise::alone);
  if (std::strcmp(way, "step") == 0) {
    for (int n = 0; n < kSteps; ++n) {
      advance<CoadjointRk4, double>(body, state, {}, n * kStep_ns, kStep_ns);
    }
  } else if (std::strcmp(way, "scene") == 0) {
    for (int n = 0; n < kSteps; ++n) {
      fleet.step(n * kStep_ns, kStep_ns);
    }
    state = fleet.vehicles()[0].state;
  } else if (std::strcmp(way, "nothing") != 0) {
    std::fprintf(stderr, "usage: instructions_bench step|scene|nothing\n");
    return 2;
  }
  std::printf("%.17g\n", state.q_IB.w);
  return 0;
}
