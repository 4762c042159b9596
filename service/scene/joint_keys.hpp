#pragma once
// The keys of a joint, in [[spacecraft.joint]] and [[spacecraft.chain]] alike.

#include <optional>
#include <vector>

#include "adstar/multibody/placement.hpp"
#include "service/scene/keys.hpp"

namespace adstar::scene {

/// What a joint is beside the bodies that it joins.
struct JointRead {
  multibody::Joint<double> joint;
  multibody::JointStart<double> start;
  Value coordinate, rate;        ///< where the start was named, if it was
  std::vector<double> standing;  ///< of its motor, a coordinate each; empty: none
  double limit = 0;
  bool commanded = false;
};

/// Nothing, and a complaint, when its kind is not known.
std::optional<JointRead> read_joint_keys(Keys& keys);

}  // namespace adstar::scene
