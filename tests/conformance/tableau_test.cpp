// Order conditions of every tableau, in exact fractions: one for each rooted tree (Butcher 1963). Those of a
// tableau that is published to 30 digits hold to 1e-27, the products of its largest entries.
#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "adstar/integrators/tableaus.hpp"

namespace adstar {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exact(const Fraction& f) { return Rational(f.numerator, f.denominator); }
Rational exact(const LongConstant& c) { return Rational(c.high) + Rational(c.low); }

/// How far from exact a condition may be.
template <class Tableau>
Rational tolerance() {
  constexpr bool kRational = std::is_same_v<decltype(Tableau::c), const Fraction[Tableau::kStages]>;
  return kRational ? Rational(0) : Rational(1) / pow(boost::multiprecision::cpp_int(10), 27);
}

/// A rooted tree: the subtrees at its root, as indices into the list of all smaller trees,
/// ascending.
struct Tree {
  std::vector<std::size_t> branches;
  int order = 1;
  Rational density = 1;  ///< γ: order times the densities of the branches
  std::string name() const { return "tree of order " + std::to_string(order); }
};

/// All rooted trees up to an order: 1, 1, 2, 4, 9, 20, 48, 115 of them.
std::vector<Tree> trees_up_to(int order) {
  std::vector<Tree> trees{Tree{}};
  for (int n = 2; n <= order; ++n) {
    const std::size_t smaller = trees.size();
    std::vector<Tree> found;
    const auto grow = [&](auto&& self, Tree partial, std::size_t first) -> void {
      if (partial.order == n) {
        partial.density *= n;
        found.push_back(partial);
        return;
      }
      for (std::size_t i = first; i < smaller && partial.order + trees[i].order <= n; ++i) {
        Tree next = partial;
        next.branches.push_back(i);
        next.order += trees[i].order;
        next.density *= trees[i].density;
        self(self, next, i);
      }
    };
    grow(grow, Tree{}, 0);
    trees.insert(trees.end(), found.begin(), found.end());
  }
  return trees;
}

template <class Tableau>
class TableauOf : public testing::Test {
 public:
  static constexpr int kStages = Tableau::kStages;

  /// Φ_i of every tree at every stage: the product over branches of Σ_j a_ij Φ_j.
  static std::vector<std::vector<Rational>> elementary_weights(const std::vector<Tree>& trees) {
    std::vector<std::vector<Rational>> weights;
    for (const Tree& tree : trees) {
      std::vector<Rational> at_stage(kStages, Rational(1));
      for (std::size_t i = 0; i < kStages; ++i) {
        for (const std::size_t branch : tree.branches) {
          Rational sum = 0;
          for (std::size_t j = 0; j < kStages; ++j) {
            sum += exact(Tableau::a[i][j]) * weights[branch][j];
          }
          at_stage[i] *= sum;
        }
      }
      weights.push_back(at_stage);
    }
    return weights;
  }

  static Rational total(const std::vector<Rational>& at_stage) {
    Rational sum = 0;
    for (std::size_t i = 0; i < kStages; ++i) {
      sum += exact(Tableau::b[i]) * at_stage[i];
    }
    return sum;
  }
};

using Tableaus = testing::Types<Midpoint2, Rk4, Dopri5, Verner6, Fehlberg8, Dop853>;
TYPED_TEST_SUITE(TableauOf, Tableaus);

TYPED_TEST(TableauOf, is_explicit_with_row_sums_equal_to_its_nodes) {
  for (std::size_t i = 0; i < TypeParam::kStages; ++i) {
    Rational sum = 0;
    for (std::size_t j = 0; j < TypeParam::kStages; ++j) {
      sum += exact(TypeParam::a[i][j]);
      EXPECT_TRUE(j < i || TypeParam::a[i][j].is_zero()) << "row " << i << ", column " << j;
    }
    EXPECT_LE(abs(sum - exact(TypeParam::c[i])), tolerance<TypeParam>()) << "row " << i;
  }
}

TYPED_TEST(TableauOf, meets_every_condition_of_its_order) {
  const auto trees = trees_up_to(TypeParam::kOrder);
  const auto weights = this->elementary_weights(trees);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    EXPECT_LE(abs(this->total(weights[i]) - 1 / trees[i].density), tolerance<TypeParam>())
        << trees[i].name();
  }
}

TYPED_TEST(TableauOf, claims_no_less_than_its_order) {
  const auto trees = trees_up_to(TypeParam::kOrder + 1);
  const auto weights = this->elementary_weights(trees);
  bool all = true;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    all = all && abs(this->total(weights[i]) - 1 / trees[i].density) <= tolerance<TypeParam>();
  }
  EXPECT_FALSE(all);
}

TYPED_TEST(TableauOf, overshoots_by_the_magnitudes_of_its_widest_stage) {
  Rational reach = 0;
  for (const auto& row : TypeParam::a) {
    Rational sum = 0;
    for (const auto& entry : row) {
      sum += abs(exact(entry));
    }
    reach = std::max(reach, sum);
  }
  EXPECT_DOUBLE_EQ(stage_overshoot<TypeParam>(), static_cast<double>(reach));
}

TEST(RootedTrees, are_as_many_as_Cayley_counted) {
  EXPECT_EQ(trees_up_to(1).size(), 1u);
  EXPECT_EQ(trees_up_to(4).size(), 1u + 1 + 2 + 4);
  EXPECT_EQ(trees_up_to(8).size(), 1u + 1 + 2 + 4 + 9 + 20 + 48 + 115);
}

TEST(Fraction, gives_each_scalar_its_own_rounding) {
  constexpr Fraction third{1, 3};
  EXPECT_EQ(third.as<double>(), 1.0 / 3);
  EXPECT_EQ(third.as<long double>(), 1.0L / 3);
  EXPECT_FALSE(third.is_zero());
  EXPECT_TRUE((Fraction{0, 7}).is_zero());
}

}  // namespace
}  // namespace adstar
