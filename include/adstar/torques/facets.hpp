#pragma once
// The outside of a spacecraft as flat plates, for what flows or shines on it. A plate has one side that is looked at: the one its
// normal points from. Plates do not shade each other.

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "adstar/vec3.hpp"

namespace adstar {

template <class T>
struct Facet {
  T area_m2{};
  Vec3<T> normal_B;    ///< unit, outwards
  Vec3<T> centre_B_m;  ///< of pressure, from the centre of mass
  T drag_coefficient = T(2.2);
  T specular{},
      diffuse{};  ///< parts of the light that it reflects so; the rest, 1 less both, is absorbed
};

/// Shared, so that a copy of a torque does not allocate.
template <class T>
using Facets = std::shared_ptr<const std::vector<Facet<T>>>;

template <class T>
Facets<T> make_facets(std::vector<Facet<T>> facets) {
  return std::make_shared<const std::vector<Facet<T>>>(std::move(facets));
}

/// The six sides of a box along the axes of B, its middle at `middle_B_m` from the centre of mass: +x, -x, +y, -y, +z, -z, all
/// else as `like` has it.
template <class T>
std::vector<Facet<T>> box_facets(const Vec3<T>& lengths_m, const Vec3<T>& middle_B_m = {},
                                 const Facet<T>& like = {}) {
  const std::array<Vec3<T>, 3> axes{Vec3<T>{T(1), T(0), T(0)}, Vec3<T>{T(0), T(1), T(0)},
                                    Vec3<T>{T(0), T(0), T(1)}};
  const std::array<T, 3> lengths{lengths_m.x, lengths_m.y, lengths_m.z};
  std::vector<Facet<T>> facets;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const int sign : {1, -1}) {
      Facet<T> facet = like;
      facet.area_m2 = lengths[(i + 1) % 3] * lengths[(i + 2) % 3];
      facet.normal_B = T(sign) * axes[i];
      facet.centre_B_m = middle_B_m + (T(0.5) * lengths[i]) * facet.normal_B;
      facets.push_back(facet);
    }
  }
  return facets;
}

}  // namespace adstar
