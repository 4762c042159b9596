#pragma once
// A torque that does not change in its frame.

#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct Constant {
  static constexpr const char* kName = "constant";
  Frame frame = Frame::body;
  Vec3<T> torque_n_m;

  Ramp<T> ramp_from(std::int64_t) const { return {torque_n_m, {}}; }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }
};

}  // namespace adstar
