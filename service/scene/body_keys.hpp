#pragma once
// [[spacecraft.body]], [[spacecraft.joint]] and [[spacecraft.chain]]: a spacecraft of several bodies, whose hub is the
// spacecraft itself.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {

/// What the bodies and joints of a spacecraft are asked to be; its hub's start comes later.
struct LinkedPlan {
  LinkedBodies linked;  ///< bodies[0] is the hub, its start still to be set
  std::vector<multibody::JointStart<double>> starts;  ///< by joint
  std::vector<Value> joint_values;                    ///< by joint, where each was named
  std::vector<Actuator> actuators;                    ///< commanded motors
  std::vector<Facets<double>> outsides;               ///< by body; null: it names none
  Value where;                                        ///< for what is wrong with the whole
};

/// Of the spacecraft's table, with what it says of the hub's outside; null when it is one body.
std::unique_ptr<LinkedPlan> read_linked(Keys& spacecraft, const Facets<double>& outside);

/// Of the whole about the common centre of mass [N m s].
Vec3<double> momentum_of(const LinkedBodies& linked);

/// The bodies placed about a hub of that inertia, attitude and rate, their common centre of mass at rest in the origin. A
/// complaint and null where they do not fit together.
std::shared_ptr<const LinkedBodies> place_linked(const LinkedPlan& plan,
                                                 const Eigen::Matrix3d& inertia_B,
                                                 const Quat<double>& q_IB,
                                                 const Vec3<double>& omega_B);

}  // namespace adstar::scene
