#pragma once
// A planar arm in the x-y plane in minimal coordinates: the absolute angles of its links (and x, y of a base that
// flies free), their equations written out here, in long double by Boost.odeint. Nothing of the library is in it.

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <boost/numeric/odeint.hpp>

#include "tests/multibody/mechanisms.hpp"

namespace adstar::test {

struct ArmLink {
  double mass, inertia, length, centre;          ///< centre of mass from the near joint
  double angle, rate;                            ///< absolute [rad], [rad/s]
  double motor = 0, stiffness = 0, damping = 0;  ///< of the near joint
};

/// r_k = r_0 + Σ_j a_kj (cos φ_j, sin φ_j). Link 0 of a free arm is its base, centre of mass at r_0, and its far
/// joint `length - centre` ahead; of an arm on the ground link 0 hangs on the origin.
class PlanarArm {
 public:
  using Real = long double;
  using Flat = std::vector<Real>;  ///< [x, y,] φ, then their rates

  PlanarArm(std::vector<ArmLink> links, bool free, double gravity)
      : links_(std::move(links)), free_(free), gravity_(gravity) {}

  Flat start() const {
    const std::size_t n = links_.size(), extra = free_ ? 2 : 0;
    Flat y(2 * (n + extra), 0);
    for (std::size_t i = 0; i < n; ++i) {
      y[extra + i] = links_[i].angle;
      y[n + 2 * extra + i] = links_[i].rate;
    }
    return y;
  }

  void operator()(const Flat& y, Flat& dy, Real) const {
    using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
    const int n = static_cast<int>(links_.size()), extra = free_ ? 2 : 0, size = n + extra;
    const auto phi = [&](int i) { return y[static_cast<std::size_t>(extra + i)]; };
    const auto rate = [&](int i) { return y[static_cast<std::size_t>(size + extra + i)]; };
    Matrix A = Matrix::Zero(size, size);
    Vector f = Vector::Zero(size);
    for (int k = 0; k < n; ++k) {
      const Real m = links_[static_cast<std::size_t>(k)].mass;
      for (int i = 0; i <= k; ++i) {
        const Real a_i = arm(k, i);
        for (int j = 0; j <= k; ++j) {
          A(extra + i, extra + j) += m * a_i * arm(k, j) * std::cos(phi(i) - phi(j));
          f(extra + i) -= m * a_i * arm(k, j) * std::sin(phi(i) - phi(j)) * rate(j) * rate(j);
        }
        f(extra + i) -= m * gravity_ * a_i * std::cos(phi(i));
        if (free_) {
          A(0, extra + i) += -m * a_i * std::sin(phi(i));
          A(1, extra + i) += m * a_i * std::cos(phi(i));
          f(0) += m * a_i * std::cos(phi(i)) * rate(i) * rate(i);
          f(1) += m * a_i * std::sin(phi(i)) * rate(i) * rate(i);
        }
      }
      if (free_) {
        A(0, 0) += m;
        A(1, 1) += m;
        f(1) -= m * gravity_;
      }
      A(extra + k, extra + k) += links_[static_cast<std::size_t>(k)].inertia;
      // The near joint: its couple on this link, and its opposite on the one before.
      if (k == 0 && free_) {
        continue;
      }
      const ArmLink& link = links_[static_cast<std::size_t>(k)];
      const Real before = k == 0 ? 0 : phi(k - 1), rate_before = k == 0 ? 0 : rate(k - 1);
      const Real couple =
          link.motor - link.stiffness * (phi(k) - before) - link.damping * (rate(k) - rate_before);
      f(extra + k) += couple;
      if (k > 0) {
        f(extra + k - 1) -= couple;
      }
    }
    for (int i = 0; i < extra; ++i) {
      for (int j = extra; j < size; ++j) {
        A(j, i) = A(i, j);
        f(j) += 0;
      }
    }
    const Vector a = A.fullPivLu().solve(f);
    for (int i = 0; i < size; ++i) {
      dy[static_cast<std::size_t>(i)] = y[static_cast<std::size_t>(size + i)];
      dy[static_cast<std::size_t>(size + i)] = a(i);
    }
  }

  Flat run(double duration_s) const {
    namespace odeint = boost::numeric::odeint;
    Flat y = start();
    odeint::integrate_adaptive(
        odeint::make_controlled(Real(1e-15), Real(1e-15),
                                odeint::runge_kutta_fehlberg78<Flat, Real>()),
        *this, y, Real(0), Real(duration_s), Real(1e-3));
    return y;
  }

  /// The same as an assembly on revolute joints.
  Mechanism<double> mechanism() const {
    Mechanism<double> m;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const ArmLink& link = links_[i];
      m.add_body(numbered("link", static_cast<int>(i)), link.mass,
                 {0.6 * link.inertia, 0.7 * link.inertia, link.inertia});
      const int place = static_cast<int>(i);
      if (i == 0 && free_) {
        const double half = link.angle / 2;
        m.bodies[0].q_IB = {std::cos(half), 0, 0, std::sin(half)};
        m.bodies[0].omega_B = {0, 0, link.rate};
        continue;
      }
      const double before = i == 0 ? 0 : links_[i - 1].angle;
      const double rate_before = i == 0 ? 0 : links_[i - 1].rate;
      const V on_a = i == 0 ? V{} : V{links_[i - 1].length - links_[i - 1].centre, 0, 0};
      multibody::Joint<double>& joint =
          m.add_joint(numbered("j", place), multibody::JointKind::revolute,
                      i == 0 ? multibody::kGround : place - 1, place, on_a, {-link.centre, 0, 0},
                      {{link.angle - before, 0, 0}, {link.rate - rate_before, 0, 0}});
      joint.laws[0].stiffness = link.stiffness;
      joint.laws[0].damping = link.damping;
    }
    m.place();
    return m;
  }
  multibody::AssemblyOptions<double> options(multibody::Formulation formulation) const {
    return {formulation, {0, -gravity_, 0}};
  }
  std::vector<std::array<double, 3>> motors() const {
    std::vector<std::array<double, 3>> all;
    for (std::size_t i = free_ ? 1 : 0; i < links_.size(); ++i) {
      all.push_back({links_[i].motor, 0, 0});
    }
    return all;
  }
  /// The largest error of a link's angle [rad].
  double error(const Flat& truth, const multibody::AssemblyState<double>& state) const {
    double worst = 0;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const double half = static_cast<double>(truth[(free_ ? 2 : 0) + i]) / 2;
      const Quat<double> q{std::cos(half), 0, 0, std::sin(half)};
      worst = std::max(worst, angle_between(q, state.bodies[i].q_IB));
    }
    return worst;
  }

 private:
  Real arm(int k, int i) const {
    const ArmLink& link = links_[static_cast<std::size_t>(i)];
    if (free_ && i == 0) {
      return k == 0 ? 0 : Real(link.length) - Real(link.centre);
    }
    return i < k ? link.length : link.centre;
  }

  std::vector<ArmLink> links_;
  bool free_;
  double gravity_;
};

/// Five links, each with a motor, a spring and a damper.
inline std::vector<ArmLink> five_links() {
  return {{3.0, 0.40, 1.0, 0.45, 0.3, 0.2, 0.0, 0.0, 0.0},
          {1.2, 0.11, 0.8, 0.40, -0.4, 0.9, 0.15, 0.5, 0.02},
          {0.9, 0.06, 0.7, 0.30, 0.8, -0.7, -0.10, 0.0, 0.05},
          {0.7, 0.04, 0.6, 0.35, 1.3, 0.4, 0.05, 0.3, 0.0},
          {0.5, 0.02, 0.5, 0.25, 2.0, -1.1, 0.02, 0.0, 0.01}};
}

}  // namespace adstar::test
