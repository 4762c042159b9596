// Our elliptic functions against Boost's in 113 bits, from modulus zero to one and near both.
#include "adstar/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <gtest/gtest.h>

#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::kEpsilon;
using test::Quad;

/// 1 - m, and m with every digit that it has.
struct Modulus {
  Quad complement, m;
  Quad k() const { return sqrt(m); }
};

std::vector<Modulus> moduli() {
  std::vector<Modulus> all;
  for (const double small : {0.0, 1e-30, 1e-16, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.3, 0.5}) {
    all.push_back({1 - Quad(small), Quad(small)});
  }
  for (const double small : {1e-28, 1e-24, 1e-16, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.3}) {
    all.push_back({Quad(small), 1 - Quad(small)});
  }
  return all;
}

template <class T>
WiderOf<T> wider(const Quad& x) {
  if constexpr (std::is_same_v<T, double>) {
    const double hi = static_cast<double>(x);
    return {hi, static_cast<double>(Quad(x - hi))};
  } else {
    return x;
  }
}

template <class T>
EllipticLadder<T> ladder_of(const Modulus& modulus) {
  return elliptic_ladder<T>(wider<T>(sqrt(modulus.complement)), wider<T>(modulus.m));
}

Quad value(const DoubleDouble& x) { return Quad(x.hi) + Quad(x.lo); }
Quad value(const Quad& x) { return x; }

/// K by the ladder's own limit needs another: Carlson's duplication, as Boost sums it.
Quad complete(const Modulus& modulus) {
  return boost::math::ellint_rf(Quad(0), modulus.complement, Quad(1));
}

template <class T>
Jacobi<T> at(const EllipticLadder<T>& l, const Quad& u) {
  const auto phase = sincos(wider<T>(Quad(u * value(l.mean))));
  return elliptic_rung_0(l, elliptic_rung_1(l, SinCos<T>{T(phase.sin), T(phase.cos)}));
}

TEST(EllipticLadder, has_the_complete_integral_for_its_limit_in_twice_the_digits) {
  const Quad half_pi = acos(Quad(0));
  for (const Modulus& modulus : moduli()) {
    const Quad expected = half_pi / complete(modulus);
    EXPECT_LT(abs(value(ladder_of<double>(modulus).mean) / expected - 1), 1e-29)
        << "1 - m = " << modulus.complement;
    EXPECT_LT(abs(ladder_of<Quad>(modulus).mean / expected - 1), 1e-32)
        << "1 - m = " << modulus.complement;
  }
}

TEST(Elliptic, sn_cn_dn_agree_with_Boost_at_every_modulus_and_argument) {
  double worst = 0;
  for (const Modulus& modulus : moduli()) {
    const EllipticLadder<double> l = ladder_of<double>(modulus);
    const Quad K = complete(modulus);
    for (int i = -40; i <= 40; ++i) {
      const Quad u = K * (10 * i + 3) / 100;  // at whole quarters Boost's asin slips beyond 1
      // Boost takes k, which near one has lost its complement: ask in the first quarter only there.
      const Quad k = modulus.k();
      if (modulus.complement < 1e-4 && std::abs(i) > 5) {
        continue;
      }
      Quad cn, dn;
      const Quad sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
      const Jacobi<double> ours = at(l, u);
      const double size = 1 + std::fabs(static_cast<double>(u));
      for (const double error : {ours.s - static_cast<double>(sn), ours.c - static_cast<double>(cn),
                                 ours.d - static_cast<double>(dn)}) {
        worst = std::max(worst, std::fabs(error) / size);
        ASSERT_LT(std::fabs(error), 4 * kEpsilon * size)
            << "1 - m = " << modulus.complement << ", u = " << u;
      }
    }
  }
  RecordProperty("worst_epsilon", std::to_string(worst / kEpsilon));
}

TEST(Elliptic, functions_keep_their_squares_at_every_modulus) {
  for (const Modulus& modulus : moduli()) {
    const EllipticLadder<double> l = ladder_of<double>(modulus);
    const double m = static_cast<double>(modulus.m), rest = static_cast<double>(modulus.complement);
    for (int i = -50; i <= 50; ++i) {
      const Jacobi<double> j = at(l, complete(modulus) * i / 10);
      EXPECT_NEAR(j.s * j.s + j.c * j.c, 1, 3 * kEpsilon);
      EXPECT_NEAR(j.d * j.d + m * j.s * j.s, 1, 4 * kEpsilon);
      EXPECT_NEAR(j.d * j.d / (j.c * j.c + rest * j.s * j.s), 1, 8 * kEpsilon);
    }
  }
}

TEST(Elliptic, near_a_quarter_period_small_values_keep_their_digits) {
  for (const Modulus& modulus : moduli()) {
    if (modulus.complement > 0.5) {
      continue;
    }
    const EllipticLadder<double> l = ladder_of<double>(modulus);
    const Jacobi<double> quarter = elliptic_rung_0(l, elliptic_rung_1(l, {1.0, 0.0}));
    EXPECT_EQ(quarter.s, 1);
    EXPECT_EQ(quarter.c, 0);
    EXPECT_NEAR(quarter.d / static_cast<double>(Quad(sqrt(modulus.complement))), 1, 8 * kEpsilon);
  }
}

TEST(Elliptic, sums_are_those_of_the_arguments) {
  for (const Modulus& modulus : moduli()) {
    const EllipticLadder<Quad> l = ladder_of<Quad>(modulus);
    const Quad K = complete(modulus);
    for (int i = -7; i <= 7; ++i) {
      for (int j = -7; j <= 7; ++j) {
        const Quad u = K * i / 5, v = K * j / 7;
        const Jacobi<Quad> sum = elliptic_sum(at(l, u), at(l, v), modulus.m), whole = at(l, u + v);
        EXPECT_LT(abs(sum.s - whole.s) + abs(sum.c - whole.c) + abs(sum.d - whole.d), 1e-30);
      }
    }
  }
}

TEST(ThirdKind, angle_and_mean_rate_agree_with_the_integral_of_Boost) {
  // With F(u) = w Π(-ν; φ, k), w² = (1 + ν)(ν + k²)/ν, on rung 1: angle = 2 (mean rate of F · u - F).
  double worst = 0;
  for (const double m : {1e-8, 1e-3, 0.1, 0.5, 0.9, 0.999, 1 - 1e-6}) {
    const Modulus modulus{1 - Quad(m), Quad(m)};
    const EllipticLadder<double> l = ladder_of<double>(modulus);
    const EllipticLadder<Quad> lq = ladder_of<Quad>(modulus);
    for (const double pole : {1e-6, 0.01, 0.3, 1.0}) {
      // y up to its greatest, 1/√k of rung 1.
      const Quad k_1 = lq.gap[0] / (lq.a[0] + lq.g[0]);
      const Quad y = pole / sqrt(k_1);
      const ThirdKind<double> third = third_kind<double>(l, wider<double>(y));
      const Quad nu = k_1 * k_1 * y * y, w = sqrt((1 + nu) * (1 + 1 / (y * y)));
      const Quad a_1 = lq.a[1];
      for (const double part : {0.05, 0.3, 0.6, 0.95}) {
        const Quad K_1 = boost::math::ellint_1(k_1);
        const Quad u_1 = K_1 * part;  // on rung 1: a_1 times u
        Quad cn, dn;
        const Quad sn = boost::math::jacobi_elliptic(k_1, u_1, &cn, &dn);
        const Quad integral = boost::math::ellint_3(k_1, Quad(-nu), Quad(asin(sn)));
        // Mean rate of F per u_1, by the complete integral; and its start value w.
        const Quad mean = w * boost::math::ellint_3(k_1, Quad(-nu)) / K_1;
        const Quad expected = 2 * (w * integral - mean * u_1);
        const Jacobi<double> rung_1{static_cast<double>(sn), static_cast<double>(cn),
                                    static_cast<double>(Quad(dn * a_1))};
        const double ours = third_kind_angle(l, third, rung_1);
        const double error = std::fabs(static_cast<double>(Quad(ours + expected)));
        worst = std::max(worst, error);
        EXPECT_LT(error, 8 * kEpsilon) << "m = " << m << ", pole " << pole << ", part " << part
                                       << ": " << ours << " for " << -expected;
        const Quad excess = 2 * a_1 * (w - mean);
        EXPECT_LT(abs(value(third.mean_over_start) - excess), 1e-18 * (1 + abs(excess)))
            << "m = " << m << ", pole " << pole << ": " << value(third.mean_over_start) << " for "
            << excess;
      }
    }
  }
  RecordProperty("worst_epsilon", std::to_string(worst / kEpsilon));
}

TEST(ThirdKind, angles_add_up_as_the_addition_theorem_says) {
  for (const double m : {1e-8, 0.1, 0.5, 0.99, 1 - 1e-9}) {
    const Modulus modulus{1 - Quad(m), Quad(m)};
    const EllipticLadder<Quad> l = ladder_of<Quad>(modulus);
    const Quad k_1 = l.gap[0] / (l.a[0] + l.g[0]);
    for (const double pole : {1e-6, 0.3, 1.0}) {
      const ThirdKind<Quad> third = third_kind<Quad>(l, pole / sqrt(k_1));
      const auto rung_1 = [&](const Quad& phase) {
        const SinCos<Quad> a = sincos(phase);
        return elliptic_rung_1(l, a);
      };
      for (int i = -6; i <= 6; ++i) {
        for (int j = -6; j <= 6; ++j) {
          const Quad zeta(i * 0.37), eta(j * 0.29);
          const auto u = rung_1(zeta), v = rung_1(eta), sum = rung_1(zeta + eta);
          const Quad difference = third_kind_angle(l, third, sum) - third_kind_angle(l, third, u);
          const Quad theorem =
              third_kind_angle(l, third, v) + third_kind_sum_angle(third, u.s, v.s, sum.s);
          EXPECT_LT(abs(difference - theorem), 1e-30) << "m = " << m << ", pole " << pole;
        }
      }
    }
  }
}

}  // namespace
}  // namespace adstar
