#pragma once
// exp, dexp and dexp⁻¹ of so(3) in 100 digits, two ways that share nothing with the library: as
// power series of the matrix K = hat(psi), and as the textbook's closed forms in the whole angle.

#include "tests/support/wide.hpp"

namespace adstar::test {

struct WideMatrix {
  Wide m[3][3]{};
};

inline WideMatrix identity() {
  WideMatrix one;
  one.m[0][0] = one.m[1][1] = one.m[2][2] = 1;
  return one;
}

inline WideMatrix operator*(const WideMatrix& a, const WideMatrix& b) {
  WideMatrix c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    }
  }
  return c;
}

inline WideMatrix operator*(const Wide& s, WideMatrix a) {
  for (auto& row : a.m) {
    for (Wide& x : row) {
      x *= s;
    }
  }
  return a;
}

inline WideMatrix operator+(WideMatrix a, const WideMatrix& b) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      a.m[i][j] += b.m[i][j];
    }
  }
  return a;
}

inline Vec3<Wide> operator*(const WideMatrix& a, const Vec3<Wide>& v) {
  return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
          a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
          a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}

inline WideMatrix hat_matrix(const Vec3<Wide>& p) {
  return {{{0, -p.z, p.y}, {p.z, 0, -p.x}, {-p.y, p.x, 0}}};
}

/// Σ Kⁿ/(n + shift)!: exp for shift 0, dexp for shift 1.
inline WideMatrix series(const Vec3<Wide>& psi, int shift) {
  const WideMatrix K = hat_matrix(psi);
  WideMatrix term = identity(), sum = identity();
  for (int n = 1; n < 120; ++n) {
    term = (Wide(1) / (n + shift)) * (term * K);
    sum = sum + term;
  }
  return sum;
}

inline WideMatrix exp_series(const Vec3<Wide>& psi) { return series(psi, 0); }
inline WideMatrix dexp_series(const Vec3<Wide>& psi) { return series(psi, 1); }

/// The inverse matrix of dexp, by cofactors.
inline WideMatrix dexpinv_matrix(const Vec3<Wide>& psi) {
  const WideMatrix d = dexp_series(psi);
  const auto minor = [&](int i, int j) {
    const int r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
    return Wide(d.m[r][c] * d.m[s][e] - d.m[r][e] * d.m[s][c]);
  };
  const Wide determinant =
      d.m[0][0] * minor(0, 0) + d.m[0][1] * minor(0, 1) + d.m[0][2] * minor(0, 2);
  WideMatrix inverse;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      inverse.m[j][i] = minor(i, j) / determinant;
    }
  }
  return inverse;
}

/// sin θ/θ, (1 - cos θ)/θ², (θ - sin θ)/θ³, (1 - (θ/2) cot(θ/2))/θ², and sine and cosine of θ/2.
struct ClosedForms {
  Wide A, B, E, g, half_sin, half_cos;
};

inline ClosedForms closed_forms(const Wide& angle) {
  const Wide half = angle / 2, s = sin(half), c = cos(half), sine = sin(angle), cosine = cos(angle);
  const Wide squared = angle * angle;
  return {sine / angle,
          (1 - cosine) / squared,
          (angle - sine) / (squared * angle),
          (1 - half * c / s) / squared,
          s,
          c};
}

}  // namespace adstar::test
