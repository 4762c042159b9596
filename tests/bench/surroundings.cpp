// What one evaluation of each model of the surroundings takes: the median of many runs, in ns. And what the kinks of a box that
// tumbles through the air cost in accuracy.
//
//   cmake --build build/release --target surroundings
//   build/release/tests/bench/surroundings_bench
//
// A torque is asked for at another time and attitude each time, as stages of a step ask for it.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <initializer_list>
#include <vector>

#include "adstar/integrators/all.hpp"
#include "adstar/orbit/orbital_frame.hpp"
#include "adstar/propagator.hpp"
#include "adstar/torques/all.hpp"
#include "tests/support/random_motion.hpp"

namespace {

using namespace adstar;
using V = Vec3<double>;

constexpr std::size_t kCalls = 2000, kRuns = 201;

struct Question {
  double t_s;
  Quat<double> q_IB;
};

double sink = 0;

template <class Ask>
double median_ns(const std::vector<Question>& questions, const Ask& ask) {
  std::array<double, kRuns> runs{};
  for (double& run : runs) {
    const auto begin = std::chrono::steady_clock::now();
    double sum = 0;
    for (const Question& question : questions) {
      sum += ask(question);
    }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    sink = sink + sum;
    run = took.count() / kCalls;
  }
  std::nth_element(runs.begin(), runs.begin() + kRuns / 2, runs.end());
  return runs[kRuns / 2];
}

template <class Ask>
void row(const char* name, const std::vector<Question>& questions, const Ask& ask) {
  std::printf("%-44s %7.0f\n", name, median_ns(questions, ask));
}

template <class Model>
void torque_row(const char* name, const std::vector<Question>& questions, const Model& model) {
  row(name, questions, [&](const Question& q) {
    const V tau = model.at(q.t_s, q.q_IB);
    return tau.x + tau.y + tau.z;
  });
}

Orbit<double> table_of(const Orbit<double>& orbit, EphemerisMethod method, int degree) {
  Ephemeris<double> table;
  table.method = method;
  table.degree = degree;
  for (int i = 0; i < 1440; ++i) {
    const OrbitMotion<double> m = motion_at(orbit, 60.0 * i);
    table.rows.push_back({60.0 * i, m.r_I, m.v_I});
  }
  return make_ephemeris(table);
}

/// A box of 1 by 0.5 by 0.3 m that tumbles at 350 km for 5,500 s, about a revolution, in steps of h.
State<double> tumbled(std::int64_t h_ns) {
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
  Aerodynamic<double> air;
  air.orbit = make_orbit<double>({6.728e6, 0.001, 0.9, 0.4, 0.7, 0.1});
  air.facets = make_facets(box_facets<double>({1, 0.5, 0.3}, {0.05, 0, 0}, Facet<double>{}));
  const std::vector<Torque<double>> torques{air};
  const BodyOf<CoadjointRk4, double> prepared(body);
  State<double> state = make_state(Quat<double>{}, body.momentum({0.02, -0.05, 0.03}));
  for (std::int64_t t_ns = 0; t_ns < 5'500'000'000'000; t_ns += h_ns) {
    advance<CoadjointRk4, double>(prepared, state, torques, t_ns, h_ns);
  }
  return state;
}

void print_kinks() {
  const State<double> truth = tumbled(10'000'000);
  std::printf("\n%-44s %7s\n", "a box that tumbles through the air, h [s]", "rad");
  for (const std::int64_t h_ns : std::initializer_list<std::int64_t>{2'500'000'000, 1'000'000'000,
                                                                     500'000'000, 100'000'000}) {
    std::printf("%-44.1f %7.0e\n", seconds<double>(h_ns),
                angle_between(tumbled(h_ns).q_IB, truth.q_IB));
  }
}

}  // namespace

int main() {
  test::Generator random(1);
  std::vector<Question> questions;
  for (std::size_t i = 0; i < kCalls; ++i) {
    questions.push_back({0.01 * static_cast<double>(i) + 7000, test::unit_quaternion(random)});
  }
  const Orbit<double> circle = make_orbit<double>({6.778e6, 0, 0.9, 0.4, 0.7, 0.1});
  const Orbit<double> ellipse = make_orbit<double>({6.778e6, 0.002, 0.9, 0.4, 0.7, 0.1});
  const Orbit<double> secular = make_secular_orbit<double>({6.778e6, 0.002, 0.9, 0.4, 0.7, 0.1});
  const Orbit<double> hermite = table_of(ellipse, EphemerisMethod::hermite, 7);
  const Orbit<double> lagrange = table_of(ellipse, EphemerisMethod::lagrange, 8);

  std::printf("%-44s %7s\n", "one evaluation", "ns");
  const auto orbit_row = [&](const char* name, const Orbit<double>& orbit) {
    row(name, questions, [&](const Question& q) {
      const OrbitMotion<double> m = motion_at(orbit, q.t_s);
      return m.r_I.x + m.v_I.y;
    });
  };
  orbit_row("motion, Kepler circle", circle);
  orbit_row("motion, Kepler e = 0.002", ellipse);
  orbit_row("motion, Kepler and J2", secular);
  orbit_row("motion, table, Hermite degree 7", hermite);
  orbit_row("motion, table, Lagrange degree 8", lagrange);
  row("orbital frame of a motion", questions, [&](const Question& q) {
    const OrbitMotion<double> m{{7e6, q.t_s, 1e6}, {1e3, 7e3, q.t_s}};
    return orbital_frame(m).q_IO.w;
  });
  row("e^x", questions, [](const Question& q) { return exponential(-1e-3 * q.t_s); });

  GravityGradient<double> gravity;
  gravity.orbit = ellipse;
  gravity.act_on(RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(1, 2, 2.5).asDiagonal())));
  torque_row("gravity_gradient", questions, gravity);

  for (const int degree : {0, 4, 8, 13}) {
    FieldOnOrbit<double> field{ellipse, {}};
    if (degree > 0) {
      field.field.harmonics = make_igrf(2025.5, degree);
    }
    char name[64];
    std::snprintf(name, sizeof name,
                  degree > 0 ? "residual_dipole, IGRF degree %d" : "residual_dipole, dipole",
                  degree);
    torque_row(name, questions,
               ResidualDipole<double>{{0.1, 0.2, 0.3},
                                      std::make_shared<const FieldOnOrbit<double>>(field)});
  }
  for (const double lag : {0.0, 0.1}) {
    Coils<double> coils;
    coils.limit_A_m2 = {1, 1, 1};
    coils.lag_s = lag;
    coils.field.orbit = ellipse;
    coils.field.field.harmonics = make_igrf(2025.5);
    Magnetorquer<double> torquer;
    torquer.coils = std::make_shared<const Coils<double>>(coils);
    torquer.window[0] = {0, 7'001'000'000'000, {0.1, 0.2, 0.3}};
    torquer.window[1] = {7'001'000'000'000, 9'000'000'000'000, {0.1, 0.2, 0.3}};
    torquer.intervals = 2;
    torque_row(lag > 0 ? "magnetorquer, lag, IGRF degree 13" : "magnetorquer, IGRF degree 13",
               questions, torquer);
  }
  Facet<double> like;
  like.specular = 0.3;
  const Facets<double> box = make_facets(box_facets<double>({1, 2, 3}, {0.1, 0, 0}, like));
  Aerodynamic<double> air;
  air.orbit = ellipse;
  air.facets = box;
  torque_row("aerodynamic, six plates", questions, air);
  SolarPressure<double> sun;
  sun.orbit = ellipse;
  sun.facets = box;
  sun.sun.days_since_J2000_at_start = 9300;
  for (const Shadow shadow : {Shadow::none, Shadow::cylinder, Shadow::cone}) {
    constexpr const char* kNames[] = {"solar_pressure, six plates, no shadow",
                                      "solar_pressure, six plates, cylinder",
                                      "solar_pressure, six plates, cone"};
    sun.shadow = shadow;
    torque_row(kNames[static_cast<std::size_t>(shadow)], questions, sun);
  }
  Thruster<double> thruster;
  thruster.torque_n_m = {1, 2, 3};
  thruster.intervals = thruster.kWindow;
  row("thruster, sixteen times in its window", questions, [&](const Question& q) {
    return thruster.ramp_from(static_cast<std::int64_t>(q.t_s)).start.x;
  });
  print_kinks();
  return sink == 12345 ? 1 : 0;
}
