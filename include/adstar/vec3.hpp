#pragma once
// Three-component vectors and symmetric 3x3 matrices of the kernels, with the order of every sum
// fixed.
//
// Plain structs and free functions: a library's choice of packets would choose the order of a
// reduction, and with it the bits (service/decisions/0002). Eigen stands at the interface:
// to_eigen, from_eigen.

#include <cmath>

#include <Eigen/Core>

namespace adstar {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

template <class T>
constexpr Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr T squared_norm(const Vec3<T>& a) {
  return dot(a, a);
}
template <class T>
T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// Symmetric 3x3 matrix.
template <class T>
struct Sym3 {
  T xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
  friend bool operator==(const Sym3&, const Sym3&) = default;
};

template <class T>
constexpr Vec3<T> operator*(const Sym3<T>& m, const Vec3<T>& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z,  //
          m.xy * v.x + m.yy * v.y + m.yz * v.z,  //
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

template <class T>
Eigen::Matrix<T, 3, 1> to_eigen(const Vec3<T>& v) {
  return {v.x, v.y, v.z};
}
template <class T>
Vec3<T> from_eigen(const Eigen::Matrix<T, 3, 1>& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace adstar
