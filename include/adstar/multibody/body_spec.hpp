#pragma once
// What an assembly is asked for, and the errors that say what cannot be: std::invalid_argument, with the name of
// the body or the joint, what it has, what was expected, and what to try.

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/multibody/joint.hpp"

namespace adstar::multibody {

/// A body as it is asked for, and where it starts.
template <class T>
struct BodySpec {
  std::string name;
  T mass_kg{};
  Eigen::Matrix<T, 3, 3> inertia_B;  ///< about its own centre of mass [kg m²]
  Vec3<T> x_I;                       ///< centre of mass [m]
  Quat<T> q_IB;
  Vec3<T> v_I;      ///< [m/s]
  Vec3<T> omega_B;  ///< [rad/s]
};

namespace detail {

template <class... Word>
[[noreturn]] void refuse(const Word&... words) {
  std::ostringstream text;
  (text << ... << words);
  throw std::invalid_argument(text.str());
}

template <class T>
bool finite(const Vec3<T>& v) {
  return v.x - v.x == T(0) && v.y - v.y == T(0) && v.z - v.z == T(0);
}

template <class T>
void check_body(const BodySpec<T>& spec) {
  const auto who = "body '" + spec.name + "': ";
  if (spec.name.empty() || spec.name == "ground") {
    refuse(who, "a body needs a name of its own; 'ground' is the inertial frame");
  }
  if (!(spec.mass_kg > T(0)) || !(spec.mass_kg - spec.mass_kg == T(0))) {
    refuse(who, "its mass is ", static_cast<double>(spec.mass_kg),
           " kg, expected finite and positive; a massless part belongs to a neighbour");
  }
  const Eigen::Matrix<T, 3, 3>& J = spec.inertia_B;
  const Sym3<T> lower{J(0, 0), J(1, 1), J(2, 2), J(1, 0), J(2, 0), J(2, 1)};
  const T size = (lower.xx + lower.yy) + lower.zz;
  using std::abs;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < r; ++c) {
      if (!(abs(J(r, c) - J(c, r)) <= T(1e-12) * size)) {
        refuse(who, "its inertia is not symmetric; give both halves alike");
      }
    }
  }
  if (!(size > T(0)) || !(size - size == T(0))) {
    refuse(who, "its inertia is not finite and positive; give it about the centre of mass");
  }
  const auto moments = principal_moments(lower);
  if (!(moments[0] > T(1e-14) * moments[2])) {
    refuse(who, "its least moment of inertia is ", static_cast<double>(moments[0]),
           " kg m2, expected positive; a rod needs a thickness");
  }
  if (!(moments[2] <= (moments[0] + moments[1]) * T(1 + 1e-9))) {
    refuse(who, "its moments of inertia are ", static_cast<double>(moments[0]), ", ",
           static_cast<double>(moments[1]), ", ", static_cast<double>(moments[2]),
           " kg m2; no body has one above the sum of the others; give the tensor about the centre "
           "of mass");
  }
  const T q2 = squared_norm(spec.q_IB);
  if (!(abs(q2 - T(1)) < T(1e-6)) || !finite(spec.x_I) || !finite(spec.v_I) ||
      !finite(spec.omega_B)) {
    refuse(who, "its start is not finite, or its attitude not a unit quaternion");
  }
}

template <class T>
void check_law(const std::string& who, const CoordinateLaw<T>& law) {
  for (const T& each : {law.stiffness, law.damping, law.stop_stiffness, law.stop_dissipation}) {
    if (!(each >= T(0)) || !(each - each == T(0))) {
      refuse(who, "a stiffness or damping is ", static_cast<double>(each),
             ", expected zero or more");
    }
  }
  if (law.stops && !(law.lower < law.upper)) {
    refuse(who, "its stops are at ", static_cast<double>(law.lower), " and ",
           static_cast<double>(law.upper), "; the lower one must be below");
  }
  if (!(law.rest - law.rest == T(0))) {
    refuse(who, "the rest of its spring is not finite");
  }
}

template <class T>
void check_joint(const Joint<T>& joint, const std::vector<BodySpec<T>>& bodies) {
  const auto who = "joint '" + joint.name + "': ";
  const int count = static_cast<int>(bodies.size());
  if (joint.name.empty()) {
    refuse(who, "a joint needs a name");
  }
  for (const int body : {joint.body_a, joint.body_b}) {
    if (body < kGround || body >= count) {
      refuse(who, "there is no body ", body, " among ", count);
    }
  }
  if (joint.body_a == joint.body_b) {
    refuse(who, "it joins ",
           joint.body_a == kGround ? std::string("the ground")
                                   : bodies[static_cast<std::size_t>(joint.body_a)].name,
           " to itself; name two bodies, or a body and the ground");
  }
  for (const JointFrame<T>* frame : {&joint.a, &joint.b}) {
    using std::abs;
    if (!finite(frame->point_B) || !(abs(squared_norm(frame->q_BF) - T(1)) < T(1e-6))) {
      refuse(who, "a frame of it is not finite, or its axes not a unit quaternion");
    }
  }
  for (const CoordinateLaw<T>& law : joint.laws) {
    check_law(who, law);
  }
}

template <class Named>
void check_names(const std::vector<Named>& all, std::string_view what) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (all[i].name == all[j].name) {
        refuse(what, " '", all[i].name, "' is there twice; give each a name of its own");
      }
    }
  }
}

}  // namespace detail

/// The place of a body by its name; 'ground' is kGround.
template <class T>
int place_of(const std::vector<BodySpec<T>>& bodies, std::string_view name) {
  if (name == "ground") {
    return kGround;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) {
      return static_cast<int>(i);
    }
  }
  detail::refuse("there is no body '", name, "'");
}

}  // namespace adstar::multibody
