#pragma once
// Compositions of two flows, A a_0 B b_0 A a_1 ... B b_{n-1} A a_n, all palindromic: A drifts, B kicks.
//
// With c_i the time of kick i and d_i the kicks given before drift i, in steps, their conditions are
//   Σ a_i = Σ b_i = 1                                     consistent; palindromic: order 2
//   Σ b_i (c_i - ½)² = 1/12,  Σ a_i (d_i - ½)² = 1/12     order 4
//   Σ b_i (c_i - ½)^{2k} = 1/((2k + 1) 4^k), k < n        the kicks are a quadrature of order 2n
// Where B is smaller than A by ε, the last leaves ε h^{2n} + ε² h^p: "order (2n, p)" (McLachlan 1995;
// Laskar and Robutel 2001). tests/conformance/splitting_test.cpp holds all conditions to 1e-31.

#include <algorithm>

#include "adstar/integrators/constants.hpp"

namespace adstar {

/// The longest drift of a composition, in steps.
template <class Composition>
constexpr double longest_drift() {
  double longest = 0;
  for (const LongConstant& a : Composition::a) {
    longest = std::max(longest, a.high < 0 ? -a.high : a.high);
  }
  return longest;
}

/// Strang 1968.
struct Strang {
  static constexpr int kOrder = 2;
  static constexpr int kKicks = 1;
  static constexpr LongConstant a[] = {
      {0x1.0000000000000p-1, 0},  // 0.5
      {0x1.0000000000000p-1, 0},  // 0.5
  };
  static constexpr LongConstant b[] = {
      {0x1.0000000000000p+0, 0},  // 1.0
  };
};

/// Blanes and Moan 2002, S6 of order 4: for any two flows. a_0, a_1, b_0 as published, the others solved for.
struct BlanesMoan4 {
  static constexpr int kOrder = 4;
  static constexpr int kKicks = 6;
  static constexpr LongConstant a[] = {
      {0x1.446b185e4f0adp-4, 0x1.a84bca711af1dp-58},   // 0.0792036964311957
      {0x1.69a6288544ab6p-2, -0x1.f04ba392c9bbfp-56},  // 0.353172906049774
      {-0x1.5898de0e14a0ep-5, 0x1.7eb2835d97d16p-60},  // -0.0420650803577197044759166922696745686
      {0x1.c148b493a8983p-3, 0x1.b9362302a609ap-57},   // 0.219376955753500008951833384539349137
      {-0x1.5898de0e14a0ep-5, 0x1.7eb2835d97d16p-60},  // -0.0420650803577197044759166922696745686
      {0x1.69a6288544ab6p-2, -0x1.f04ba392c9bbfp-56},  // 0.353172906049774
      {0x1.446b185e4f0adp-4, 0x1.a84bca711af1dp-58},   // 0.0792036964311957
  };
  static constexpr LongConstant b[] = {
      {0x1.ad16419760f57p-3, -0x1.e5b0cb58ba926p-58},  // 0.209515106613362
      {-0x1.269bc22a3b3d9p-3, 0x1.efcb2e7c772fcp-57},  // -0.143851773179817469134513970208481911
      {0x1.bcc2c0496d241p-2, -0x1.f9e591a033cd3p-58},  // 0.434336666566455469134513970208481911
      {0x1.bcc2c0496d241p-2, -0x1.f9e591a033cd3p-58},  // 0.434336666566455469134513970208481911
      {-0x1.269bc22a3b3d9p-3, 0x1.efcb2e7c772fcp-57},  // -0.143851773179817469134513970208481911
      {0x1.ad16419760f57p-3, -0x1.e5b0cb58ba926p-58},  // 0.209515106613362
  };
};

/// McLachlan 1995, order (8, 4) in five kicks.
struct McLachlan84 {
  static constexpr int kOrder = 4;
  static constexpr int kKicks = 5;
  static constexpr LongConstant a[] = {
      {0x1.349f03a3652d3p-4, -0x1.16b2f1b5aa8d4p-59},  // 0.0753469602698928884165278036834744644
      {0x1.092c65e1ddd29p-1, 0x1.1ace79a1f69d9p-56},   // 0.517916854688256782300773978496315644
      {-0x1.7e0232b253c1cp-4, 0x1.00fc9297d682ep-61},  // -0.0932638149581496707173017821797901087
      {-0x1.7e0232b253c1cp-4, 0x1.00fc9297d682ep-61},  // -0.0932638149581496707173017821797901087
      {0x1.092c65e1ddd29p-1, 0x1.1ace79a1f69d9p-56},   // 0.517916854688256782300773978496315644
      {0x1.349f03a3652d3p-4, -0x1.16b2f1b5aa8d4p-59},  // 0.0753469602698928884165278036834744644
  };
  static constexpr LongConstant b[] = {
      {0x1.85952d63afc25p-3, -0x1.4210349d73310p-57},  // 0.190225939373676619245230762738453897
      {0x1.b16b9a5ba9da9p-1, -0x1.2324407156cc0p-55},  // 0.846524070443526257055080544646775834
      {-0x1.12d0e5b495cb2p+0, 0x1.cea13662ce60ep-56},  // -1.07350001963440575260062261477045946
      {0x1.b16b9a5ba9da9p-1, -0x1.2324407156cc0p-55},  // 0.846524070443526257055080544646775834
      {0x1.85952d63afc25p-3, -0x1.4210349d73310p-57},  // 0.190225939373676619245230762738453897
  };
};

/// McLachlan 1995, order (10, 2): five kicks at the points of Gauss.
struct McLachlan102 {
  static constexpr int kOrder = 2;
  static constexpr int kKicks = 5;
  static constexpr LongConstant a[] = {
      {0x1.80498fd662cb6p-5, -0x1.8c023f0449b00p-61},  // 0.0469100770306680036011865608503035174
      {0x1.78891c57306c9p-3, -0x1.672efff8b0974p-58},  // 0.18385526791649045088065622879959208
      {0x1.13b23fd99b705p-2, -0x1.33a85c1363196p-57},  // 0.269234655052841545518157210350104402
      {0x1.13b23fd99b705p-2, -0x1.33a85c1363196p-57},  // 0.269234655052841545518157210350104402
      {0x1.78891c57306c9p-3, -0x1.672efff8b0974p-58},  // 0.18385526791649045088065622879959208
      {0x1.80498fd662cb6p-5, -0x1.8c023f0449b00p-61},  // 0.0469100770306680036011865608503035174
  };
  static constexpr LongConstant b[] = {
      {0x1.e539ec36e038cp-4, 0x1.81e456d0f9271p-60},   // 0.118463442528094543757132020359958681
      {0x1.ea1da25ae415bp-3, -0x1.a64d03c22ea0cp-60},  // 0.239314335249683234020645757417819096
      {0x1.23456789abcdfp-2, 0x1.23456789abcdfp-62},   // 0.284444444444444444444444444444444444
      {0x1.ea1da25ae415bp-3, -0x1.a64d03c22ea0cp-60},  // 0.239314335249683234020645757417819096
      {0x1.e539ec36e038cp-4, 0x1.81e456d0f9271p-60},   // 0.118463442528094543757132020359958681
  };
};

}  // namespace adstar
