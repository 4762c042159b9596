// How far a part of a step may turn: the worst error of every scheme over candidate limits, from which
// kSubstepAngleRad and the table of service/decisions/0010-guard-limits.md were chosen.
//
//   cmake --build build/release --target guard_limits
//   build/release/tests/bench/guard_limits_bench [SCHEME ...]
//
// Each figure is the worst of 1500 bodies (300 under torque), in rad of attitude error per radian turned; steps that were
// reported as unresolved are not in it, how many in a hundred those were stands in brackets.
//   ordinary    random bodies, four steps of the limit each, free
//   needle      the same, J_min/J_max from 1e-6 to 1, half of them spinning across the light axis
//   separatrix  on it and beside it by 1e-12 to 0.1, one step of 3 to 20 rad, split by the guard
//   weak, strong, ruling   as ordinary, under a torque whose impulse over a step is a thousandth of the
//               momentum, a third of it, all of it
// Free bodies are judged by the closed form in 64-bit mantissa, forced ones by the eighth-order
// tableau on (q, omega) in parts of an eighth of a radian.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "adstar/propagator.hpp"
#include "tests/support/random_motion.hpp"

namespace {

using namespace adstar;
using V = Vec3<double>;
using Wide = long double;
using TrueScheme = QuaternionRk<Fehlberg8, false>;

constexpr int kBodies = 1500, kForcedBodies = 300;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr double kCandidates[] = {0.05, 0.075, 0.1, 0.125, 0.25, 0.375, 0.5, 0.7,
                                  0.75, 1,     1.1, 1.25,  1.5,  1.75,  2};

enum class Class { ordinary, needle, separatrix, weak, strong, ruling };
constexpr const char* kNames[] = {"ordinary", "needle", "separatrix", "weak", "strong", "ruling"};

struct Start {
  Eigen::Vector3d moments;
  V Pi;             ///< turning by one radian a second
  double turn_rad;  ///< of one step; 0: the limit
  int steps;
  V torque;  ///< per unit of |Pi| and step; zero: free
};

Eigen::Vector3d needle(test::Generator& random) {
  const double thick = test::log_uniform(random, 1e-6, 1);
  return {2 * thick, 1 + thick, 1 + thick * test::uniform(random, 1, 1.5)};
}

V beside_separatrix(const Eigen::Vector3d& J, test::Generator& random) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return J[a] < J[b]; });
  const double A = (J[order[1]] - J[order[0]]) / J[order[0]];
  const double B = (J[order[2]] - J[order[1]]) / J[order[2]];
  const double aside =
      test::uniform(random, 0, 1) < 0.2 ? 0 : test::log_uniform(random, 1e-12, 0.1);
  const double middle = test::log_uniform(random, 1e-6, 3);
  double Pi[3];
  Pi[order[0]] = std::sqrt(B) * (1 + aside);
  Pi[order[1]] = std::sqrt(A + B) * middle * (test::uniform(random, -1, 1) < 0 ? -1 : 1);
  Pi[order[2]] = std::sqrt(A);
  return {Pi[0], Pi[1], Pi[2]};
}

std::vector<Start> starts(Class what) {
  test::Generator random(1500 + static_cast<unsigned>(what));
  std::vector<Start> all;
  for (int i = 0; i < (what < Class::weak ? kBodies : kForcedBodies); ++i) {
    Start start{test::moments(random), test::unit_vector(random), 0, 4, {}};
    switch (what) {
      case Class::needle:
        start.moments = needle(random);
        if (i % 2 == 0) {
          start.Pi.x *= start.moments.x();
        }
        break;
      case Class::separatrix:
        start.Pi = beside_separatrix(start.moments, random);
        start.turn_rad = test::uniform(random, 3, 20);
        start.steps = 1;
        break;
      case Class::weak:
        start.torque = 1e-3 * test::unit_vector(random);
        break;
      case Class::strong:
        start.torque = 0.3 * test::unit_vector(random);
        break;
      case Class::ruling:
        start.torque = test::unit_vector(random);
        break;
      case Class::ordinary:
        break;
    }
    const RigidBody<double> body(Eigen::Matrix3d(start.moments.asDiagonal()));
    start.Pi = (1 / std::sqrt(angular_speed_bound_squared(body, start.Pi, 0.0))) * start.Pi;
    all.push_back(start);
  }
  return all;
}

std::vector<Torque<double>> torques_of(const Start& start, double turn) {
  if (start.torque == V{}) {
    return {};
  }
  return {Constant<double>{Frame::body, (turn * norm(start.Pi)) * start.torque}};
}

Quat<Wide> truth_of(const Start& start, double turn) {
  const V Pi = turn * start.Pi;
  const RigidBody<Wide> body(Eigen::Matrix3d(start.moments.asDiagonal()).cast<Wide>());
  State<Wide> state = make_state(Quat<Wide>{1, 0, 0, 0}, Vec3<Wide>{Pi.x, Pi.y, Pi.z});
  if (start.torque == V{}) {
    FreeExact::step(BodyOf<FreeExact, Wide>(body), state, Wide(start.steps), NoTorque{});
    return state.q_IB;
  }
  std::vector<Torque<Wide>> torques;
  for (const Torque<double>& torque : torques_of(start, turn)) {
    const V tau = std::get<Constant<double>>(torque).torque_n_m;
    torques.emplace_back(Constant<Wide>{Frame::body, {tau.x, tau.y, tau.z}});
  }
  advance<TrueScheme, Wide>(body, state, torques, 0, start.steps * kSecond,
                            {1.0 / 8, 1'000'000, 64});
  return normalised(state.q_IB);
}

struct Outcome {
  double worst_per_rad = 0;
  int reported = 0;
};

template <class Scheme>
Outcome run(const std::vector<Start>& all, const std::vector<Quat<Wide>>& truths, double limit) {
  Outcome outcome;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Start& start = all[i];
    const double turn = start.turn_rad > 0 ? start.turn_rad : limit;
    const BodyOf<Scheme, double> body(
        RigidBody<double>(Eigen::Matrix3d(start.moments.asDiagonal())));
    State<double> state = make_state(Quat<double>{}, turn * start.Pi);
    const std::vector<Torque<double>> torques = torques_of(start, turn);
    bool resolved = true;
    double turned = 0;  ///< by the speeds at the ends of the steps: a torque may double it
    const auto speed = [&] { return norm(body.angular_velocity(body_momentum(state))); };
    for (int n = 0; n < start.steps; ++n) {
      turned += 0.5 * speed();
      resolved = advance<Scheme, double>(body, state, torques, n * kSecond, kSecond,
                                         {limit * (1 + 1e-9), 64, 64})
                     .resolved() &&
                 resolved;
      turned += 0.5 * speed();
    }
    if (!resolved) {
      ++outcome.reported;
      continue;
    }
    const Quat<double>& q = state.q_IB;
    const auto error =
        static_cast<double>(angle_between(truths[i], normalised(Quat<Wide>{q.w, q.x, q.y, q.z})));
    const double per_rad = error / std::max(turned, turn * start.steps);
    if (!(per_rad <= outcome.worst_per_rad)) {
      outcome.worst_per_rad = per_rad;
    }
  }
  return outcome;
}

/// What the limits are judged on, the same for all schemes.
struct Cases {
  std::vector<Start> starts;
  std::map<double, std::vector<Quat<Wide>>> truths;  ///< by limit, as they are asked for

  const std::vector<Quat<Wide>>& at(double limit) {
    const double key = starts.front().turn_rad > 0 ? 0 : limit;
    std::vector<Quat<Wide>>& known = truths[key];
    for (std::size_t i = known.size(); i < starts.size(); ++i) {
      known.push_back(truth_of(starts[i], starts[i].turn_rad > 0 ? starts[i].turn_rad : limit));
    }
    return known;
  }
};

template <class Scheme>
void print(std::vector<Cases>& all) {
  std::printf("%s, limit %g rad\n  limit", Scheme::kName, Scheme::kSubstepAngleRad);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::printf("%18s", kNames[i]);
  }
  std::printf("\n");
  for (const double limit : kCandidates) {
    if (limit < 0.6 * Scheme::kSubstepAngleRad || limit > 1.7 * Scheme::kSubstepAngleRad) {
      continue;
    }
    std::printf("%7g", limit);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool forced = i >= static_cast<std::size_t>(Class::weak);
      if (forced && Scheme::kClaims.free_only) {
        std::printf("%18s", "-");
        continue;
      }
      const Outcome outcome = run<Scheme>(all[i].starts, all[i].at(limit), limit);
      std::printf("%11.1e (%3.0f%%)", outcome.worst_per_rad,
                  100.0 * outcome.reported / static_cast<double>(all[i].starts.size()));
    }
    std::printf("\n");
  }
  std::fflush(stdout);
}

bool wanted(std::string_view name, std::span<char*> names) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char*> names(argv + 1, static_cast<std::size_t>(argc - 1));
  std::vector<Cases> all;
  for (const Class what : {Class::ordinary, Class::needle, Class::separatrix, Class::weak,
                           Class::strong, Class::ruling}) {
    all.push_back({starts(what), {}});
  }
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto judge = [&]<class Scheme>(const Scheme&) {
      if (wanted(Scheme::kName, names) && Scheme::kOrder != kExactOrder) {
        print<Scheme>(all);
      }
    };
    (judge(std::tuple_element_t<I, Schemes>{}), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Schemes>>{});
  return 0;
}
