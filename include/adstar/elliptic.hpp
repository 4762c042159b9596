#pragma once
// Jacobi's elliptic functions and what a free rigid body needs of the third kind, on the ladder of
// arithmetic and geometric means
//   a_0 = 1, g_0 = k',   a_{n+1} = (a_n + g_n)/2,  g_{n+1} = √(a_n g_n)  →  mean = π/(2K)
// (Gauss 1818; Abramowitz and Stegun 17.6; DLMF 19.8, 22.7). The modulus is given by its complement k',
// and by m = k² beside it, so that nothing cancels from m = 0 to m = 1 - 1e-300: every sum below is
// one of positive terms. No circular limit is singled out, and no hyperbolic one: the ladder only
// gets longer, by one rung for every squaring of k'.
//
// Along the ladder, with the *same* phase ζ = mean·u on every rung (Gauss's transformation), go
// s, c of an angle φ_n and d = √(a²c² + g²s²): dφ_n/du = d. On rung 0 they are sn, cn, dn of u, on
// the last sin ζ, cos ζ and the mean.

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "adstar/double_double.hpp"
#include "adstar/trig.hpp"

namespace adstar {

/// sn, cn, dn on rung 0; s, c, d of the head of this file on the others.
template <class T>
struct Jacobi {
  T s, c, d;
};

/// What rates are computed in, so that a long time does not show their rounding.
template <class T>
struct Wider {
  using type = T;
};
template <>
struct Wider<double> {
  using type = DoubleDouble;
};
template <>
struct Wider<float> {
  using type = double;
};
template <class T>
using WiderOf = typename Wider<T>::type;

/// To T from its wider type.
template <class T, class W>
T rounded(const W& x) {
  return static_cast<T>(x);
}

/// The ladder of one modulus.
template <class T>
struct EllipticLadder {
  using W = WiderOf<T>;
  static constexpr int kMost = 24;

  int rungs = 0;                     ///< a, g, gap of rung 0 to rungs - 1; above them, the mean
  W a[kMost], g[kMost], gap[kMost];  ///< gap = a - g without cancellation
  W mean;                            ///< π/(2K)
};

/// k' = √(1 - m) > 0 and m, each exact to round-off.
template <class T>
EllipticLadder<T> elliptic_ladder(const WiderOf<T>& k_prime, const WiderOf<T>& m) {
  using std::sqrt;
  using W = WiderOf<T>;
  EllipticLadder<T> l;
  W a = W(1), g = k_prime, gap = m / (W(1) + k_prime);
  const T tolerance = sqrt(std::numeric_limits<T>::epsilon());
  for (int n = 0; n < EllipticLadder<T>::kMost; ++n) {
    l.a[n] = a;
    l.g[n] = g;
    l.gap[n] = gap;
    l.rungs = n + 1;
    const W next = W(0.5) * (a + g);
    const bool last = !(rounded<T>(gap) > tolerance * rounded<T>(a));
    g = last ? next : sqrt(a * g);
    gap = gap * gap / (W(4) * (next + g));  // ½ (√a - √g)²
    a = next;
    if (last) {  // so close that the mean is the next but one, less gap²/16
      l.mean = a - W(0.5) * gap;
      break;
    }
  }
  return l;
}

namespace detail {

/// From rung n + 1 to rung n at the same phase: s' = 2a s/((a + g) + (a - g) s²) (Gauss 1818), made
/// homogeneous in s and c, so that a rounding of s² + c² does not grow on the way.
template <class T>
Jacobi<T> rung_down(const T& a, const T& g, const Jacobi<T>& up) {
  const T s2 = up.s * up.s, c2 = (a + g) * (up.c * up.c);
  const T inverse = T(1) / (c2 + T(2) * a * s2);
  return {T(2) * a * up.s * inverse, T(2) * up.c * up.d * inverse,
          a * (c2 + T(2) * g * s2) * inverse};
}

/// s² + c² = 1 and d² = a²c² + g²s² again: what is left of the rungs' rounding is in s/c alone.
template <class T>
Jacobi<T> on_the_circle(const EllipticLadder<T>& l, const Jacobi<T>& j, int rung) {
  using std::sqrt;
  const T inverse = T(1) / sqrt(j.s * j.s + j.c * j.c);
  const T s = j.s * inverse, c = j.c * inverse;
  if (rung >= l.rungs) {
    return {s, c, rounded<T>(l.mean)};
  }
  const T gs = rounded<T>(l.g[rung]) * s, ac = rounded<T>(l.a[rung]) * c;
  return {s, c, sqrt(ac * ac + gs * gs)};
}

}  // namespace detail

/// Rung 1 of a phase's sine and cosine.
template <class T>
Jacobi<T> elliptic_rung_1(const EllipticLadder<T>& l, const SinCos<T>& phase) {
  Jacobi<T> j{phase.sin, phase.cos, rounded<T>(l.mean)};
  for (int n = std::min(l.rungs, EllipticLadder<T>::kMost) - 1; n >= 1; --n) {
    j = detail::rung_down(rounded<T>(l.a[n]), rounded<T>(l.g[n]), j);
  }
  return detail::on_the_circle(l, j, 1);
}

/// sn, cn, dn from rung 1.
template <class T>
Jacobi<T> elliptic_rung_0(const EllipticLadder<T>& l, const Jacobi<T>& rung_1) {
  return detail::on_the_circle(l, detail::rung_down(T(1), rounded<T>(l.g[0]), rung_1), 0);
}

/// s of rung 1 from sn and dn.
template <class T>
T sine_on_rung_1(const EllipticLadder<T>& l, const Jacobi<T>& rung_0) {
  return rung_0.s * (T(1) + rounded<T>(l.g[0])) / (T(1) + rung_0.d);
}

/// sn, cn, dn of u + v (Jacobi 1829; DLMF 22.8). 1 - m s²s'² is written as a sum.
template <class T>
Jacobi<T> elliptic_sum(const Jacobi<T>& u, const Jacobi<T>& v, const T& m) {
  const T inverse = T(1) / (v.c * v.c + (v.s * v.s) * (u.d * u.d));
  return {(u.s * (v.c * v.d) + v.s * (u.c * u.d)) * inverse,
          (u.c * v.c - (u.s * v.s) * (u.d * v.d)) * inverse,
          (u.d * v.d - m * (u.s * v.s) * (u.c * v.c)) * inverse};
}

/// The integral of the third kind, Π, with its pole off the real axis: there it is an angle, and
/// splits into a mean rate and a periodic part. From rung 1 on, let τ_n = sn/(cn dn) of the pole's
/// imaginary part to the modulus k'_n, y = sn/cn. Landen's transformation, which doubles the phase,
/// halves the angle of Jacobi's Θ:  Θ(2u | next rung) ~ Θ(u)² dn(u), so that with r_n = (1 - k'_n) τ_n
///   angle(u) = 2 arg Θ(u + i b) = -Σ_{n≥1} 2^(1-n) atan(r_n sin φ_{n+1}),   φ_{n+1} at the phase 2ⁿζ,
///   y_{n+1} = (1 + k'_n) τ_n,   τ_n = y_n √((1 + y_n²)/(1 + k_n² y_n²)),
/// and d angle/du at u = 0 is -Σ (a_n + g_n) r_n: what the mean rate has more than the rate there.
/// Between two points the angle is
///   angle(u + v) - angle(u) = angle(v) + 2 atan(q s_u s_v s_{u+v} / (1 + ½ ν (Σ s² - k² Π s²)))
/// on rung 1, ν = k² y², q² = ν (1 + ν)(ν + k²): the addition theorem, DLMF 19.11(i), whose root is a
/// perfect square. So nothing of a short step hangs on the phase at its start.
/// (The doubling: DLMF 22.7(i), 20.7(iv); the sum of arc tangents is worked out from them here.)
template <class T>
struct ThirdKind {
  using W = WiderOf<T>;
  static constexpr int kMost = EllipticLadder<T>::kMost;
  int terms = 0;
  T r[kMost], k_prime[kMost];  ///< from rung 1 on
  W mean_over_start{};         ///< Σ (a_n + g_n) r_n
  T k_squared{}, nu{}, q{};    ///< of rung 1
};

/// `y`: sn/cn of the pole's part on rung 1.
template <class T>
ThirdKind<T> third_kind(const EllipticLadder<T>& l, WiderOf<T> y) {
  using std::sqrt;
  using W = WiderOf<T>;
  // 1e-4 of an ulp of the result: what a wider type knows below that, no time brings to light.
  const T negligible = T(1e-4) * std::numeric_limits<T>::epsilon();
  ThirdKind<T> k;
  W a = l.mean, gap = l.gap[l.rungs - 1];
  for (int n = 1; n < ThirdKind<T>::kMost; ++n) {
    if (n < l.rungs) {
      a = l.a[n];
      gap = l.gap[n];
    } else {  // a = g = mean, but for a gap that τ may still make felt
      a = l.mean;
      gap = gap * gap / (W(8) * l.mean);
    }
    const W ratio = gap / a;             // 1 - k'
    const W one_k_prime = W(2) - ratio;  // 1 + k'
    const W k2 = ratio * one_k_prime;
    const W y2 = y * y;
    const W tau = y * sqrt((W(1) + y2) / (W(1) + k2 * y2));
    if (n == 1) {
      k.k_squared = rounded<T>(k2);
      k.nu = rounded<T>(k2 * y2);
      k.q = rounded<T>(k2 * y) * sqrt((T(1) + k.nu) * (T(1) + rounded<T>(y2)));
    }
    const W r = ratio * tau;
    k.r[n - 1] = rounded<T>(r);
    k.k_prime[n - 1] = rounded<T>(W(1) - ratio);
    k.terms = n;
    k.mean_over_start = k.mean_over_start + (a * one_k_prime) * r;
    if (!(k.r[n - 1] > negligible)) {
      break;
    }
    y = one_k_prime * tau;
  }
  return k;
}

namespace detail {
template <class T>
T arc_tangent(const T& x) {
  using std::atan;
  if constexpr (std::is_same_v<T, double>) {
    return adstar::atan(x);
  } else {
    return atan(x);
  }
}
}  // namespace detail

/// 2 atan(...) of the addition theorem; s of rung 1 at u, v and u + v.
template <class T>
T third_kind_sum_angle(const ThirdKind<T>& k, const T& s_u, const T& s_v, const T& s_sum) {
  const T product = s_u * s_v * s_sum;
  const T squares = s_u * s_u + s_v * s_v + s_sum * s_sum - k.k_squared * (product * product);
  return T(2) * detail::arc_tangent(k.q * product / (T(1) + T(0.5) * k.nu * squares));
}

/// The periodic part at the point of rung 1.
template <class T>
T third_kind_angle(const EllipticLadder<T>& l, const ThirdKind<T>& k, const Jacobi<T>& rung_1) {
  const T a = l.rungs > 1 ? rounded<T>(l.a[1]) : rounded<T>(l.mean);
  T s = rung_1.s, c = rung_1.c, d = rung_1.d / a;
  T sum = T(0), weight = T(1);
  for (int n = 0; n < k.terms; ++n) {
    const T inverse = T(1) / d;
    const T s2 = s * s, c2 = c * c;
    s = (T(1) + k.k_prime[n]) * s * c * inverse;
    c = (c2 - k.k_prime[n] * s2) * inverse;
    d = (c2 + k.k_prime[n] * s2) * inverse;
    sum = sum + weight * detail::arc_tangent(k.r[n] * s);
    weight = T(0.5) * weight;
  }
  return -sum;
}

}  // namespace adstar
