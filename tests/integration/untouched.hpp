#pragma once
// A scene with a body that nobody can reach, beside one that takes commands; and the proof that,
// whatever was done to the daemon, no step of it was lost, taken twice, or taken otherwise.

#include <string>

#include <gtest/gtest.h>

#include "adstar/integrators/coadjoint.hpp"
#include "tests/integration/daemon_harness.hpp"

namespace adstar::testing {

/// paper_scene with a second body, "free1", of the same shape and motion.
inline std::string scene_with_free_body(const dds::ParticipantOptions& where, SceneOptions o = {}) {
  o.more +=
      "[[spacecraft]]\nname = \"free1\"\ninertia_body_kg_m2 = [0.9144, 1.098, 1.66]\n"
      "angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]\n";
  return paper_scene(where, o);
}

/// Stops the daemon, hears its last state, and computes as many steps of `step_ns` anew. `ground`
/// must hear the daemon.
inline void stop_and_expect_untouched(Daemon& daemon, GroundStation& ground, std::int64_t step_ns) {
  ASSERT_EQ(daemon.stop(), 0) << daemon.log();
  ASSERT_TRUE(ground.until([&] {
    return ground.status && ground.status->state == adstar_SERVICE_STOPPED &&
           (ground.attitude["free1"].flags & adstar_FLAG_FINAL) != 0 &&
           ground.momentum["free1"].step == ground.attitude["free1"].step;
  })) << daemon.log();
  const adstar_AttitudeState& last = ground.attitude["free1"];
  EXPECT_EQ(last.time_ns, static_cast<std::int64_t>(last.step) * step_ns);
  EXPECT_EQ(ground.status->time_ns, static_cast<std::int64_t>(ground.status->step) * step_ns);
  const RigidBody<double> body(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal());
  auto state = make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  const adstar_Vector3& H = ground.momentum["free1"].momentum_inertial_n_m_s;
  EXPECT_EQ((Vec3<double>{H.x, H.y, H.z}), state.H_I.value()) << "to the last bit";
  for (std::uint64_t i = 0; i < last.step; ++i) {
    CoadjointRk4::step(body, state, 1e-9 * static_cast<double>(step_ns), NoTorque{});
  }
  const adstar_Quaternion& q = last.attitude_body_to_inertial;
  EXPECT_EQ((Quat<double>{q.w, q.x, q.y, q.z}), state.q_IB) << "after " << last.step << " steps";
}

}  // namespace adstar::testing
