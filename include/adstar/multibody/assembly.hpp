#pragma once
// Rigid bodies and the joints between them: checked once, then constant.
//
// Redundant constraints. What joints that close loops hold may already be held by the others (a planar four-bar
// of four revolutes: two rotations and one translation out of its plane). At construction the rows of loop joints go
// through a pivoted Cholesky factorisation of G A (elimination.hpp) in unit masses; a row whose pivot is below
// kRedundantShare of its mobility depends on the others: it is named in `loops` and *left out*, so its load is
// zero and the loads of the others carry it. The motion does not depend on the choice. Its gap is measured with all
// others after every step: should it open, the step is reported. Start away from dead points, where a row looks
// dependent that is not.

#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/multibody/body_spec.hpp"
#include "adstar/multibody/elimination.hpp"
#include "adstar/multibody/joint.hpp"
#include "adstar/multibody/joint_coordinates.hpp"
#include "adstar/multibody/topology.hpp"

namespace adstar::multibody {

template <class T>
struct Body {
  std::string name;
  T mass{};  ///< [kg]
  RigidBody<T> rigid;
};

/// What each body carries, see state.hpp.
enum class Formulation {
  se3,            ///< (R, x) in SE(3), (H, p) about one origin: total H and p exact
  direct_product  ///< x and R apart, p and the body's own spin: total p exact
};

template <class T>
struct AssemblyOptions {
  Formulation formulation = Formulation::se3;
  Vec3<T> gravity_I{};  ///< uniform [m/s²]
};

/// A joint that closes a loop, and which of its rows the others hold already.
struct LoopJoint {
  int joint = 0;
  std::string name;
  std::vector<int> held, redundant;  ///< rows
  std::string describe(JointKind kind) const {
    std::string text = "joint '" + name + "' closes a loop";
    for (std::size_t i = 0; i < redundant.size(); ++i) {
      text += i == 0 ? "; the other joints already hold its " : ", ";
      text += row_name(kind, redundant[i]);
    }
    return text;
  }
};

/// A joint whose bodies are apart at the start, or part there.
struct JointApart : std::invalid_argument {
  JointApart(std::size_t which, const std::string& what_is_wrong, const std::string& remedy)
      : std::invalid_argument(what_is_wrong + "; " + remedy), joint(which), defect(what_is_wrong) {}
  std::size_t joint;
  std::string defect;  ///< the message without its remedy
};

/// Bodies part by no more than this share of their size at the start.
inline constexpr double kStartTolerance = 1e-9;
/// Squared sine of the angle between a redundant row and what the others span.
inline constexpr double kRedundantShare = 1e-10;

template <class T>
BodyMotion<T> start_of(const BodySpec<T>& spec) {
  const Quat<T> q_IB = normalised(spec.q_IB);
  return {spec.x_I, q_IB, spec.v_I, rotate(q_IB, spec.omega_B)};
}

/// Of what translations of a joint are judged against [m], and rates along it [m/s].
template <class T>
T length_scale(const JointMotion<T>& m, const BodyMotion<T>& a, const BodyMotion<T>& b) {
  return (norm(a.x_I) + norm(b.x_I)) + (norm(m.s) + norm(m.r));
}
template <class T>
T speed_scale(const JointMotion<T>& m, const BodyMotion<T>& a, const BodyMotion<T>& b) {
  return (norm(a.v_I) + norm(b.v_I)) + (norm(a.omega_I) * norm(m.s) + norm(b.omega_I) * norm(m.r));
}

template <class T>
class Assembly {
 public:
  /// Throws std::invalid_argument, which says what is wrong with which body or joint.
  Assembly(const std::vector<BodySpec<T>>& bodies, std::vector<Joint<T>> joints,
           const AssemblyOptions<T>& options = {})
      : joints_(std::move(joints)), options_(options) {
    if (bodies.empty()) {
      detail::refuse("an assembly needs a body");
    }
    for (const BodySpec<T>& spec : bodies) {
      detail::check_body(spec);
      bodies_.push_back({spec.name, spec.mass_kg, RigidBody<T>(spec.inertia_B)});
      starts_.push_back(start_of(spec));
      mass_ = mass_ + spec.mass_kg;
    }
    detail::check_names(bodies, "body");
    for (Joint<T>& joint : joints_) {
      detail::check_joint(joint, bodies);
      joint.a.q_BF = normalised(joint.a.q_BF);
      joint.b.q_BF = normalised(joint.b.q_BF);
    }
    detail::check_names(joints_, "joint");
    topology_ = find_topology(bodies_.size(), joints_);
    if (!topology_.unreached.empty()) {
      detail::refuse(
          "body '", bodies_[static_cast<std::size_t>(topology_.unreached.front())].name,
          "' hangs on nothing: no joints lead from it to ",
          topology_.grounded ? std::string("the ground") : "'" + bodies_.front().name + "'",
          "; join it, or make it an assembly of its own");
    }
    check_start();
    find_redundant_rows();
  }

  const std::vector<Body<T>>& bodies() const { return bodies_; }
  const std::vector<Joint<T>>& joints() const { return joints_; }
  const std::vector<BodyMotion<T>>& starts() const { return starts_; }
  const AssemblyOptions<T>& options() const { return options_; }
  const Topology& topology() const { return topology_; }
  const std::vector<LoopJoint>& loops() const { return loops_; }
  const std::vector<RowPlace>& loop_rows() const { return loop_rows_; }
  T mass() const { return mass_; }

  /// A body's motion out of a list, or the ground's.
  static const BodyMotion<T>& motion_of(const std::vector<BodyMotion<T>>& motions, int body) {
    static const BodyMotion<T> ground{};
    return body == kGround ? ground : motions[static_cast<std::size_t>(body)];
  }

 private:
  void check_start() const {
    JointMotion<T> m;
    using std::abs;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint<T>& joint = joints_[j];
      const auto apart = [&](int row, const char* verb, const T& by, const char* unit,
                             const char* remedy) {
        std::ostringstream text;
        text << "joint '" << joint.name << "' (" << kind_name(joint.kind)
             << "): " << row_name(joint.kind, row) << verb << static_cast<double>(by) << unit
             << " at the start";
        throw JointApart(j, text.str(), remedy);
      };
      const BodyMotion<T>& a = motion_of(starts_, joint.body_a);
      const BodyMotion<T>& b = motion_of(starts_, joint.body_b);
      evaluate(joint, a, b, m);
      const T length = length_scale(m, a, b), speed = speed_scale(m, a, b);
      const T turn = norm(a.omega_I) + norm(b.omega_I);
      for (int row = 0; row < m.shape.rows(); ++row) {
        const auto i = static_cast<std::size_t>(row);
        const bool moves = row < m.shape.translations;
        const T tolerance = T(kStartTolerance);
        if (!(abs(m.gap[i]) <= tolerance * (moves ? length : T(1)))) {
          apart(row, " is open by ", m.gap[i], moves ? " m" : " rad",
                "move the bodies together, or let place() do it");
        }
        if (!(abs(m.rate[i]) <= tolerance * (moves ? speed : turn))) {
          apart(row, " opens at ", m.rate[i], moves ? " m/s" : " rad/s",
                "make the velocities fit, or let place() do it");
        }
      }
      if (joint.kind != JointKind::spherical && joint.kind != JointKind::universal &&
          (dot(m.z_F, m.z_G) < T(0) ||
           (joint.kind != JointKind::revolute && dot(m.x_F, m.x_G) < T(0)))) {
        detail::refuse("joint '", joint.name, "' (", kind_name(joint.kind),
                       "): its axes in the two bodies point opposite ways; turn one frame over");
      }
    }
  }

  void find_redundant_rows() {
    std::vector<RowPlace> all;
    for (const int j : topology_.loops) {
      const Joint<T>& joint = joints_[static_cast<std::size_t>(j)];
      for (int row = 0; row < shape_of(joint.kind).rows(); ++row) {
        all.push_back({j, row});
      }
      loops_.push_back({j, joint.name, {}, {}});
    }
    if (all.empty()) {
      return;
    }
    // The rank of C does not depend on the masses: those that are kindest to the digits.
    Elimination<T> system(topology_, joints_, all);
    T length{};
    int count = 0;
    JointMotion<T> m;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      evaluate(joints_[j], motion_of(starts_, joints_[j].body_a),
               motion_of(starts_, joints_[j].body_b), m);
      jacobian_block(m, m.s, T(-1), system.jacobians()[j].a);
      jacobian_block(m, m.r, T(1), system.jacobians()[j].b);
      for (const auto& [body, lever] :
           {std::pair(joints_[j].body_a, m.s), std::pair(joints_[j].body_b, m.r)}) {
        if (body != kGround) {
          length = length + norm(lever);
          ++count;
        }
      }
    }
    length = length / T(count);
    const T J = length > T(0) ? length * length : T(1);
    const std::vector<MassBlock<T>> masses(bodies_.size(),
                                           MassBlock<T>{{J, J, J, T(0), T(0), T(0)}, T(1)});
    const std::span<const T> border = system.border(masses);
    std::vector<T> mobility;
    mobility.reserve(all.size());
    for (const RowPlace& row : all) {
      mobility.push_back(system.mobility(row, masses));
    }
    keep_independent(std::vector<T>(border.begin(), border.end()), mobility, all);
  }

  /// Pivoted Cholesky: each time the row that is furthest from those taken, by share of its mobility.
  void keep_independent(std::vector<T> A, const std::vector<T>& mobility,
                        const std::vector<RowPlace>& all) {
    const std::size_t m = all.size();
    std::vector<bool> taken(m, false);
    for (std::size_t step = 0; step < m; ++step) {
      std::size_t best = m;
      T share = T(kRedundantShare);
      for (std::size_t i = 0; i < m; ++i) {
        // Of rows that are as good, to round-off, the first.
        if (!taken[i] && A[i * m + i] > T(1 + 1e-6) * (share * mobility[i])) {
          share = A[i * m + i] / mobility[i];
          best = i;
        }
      }
      if (best == m) {
        break;
      }
      taken[best] = true;
      for (std::size_t i = 0; i < m; ++i) {
        const T factor = A[i * m + best] / A[best * m + best];
        for (std::size_t k = 0; !taken[i] && k < m; ++k) {
          A[i * m + k] = A[i * m + k] - factor * A[best * m + k];
        }
      }
    }
    for (std::size_t i = 0; i < m; ++i) {
      for (LoopJoint& loop : loops_) {
        if (loop.joint == all[i].joint) {
          (taken[i] ? loop.held : loop.redundant).push_back(all[i].row);
        }
      }
      if (taken[i]) {
        loop_rows_.push_back(all[i]);
      }
    }
  }

  std::vector<Body<T>> bodies_;
  std::vector<Joint<T>> joints_;
  std::vector<BodyMotion<T>> starts_;
  AssemblyOptions<T> options_;
  Topology topology_;
  std::vector<LoopJoint> loops_;
  std::vector<RowPlace> loop_rows_;
  T mass_{};
};

}  // namespace adstar::multibody
