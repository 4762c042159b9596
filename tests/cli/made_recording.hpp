#pragma once
// Recordings that the test makes up itself, sample by sample, without a bus.

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <dds/ddsi/ddsi_cdrstream.h>

#include "service/bag/rolling_writer.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/topics.hpp"
#include "tests/cli/client.hpp"

namespace adstar::testing {

/// As Cyclone puts it on the wire on this machine.
template <class T>
std::vector<std::byte> payload_of(const T& sample) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, 1);
  dds_stream_writeLE(&stream, reinterpret_cast<const char*>(&sample),
                     dds::topic_of<T>().descriptor->m_ops);
  std::vector<std::byte> payload(4 + stream.x.m_index);
  payload[1] = std::byte{1};
  std::memcpy(payload.data() + 4, stream.x.m_buffer, stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return payload;
}

/// 100 Hz: step n is at n·10 ms.
inline constexpr std::int64_t kStep_ns = 10'000'000;

inline adstar_AttitudeState attitude_at(std::uint64_t step, std::string_view spacecraft = "sat1") {
  adstar_AttitudeState sample{};
  dds::set_text(sample.spacecraft, spacecraft);
  dds::set_text(sample.service, "fly");
  sample.step = step;
  sample.time_ns = static_cast<std::int64_t>(step) * kStep_ns;
  sample.attitude_body_to_inertial = {1, 0, 0, 0};
  sample.angular_velocity_body_rad_s = {0, 0, static_cast<double>(step)};
  return sample;
}

inline adstar_MomentumState momentum_at(std::uint64_t step, std::string_view spacecraft = "sat1") {
  adstar_MomentumState sample{};
  dds::set_text(sample.spacecraft, spacecraft);
  dds::set_text(sample.service, "fly");
  sample.step = step;
  sample.time_ns = static_cast<std::int64_t>(step) * kStep_ns;
  sample.momentum_inertial_n_m_s = {0, 0, static_cast<double>(step)};
  return sample;
}

class MadeRecording {
 public:
  explicit MadeRecording(bag::Rolling rolling = {}) : rolling_(rolling) {}

  std::string directory() const { return (home_ / "bag").string(); }
  std::string out(const std::string& name) const { return (home_ / name).string(); }

  /// Received a millisecond after the one before, or when the test says.
  void add(const adstar_AttitudeState& sample) { add(0, sample); }
  void add(const adstar_MomentumState& sample) { add(1, sample); }
  void add(const adstar_FleetState& sample) { add(2, sample); }
  void add(const adstar_ServiceStatus& sample) { add(3, sample); }
  /// Attitude and momentum of the steps from first to last.
  void fly(std::uint64_t first, std::uint64_t last, std::string_view spacecraft = "sat1") {
    for (std::uint64_t step = first; step <= last; ++step) {
      add(attitude_at(step, spacecraft));
      add(momentum_at(step, spacecraft));
    }
  }
  void finish() { writer_.finish(); }

  std::int64_t now_ns = 1'700'000'000'000'000'000;

 private:
  template <class T>
  void add(std::size_t topic, const T& sample) {
    writer_.add(topic, now_ns += 1'000'000, payload_of(sample));
  }

  Scratch home_;
  bag::Rolling rolling_;
  bag::RollingWriter writer_{home_ / "bag",
                             {{"/adstar/attitude_state", "adstar/msg/AttitudeState", ""},
                              {"/adstar/momentum_state", "adstar/msg/MomentumState", ""},
                              {"/adstar/fleet_state", "adstar/msg/FleetState", ""},
                              {"/adstar/service_status", "adstar/msg/ServiceStatus", ""}},
                             rolling_};
};

}  // namespace adstar::testing
