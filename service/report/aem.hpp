#pragma once
// Attitude Ephemeris Message, version 2.0, in keyword = value notation: CCSDS 504.0-B-2 (January 2024), "Attitude Data
// Messages", section 4 (content and order), 6 (syntax), annex F (directions).
//
// Frame A is I, frame B the body. Annex F2.1: the quaternion "from A to B" turns the basis vectors of A into those of
// B, and X_B = M_BA X_A with M_BA(1,2) = 2 (Q1 Q2 + Q3 QC). The columns of R_IB are the basis vectors of B in I, and
// M_BA = R_IBᵀ: so (Q1, Q2, Q3, QC) = (x, y, z, w) of q_IB, nothing to turn round. Annex F4: the angular velocity is that of B
// relative to A; ANGVEL_FRAME says that its components are in B: omega_B.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "service/scene/time_scales.hpp"

namespace adstar::report {

struct AttitudePoint {
  std::int64_t time_ns = 0;    ///< simulation time
  std::array<double, 4> q_IB;  ///< w, x, y, z
  std::array<double, 3> omega_B_rad_s;
};

struct AemHeader {
  std::string creation_utc;  ///< "2026-01-01T00:00:00"
  std::string originator = "ADSTAR";
  std::string object_name;
  std::string object_id = "UNKNOWN";
  std::string inertial_frame = "GCRF";
  std::string body_frame = "SC_BODY_1";
  scene::TaiDate epoch;  ///< of simulation time 0
};

/// Appends a message to `text`, piece by piece: the caller may empty it in between. Throws std::invalid_argument for what
/// the standard has no words for.
class AemWriter {
 public:
  /// Header and metadata, for attitudes from first_ns to last_ns. Throws when a date is beyond the calendar.
  AemWriter(AemHeader header, std::int64_t first_ns, std::int64_t last_ns, std::string& text);

  /// In increasing time, none twice (4.2.4.8.1), finite (6.8.5).
  void add(const AttitudePoint& point);

  /// The message is whole: its last attitude was that of last_ns.
  void end();

 private:
  AemHeader header_;
  std::int64_t first_ns_, last_ns_;
  std::optional<std::int64_t> newest_ns_;
  std::string& text_;
};

/// 6.8.4.2: sixteen significant digits, "-1.234567890123456E-01".
std::string aem_number(double value);

/// 6.8.6: all uppercase or all lowercase; and no character that the notation does not have.
std::string aem_name(const std::string& text);

}  // namespace adstar::report
