#pragma once
// A double that counts what is done with it: what a step costs, without a clock.

#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace adstar::test {

struct Counted {
  double x = 0;
  static inline std::int64_t operations = 0;

  constexpr Counted() = default;
  constexpr Counted(double value) : x(value) {}  // NOLINT: as a double would
  constexpr Counted(int value) : x(value) {}     // NOLINT
  constexpr Counted(std::int64_t value) : x(static_cast<double>(value)) {}  // NOLINT
  explicit constexpr operator double() const { return x; }
  explicit constexpr operator std::int64_t() const { return static_cast<std::int64_t>(x); }
  explicit constexpr operator long long() const { return static_cast<long long>(x); }

  friend Counted operator+(Counted a, Counted b) { return ++operations, Counted(a.x + b.x); }
  friend Counted operator-(Counted a, Counted b) { return ++operations, Counted(a.x - b.x); }
  friend Counted operator*(Counted a, Counted b) { return ++operations, Counted(a.x * b.x); }
  friend Counted operator/(Counted a, Counted b) { return ++operations, Counted(a.x / b.x); }
  friend Counted operator-(Counted a) { return Counted(-a.x); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  Counted& operator/=(Counted b) { return *this = *this / b; }
  friend bool operator==(Counted a, Counted b) { return a.x == b.x; }
  friend auto operator<=>(Counted a, Counted b) { return a.x <=> b.x; }
};

inline Counted sqrt(Counted a) { return ++Counted::operations, Counted(std::sqrt(a.x)); }
inline Counted abs(Counted a) { return Counted(std::fabs(a.x)); }
inline Counted floor(Counted a) { return Counted(std::floor(a.x)); }
inline Counted ceil(Counted a) { return Counted(std::ceil(a.x)); }
inline Counted sin(Counted a) { return ++Counted::operations, Counted(std::sin(a.x)); }
inline Counted cos(Counted a) { return ++Counted::operations, Counted(std::cos(a.x)); }
inline Counted atan(Counted a) { return ++Counted::operations, Counted(std::atan(a.x)); }

}  // namespace adstar::test

template <>
class std::numeric_limits<adstar::test::Counted> : public std::numeric_limits<double> {};

template <>
struct Eigen::NumTraits<adstar::test::Counted> : Eigen::NumTraits<double> {
  using Real = adstar::test::Counted;
  using NonInteger = adstar::test::Counted;
  using Nested = adstar::test::Counted;
};
