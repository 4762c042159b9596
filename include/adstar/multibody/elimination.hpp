#pragma once
// The index-1 system of a tree with a few loops, by block elimination from the leaves to the root.
//
//   M a = f + Cᵀ λ + Gᵀ μ,   C a = gamma,   G a = gamma_G        C: joints of the tree, G: joints that close loops
// For a body i whose joint leads to its parent p, with M̂, f̂ what its own children left (M̂ = M at a leaf):
//   S = C_i M̂_i⁻¹ C_iᵀ,   ĝ = gamma - C_i M̂_i⁻¹ f̂_i
//   M̂_p += C_pᵀ S⁻¹ C_p,   f̂_p += C_pᵀ S⁻¹ ĝ
// and back from the root: λ = S⁻¹ (ĝ - C_p a_p), a_i = M̂_i⁻¹ (f̂_i + C_iᵀ λ). M̂ is Featherstone's articulated inertia
// (Rigid Body Dynamics Algorithms, 2008, section 7.1) in the form of Lagrange multipliers (Baraff 1996): what a joint
// leaves free adds nothing to the parent, to the last bit, so a heavy body behind a light one does not drown it.
// Loops: A = the tree's answer to Gᵀ, the dense border (G A) μ = gamma_G - G a_0, and the tree once more with Gᵀ μ.
// Cost: linear in the bodies; with m loop rows, m more passes at the factorisation and m³/6 of the border.

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "adstar/multibody/dense.hpp"
#include "adstar/multibody/joint.hpp"
#include "adstar/multibody/topology.hpp"
#include "adstar/vec3.hpp"

namespace adstar::multibody {

/// (omega', v') or (moment about the centre of mass, force), in I.
template <class T>
using Spatial = std::array<T, 6>;

/// M of one body: J in I, and its mass.
template <class T>
struct MassBlock {
  Sym3<T> J_I;
  T mass{};
};

/// C of one joint, on both sides.
template <class T>
struct JointJacobian {
  JacobianBlock<T> a, b;
};

/// A row of a joint.
struct RowPlace {
  int joint = 0, row = 0;
  friend bool operator==(const RowPlace&, const RowPlace&) = default;
};

/// A pivot of the border below this share of the row's mobility() is round-off: the loop is at a dead point.
inline constexpr double kBorderFloor = 1e-13;

template <class T>
class Elimination {
 public:
  /// `loop_rows`: rows of the topology's loop joints that are to be held.
  Elimination(const Topology& topology, const std::vector<Joint<T>>& joints,
              std::vector<RowPlace> loop_rows)
      : links_(topology.links),
        loop_joints_(topology.loops),
        loop_rows_(std::move(loop_rows)),
        blocks_(links_.size()),
        jacobians_(joints.size()),
        scratch_(links_.size()),
        answers_(loop_rows_.size() * links_.size()),
        border_(loop_rows_.size() * loop_rows_.size()),
        mu_(loop_rows_.size()),
        least_(loop_rows_.size()) {
    for (const Joint<T>& joint : joints) {
      sides_.push_back({joint.body_a, joint.body_b});
      rows_.push_back(shape_of(joint.kind).rows());
    }
  }

  /// To be filled before factor().
  std::span<JointJacobian<T>> jacobians() { return jacobians_; }
  /// G A before it is factored; for whoever looks for its rank.
  std::span<const T> border(std::span<const MassBlock<T>> masses) {
    factor_tree(masses);
    make_border();
    return border_;
  }

  /// How many loop rows were found dependent on the others, at this configuration.
  int factor(std::span<const MassBlock<T>> masses) {
    factor_tree(masses);
    if (loop_rows_.empty()) {
      return 0;
    }
    make_border();
    const int m = static_cast<int>(loop_rows_.size());
    for (std::size_t r = 0; r < loop_rows_.size(); ++r) {
      least_[r] = T(kBorderFloor) * mobility(loop_rows_[r], masses);
    }
    return factor_cholesky(border_.data(), m, m, least_.data());
  }

  /// g M⁻¹ gᵀ of a row g of G, as if nothing else held its bodies; their inertia by its trace.
  T mobility(const RowPlace& place, std::span<const MassBlock<T>> masses) const {
    const JointJacobian<T>& G = jacobians_[at(place.joint)];
    const Sides& on = sides_[at(place.joint)];
    T sum{};
    const auto add = [&](int body, const T* row) {
      if (body == kGround) {
        return;
      }
      const MassBlock<T>& own = masses[at(body)];
      const T moment = (own.J_I.xx + own.J_I.yy) + own.J_I.zz;
      sum = sum + (row[0] * row[0] + row[1] * row[1] + row[2] * row[2]) / moment +
            (row[3] * row[3] + row[4] * row[4] + row[5] * row[5]) / own.mass;
    };
    add(on.a, G.a.row[place.row]);
    add(on.b, G.b.row[place.row]);
    return sum;
  }

  /// `f`: forces on the bodies, and then their accelerations; `gamma`, `lambda`: by joint.
  void solve(std::span<Spatial<T>> f, std::span<const std::array<T, 6>> gamma,
             std::span<std::array<T, 6>> lambda) {
    if (loop_rows_.empty()) {
      solve_tree(f, gamma.data(), lambda.data());
      return;
    }
    for (std::size_t i = 0; i < f.size(); ++i) {
      scratch_[i] = f[i];
    }
    solve_tree(scratch_, gamma.data(), lambda.data());
    const std::size_t m = loop_rows_.size();
    for (std::size_t r = 0; r < m; ++r) {
      const RowPlace at = loop_rows_[r];
      mu_[r] = gamma[static_cast<std::size_t>(at.joint)][static_cast<std::size_t>(at.row)] -
               row_times(at, scratch_);
    }
    solve_lower(border_.data(), static_cast<int>(m), static_cast<int>(m), mu_.data());
    solve_upper(border_.data(), static_cast<int>(m), static_cast<int>(m), mu_.data());
    for (const int j : loop_joints_) {
      lambda[static_cast<std::size_t>(j)] = {};
    }
    for (std::size_t r = 0; r < m; ++r) {
      const RowPlace at = loop_rows_[r];
      lambda[static_cast<std::size_t>(at.joint)][static_cast<std::size_t>(at.row)] = mu_[r];
      add_row(at, mu_[r], f);
    }
    solve_tree(f, gamma.data(), lambda.data());
  }

 private:
  struct Sides {
    int a, b;
  };
  /// Of one body and the joint to its parent; n rows.
  struct Block {
    T L[36];   ///< M̂ = L Lᵀ
    T Y[36];   ///< L⁻¹ C_iᵀ, a row for each row of C
    T LS[36];  ///< S = Yᵀ Y = LS LSᵀ
    T Z[36];   ///< LS⁻¹ C_p, n × 6
    T y[6];    ///< L⁻¹ f̂
    T g[6];    ///< LS⁻¹ ĝ
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Block& block(int body) { return blocks_[at(body)]; }

  void factor_tree(std::span<const MassBlock<T>> masses) {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      T* const M = blocks_[i].L;
      for (int k = 0; k < 36; ++k) {
        M[k] = T(0);
      }
      const Sym3<T>& J = masses[i].J_I;
      M[0] = J.xx, M[6] = J.xy, M[7] = J.yy, M[12] = J.xz, M[13] = J.yz, M[14] = J.zz;
      M[21] = M[28] = M[35] = masses[i].mass;
    }
    for (std::size_t l = links_.size(); l-- > 0;) {
      const TreeLink& link = links_[l];
      Block& own = block(link.body);
      factor_cholesky_of<6>(own.L);
      if (link.joint < 0) {
        continue;
      }
      const JointJacobian<T>& C = jacobians_[at(link.joint)];
      const JacobianBlock<T>& child = link.child_is_b ? C.b : C.a;
      const JacobianBlock<T>& parent = link.child_is_b ? C.a : C.b;
      T* const M = link.parent == kGround ? nullptr : block(link.parent).L;
      with_rows(rows_[at(link.joint)], [&](auto N) { eliminate<N()>(own, child, parent, M); });
    }
  }

  /// A body whose M̂ is factored, and its joint of N rows, into the parent's M̂ (null: the ground).
  template <int N>
  static void eliminate(Block& own, const JacobianBlock<T>& child, const JacobianBlock<T>& parent,
                        T* M) {
    for (int i = 0; i < N; ++i) {
      T* const column = own.Y + 6 * i;
      for (int k = 0; k < 6; ++k) {
        T sum = child.row[i][k];
        for (int j = 0; j < k; ++j) {
          sum = sum - own.L[6 * k + j] * column[j];
        }
        column[k] = sum * own.L[7 * k];
      }
      for (int j = 0; j <= i; ++j) {
        own.LS[6 * i + j] = product(column, own.Y + 6 * j);
      }
    }
    factor_cholesky_of<N>(own.LS);
    if (M == nullptr) {
      return;
    }
    for (int i = 0; i < N; ++i) {  // forward substitution, six right-hand sides at once
      T* const row = own.Z + 6 * i;
      for (int k = 0; k < 6; ++k) {
        T sum = parent.row[i][k];
        for (int j = 0; j < i; ++j) {
          sum = sum - own.LS[6 * i + j] * own.Z[6 * j + k];
        }
        row[k] = sum * own.LS[7 * i];
      }
    }
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c <= r; ++c) {
        T sum = M[6 * r + c];
        for (int i = 0; i < N; ++i) {
          sum = sum + own.Z[6 * i + r] * own.Z[6 * i + c];
        }
        M[6 * r + c] = sum;
      }
    }
  }

  /// action(constant N) with N the rows of the joint.
  template <class Action>
  static void with_rows(int rows, const Action& action) {
    switch (rows) {
      case 3:
        return action(std::integral_constant<int, 3>{});
      case 4:
        return action(std::integral_constant<int, 4>{});
      case 5:
        return action(std::integral_constant<int, 5>{});
      default:
        return action(std::integral_constant<int, 6>{});
    }
  }

  /// `gamma` null: zero. `lambda` null: not wanted.
  void solve_tree(std::span<Spatial<T>> f, const std::array<T, 6>* gamma,
                  std::array<T, 6>* lambda) {
    for (std::size_t l = links_.size(); l-- > 0;) {
      const TreeLink& link = links_[l];
      Block& own = block(link.body);
      for (std::size_t k = 0; k < 6; ++k) {
        own.y[k] = f[at(link.body)][k];
      }
      solve_lower(own.L, 6, 6, own.y);
      if (link.joint >= 0) {
        const T* const right = gamma == nullptr ? nullptr : gamma[at(link.joint)].data();
        T* const up = link.parent == kGround ? nullptr : f[at(link.parent)].data();
        with_rows(rows_[at(link.joint)], [&](auto N) { gather<N()>(own, right, up); });
      }
    }
    for (const TreeLink& link : links_) {
      Block& own = block(link.body);
      if (link.joint >= 0) {
        const T* const above = link.parent == kGround ? nullptr : f[at(link.parent)].data();
        with_rows(rows_[at(link.joint)], [&](auto N) {
          T load[6];
          spread<N()>(own, above, load);
          for (std::size_t i = 0; lambda != nullptr && i < N(); ++i) {
            lambda[at(link.joint)][i] = load[i];
          }
        });
      }
      solve_upper(own.L, 6, 6, own.y);
      for (std::size_t k = 0; k < 6; ++k) {
        f[at(link.body)][k] = own.y[k];
      }
    }
  }

  /// g := LS⁻¹ (gamma - Y y), and Zᵀ g to the parent's force `up` (null: the ground).
  template <int N>
  static void gather(Block& own, const T* gamma, T* up) {
    for (int i = 0; i < N; ++i) {
      const T right = gamma == nullptr ? T(0) : gamma[i];
      own.g[i] = right - product(own.Y + 6 * i, own.y);
    }
    solve_lower(own.LS, N, 6, own.g);
    for (int i = 0; up != nullptr && i < N; ++i) {
      for (int k = 0; k < 6; ++k) {
        up[k] = up[k] + own.Z[6 * i + k] * own.g[i];
      }
    }
  }

  /// λ = LS⁻ᵀ (g - Z a_p), and y += Yᵀ λ.
  template <int N>
  static void spread(Block& own, const T* above, T* load) {
    for (int i = 0; i < N; ++i) {
      load[i] = above == nullptr ? own.g[i] : own.g[i] - product(own.Z + 6 * i, above);
    }
    solve_upper(own.LS, N, 6, load);
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < 6; ++k) {
        own.y[k] = own.y[k] + own.Y[6 * i + k] * load[i];
      }
    }
  }

  void make_border() {
    const std::size_t m = loop_rows_.size(), k = links_.size();
    for (std::size_t r = 0; r < m; ++r) {
      const std::span<Spatial<T>> answer(answers_.data() + r * k, k);
      for (Spatial<T>& each : answer) {
        each = {};
      }
      add_row(loop_rows_[r], T(1), answer);
      solve_tree(answer, nullptr, nullptr);
      for (std::size_t s = 0; s < m; ++s) {
        border_[s * m + r] = row_times(loop_rows_[s], answer);
      }
    }
  }

  /// f += (row of G)ᵀ μ
  void add_row(const RowPlace& place, const T& mu, std::span<Spatial<T>> f) const {
    const JointJacobian<T>& G = jacobians_[at(place.joint)];
    const Sides& on = sides_[at(place.joint)];
    for (std::size_t k = 0; k < 6; ++k) {
      if (on.a != kGround) {
        f[at(on.a)][k] = f[at(on.a)][k] + mu * G.a.row[place.row][k];
      }
      if (on.b != kGround) {
        f[at(on.b)][k] = f[at(on.b)][k] + mu * G.b.row[place.row][k];
      }
    }
  }
  T row_times(const RowPlace& place, std::span<const Spatial<T>> a) const {
    const JointJacobian<T>& G = jacobians_[at(place.joint)];
    const Sides& on = sides_[at(place.joint)];
    T sum{};
    if (on.a != kGround) {
      sum = sum + product(G.a.row[place.row], a[at(on.a)].data());
    }
    if (on.b != kGround) {
      sum = sum + product(G.b.row[place.row], a[at(on.b)].data());
    }
    return sum;
  }
  static T product(const T* x, const T* y) {
    return ((x[0] * y[0] + x[1] * y[1]) + (x[2] * y[2] + x[3] * y[3])) +
           (x[4] * y[4] + x[5] * y[5]);
  }

  std::vector<TreeLink> links_;
  std::vector<int> loop_joints_;
  std::vector<RowPlace> loop_rows_;
  std::vector<Sides> sides_;
  std::vector<int> rows_;  ///< by joint
  std::vector<Block> blocks_;
  std::vector<JointJacobian<T>> jacobians_;
  std::vector<Spatial<T>> scratch_;
  std::vector<Spatial<T>> answers_;  ///< A, by row then body
  std::vector<T> border_;            ///< G A, then its factor
  std::vector<T> mu_, least_;
};

}  // namespace adstar::multibody
