#pragma once
// Truth for any motion of one body: the plain quaternion-momentum equations in 113 bits, by the
// modified midpoint rule extrapolated to order 16 (Gragg 1965, Bulirsch and Stoer 1966). No formula
// of the Lie group, none of the library's.
//   q' = ½ q (0, omega_B),   Pi_B' = Pi_B × omega_B + tau_B,   omega_B = J⁻¹ Pi_B

#include <array>
#include <functional>

#include <Eigen/Core>
#include <Eigen/LU>

#include "tests/support/wide.hpp"

namespace adstar::test {

using QuadMatrix = Eigen::Matrix<Quad, 3, 3>;

struct PlainState {
  std::array<Quad, 7> y{};  ///< q (w, x, y, z), Pi_B
  Quat<Quad> q_IB() const { return {y[0], y[1], y[2], y[3]}; }
  Vec3<Quad> Pi_B() const { return {y[4], y[5], y[6]}; }
};

inline PlainState plain_state(const Quat<Quad>& q, const Vec3<Quad>& Pi) {
  return {{q.w, q.x, q.y, q.z, Pi.x, Pi.y, Pi.z}};
}

/// Body torque [N m] at time [s], attitude and angular velocity.
using PlainTorque = std::function<Vec3<Quad>(const Quad&, const Quat<Quad>&, const Vec3<Quad>&)>;

class PlainMotion {
 public:
  PlainMotion(const QuadMatrix& J, PlainTorque torque)
      : J_inverse_(J.inverse()), torque_(std::move(torque)) {}

  PlainState run(PlainState state, const Quad& from_s, const Quad& to_s, int steps) const {
    const Quad h = (to_s - from_s) / steps;
    for (int n = 0; n < steps; ++n) {
      state = extrapolated(state, from_s + n * h, h);
    }
    return state;
  }

 private:
  using Y = std::array<Quad, 7>;

  Y rate(const Quad& t, const Y& y) const {
    const Vec3<Quad> Pi{y[4], y[5], y[6]};
    const Eigen::Matrix<Quad, 3, 1> w = J_inverse_ * Eigen::Matrix<Quad, 3, 1>(Pi.x, Pi.y, Pi.z);
    const Vec3<Quad> omega{w[0], w[1], w[2]};
    const Vec3<Quad> tau =
        torque_ ? torque_(t, Quat<Quad>{y[0], y[1], y[2], y[3]}, omega) : Vec3<Quad>{};
    const Quad half(0.5);
    return {-half * (y[1] * w[0] + y[2] * w[1] + y[3] * w[2]),
            half * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]),
            half * (y[0] * w[1] - y[1] * w[2] + y[3] * w[0]),
            half * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]),
            Pi.y * w[2] - Pi.z * w[1] + tau.x,
            Pi.z * w[0] - Pi.x * w[2] + tau.y,
            Pi.x * w[1] - Pi.y * w[0] + tau.z};
  }

  static Y plus(const Y& a, const Quad& s, const Y& b) {
    Y c;
    for (std::size_t i = 0; i < 7; ++i) {
      c[i] = a[i] + s * b[i];
    }
    return c;
  }

  Y midpoint(const Y& y, const Quad& t, const Quad& H, int n) const {
    const Quad h = H / n;
    Y before = y, now = plus(y, h, rate(t, y));
    for (int i = 1; i < n; ++i) {
      const Y next = plus(before, 2 * h, rate(t + i * h, now));
      before = now;
      now = next;
    }
    const Y end = plus(before, h, rate(t + H, now));
    Y mean;
    for (std::size_t i = 0; i < 7; ++i) {
      mean[i] = (now[i] + end[i]) / 2;
    }
    return mean;
  }

  PlainState extrapolated(const PlainState& state, const Quad& t, const Quad& H) const {
    constexpr int kColumns = 8;
    std::array<Y, kColumns> table;
    for (int k = 0; k < kColumns; ++k) {
      table[static_cast<std::size_t>(k)] = midpoint(state.y, t, H, 2 * (k + 1));
      for (int j = k - 1; j >= 0; --j) {  // Aitken and Neville in h²
        const Quad ratio = Quad(k + 1) / Quad(j + 1);
        Y& lower = table[static_cast<std::size_t>(j)];
        const Y& upper = table[static_cast<std::size_t>(j) + 1];
        for (std::size_t i = 0; i < 7; ++i) {
          lower[i] = upper[i] + (upper[i] - lower[i]) / (ratio * ratio - 1);
        }
      }
    }
    return {table[0]};
  }

  QuadMatrix J_inverse_;
  PlainTorque torque_;
};

}  // namespace adstar::test
