#pragma once
// Random directions, attitudes and physically possible inertias; every test seeds its own
// generator.

#include <cmath>
#include <random>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"

namespace adstar::test {

using Generator = std::mt19937_64;

inline double uniform(Generator& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline double log_uniform(Generator& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

inline Vec3<double> unit_vector(Generator& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const Vec3<double> v{normal(random), normal(random), normal(random)};
    const double n = norm(v);
    if (n > 1e-3) {
      return (1 / n) * v;
    }
  }
}

inline Quat<double> unit_quaternion(Generator& random) {
  std::normal_distribution<double> normal;
  return normalised(Quat<double>{normal(random), normal(random), normal(random), normal(random)});
}

/// Principal moments of a body: the sums of two of three positive second moments of its mass.
inline Eigen::Vector3d moments(Generator& random) {
  const double a = log_uniform(random, 0.01, 1), b = log_uniform(random, 0.01, 1),
               c = log_uniform(random, 0.01, 1);
  return {a + b, b + c, c + a};
}

/// Q diag(moments) Qᵀ, symmetric to the last bit.
inline Eigen::Matrix3d rotated_inertia(const Eigen::Vector3d& principal, const Quat<double>& q) {
  const Eigen::Matrix3d Q = to_eigen(q).toRotationMatrix();
  const Eigen::Matrix3d J = Q * principal.asDiagonal() * Q.transpose();
  return 0.5 * (J + J.transpose().eval());
}

}  // namespace adstar::test
