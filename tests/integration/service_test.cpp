// The whole service over real DDS: adstard, its bridge, and this process as commander and listener.

#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include "adstar/integrators/coadjoint.hpp"
#include "tests/integration/daemon_harness.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::paper_scene;
using testing::private_corner;

constexpr std::int64_t kMillisecond = 1'000'000;

Vec3<double> vector_of(const adstar_Vector3& v) { return {v.x, v.y, v.z}; }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Service, publishes_the_initial_state_and_keeps_a_free_bodys_momentum_to_the_last_bit) {
  const auto corner = private_corner();
  Daemon daemon(paper_scene(corner, {}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
  const auto first = ground.momentum["sat1"];
  EXPECT_EQ(first.momentum_inertial_n_m_s.x, 0.9144 * 0.45549);
  EXPECT_EQ(first.momentum_inertial_n_m_s.y, 1.098 * 0.82623);
  EXPECT_EQ(first.momentum_inertial_n_m_s.z, 1.66 * 0.03476);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > first.step + 100; }));
  const auto later = ground.momentum["sat1"];
  EXPECT_EQ(vector_of(later.momentum_inertial_n_m_s), vector_of(first.momentum_inertial_n_m_s));
  EXPECT_NE(vector_of(later.momentum_body_n_m_s), vector_of(first.momentum_body_n_m_s));
  EXPECT_EQ(later.time_ns, static_cast<std::int64_t>(later.step) * 10 * kMillisecond);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Service, delivers_the_impulse_of_an_inertial_pulse_at_any_phase_against_the_step) {
  const auto corner = private_corner();
  Daemon daemon(paper_scene(corner, {.rate = 4, .frame = "inertial"}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
  const std::int64_t step = 10 * kMillisecond;
  const std::int64_t offsets[] = {0, 1, 1'234'567, 5'000'000, 9'999'999};
  const std::int64_t lengths[] = {1, 3'000'000, 10'000'000, 123'456'789};
  int pulse = 0;
  for (const std::int64_t offset : offsets) {
    const std::int64_t length = lengths[pulse++ % 4];
    const auto before = ground.momentum["sat1"];
    auto command = ground.command("sat1", {0.3, -0.7, 0.11});
    // Far enough ahead to be waiting, in simulated time, when it arrives.
    command.start_time_ns = before.time_ns + 200 * step + offset;
    command.end_time_ns = command.start_time_ns + length;
    const auto answer = ground.send(command);
    ASSERT_TRUE(answer.has_value());
    const auto verdict = ground.final_answer(command.sequence_number);
    ASSERT_TRUE(verdict.has_value());
    ASSERT_EQ(verdict->verdict, adstar_VERDICT_APPLIED) << "too slow a machine? offset " << offset;
    EXPECT_EQ(verdict->step, static_cast<std::uint64_t>(command.start_time_ns / step));
    EXPECT_EQ(verdict->effective_start_time_ns, command.start_time_ns);
    EXPECT_EQ(verdict->effective_end_time_ns, command.end_time_ns);
    ASSERT_TRUE(ground.until(
        [&] { return ground.momentum["sat1"].time_ns >= command.end_time_ns + step; }));
    const auto after = ground.momentum["sat1"];
    const Vec3<double> impulse =
        (1e-9 * static_cast<double>(length)) * Vec3<double>{0.3, -0.7, 0.11};
    const Vec3<double> H_0 = vector_of(before.momentum_inertial_n_m_s);
    const Vec3<double> H_1 = vector_of(after.momentum_inertial_n_m_s);
    EXPECT_LE(norm((H_1 - H_0) - impulse), 1e-12 * std::max(norm(H_1), norm(impulse)))
        << "offset " << offset << " length " << length;
    EXPECT_NE(H_1, H_0);
  }
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

/// End state of the paper's body after a body-frame pulse, in 113 bits.
State<boost::multiprecision::cpp_bin_float_quad> pulse_reference(std::int64_t start_ns,
                                                                 std::int64_t end_ns,
                                                                 std::int64_t final_ns) {
  using Quad = boost::multiprecision::cpp_bin_float_quad;
  const Eigen::Matrix<Quad, 3, 3> J =
      Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal().toDenseMatrix().cast<Quad>();
  const RigidBody<Quad> body(J);
  auto state =
      make_state(Quat<Quad>{}, body.momentum({Quad(0.45549), Quad(0.82623), Quad(0.03476)}));
  const auto run = [&](std::int64_t from, std::int64_t to, double scale) {
    const std::int64_t steps = (to - from) / kMillisecond + 1;
    const Quad h = Quad(to - from) / Quad(1'000'000'000) / Quad(steps);
    const TorqueSample<Quad> tau{{Quad(0.3 * scale), Quad(-0.2 * scale), Quad(0.1 * scale)}, {}};
    for (std::int64_t i = 0; i < steps; ++i) {
      CoadjointRk4::step(body, state, h, body_torque([&](const Stage<Quad>&) { return tau; }));
    }
  };
  run(0, start_ns, 0);
  run(start_ns, end_ns, 1);
  run(end_ns, final_ns, 0);
  return state;
}

TEST(Service, agrees_with_a_113_bit_run_on_a_body_pulse_to_the_schemes_order) {
  const std::int64_t start = 4'003'700'001, end = 5'512'345'678, final = 8'000'000'000;
  const auto reference = pulse_reference(start, end, final);
  const Vec3<double> H_ref{static_cast<double>(reference.H_I.x.value),
                           static_cast<double>(reference.H_I.y.value),
                           static_cast<double>(reference.H_I.z.value)};
  const Quat<double> q_ref{
      static_cast<double>(reference.q_IB.w), static_cast<double>(reference.q_IB.x),
      static_cast<double>(reference.q_IB.y), static_cast<double>(reference.q_IB.z)};
  double momentum_error[2];
  double attitude_error[2];
  const char* const steps[] = {"100ms", "50ms"};
  for (int i = 0; i < 2; ++i) {
    const auto corner = private_corner();
    Daemon daemon(
        paper_scene(corner, {.step = steps[i], .rate = 2, .duration = "8s", .telemetry_hz = 10}));
    GroundStation ground(corner);
    auto command = ground.command("sat1", {0.3, -0.2, 0.1});
    command.start_time_ns = start;
    command.end_time_ns = end;
    const auto answer = ground.send(command);
    ASSERT_TRUE(answer.has_value()) << daemon.log();
    ASSERT_EQ(answer->verdict, adstar_VERDICT_ACCEPTED) << "too slow a machine?";
    ASSERT_TRUE(ground.until([&] {
      return (ground.momentum["sat1"].flags & adstar_FLAG_FINAL) != 0 &&
             (ground.attitude["sat1"].flags & adstar_FLAG_FINAL) != 0;
    })) << daemon.log();
    EXPECT_EQ(daemon.exit_code(), 0) << daemon.log();
    EXPECT_EQ(ground.momentum["sat1"].time_ns, final);
    momentum_error[i] = norm(vector_of(ground.momentum["sat1"].momentum_inertial_n_m_s) - H_ref);
    const auto& q = ground.attitude["sat1"].attitude_body_to_inertial;
    attitude_error[i] = angle_between(Quat<double>{q.w, q.x, q.y, q.z}, q_ref);
  }
  EXPECT_NEAR(std::log2(momentum_error[0] / momentum_error[1]), 4, 0.5)
      << momentum_error[0] << " " << momentum_error[1];
  EXPECT_NEAR(std::log2(attitude_error[0] / attitude_error[1]), 4, 0.5)
      << attitude_error[0] << " " << attitude_error[1];
  EXPECT_LT(momentum_error[1], 1e-7);
}

TEST(Service, answers_every_bad_command_and_none_disturbs_the_state) {
  const auto corner = private_corner();
  Daemon daemon(paper_scene(corner, {}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
  const auto before = vector_of(ground.momentum["sat1"].momentum_inertial_n_m_s);
  const auto refused = [&](adstar_TorqueCommand command, adstar_RefusalReason reason) {
    const auto answer = ground.send(command);
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->verdict, adstar_VERDICT_REFUSED);
    EXPECT_EQ(answer->reason, reason);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  auto nan = ground.command("sat1", {0, std::nan(""), 0});
  nan.duration_ns = 1'000'000'000;
  refused(nan, adstar_REASON_NOT_FINITE);
  auto infinite = ground.command("sat1", {infinity, 0, 0});
  infinite.duration_ns = 1'000'000'000;
  refused(infinite, adstar_REASON_NOT_FINITE);
  auto backwards = ground.command("sat1", {0.1, 0, 0});
  backwards.start_time_ns = 3'600'000'000'000;
  backwards.end_time_ns = 3'500'000'000'000;
  refused(backwards, adstar_REASON_BAD_INTERVAL);
  auto nobody = ground.command("sat9", {0.1, 0, 0});
  nobody.duration_ns = 1'000'000'000;
  refused(nobody, adstar_REASON_UNKNOWN_SPACECRAFT);
  auto nothing = ground.command("sat1", {0.1, 0, 0});
  dds::set_text(nothing.actuator, "wheels");
  nothing.duration_ns = 1'000'000'000;
  refused(nothing, adstar_REASON_UNKNOWN_ACTUATOR);
  EXPECT_TRUE(ground.until([&] { return ground.status && ground.status->commands_refused == 5; }))
      << "of the tick and of the bridge: " << (ground.status ? ground.status->commands_refused : 0);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].time_ns > 50 * kMillisecond; }));
  auto past = ground.command("sat1", {0.1, 0, 0});
  past.start_time_ns = 1;
  past.end_time_ns = 10 * kMillisecond;
  const auto expired = ground.send(past);
  ASSERT_TRUE(expired.has_value());
  EXPECT_EQ(expired->verdict, adstar_VERDICT_EXPIRED);
  const std::uint64_t step = ground.momentum["sat1"].step;
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > step + 10; }));
  EXPECT_EQ(vector_of(ground.momentum["sat1"].momentum_inertial_n_m_s), before);

  auto strong = ground.command("sat1", {2, -4, 0});
  strong.duration_ns = 10 * kMillisecond;
  const auto clamped = ground.send(strong);
  ASSERT_TRUE(clamped.has_value());
  EXPECT_EQ(clamped->verdict, adstar_VERDICT_CLAMPED);
  EXPECT_EQ(clamped->torque_applied_n_m.x, 0.5);
  EXPECT_EQ(clamped->torque_applied_n_m.y, -1.0);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Service, gives_a_late_joiner_the_last_sample) {
  const auto corner = private_corner();
  Daemon daemon(paper_scene(corner, {.step = "100ms", .telemetry_hz = 0.01}));
  {
    GroundStation first(corner);
    ASSERT_TRUE(first.until([&] { return first.momentum.contains("sat1"); })) << daemon.log();
  }
  GroundStation late(corner);
  EXPECT_TRUE(
      late.until([&] { return late.momentum.contains("sat1") && late.attitude.contains("sat1"); }));
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Service, ends_cleanly_on_each_signal_with_the_last_state_published_and_the_bridge_gone) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto corner = private_corner();
    Daemon daemon(paper_scene(corner, {}));
    GroundStation ground(corner);
    ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
    const pid_t bridge = daemon.bridge();
    ASSERT_GT(bridge, 0);
    daemon.signal(signal);
    EXPECT_EQ(daemon.exit_code(), 0) << daemon.log();
    EXPECT_NE(kill(bridge, 0), 0) << "the bridge is still there";
    EXPECT_TRUE(ground.until([&] {
      return (ground.momentum["sat1"].flags & adstar_FLAG_FINAL) != 0 && ground.status &&
             ground.status->state == adstar_SERVICE_STOPPED;
    }));
    EXPECT_EQ(ground.status->step, ground.momentum["sat1"].step);
    EXPECT_TRUE(contains(daemon.log(), fmt::format("{} steps of 10ms", ground.status->step)))
        << daemon.log();
  }
}

TEST(Service, refuses_to_fly_a_spacecraft_that_another_daemon_flies) {
  const auto corner = private_corner();
  Daemon first(paper_scene(corner, {}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << first.log();
  Daemon second(paper_scene(corner, {}));
  EXPECT_EQ(second.exit_code(), 3);
  EXPECT_TRUE(contains(second.log(), "spacecraft 'sat1' is already flown by service 'fly'"))
      << second.log();
  EXPECT_EQ(first.stop(), 0) << first.log();
}

TEST(Service, names_a_missing_interface_and_exits_with_the_code_for_scenes) {
  const auto corner = private_corner("nosuch0");
  Daemon daemon(paper_scene(corner, {}));
  EXPECT_EQ(daemon.exit_code(), 2);
  EXPECT_TRUE(contains(daemon.log(), "no network interface 'nosuch0'; try one of: "))
      << daemon.log();
}

}  // namespace
}  // namespace adstar
