// The closed form, 100 s of the paper's body in one step.
//
// In a unit of its own: beside step_bench's functions it changes what the compiler inlines there.

#include <benchmark/benchmark.h>

#include "adstar/propagator.hpp"

namespace {

using namespace adstar;

void one_shot(benchmark::State& bench) {
  const Eigen::Matrix3d J = Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal();
  const BodyOf<FreeExact, double> body{RigidBody<double>(J)};
  const auto begin = make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  for (auto _ : bench) {
    adstar::State<double> state = begin;
    FreeExact::step(body, state, 100.0, NoTorque{});
    benchmark::DoNotOptimize(state);
  }
}
BENCHMARK(one_shot)->Name("free_exact/one_shot");

}  // namespace
