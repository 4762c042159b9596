#include "service/dds/ros2.hpp"

#include <array>
#include <limits>

namespace adstar::ros2 {
namespace {

// Cyclone does not write to what it sends.
char* lent(const char* text) noexcept { return const_cast<char*>(text); }

std_msgs_msg_dds__Header_ inertial_header(const runtime::TelemetryRecord& record) noexcept {
  return {to_time(record.time_ns), lent(kInertialFrame)};
}

geometry_msgs_msg_dds__Quaternion_ quaternion(const std::array<double, 4>& wxyz) noexcept {
  return {wxyz[1], wxyz[2], wxyz[3], wxyz[0]};
}

}  // namespace

std::string body_frame(std::string_view spacecraft) { return std::string(spacecraft) + "/body"; }

Time to_time(std::int64_t time_ns) noexcept {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (time_ns / kSecond > kMost) {
    return {static_cast<std::int32_t>(kMost), kSecond - 1};
  }
  return {static_cast<std::int32_t>(time_ns / kSecond),
          static_cast<std::uint32_t>(time_ns % kSecond)};
}

QuaternionStamped to_attitude(const runtime::TelemetryRecord& record) noexcept {
  return {inertial_header(record), quaternion(record.q_IB)};
}

Vector3Stamped to_angular_momentum(const runtime::TelemetryRecord& record) noexcept {
  const auto& H = record.H_I_n_m_s;
  return {inertial_header(record), {H[0], H[1], H[2]}};
}

TransformStamped to_transform(const runtime::TelemetryRecord& record,
                              const std::string& body_frame) noexcept {
  return {inertial_header(record), lent(body_frame.c_str()), {{}, quaternion(record.q_IB)}};
}

}  // namespace adstar::ros2
