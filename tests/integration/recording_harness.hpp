#pragma once
// What tests of recordings share: a scene that speaks on every topic, a subscriber that keeps all, the client.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "service/bag/sqlite.hpp"
#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar::testing {

namespace fs = std::filesystem;

/// One spacecraft with a wheel, an orbit and an actuator, one of linked bodies: every kind of telemetry.
inline std::string full_scene(const dds::ParticipantOptions& where) {
  return fmt::format(R"([simulation]
step = "10ms"
pace = "clock"
epoch_utc = 2026-01-01T00:00:00Z
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[spacecraft.orbit]
semi_major_axis_m = 6.9e6
inclination_rad = 1.2
[[spacecraft.wheel]]
name = "wheel1"
axis_body = [0, 0, 1]
spin_inertia_kg_m2 = 0.02
speed_rad_s = 20
viscous_friction_n_m_s_rad = 1e-3
[[spacecraft.torque]]
model = "commanded"
name = "body"
frame = "body"
max_torque_n_m = [1.0, 1.0, 1.0]
[[spacecraft]]
name = "sat2"
mass_kg = 100.0
inertia_body_kg_m2 = [9.0, 11.0, 16.0]
angular_velocity_body_rad_s = [0.0, 0.1, 0.0]
[[spacecraft.body]]
name = "panel"
mass_kg = 5.0
inertia_body_kg_m2 = [0.5, 0.2, 0.6]
[[spacecraft.joint]]
name = "hinge"
kind = "revolute"
from = "hub"
to = "panel"
point_from_body_m = [0.0, 0.5, 0.0]
point_to_body_m = [0.0, -1.0, 0.0]
axis_body = [1.0, 0.0, 0.0]
[budget]
admission = "warn"
[telemetry]
attitude_hz = 50
momentum_hz = 50
pointing_hz = 10
wheel_hz = 10
linked_hz = 10
[service]
name = "fly"
[dds]
domain = {}
partition = "{}"
interface = "{}"
)",
                     where.domain, where.partition, where.interface);
}

inline std::vector<std::string> at_place(std::vector<std::string> words,
                                         const dds::ParticipantOptions& where) {
  words.insert(words.begin(), ADSTAR);
  words.insert(words.end(), {"--domain", std::to_string(where.domain), "--partition",
                             where.partition, "--interface", where.interface});
  return words;
}

inline Outcome client(std::vector<std::string> words) {
  words.insert(words.begin(), ADSTAR);
  return run(words);
}

inline std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Keeps every sample of sat1, not only the newest.
class Listener {
 public:
  explicit Listener(const dds::ParticipantOptions& where)
      : participant_(where),
        commands_(participant_),
        attitude_(participant_),
        momentum_(participant_) {}

  void listen() {
    while (attitude_.take([&](const adstar_AttitudeState& s, const dds_sample_info_t&) {
      if (dds::text_of(s.spacecraft) == "sat1") {
        attitude[s.step] = s;
      }
    }) > 0) {}
    while (momentum_.take([&](const adstar_MomentumState& s, const dds_sample_info_t&) {
      if (dds::text_of(s.spacecraft) == "sat1") {
        momentum[s.step] = s;
      }
    }) > 0) {}
  }
  /// Until so many more of each.
  bool hear(std::size_t more) {
    const std::size_t a = attitude.size() + more, m = momentum.size() + more;
    return eventually([&] {
      listen();
      return attitude.size() >= a && momentum.size() >= m;
    });
  }

  /// Half a second of torque on sat1, once so many readers of commands are there: daemon and recorder.
  bool push(std::uint32_t readers) {
    if (!eventually([&] { return commands_.matched() >= readers; })) {
      return false;
    }
    adstar_TorqueCommand c{};
    dds::set_text(c.spacecraft, "sat1");
    dds::set_text(c.actuator, "body");
    c.commander = {0x1234, static_cast<std::uint64_t>(getpid())};
    c.sequence_number = 1;
    c.start_time_ns = runtime::kStartAtNextBeat;
    c.duration_ns = 500'000'000;
    c.torque_n_m = {0, 0, 0.1};
    return commands_.write(c);
  }

  std::map<std::uint64_t, adstar_AttitudeState> attitude;
  std::map<std::uint64_t, adstar_MomentumState> momentum;

 private:
  dds::Participant participant_;
  dds::Writer<adstar_TorqueCommand> commands_;
  dds::Reader<adstar_AttitudeState> attitude_;
  dds::Reader<adstar_MomentumState> momentum_;
};

inline bool has_begun(const Process& recorder) {
  return eventually([&] { return recorder.err().find("Ctrl-C ends it") != std::string::npos; });
}

inline std::map<std::string, std::int64_t> counts_in(const fs::path& file) {
  const bag::Database database(file, bag::Database::Mode::open);
  auto rows = database.prepare(
      "SELECT name, COUNT(*) FROM topics JOIN messages ON topic_id = topics.id GROUP BY name");
  std::map<std::string, std::int64_t> counts;
  while (rows.step()) {
    counts[rows.text(0)] = rows.number(1);
  }
  return counts;
}

}  // namespace adstar::testing
