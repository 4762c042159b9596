#pragma once
// The Earth's magnetic field by spherical harmonics: IGRF-14 to degree 13, in the terrestrial frame E.
//
//   V = a Σ_n Σ_m (a/r)^(n+1) (g_nm cos mλ + h_nm sin mλ) P_nm(sin φ),   B_E = -∇V
// with P_nm Schmidt semi-normalised (Alken et al. 2021, International Geomagnetic Reference Field: the thirteenth
// generation, Earth Planets Space 73:49, eq. 1 and 2). Evaluated in Cartesian coordinates, which know no poles: with
// V_nm + i W_nm = (a/r)^(n+1) P_nm(sin φ) e^(imλ), P_nm not normalised (Cunningham 1970; Montenbruck and Gill, Satellite Orbits,
// 2000, eq. 3.29 to 3.33),
//   V_mm + i W_mm = (2m - 1) a/r (u_x + i u_y) (V_m-1,m-1 + i W_m-1,m-1)
//   V_nm = (2n - 1)/(n - m) a/r u_z V_n-1,m - (n + m - 1)/(n - m) (a/r)² V_n-2,m,   W_nm alike,
// and the gradient of what has degree n is a sum of those of degree n + 1, whose weights, three each, are worked out once.
//
// The coefficients are those of one moment, the scene's epoch: between two epochs of the model by a line, past the last by
// its yearly change. They stay what they are within a run: the field changes by up to 200 nT a year, 0.5 nT a day. Left out:
// what the ionosphere and the magnetosphere add (tens of nT, hundreds in storms), the crust beyond degree 13.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "adstar/earth/dipole.hpp"
#include "adstar/earth/igrf14.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// g_nm and h_nm of one moment [T].
template <class T>
struct FieldCoefficients {
  static constexpr std::size_t kCount = igrf14::kCoefficients_nT.size();
  std::array<T, kCount> values{};  ///< in the order of earth/igrf14.hpp

  const T& g(int n, int m) const { return values[at(n, m)]; }
  T h(int n, int m) const { return m == 0 ? T(0) : values[at(n, m) + 1]; }

 private:
  static constexpr std::size_t at(int n, int m) {
    return static_cast<std::size_t>(n * n - 1 + (m == 0 ? 0 : 2 * m - 1));
  }
};

/// IGRF-14 at a decimal year from 1990 to 2030; beyond, its first or last line goes on, for what that is worth.
template <class T>
FieldCoefficients<T> igrf_coefficients(const T& year) {
  using std::floor;
  const T since = (year - T(igrf14::kFirstEpoch)) / T(igrf14::kEpochStep);
  constexpr auto kLast = static_cast<int>(igrf14::kEpochs) - 1;
  const int epoch = since >= T(kLast) ? kLast : std::max(0, static_cast<int>(floor(since)));
  const auto e = static_cast<std::size_t>(epoch);
  const T years = year - (T(igrf14::kFirstEpoch) + T(igrf14::kEpochStep) * T(epoch));
  FieldCoefficients<T> c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const auto& row = igrf14::kCoefficients_nT[i];
    const T begin = T(row[e]);
    const T slope =
        epoch == kLast ? T(row[e + 1]) : (T(row[e + 1]) - begin) / T(igrf14::kEpochStep);
    c.values[i] = (begin + years * slope) / T(1'000'000'000);
  }
  return c;
}

/// The dipole in them.
template <class T>
DipoleField<T> dipole_of(const FieldCoefficients<T>& c) {
  return {{c.g(1, 1), c.h(1, 1), c.g(1, 0)}};
}

/// Harmonics up to `degree`, ready to evaluate; 8 kB: to be shared.
template <class T>
class HarmonicField {
 public:
  static constexpr int kMostDegree = igrf14::kDegree;

  /// `degree` from 1 to 13.
  HarmonicField(const FieldCoefficients<T>& c, int degree) : degree_(degree) {
    using std::sqrt;
    for (int m = 0; m <= degree + 1; ++m) {
      for (int n = m; n <= degree + 1; ++n) {
        Term& term = terms_[index(n, m)];
        if (n > m) {
          term.up = T(2 * n - 1) / T(n - m);
          term.down = T(n + m - 1) / T(n - m);
        }
      }
    }
    for (int n = 1; n <= degree; ++n) {
      T scale(1), square{};  // √((2 - δ_m0) (n - m)!/(n + m)!)
      for (int m = 0; m <= n; ++m) {
        square = square + c.g(n, m) * c.g(n, m) + c.h(n, m) * c.h(n, m);
        if (m > 0) {
          scale = scale * sqrt(T(m == 1 ? 2 : 1) / (T(n + m) * T(n - m + 1)));
        }
        add(n, m, scale * c.g(n, m), scale * c.h(n, m));
      }
      strength_T_[static_cast<std::size_t>(n)] = T(n + 1) * sqrt(square);
    }
  }

  /// The same numbers in another scalar.
  template <class U>
  explicit HarmonicField(const HarmonicField<U>& other) : degree_(other.degree_) {
    const auto in_T = [](const Vec3<U>& v) { return Vec3<T>{T(v.x), T(v.y), T(v.z)}; };
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const auto& from = other.terms_[i];
      terms_[i] = {in_T(from.of_V), in_T(from.of_W), T(from.up), T(from.down)};
    }
    for (std::size_t n = 0; n < strength_T_.size(); ++n) {
      strength_T_[n] = T(other.strength_T_[n]);
    }
  }

  int degree() const { return degree_; }

  /// In E [T], of a direction in E and a distance.
  Vec3<T> field_E(const OrbitPosition<T>& at_E) const {
    const T ratio = T(kMagneticRadius_m) / at_E.distance_m;
    const Vec3<T> s = ratio * at_E.direction_I;
    const T square = ratio * ratio;
    T V_mm = ratio, W_mm{};
    Vec3<T> B{};
    for (int m = 0; m <= degree_ + 1; ++m) {
      if (m > 0) {
        const T x = T(2 * m - 1) * s.x, y = T(2 * m - 1) * s.y, V = V_mm;
        V_mm = x * V - y * W_mm;
        W_mm = x * W_mm + y * V;
      }
      const Term* term = &terms_[index(m, m)];
      T V = V_mm, W = W_mm, V_before{}, W_before{};
      B = B + (V * term->of_V + W * term->of_W);
      for (int n = m + 1; n <= degree_ + 1; ++n) {
        ++term;
        const T up = term->up * s.z, down = term->down * square;
        const T V_next = up * V - down * V_before, W_next = up * W - down * W_before;
        V_before = V;
        W_before = W;
        V = V_next;
        W = W_next;
        B = B + (V * term->of_V + W * term->of_W);
      }
    }
    return B;
  }

  /// Of |B| beyond `distance_m` [T]: Σ_n (n + 1) (a/r)^(n+2) |(g_nm, h_nm)_m|. By the addition theorem the harmonics of a degree
  /// and their two tangential derivatives are orthogonal rows of lengths 1 and twice √(n(n + 1)/2) < n + 1.
  T bound(const T& distance_m) const {
    const T ratio = T(kMagneticRadius_m) / distance_m;
    T power = ratio * ratio, sum{};
    for (int n = 1; n <= degree_; ++n) {
      power = power * ratio;
      sum = sum + power * strength_T_[static_cast<std::size_t>(n)];
    }
    return sum;
  }

 private:
  template <class U>
  friend class HarmonicField;

  /// What V_nm and W_nm bring to B, and how they come from those before.
  struct Term {
    Vec3<T> of_V, of_W;
    T up{}, down{};
  };
  static constexpr int kRows = kMostDegree + 2;

  /// By order first.
  static constexpr std::size_t index(int n, int m) {
    return static_cast<std::size_t>(m * kRows - m * (m - 1) / 2 + n - m);
  }

  /// -∇ of a (C V_nm + S W_nm).
  void add(int n, int m, const T& C, const T& S) {
    Term& level = terms_[index(n + 1, m)];
    const T rise = T(n - m + 1);
    level.of_V.z = level.of_V.z + rise * C;
    level.of_W.z = level.of_W.z + rise * S;
    const T half = m == 0 ? T(1) : T(0.5);
    Term& above = terms_[index(n + 1, m + 1)];
    above.of_V.x = above.of_V.x + half * C;
    above.of_W.y = above.of_W.y + half * C;
    if (m == 0) {
      return;
    }
    above.of_W.x = above.of_W.x + half * S;
    above.of_V.y = above.of_V.y - half * S;
    Term& below = terms_[index(n + 1, m - 1)];
    const T f = half * T(n - m + 2) * rise;
    below.of_V.x = below.of_V.x - f * C;
    below.of_W.x = below.of_W.x - f * S;
    below.of_W.y = below.of_W.y + f * C;
    below.of_V.y = below.of_V.y - f * S;
  }

  int degree_;
  std::array<Term, kRows*(kRows + 1) / 2> terms_{};
  std::array<T, kMostDegree + 1> strength_T_{};
};

/// IGRF-14 at a decimal year, cut at `degree` (1 to 13).
template <class T>
std::shared_ptr<const HarmonicField<T>> make_igrf(const T& year, int degree = igrf14::kDegree) {
  return std::make_shared<const HarmonicField<T>>(igrf_coefficients(year), degree);
}

}  // namespace adstar
