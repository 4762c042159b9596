#pragma once
// Which joints make a tree over the bodies, and which close loops: breadth first from the ground, if a joint
// is attached to it, else from body 0, in the order of the joints.

#include <cstddef>
#include <vector>

#include "adstar/multibody/joint.hpp"

namespace adstar::multibody {

/// A body and the joint that holds it to the one nearer the root.
struct TreeLink {
  int body = 0;
  int parent = kGround;
  int joint = -1;          ///< -1: a free base, held by nothing
  bool child_is_b = true;  ///< of the joint
};

struct Topology {
  bool grounded = false;
  std::vector<TreeLink> links;  ///< parents before children
  std::vector<int> loops;       ///< joints that are not in the tree
  std::vector<int> unreached;   ///< bodies without a way to the root
};

template <class T>
Topology find_topology(std::size_t bodies, const std::vector<Joint<T>>& joints) {
  Topology topology;
  std::vector<bool> reached(bodies, false), used(joints.size(), false);
  std::vector<std::vector<int>> touching(bodies);
  std::vector<int> of_ground;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    for (const int body : {joints[j].body_a, joints[j].body_b}) {
      (body == kGround ? of_ground : touching[static_cast<std::size_t>(body)])
          .push_back(static_cast<int>(j));
    }
  }
  const auto reach_from = [&](int from, const std::vector<int>& around) {
    for (const int j : around) {
      const Joint<T>& joint = joints[static_cast<std::size_t>(j)];
      const bool child_is_b = joint.body_a == from;
      const int child = child_is_b ? joint.body_b : joint.body_a;
      if (used[static_cast<std::size_t>(j)] || child == kGround ||
          reached[static_cast<std::size_t>(child)]) {
        continue;
      }
      used[static_cast<std::size_t>(j)] = true;
      reached[static_cast<std::size_t>(child)] = true;
      topology.links.push_back({child, from, j, child_is_b});
    }
  };
  topology.grounded = !of_ground.empty();
  if (topology.grounded) {
    reach_from(kGround, of_ground);
  } else if (bodies > 0) {
    reached[0] = true;
    topology.links.push_back({0, kGround, -1, true});
  }
  std::size_t next = 0;
  while (next < topology.links.size()) {  // which grows
    const int body = topology.links[next++].body;
    reach_from(body, touching[static_cast<std::size_t>(body)]);
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!used[j]) {
      topology.loops.push_back(static_cast<int>(j));
    }
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    if (!reached[i]) {
      topology.unreached.push_back(static_cast<int>(i));
    }
  }
  return topology;
}

}  // namespace adstar::multibody
