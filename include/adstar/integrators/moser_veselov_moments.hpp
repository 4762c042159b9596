#pragma once
// The moments of inertia with which a discrete Moser-Veselov step is the exact flow of a free body.
//
// With the moments I_j themselves the step (moser_veselov.hpp) has order 2. Of the step size h, the
// squared momentum and the energy alone depend the moments Ĩ_j that make it exact (Hairer and
// Vilmart 2006, theorem 5, to order 10 their section 4):
//   1/Ĩ_j = (1/I_j) (1 + s) + d,   s = s₂h² + s₄h⁴ + ...,  d = d₂h² + d₄h⁴ + ...
// Any s and d keep the energy: the step keeps |y|² and Σ y_j²/Ĩ_j whatever the Ĩ.
//
// The coefficients. Put the power series in h of the exact flow's quaternion into the step's three
// equations: they are linear in Ĩ_1, Ĩ_2, Ĩ_3, which gives these as power series in h, and with
// them s and d, as exact rationals for any rational body and momentum. s_2k and d_2k are
// homogeneous of degree k in the invariants, with coefficients that are polynomials in the symmetric
// functions of the 1/I_j; enough samples determine these (tests/derivation/moser_veselov.py).
//
// Written in what stays small. With m = 1/I_m of the middle moment,
//   β_j = (1/I_j - m)/m = (I_m - I_j)/I_j,   η = h m y,   c = ½ |η|²,   b = ½ Σ β_j η_j²,
//   f = Σ β_j,   g = β_1 β_3   (β_2 = 0: the middle's),
// s and d/m are the sums of `kScale` and `kShift` below. No power of f exceeds that of its b: for a
// needle f is 1e6 and more, but f b is of the size of (h|omega|)², and g of 1. In the symmetric
// functions of the 1/I_j themselves the sums cancel there, and nothing would be left.

#include <array>
#include <cstddef>
#include <cstdint>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/vec3.hpp"

namespace adstar {
namespace detail {

/// (numerator/denominator) c^c b^b f^f g^g
struct MomentTerm {
  int c, b, f, g;
  std::int64_t numerator, denominator;
};

inline constexpr MomentTerm kScale[] = {
    // h^2
    {1, 0, 0, 0, -1, 2},
    {1, 0, 0, 1, 1, 6},
    {0, 1, 0, 0, -1, 1},
    {0, 1, 1, 0, -1, 3},
    // h^4
    {2, 0, 0, 0, 1, 12},
    {2, 0, 0, 1, -1, 12},
    {2, 0, 0, 2, 1, 30},
    {1, 1, 0, 0, 1, 3},
    {1, 1, 1, 0, 1, 6},
    {1, 1, 1, 1, -1, 30},
    {0, 2, 0, 0, 1, 4},
    {0, 2, 1, 0, 1, 6},
    {0, 2, 2, 0, 1, 30},
    {0, 2, 0, 1, -1, 60},
    // h^6
    {3, 0, 0, 0, -1, 180},
    {3, 0, 0, 1, 1, 72},
    {3, 0, 0, 2, -1, 60},
    {3, 0, 0, 3, 17, 2520},
    {2, 1, 0, 0, -1, 30},
    {2, 1, 1, 0, -1, 36},
    {2, 1, 1, 1, 1, 60},
    {2, 1, 0, 2, -1, 45},
    {2, 1, 1, 2, -1, 70},
    {1, 2, 0, 0, -1, 24},
    {1, 2, 1, 0, -1, 18},
    {1, 2, 2, 0, -1, 60},
    {1, 2, 0, 1, -1, 30},
    {1, 2, 2, 1, 1, 420},
    {1, 2, 0, 2, 41, 2520},
    {0, 3, 2, 0, -1, 90},
    {0, 3, 0, 1, 1, 30},
    {0, 3, 3, 0, -1, 630},
    {0, 3, 1, 1, 1, 630},
    // h^8
    {4, 0, 0, 0, 1, 5040},
    {4, 0, 0, 1, -1, 1080},
    {4, 0, 0, 2, 1, 360},
    {4, 0, 0, 3, -17, 5040},
    {4, 0, 0, 4, 31, 22680},
    {3, 1, 0, 0, 1, 630},
    {3, 1, 1, 0, 1, 540},
    {3, 1, 1, 1, -1, 360},
    {3, 1, 0, 2, 1, 135},
    {3, 1, 1, 2, 1, 140},
    {3, 1, 0, 3, -1, 315},
    {3, 1, 1, 3, -11, 3240},
    {2, 2, 0, 0, 1, 360},
    {2, 2, 1, 0, 1, 180},
    {2, 2, 2, 0, 1, 360},
    {2, 2, 0, 1, 1, 180},
    {2, 2, 2, 1, -1, 840},
    {2, 2, 0, 2, 1, 630},
    {2, 2, 1, 2, 1, 105},
    {2, 2, 2, 2, 13, 3780},
    {2, 2, 0, 3, 1, 2520},
    {1, 3, 2, 0, 1, 270},
    {1, 3, 0, 1, -1, 90},
    {1, 3, 3, 0, 1, 1260},
    {1, 3, 1, 1, -2, 315},
    {1, 3, 0, 2, -1, 45},
    {1, 3, 3, 1, -1, 11340},
    {1, 3, 1, 2, -11, 1890},
    {0, 4, 2, 0, 1, 240},
    {0, 4, 0, 1, -1, 80},
    {0, 4, 3, 0, 1, 2520},
    {0, 4, 1, 1, 1, 420},
    {0, 4, 4, 0, 1, 22680},
    {0, 4, 2, 1, -1, 15120},
    {0, 4, 0, 2, 17, 5040}};

inline constexpr MomentTerm kShift[] = {
    // h^2
    {1, 0, 0, 0, 1, 6},
    {1, 0, 0, 1, -1, 6},
    {0, 1, 0, 0, 1, 2},
    {0, 1, 1, 0, 1, 3},
    {0, 1, 0, 1, 1, 6},
    // h^4
    {2, 0, 0, 0, -1, 20},
    {2, 0, 0, 1, 1, 12},
    {2, 0, 0, 2, -1, 30},
    {1, 1, 0, 0, -1, 4},
    {1, 1, 1, 0, -1, 6},
    {1, 1, 1, 1, 1, 30},
    {1, 1, 0, 2, -1, 60},
    {0, 2, 0, 0, -1, 4},
    {0, 2, 1, 0, -1, 4},
    {0, 2, 2, 0, -1, 30},
    {0, 2, 0, 1, -3, 20},
    {0, 2, 1, 1, -1, 60},
    // h^6
    {3, 0, 0, 0, 1, 252},
    {3, 0, 0, 1, -1, 72},
    {3, 0, 0, 2, 1, 60},
    {3, 0, 0, 3, -17, 2520},
    {2, 1, 0, 0, 1, 36},
    {2, 1, 1, 0, 1, 36},
    {2, 1, 1, 1, -1, 60},
    {2, 1, 0, 2, 1, 45},
    {2, 1, 1, 2, 1, 70},
    {2, 1, 0, 3, 1, 1260},
    {1, 2, 0, 0, 1, 24},
    {1, 2, 1, 0, 5, 72},
    {1, 2, 2, 0, 1, 60},
    {1, 2, 0, 1, 4, 45},
    {1, 2, 1, 1, 1, 30},
    {1, 2, 2, 1, -1, 420},
    {1, 2, 0, 2, 71, 2520},
    {1, 2, 1, 2, 13, 2520},
    {0, 3, 2, 0, -1, 180},
    {0, 3, 0, 1, 1, 60},
    {0, 3, 3, 0, 1, 630},
    {0, 3, 1, 1, -4, 315},
    {0, 3, 2, 1, 1, 1260},
    {0, 3, 0, 2, -13, 1260},
    // h^8
    {4, 0, 0, 0, -1, 6480},
    {4, 0, 0, 1, 1, 1080},
    {4, 0, 0, 2, -1, 360},
    {4, 0, 0, 3, 17, 5040},
    {4, 0, 0, 4, -31, 22680},
    {3, 1, 0, 0, -1, 720},
    {3, 1, 1, 0, -1, 540},
    {3, 1, 1, 1, 1, 360},
    {3, 1, 0, 2, -1, 135},
    {3, 1, 1, 2, -1, 140},
    {3, 1, 0, 3, 1, 315},
    {3, 1, 1, 3, 11, 3240},
    {3, 1, 0, 4, -1, 45360},
    {2, 2, 0, 0, -1, 360},
    {2, 2, 1, 0, -7, 1080},
    {2, 2, 2, 0, -1, 360},
    {2, 2, 0, 1, -1, 90},
    {2, 2, 1, 1, -1, 180},
    {2, 2, 2, 1, 1, 840},
    {2, 2, 0, 2, -31, 1890},
    {2, 2, 1, 2, -1, 63},
    {2, 2, 2, 2, -13, 3780},
    {2, 2, 0, 3, -17, 2520},
    {2, 2, 1, 3, -1, 1512},
    {1, 3, 2, 0, -1, 1080},
    {1, 3, 0, 1, 1, 360},
    {1, 3, 3, 0, -1, 1260},
    {1, 3, 1, 1, 19, 1890},
    {1, 3, 2, 1, 2, 315},
    {1, 3, 0, 2, 2, 315},
    {1, 3, 3, 1, 1, 11340},
    {1, 3, 1, 2, 17, 1890},
    {1, 3, 2, 2, -1, 1512},
    {1, 3, 0, 3, 97, 22680},
    {0, 4, 2, 0, -1, 240},
    {0, 4, 0, 1, 1, 80},
    {0, 4, 3, 0, -19, 5040},
    {0, 4, 1, 1, 3, 280},
    {0, 4, 4, 0, -1, 22680},
    {0, 4, 2, 1, -53, 15120},
    {0, 4, 0, 2, 7, 720},
    {0, 4, 3, 1, -1, 45360},
    {0, 4, 1, 2, -1, 7560}};

}  // namespace detail

/// Σ_{0 < i + j ≤ Degree} p_ij c^i b^j of one body, the lowest power first in `row[j][i]`.
template <class T, int Degree>
class InvariantPolynomial {
 public:
  template <std::size_t N>
  InvariantPolynomial(const detail::MomentTerm (&terms)[N], const T& f, const T& g) {
    for (const detail::MomentTerm& term : terms) {
      if (term.c + term.b > Degree) {
        continue;
      }
      T product = T(term.numerator) / T(term.denominator);
      for (int i = 0; i < term.f; ++i) {
        product = product * f;
      }
      for (int i = 0; i < term.g; ++i) {
        product = product * g;
      }
      T& sum = row_[term.b][term.c];
      sum = sum + product;
    }
  }

  T operator()(const T& c, const T& b) const {
    T sum = row(Degree, c);
    for (int j = Degree - 1; j >= 0; --j) {
      sum = row(j, c) + b * sum;
    }
    return sum;
  }

 private:
  /// Σ_i p_ij c^i
  T row(int j, const T& c) const {
    T sum = row_[j][Degree - j];
    for (int i = Degree - j - 1; i >= 0; --i) {
      sum = row_[j][i] + c * sum;
    }
    return sum;
  }

  T row_[Degree + 1][Degree + 1]{};
};

}  // namespace adstar
