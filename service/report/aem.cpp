#include "service/report/aem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::report {
namespace {

std::string when(const AemHeader& header, std::int64_t time_ns) {
  const auto text = scene::utc_text(header.epoch, time_ns);
  if (!text) {
    throw std::invalid_argument(fmt::format(
        "{} s after the epoch is beyond the calendar; give another epoch", seconds_text(time_ns)));
  }
  return *text;
}

void require_finite(const AttitudePoint& point) {
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::all_of(point.q_IB.begin(), point.q_IB.end(), finite) ||
      !std::all_of(point.omega_B_rad_s.begin(), point.omega_B_rad_s.end(), finite)) {
    throw std::invalid_argument(fmt::format(
        "the attitude at {} s is not finite, and an AEM knows no such number; export csv instead",
        seconds_text(point.time_ns)));
  }
}

/// Table 4-4, QUATERNION/ANGVEL: EPOCH Q1 Q2 Q3 QC ANGVEL_X ANGVEL_Y ANGVEL_Z; 4.2.4.6: deg/s.
void append_line(std::string& text, const AemHeader& header, const AttitudePoint& point) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const auto& [w, x, y, z] = point.q_IB;
  text += when(header, point.time_ns);
  for (const double q : {x, y, z, w}) {
    text += ' ' + aem_number(q);
  }
  for (const double rate : point.omega_B_rad_s) {
    text += ' ' + aem_number(rate * kDegrees);
  }
  text += '\n';
}

}  // namespace

std::string aem_number(double value) {
  constexpr int kDecimals = 15;
  return fmt::format("{:.{}E}", value == 0 ? 0.0 : value, kDecimals);  // 6.8.5: there is no -0
}

std::string aem_name(const std::string& text) {
  std::string name = text;
  const bool lower =
      std::none_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  for (char& c : name) {
    if (c < ' ' || c > '~') {
      c = '?';
    } else if (!lower && c >= 'a' && c <= 'z') {
      c = static_cast<char>(c - 'a' + 'A');
    }
  }
  return name;
}

AemWriter::AemWriter(AemHeader header, std::int64_t first_ns, std::int64_t last_ns,
                     std::string& text)
    : header_(std::move(header)), first_ns_(first_ns), last_ns_(last_ns), text_(text) {
  // Tables 4-2 and 4-3, in their order.
  text_ += fmt::format(
      "CCSDS_AEM_VERS = 2.0\n"
      "CREATION_DATE = {}\n"
      "ORIGINATOR = {}\n"
      "\n"
      "META_START\n"
      "OBJECT_NAME = {}\n"
      "OBJECT_ID = {}\n"
      "REF_FRAME_A = {}\n"
      "REF_FRAME_B = {}\n"
      "TIME_SYSTEM = UTC\n"
      "START_TIME = {}\n"
      "STOP_TIME = {}\n"
      "ATTITUDE_TYPE = QUATERNION/ANGVEL\n"
      "ANGVEL_FRAME = {}\n"
      "META_STOP\n"
      "\n"
      "DATA_START\n",
      header_.creation_utc, aem_name(header_.originator), aem_name(header_.object_name),
      aem_name(header_.object_id), aem_name(header_.inertial_frame), header_.body_frame,
      when(header_, first_ns_), when(header_, last_ns_), header_.body_frame);
}

void AemWriter::add(const AttitudePoint& point) {
  if (newest_ns_ ? point.time_ns <= *newest_ns_ : point.time_ns != first_ns_) {
    throw std::invalid_argument(
        newest_ns_ ? fmt::format("time does not rise after {} s", seconds_text(*newest_ns_))
                   : fmt::format("the attitudes begin at {} s, and not at {} s",
                                 seconds_text(point.time_ns), seconds_text(first_ns_)));
  }
  require_finite(point);
  append_line(text_, header_, point);
  newest_ns_ = point.time_ns;
}

void AemWriter::end() {
  if (newest_ns_ != last_ns_) {
    throw std::invalid_argument(newest_ns_
                                    ? fmt::format("the attitudes end at {} s, and not at {} s",
                                                  seconds_text(*newest_ns_), seconds_text(last_ns_))
                                    : std::string("there is no attitude to write"));
  }
  text_ += "DATA_STOP\n";
}

}  // namespace adstar::report
