#include "service/samples/topic_rows.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "service/dds/cdr.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/propagation/side_rows.hpp"
#include "service/samples/joiner.hpp"
#include "service/samples/recorded_topics.hpp"

namespace adstar::samples {
namespace {

using report::Fields;

std::array<double, 3> of(const adstar_Vector3& v) { return {v.x, v.y, v.z}; }
std::array<double, 4> of(const adstar_Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

/// Those of three numbers that mean something.
void three(Fields& row, const double (&numbers)[3], std::uint32_t known) {
  for (std::uint32_t i = 0; i < 3; ++i) {
    row.number(numbers[i], i < known);
  }
}

void write(Fields& row, const adstar_AttitudeState& s) {
  row.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  row.numbers(of(s.attitude_body_to_inertial)).numbers(of(s.angular_velocity_body_rad_s));
  row.count(s.flags);
}

void write(Fields& row, const adstar_MomentumState& s) {
  row.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  row.numbers(of(s.momentum_inertial_n_m_s)).numbers(of(s.momentum_body_n_m_s));
  row.number(s.rotational_energy_j).number(s.work_j).number(s.energy_residual_j);
  row.numbers(of(s.momentum_residual_inertial_n_m_s)).count(s.flags);
}

void write(Fields& row, const adstar_WheelState& s) {
  row.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.wheel)).count(s.step);
  row.seconds(s.time_ns).number(s.speed_rad_s).number(s.momentum_n_m_s);
  row.number(s.motor_torque_n_m).number(s.friction_torque_n_m);
}

void write(Fields& row, const adstar_PointingState& s) {
  const bool orbit = (s.flags & adstar_POINTING_ORBIT) != 0;
  const bool target = (s.flags & adstar_POINTING_TARGET) != 0;
  row.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  row.numbers(of(s.position_inertial_m), orbit).numbers(of(s.velocity_inertial_m_s), orbit);
  row.numbers(of(s.attitude_body_to_orbital), orbit);
  row.numbers(of(s.angular_velocity_to_orbital_body_rad_s), orbit);
  row.numbers(of(s.pointing_error_body_rad), target);
}

void write(Fields& row, const adstar_BodyState& s) {
  row.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.body)).count(s.step);
  row.seconds(s.time_ns).numbers(of(s.attitude_body_to_inertial));
  row.numbers(of(s.angular_velocity_body_rad_s)).numbers(of(s.position_inertial_m));
  row.numbers(of(s.velocity_inertial_m_s));
}

void write(Fields& row, const adstar_JointState& s) {
  row.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.joint)).count(s.step);
  row.seconds(s.time_ns);
  three(row, s.coordinate, s.coordinates);
  three(row, s.rate, s.coordinates);
  three(row, s.motor_torque, s.coordinates);
  row.numbers(of(s.force_inertial_n)).numbers(of(s.couple_inertial_n_m));
}

void write(Fields& row, const adstar_CommandStatus& s) {
  const auto verdict = dds::verdict_of(s);
  const auto reason = dds::reason_of(s);
  row.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.actuator));
  row.word(fmt::format("{:016x}{:016x}", s.commander.high, s.commander.low));
  row.count(s.sequence_number).count(s.step).seconds(s.time_ns);
  row.word(verdict ? dds::verdict_text(*verdict) : "unknown");
  row.word(reason ? dds::reason_name(*reason) : "unknown");
  row.seconds(s.effective_start_time_ns).seconds(s.effective_end_time_ns);
  row.numbers(of(s.torque_applied_n_m)).number(s.speed_applied_rad_s);
  row.numbers(of(s.dipole_applied_a_m2));
}

void write(Fields& row, const report::Row& motion) {
  row.word(motion.spacecraft).count(motion.step).seconds(motion.time_ns);
  for (const auto& value : motion.values) {
    row.number(value.value_or(0), value.has_value());
  }
}

using Reader = std::uint64_t (*)(const bag::Recording&, const Wants&, const HearsRow&);

/// A row a sample.
template <class T>
std::uint64_t read_samples(const bag::Recording& recording, const Wants& wants,
                           const HearsRow& hears) {
  Fields row;
  return for_each_sample<T>(recording, [&](const T& sample, std::int64_t /*received_ns*/) {
    if (wants(dds::text_of(sample.spacecraft))) {
      row.clear();
      write(row, sample);
      hears(row);
    }
  });
}

/// A row a member, whoever is wanted: the roster has their names.
std::uint64_t read_fleet(const bag::Recording& recording, const Wants& /*wants*/,
                         const HearsRow& hears) {
  Fields row;
  const auto read = [&](const adstar_FleetState& s, std::int64_t /*received_ns*/) {
    for (std::uint32_t i = 0; i < s.members._length; ++i) {
      const adstar_FleetMember& m = s.members._buffer[i];
      row.clear();
      row.word(dds::text_of(s.service)).count(s.first_spacecraft + i).count(s.step);
      row.seconds(s.time_ns).numbers(of(m.attitude_body_to_inertial));
      row.numbers(of(m.angular_velocity_body_rad_s)).numbers(of(m.momentum_inertial_n_m_s));
      row.number(m.rotational_energy_j).number(m.energy_residual_j).count(m.flags);
      hears(row);
    }
  };
  return for_each_sample<adstar_FleetState>(recording, read);
}

/// Attitude and momentum of a step in one row.
std::uint64_t read_motion(const bag::Recording& recording, const Wants& wants,
                          const HearsRow& hears) {
  constexpr std::uint64_t kRound = 1024;
  Joiner joiner(Joiner::Patience::both_topics);
  Fields row;
  const auto tell = [&](const std::vector<report::Row>& rows) {
    for (const report::Row& motion : rows) {
      row.clear();
      write(row, motion);
      hears(row);
    }
  };
  const auto add = [&](const auto& sample) {
    if (wants(dds::text_of(sample.spacecraft))) {
      joiner.add(sample);
    }
  };
  std::uint64_t unreadable = 0, messages = 0;
  const std::string attitude = recorded_name<adstar_AttitudeState>();
  recording.for_each(
      {attitude, recorded_name<adstar_MomentumState>()}, [&](const bag::Message& message) {
        const bool read = message.topic == attitude
                              ? dds::with_sample<adstar_AttitudeState>(message.payload, add)
                              : dds::with_sample<adstar_MomentumState>(message.payload, add);
        unreadable += read ? 0 : 1;
        if (++messages % kRound == 0) {
          tell(joiner.end_round());
        }
      });
  tell(joiner.rest());
  return unreadable;
}

constexpr const char* kAttitudeColumns =
    "q_w,q_x,q_y,q_z,omega_body_x_rad_s,omega_body_y_rad_s,omega_body_z_rad_s";
constexpr const char* kMomentumColumns =
    "momentum_inertial_x_n_m_s,momentum_inertial_y_n_m_s,momentum_inertial_z_n_m_s";

struct Tables {
  std::vector<Table> tables;
  std::vector<Reader> readers;  ///< of each

  void add(std::string name, std::string columns, Reader reader) {
    tables.push_back({std::move(name), std::move(columns)});
    readers.push_back(reader);
  }
};

Tables make_tables() {
  Tables all;
  all.add("motion", report::motion_columns(), read_motion);
  all.add("attitude_state", fmt::format("spacecraft,step,time_s,{},flags", kAttitudeColumns),
          read_samples<adstar_AttitudeState>);
  all.add("momentum_state",
          fmt::format("spacecraft,step,time_s,{},momentum_body_x_n_m_s,momentum_body_y_n_m_s,"
                      "momentum_body_z_n_m_s,rotational_energy_j,work_j,energy_residual_j,"
                      "momentum_residual_inertial_x_n_m_s,momentum_residual_inertial_y_n_m_s,"
                      "momentum_residual_inertial_z_n_m_s,flags",
                      kMomentumColumns),
          read_samples<adstar_MomentumState>);
  all.add("wheel_state", propagation::kWheelColumns, read_samples<adstar_WheelState>);
  all.add("pointing_state", propagation::kPointingColumns, read_samples<adstar_PointingState>);
  all.add("body_state", propagation::kBodyColumns, read_samples<adstar_BodyState>);
  all.add("joint_state", propagation::kJointColumns, read_samples<adstar_JointState>);
  all.add("fleet_state",
          fmt::format("service,spacecraft_index,step,time_s,{},{},rotational_energy_j,"
                      "energy_residual_j,flags",
                      kAttitudeColumns, kMomentumColumns),
          read_fleet);
  all.add("command_status",
          "spacecraft,actuator,commander,sequence_number,step,time_s,verdict,reason,"
          "effective_start_s,effective_end_s,torque_x_n_m,torque_y_n_m,torque_z_n_m,speed_rad_s,"
          "dipole_body_x_a_m2,dipole_body_y_a_m2,dipole_body_z_a_m2",
          read_samples<adstar_CommandStatus>);
  return all;
}

const Tables& all_tables() {
  static const Tables all = make_tables();
  return all;
}

}  // namespace

const std::vector<Table>& tables() { return all_tables().tables; }

std::uint64_t for_each_row(const bag::Recording& recording, std::string_view table,
                           const Wants& wants, const HearsRow& hears) {
  const Tables& all = all_tables();
  for (std::size_t i = 0; i < all.tables.size(); ++i) {
    if (all.tables[i].name == table) {
      return all.readers[i](recording, wants, hears);
    }
  }
  throw std::invalid_argument(fmt::format("there is no table '{}'", table));
}

}  // namespace adstar::samples
