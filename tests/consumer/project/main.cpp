// Propagates a free body for a minute; fails when its inertial momentum has moved at all.
#include <cstdio>

#include <adstar/propagator.hpp>

int main() {
  const adstar::RigidBody<double> body(
      Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
  const auto start =
      adstar::make_state(adstar::Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  auto state = start;
  for (std::int64_t n = 0; n < 6000; ++n) {
    adstar::advance<adstar::CoadjointRk4, double>(body, state, {}, n * 10'000'000, 10'000'000);
  }
  std::printf("q_w after a minute: %.17g\n", state.q_IB.w);
  return state.H_I == start.H_I && !(state.q_IB == start.q_IB) ? 0 : 1;
}
