#pragma once
// The moments of inertia with which a discrete Moser-Veselov step is the exact flow of a free body.
//
// With the moments I_j themselves the step (moser_veselov.hpp) has order 2. Of the step size h, the
// squared momentum and the energy alone depend the moments Ĩ_j that make it exact (Hairer and
// Vilmart 2006, theorem 5, to order 10 their section 4; to 16 here):
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
// s and d/m are the sums of `kScale` and `kShift` of moser_veselov_terms.hpp. No power of f exceeds that of its b: for a
// needle f is 1e6 and more, but f b is of the size of (h|omega|)², and g of 1. In the symmetric
// functions of the 1/I_j themselves the sums cancel there, and nothing would be left.

#include <cstddef>

#include "adstar/integrators/moser_veselov_terms.hpp"

namespace adstar {

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
