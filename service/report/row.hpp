#pragma once
// One line about one spacecraft at one step: the columns that `propagate` and `monitor` share.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace adstar::report {

/// The columns after spacecraft, step and time_s.
inline constexpr std::array<std::string_view, 15> kColumns{"q_w",
                                                           "q_x",
                                                           "q_y",
                                                           "q_z",
                                                           "omega_body_x_rad_s",
                                                           "omega_body_y_rad_s",
                                                           "omega_body_z_rad_s",
                                                           "momentum_inertial_x_n_m_s",
                                                           "momentum_inertial_y_n_m_s",
                                                           "momentum_inertial_z_n_m_s",
                                                           "momentum_body_x_n_m_s",
                                                           "momentum_body_y_n_m_s",
                                                           "momentum_body_z_n_m_s",
                                                           "rotational_energy_j",
                                                           "work_j"};
inline constexpr std::size_t kAttitude = 0;          ///< q_w, and three more
inline constexpr std::size_t kAngularVelocity = 4;   ///< three
inline constexpr std::size_t kMomentumInertial = 7;  ///< three
inline constexpr std::size_t kMomentumBody = 10;     ///< three
inline constexpr std::size_t kEnergy = 13;
inline constexpr std::size_t kWork = 14;

struct Row {
  std::string spacecraft;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<std::optional<double>, kColumns.size()> values;  ///< nothing: not known
  std::uint32_t flags = 0;  ///< FLAG_... of idl/telemetry.idl; no column
};

/// All of them, between commas.
std::string motion_columns();

void append_csv_header(std::string& text);
/// Unknown values are empty fields.
void append_csv(std::string& text, const Row& row);
/// One object on one line; unknown and non-finite values are null.
void append_json(std::string& text, const Row& row);

}  // namespace adstar::report
