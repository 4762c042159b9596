// A thousand million steps in one run: what is conserved over 1e9 steps of 10 ms, 116 days, and what is
// not.
//
//   cmake --build build/release --target long_run_bench
//   build/release/tests/bench/long_run_bench [--steps 1000000000] [SCHEME ...]
//
// The paper's free body (Terze, Müller, Zlatar). At every decade of steps: whether the momentum still has
// the bits of the start, by how much the quaternion's length and the energy are off, and the angle to the
// closed form in 64-bit mantissa.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "adstar/propagator.hpp"

namespace {

using namespace adstar;
using Wide = long double;

constexpr std::int64_t kStepNs = 10'000'000;

Eigen::Matrix3d inertia() { return Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal(); }

State<double> start() {
  const RigidBody<double> body(inertia());
  return make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
}

/// From the closed form, `t_ns` after the start.
double attitude_error_rad(const State<double>& state, std::int64_t t_ns) {
  const Vec3<double> H = start().H_I.value();
  State<Wide> truth = make_state(Quat<Wide>{1, 0, 0, 0}, Vec3<Wide>{H.x, H.y, H.z});
  const BodyOf<FreeExact, Wide> body{RigidBody<Wide>(inertia().cast<Wide>())};
  FreeExact::step(body, truth, seconds<Wide>(t_ns), NoTorque{});
  const Quat<double>& q = state.q_IB;
  return static_cast<double>(
      angle_between(normalised(truth.q_IB), normalised(Quat<Wide>{q.w, q.x, q.y, q.z})));
}

template <class Scheme>
void print_row(const BodyOf<Scheme, double>& body, const State<double>& state, std::int64_t n) {
  const State<double> begin = start();
  const bool same = std::memcmp(&state.H_I, &begin.H_I, sizeof begin.H_I) == 0;
  const double E_0 = body.energy(body_momentum(begin)), E = body.energy(body_momentum(state));
  std::printf("%12lld  %-9s  %9.1e  %9.1e  %9.1e\n", static_cast<long long>(n),
              same ? "unchanged" : "CHANGED", squared_norm(state.q_IB) - 1, (E - E_0) / E_0,
              attitude_error_rad(state, n * kStepNs));
  std::fflush(stdout);
}

template <class Scheme>
void run(std::int64_t steps) {
  std::printf("%s\n%12s  %-9s  %9s  %9s  %9s\n", Scheme::kName, "steps", "H_I bits", "|q|^2 - 1",
              "dE/E", "rad");
  const BodyOf<Scheme, double> body{RigidBody<double>(inertia())};
  State<double> state = start();
  const auto begin = std::chrono::steady_clock::now();
  std::int64_t unresolved = 0, look_at = std::min<std::int64_t>(steps, 1'000'000);
  for (std::int64_t n = 1; n <= steps; ++n) {
    unresolved +=
        advance<Scheme, double>(body, state, {}, (n - 1) * kStepNs, kStepNs).resolved() ? 0 : 1;
    if (n == look_at) {
      print_row<Scheme>(body, state, n);
      look_at = std::min(look_at * 10, n < steps ? steps : steps + 1);
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf("%lld unresolved, %.1f s, %.0f ns a step\n", static_cast<long long>(unresolved),
              took.count(), took.count() * 1e9 / static_cast<double>(steps));
}

}  // namespace

int main(int argc, char** argv) {
  std::int64_t steps = 1'000'000'000;
  std::vector<std::string_view> names;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument != "--steps") {
      names.push_back(argument);
      continue;
    }
    const std::string_view value = i + 1 < argc ? argv[++i] : "";
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), steps);
    if (error != std::errc{} || end != value.data() + value.size() || steps < 1) {
      std::fprintf(stderr,
                   "long_run_bench: --steps: got '%s', expected a whole number above 0; try "
                   "1000000000\n",
                   argv[std::min(i, argc - 1)]);
      return 2;
    }
  }
  if (names.empty()) {
    names = {CoadjointRk4::kName, MoserVeselov10::kName};
  }
  for (const std::string_view name : names) {
    if (!with_scheme(name, [&](auto scheme) { run<decltype(scheme)>(steps); })) {
      std::fprintf(stderr, "long_run_bench: there is no scheme '%.*s'\n",
                   static_cast<int>(name.size()), name.data());
      return 2;
    }
  }
  return 0;
}
