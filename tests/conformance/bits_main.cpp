// Prints the end states of a fixed set of motions, digit by digit, and a hash over every state on
// the way. Built for several instruction sets and by another compiler; all must print the same
// (bits_compare.cmake).

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adstar/multibody/advance.hpp"
#include "adstar/multibody/placement.hpp"
#include "adstar/propagator.hpp"

namespace {

using namespace adstar;
using V = Vec3<double>;

/// FNV-1a over the bytes of every state.
class Hash {
 public:
  void add(const State<double>& state) {
    unsigned char bytes[sizeof state];
    std::memcpy(bytes, &state, sizeof state);
    for (const unsigned char byte : bytes) {
      value_ = (value_ ^ byte) * 0x100000001b3ULL;
    }
  }
  unsigned long long value() const { return value_; }

 private:
  unsigned long long value_ = 0xcbf29ce484222325ULL;
};

Eigen::Matrix3d tensor(double xx, double yy, double zz, double xy = 0, double xz = 0,
                       double yz = 0) {
  Eigen::Matrix3d J;
  J << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return J;
}

Commanded<double> commands(Frame frame) {
  Commanded<double> actuator;
  actuator.frame = frame;
  for (std::int64_t i = 0; i < 16; ++i) {
    const auto size = static_cast<double>(i + 1);
    actuator.window[static_cast<std::size_t>(i)] = {i * 61'234'567'891 + 13,
                                                    i * 61'234'567'891 + 20'000'000'017,
                                                    {0.001 * size, -0.002 * size, 0.0005}};
  }
  actuator.intervals = 16;
  return actuator;
}

Table<double> table(Frame frame, Interpolation interpolation, AfterEnd after_end) {
  Table<double> torque{frame, interpolation, after_end, {}, {}};
  for (std::int64_t i = 0; i < 500; ++i) {
    const auto k = static_cast<double>(i % 17) - 8;
    torque.time_ns.push_back(i * 1'333'333'333 + 1);
    torque.torque_n_m.push_back({0.002 * k, 0.001 * (3 - k), -0.0007 * k});
  }
  return torque;
}

/// One of each model of the surroundings, on an orbit of each kind.
std::vector<Torque<double>> surroundings(const Eigen::Matrix3d& J) {
  const OrbitElements<double> elements{6.7e6, 0.01, 1.7, 0.4, 0.7, 0.1};
  const Orbit<double> secular = make_secular_orbit(elements);
  Ephemeris<double> table;
  for (int i = 0; i < 200; ++i) {
    const OrbitMotion<double> m = motion_at(secular, 60.0 * i);
    table.rows.push_back({60.0 * i, m.r_I, m.v_I});
  }
  GravityGradient<double> gravity;
  gravity.orbit = make_ephemeris(table);
  gravity.act_on(RigidBody<double>(J));
  Coils<double> coils;
  coils.limit_A_m2 = {5, 5, 5};
  coils.step_A_m2 = {0, 0.3, 0};
  coils.lag_s = 2;
  coils.field.orbit = secular;
  coils.field.field.harmonics = make_igrf(2025.5);
  Magnetorquer<double> torquer;
  torquer.coils = std::make_shared<const Coils<double>>(coils);
  torquer.window[0] = {13, 2'000'000'000'017, {3, -4, 9}};
  torquer.window[1] = {3'000'000'000'000, 9'000'000'000'000, {-1, 2, -3}};
  torquer.intervals = 2;
  Facet<double> like;
  like.specular = 0.3;
  like.diffuse = 0.2;
  Aerodynamic<double> air;
  air.orbit = secular;
  air.facets = make_facets(box_facets<double>({0.3, 0.2, 0.1}, {0.02, -0.03, 0.01}, like));
  SolarPressure<double> sun;
  sun.orbit = make_orbit(elements);
  sun.facets = air.facets;
  sun.sun.days_since_J2000_at_start = 9300;
  Thruster<double> thruster;
  thruster.torque_n_m = {1e-5, -2e-5, 1e-5};
  thruster.schedule = make_on_schedule({{500'000'000'001, 500'000'000'002}}, 777'777'777);
  return {gravity, ResidualDipole<double>{{0.1, 0.2, -0.1}, {torquer.coils, &torquer.coils->field}},
          torquer, air,
          sun,     thruster};
}

template <class Scheme = CoadjointRk4>
void run(const char* name, const Eigen::Matrix3d& J, const V& omega_B,
         const std::vector<Torque<double>>& torques, std::int64_t h_ns = 10'000'000) {
  const BodyOf<Scheme, double> body{RigidBody<double>(J)};
  const Quat<double> q = normalised(Quat<double>{1, -2, 0.5, 3});
  State<double> state = make_state(q, rotate(q, body.momentum(omega_B)));
  Hash hash;
  std::int64_t parts = 0;
  for (std::int64_t n = 0; n < 100'000; ++n) {
    parts += advance<Scheme>(body, state, std::span<const Torque<double>>(torques), n * h_ns, h_ns)
                 .parts;
    hash.add(state);
  }
  const Vec3<double> H = state.H_I.value();
  std::printf("%s parts %lld hash %016llx\n  q %a %a %a %a\n  H %a %a %a\n  W %a\n", name,
              static_cast<long long>(parts), hash.value(), state.q_IB.w, state.q_IB.x, state.q_IB.y,
              state.q_IB.z, H.x, H.y, H.z, state.work.value);
}

/// One shot from every start, of every length, stepping on from its end.
void run_exact(const char* name, const Eigen::Matrix3d& J) {
  const FreeBody<double> body{RigidBody<double>(J)};
  Hash hash;
  State<double> state;
  for (int i = 0; i < 20'000; ++i) {
    const auto k = static_cast<double>(i);
    const Quat<double> q = normalised(Quat<double>{1, -2, 0.01 * k, 3});
    state = make_state(q, V{0.4, 0.001 * (k - 10'000), 0.1 * (k - 77)});
    FreeExact::step(body, state, 0.01 + k * k, NoTorque{});
    FreeExact::step(body, state, -0.1, NoTorque{});
    hash.add(state);
  }
  std::printf("%s hash %016llx\n  q %a %a %a %a\n", name, hash.value(), state.q_IB.w, state.q_IB.x,
              state.q_IB.y, state.q_IB.z);
}

/// Four bodies on a universal, a spherical and a revolute joint, with springs, a stop and a motor; the last
/// joint twice, so that a loop closes.
void run_linked(const char* name, multibody::Formulation formulation) {
  using namespace multibody;
  std::vector<BodySpec<double>> bodies(4);
  std::vector<Joint<double>> joints(4);
  std::vector<JointStart<double>> starts(4);
  const JointKind kinds[] = {JointKind::universal, JointKind::spherical, JointKind::revolute,
                             JointKind::revolute};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = static_cast<double>(i);
    bodies[i].name = std::string(1, static_cast<char>('a' + i));
    bodies[i].mass_kg = 1 + k;
    bodies[i].inertia_B = tensor(1.2, 1.0, 1.5, -0.15, 0.08, 0.11);
    Joint<double>& joint = joints[i];
    joint.name = bodies[i].name;
    joint.kind = kinds[i];
    joint.body_a = i < 3 ? static_cast<int>(i) : 2;
    joint.body_b = joint.body_a + 1;
    joint.a = {{0.5, 0.1 * k, 0}, normalised(Quat<double>{1, 0.2, -0.1, 0.3})};
    joint.b = {{-0.4, 0, 0.1}, {}};
    joint.laws[0] = {2, 0.3, 0.01, true, -0.8, 0.8, 500, 0.1};
    starts[i] = {{0.3, -0.2, 0.1}, {0.5, -0.4, 0.2}};
  }
  joints[3].a = joints[2].a;
  bodies[0].omega_B = {0.1, -0.3, 0.2};
  place<double>(bodies, joints, starts);
  centre(bodies);
  const Assembly<double> assembly(bodies, joints, {formulation, {}});
  Workspace<double> work(assembly);
  AssemblyState<double> state = make_state(assembly);
  const std::array<double, 3> motors[4] = {{0.02, -0.01, 0}, {}, {0.01, 0, 0}, {}};
  Hash hash;
  std::int64_t parts = 0;
  for (int n = 0; n < 5'000; ++n) {
    parts += advance<Rk4>(assembly, work, state, 10'000'000, motors).parts;
    for (const BodyState<double>& body : state.bodies) {
      adstar::State<double> one;
      one.q_IB = body.q_IB;
      one.H_I = body.H_I;
      one.impulse_I = body.x_I;
      hash.add(one);
    }
  }
  std::printf("%s parts %lld hash %016llx\n  W %a\n", name, static_cast<long long>(parts),
              hash.value(), state.work.value);
}

void print_sines() {
  Hash hash;
  double x = 1e-9;
  State<double> state;
  for (int i = 0; i < 100'000; ++i) {
    const SinCos<double> a = sincos(x);
    state.q_IB = {a.sin, a.cos, x, 0};
    hash.add(state);
    x = x * 1.0005 + 1e-7;
  }
  std::printf("sines hash %016llx, the last at %a: %a\n", hash.value(), x, sincos(x).sin);
}

}  // namespace

int main() {
  const Eigen::Matrix3d paper = tensor(0.9144, 1.098, 1.66);
  const Eigen::Matrix3d full = tensor(1.2, 1.0, 1.5, -0.15, 0.08, 0.11);
  const Eigen::Matrix3d needle = tensor(1e-3, 1, 1.0005, 1e-4, 0, 0);
  const V slow{0.45549, 0.82623, 0.03476}, fast{30, -50, 12}, micro{1e-5, 2e-5, -1e-5};
  const Harmonic<double> body{Frame::body, {0.02, 0.015, 0.01}, {0.5, 0.3, 1.7}, {0, 1.57, 0.3}};
  const Harmonic<double> inertial{
      Frame::inertial, {0.02, 0.0, 0.01}, {0.05, 0.3, 11}, {0, 0.1, 0.2}};
  print_sines();
  run_exact("free, exact", paper);
  run_exact("free, exact, full tensor", full);
  run_exact("free, exact, even separatrix", tensor(1, 1.5, 3));
  run_exact("free, exact, needle", needle);
  run("free", paper, slow, {});
  run("free, full tensor", full, slow, {});
  run("free, slow", full, micro, {}, 1'000'000);
  run("free, sub-stepped", full, fast, {}, 100'000'000);
  run("free, needle", needle, {0.1, 1, 0.2}, {});
  run("constant", paper, slow, {Constant<double>{Frame::body, {0.01, -0.02, 0.005}}});
  run("constant, inertial", full, slow, {Constant<double>{Frame::inertial, {0.01, -0.02, 0.005}}});
  run("harmonic", full, slow, {body, inertial});
  run("damped, sub-stepped", full, fast, {Damping<double>{{0.3, 0.1, 0.2}}, body}, 100'000'000);
  run("tables", full, slow,
      {table(Frame::body, Interpolation::linear, AfterEnd::zero),
       table(Frame::inertial, Interpolation::hold, AfterEnd::hold)});
  run("commands", full, slow, {commands(Frame::body), commands(Frame::inertial)});
  run("everything, sub-stepped", full, fast,
      {body, inertial, commands(Frame::body),
       table(Frame::inertial, Interpolation::linear, AfterEnd::zero),
       Constant<double>{Frame::body, {0.01, -0.02, 0.005}}},
      50'000'000);
  run("surroundings", full, micro, surroundings(full), 100'000'000);
  run<CoadjointRk4Float>("float stages, free", paper, slow, {});
  run<CoadjointRk4Float>("float stages, free, full tensor, sub-stepped", full, fast, {},
                         100'000'000);
  run<CoadjointRk4Float>("float stages, free, needle", needle, {0.1, 1, 0.2}, {});
  run<CoadjointMidpoint2Float>("float stages, constant", paper, slow,
                               {Constant<double>{Frame::body, {0.01, -0.02, 0.005}}});
  run<CoadjointRk4Float>("float stages, everything", full, slow,
                         {body, inertial, commands(Frame::body),
                          table(Frame::inertial, Interpolation::linear, AfterEnd::zero)},
                         50'000'000);
  run_linked("linked, SE(3)", multibody::Formulation::se3);
  run_linked("linked, direct product", multibody::Formulation::direct_product);
  return 0;
}
