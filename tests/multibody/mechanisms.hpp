#pragma once
// Assemblies that several tests move.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "adstar/integrators/tableaus.hpp"
#include "adstar/multibody/advance.hpp"
#include "adstar/multibody/placement.hpp"

namespace adstar::test {

using V = Vec3<double>;

/// "link7"
inline std::string numbered(std::string text, int i) {
  text += std::to_string(i);
  return text;
}

template <class T>
struct Mechanism {
  std::vector<multibody::BodySpec<T>> bodies;
  std::vector<multibody::Joint<T>> joints;
  std::vector<multibody::JointStart<T>> starts;

  int add_body(const std::string& name, const T& mass, const Vec3<T>& moments) {
    multibody::BodySpec<T> body;
    body.name = name;
    body.mass_kg = mass;
    body.inertia_B = Eigen::Matrix<T, 3, 3>::Zero();
    body.inertia_B(0, 0) = moments.x;
    body.inertia_B(1, 1) = moments.y;
    body.inertia_B(2, 2) = moments.z;
    bodies.push_back(body);
    return static_cast<int>(bodies.size()) - 1;
  }
  multibody::Joint<T>& add_joint(const std::string& name, multibody::JointKind kind, int a, int b,
                                 const Vec3<T>& point_a, const Vec3<T>& point_b,
                                 const multibody::JointStart<T>& start = {}) {
    multibody::Joint<T> joint;
    joint.name = name;
    joint.kind = kind;
    joint.body_a = a;
    joint.body_b = b;
    joint.a.point_B = point_a;
    joint.b.point_B = point_b;
    joints.push_back(joint);
    starts.push_back(start);
    return joints.back();
  }
  void place() {
    multibody::place(bodies, joints, std::span<const multibody::JointStart<T>>(starts));
  }
};

/// An assembly in flight.
template <class T>
struct Flight {
  multibody::Assembly<T> assembly;
  multibody::Workspace<T> work;
  multibody::AssemblyState<T> state;
  multibody::AssemblyReport<T> worst;  ///< what was left open, and whether all was resolved

  explicit Flight(const Mechanism<T>& mechanism, const multibody::AssemblyOptions<T>& options = {})
      : assembly(mechanism.bodies, mechanism.joints, options),
        work(assembly),
        state(multibody::make_state(assembly)) {}

  template <class Tableau = Rk4, class Load = multibody::NoLoad>
  void run(std::int64_t steps, std::int64_t h_ns, const std::array<T, 3>* motors = nullptr,
           const Load& load = {}, const multibody::AssemblyLimits& limits = {}) {
    for (std::int64_t n = 0; n < steps; ++n) {
      const auto report =
          multibody::advance<Tableau>(assembly, work, state, h_ns, motors, load, limits);
      worst.parts = std::max(worst.parts, report.parts);
      worst.gap = std::max(worst.gap, report.gap);
      worst.gap_rate = std::max(worst.gap_rate, report.gap_rate);
      worst.unresolved_angle = worst.unresolved_angle || report.unresolved_angle;
      worst.unresolved_gap = worst.unresolved_gap || report.unresolved_gap;
      worst.out_of_balance = worst.out_of_balance || report.out_of_balance;
      worst.unresolved_stiffness = worst.unresolved_stiffness || report.unresolved_stiffness;
      worst.at_dead_point = worst.at_dead_point || report.at_dead_point;
      worst.lost = worst.lost || report.lost;
    }
  }
  double energy() const { return static_cast<double>(multibody::energy(assembly, state).total()); }
  T coordinate(std::size_t joint, std::size_t k = 0) const { return state.coordinates[joint][k]; }
  std::array<T, 3> rates(std::size_t joint) {
    multibody::observe(assembly, work, state);
    return multibody::joint_rates(assembly.joints()[joint].kind, work.joints[joint]);
  }
  Vec3<T> point(std::size_t body) const { return state.bodies[body].x_I.value(); }
};

/// Four bodies on three spherical joints, tumbling, free.
inline Mechanism<double> four_bodies(multibody::JointKind kind = multibody::JointKind::spherical) {
  Mechanism<double> m;
  for (int i = 0; i < 4; ++i) {
    m.add_body(numbered("b", i), 1 + 0.5 * i, {0.1 + 0.02 * i, 0.12, 0.15});
  }
  m.bodies[0].omega_B = {0.3, -0.5, 0.7};
  for (int i = 0; i < 3; ++i) {
    m.add_joint(numbered("j", i), kind, i, i + 1, {0.5, 0.1, 0}, {-0.4, 0, 0.1},
                {{0.3, 0.2 * i, -0.4}, {0.5, -1.0 + i, 0.3}});
  }
  m.place();
  multibody::centre(m.bodies);
  return m;
}

/// Rods one after the other on spherical joints, a little bent, turning as a whole.
template <class T>
Mechanism<T> tether(int links) {
  Mechanism<T> m;
  for (int i = 0; i < links; ++i) {
    m.add_body(numbered("link", i), T(1), {T(0.01), T(0.09), T(0.09)});
  }
  m.bodies[0].omega_B = {T(0), T(0), T(0.05)};
  for (int i = 1; i < links; ++i) {
    m.add_joint(numbered("j", i), multibody::JointKind::spherical, i - 1, i, {T(0.5), T(0), T(0)},
                {T(-0.5), T(0), T(0)},
                {{T(0), T(0.01) * T(i % 3), T(0.02)}, {T(0.01), T(0), T(-0.01)}});
  }
  m.place();
  multibody::centre(m.bodies);
  return m;
}

inline double distance(const V& a, const V& b) { return norm(a - b); }

/// The largest distance between the same bodies of two flights [m].
template <class T>
double distance(const multibody::AssemblyState<T>& a, const multibody::AssemblyState<T>& b) {
  double farthest = 0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    farthest = std::max(farthest, distance(a.bodies[i].x_I.value(), b.bodies[i].x_I.value()));
    farthest = std::max(farthest, angle_between(a.bodies[i].q_IB, b.bodies[i].q_IB));
  }
  return farthest;
}

}  // namespace adstar::test
