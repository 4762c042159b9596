#include "service/adstar/topic_rows.hpp"

#include <fmt/format.h>

#include "service/adstar/services.hpp"
#include "service/adstar/side_rows.hpp"
#include "service/dds/cdr.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

using Wants = std::function<bool(std::string_view)>;

/// A field after another.
class Line {
 public:
  explicit Line(std::string& text) : text_(text) {}
  ~Line() { text_ += '\n'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  Line& word(std::string_view value) {
    next();
    for (const char c : value) {
      text_ += c > ' ' && c != ',' && c != '"' && c != '\x7f' ? c : '?';
    }
    return *this;
  }
  Line& count(std::uint64_t value) {
    next();
    text_ += std::to_string(value);
    return *this;
  }
  Line& seconds(std::int64_t ns) {
    next();
    report::append_seconds(text_, ns);
    return *this;
  }
  Line& number(double value, bool known = true) {
    next();
    if (known) {
      report::append_number(text_, value);
    }
    return *this;
  }
  Line& vector(const adstar_Vector3& v, bool known = true) {
    return number(v.x, known).number(v.y, known).number(v.z, known);
  }
  Line& quaternion(const adstar_Quaternion& q, bool known = true) {
    return number(q.w, known).number(q.x, known).number(q.y, known).number(q.z, known);
  }
  Line& three(const double (&v)[3], std::uint32_t known) {
    return number(v[0], known > 0).number(v[1], known > 1).number(v[2], known > 2);
  }

 private:
  void next() {
    if (begun_) {
      text_ += ',';
    }
    begun_ = true;
  }
  std::string& text_;
  bool begun_ = false;
};

void write(Line& line, const adstar_AttitudeState& s) {
  line.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  line.quaternion(s.attitude_body_to_inertial).vector(s.angular_velocity_body_rad_s).count(s.flags);
}

void write(Line& line, const adstar_MomentumState& s) {
  line.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  line.vector(s.momentum_inertial_n_m_s).vector(s.momentum_body_n_m_s);
  line.number(s.rotational_energy_j).number(s.work_j).number(s.energy_residual_j);
  line.vector(s.momentum_residual_inertial_n_m_s).count(s.flags);
}

void write(Line& line, const adstar_WheelState& s) {
  line.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.wheel)).count(s.step);
  line.seconds(s.time_ns).number(s.speed_rad_s).number(s.momentum_n_m_s);
  line.number(s.motor_torque_n_m).number(s.friction_torque_n_m);
}

void write(Line& line, const adstar_PointingState& s) {
  const bool orbit = (s.flags & adstar_POINTING_ORBIT) != 0;
  const bool target = (s.flags & adstar_POINTING_TARGET) != 0;
  line.word(dds::text_of(s.spacecraft)).count(s.step).seconds(s.time_ns);
  line.vector(s.position_inertial_m, orbit).vector(s.velocity_inertial_m_s, orbit);
  line.quaternion(s.attitude_body_to_orbital, orbit);
  line.vector(s.angular_velocity_to_orbital_body_rad_s, orbit);
  line.vector(s.pointing_error_body_rad, target);
}

void write(Line& line, const adstar_BodyState& s) {
  line.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.body)).count(s.step).seconds(s.time_ns);
  line.quaternion(s.attitude_body_to_inertial).vector(s.angular_velocity_body_rad_s);
  line.vector(s.position_inertial_m).vector(s.velocity_inertial_m_s);
}

void write(Line& line, const adstar_JointState& s) {
  line.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.joint)).count(s.step);
  line.seconds(s.time_ns).three(s.coordinate, s.coordinates).three(s.rate, s.coordinates);
  line.three(s.motor_torque, s.coordinates);
  line.vector(s.force_inertial_n).vector(s.couple_inertial_n_m);
}

void write(Line& line, const adstar_CommandStatus& s) {
  const auto verdict = dds::verdict_of(s);
  const auto reason = dds::reason_of(s);
  line.word(dds::text_of(s.spacecraft)).word(dds::text_of(s.actuator));
  line.word(fmt::format("{:016x}{:016x}", s.commander.high, s.commander.low));
  line.count(s.sequence_number).count(s.step).seconds(s.time_ns);
  line.word(verdict ? dds::verdict_text(*verdict) : "unknown");
  line.word(reason ? dds::reason_name(*reason) : "unknown");
  line.seconds(s.effective_start_time_ns).seconds(s.effective_end_time_ns);
  line.vector(s.torque_applied_n_m).number(s.speed_applied_rad_s).vector(s.dipole_applied_a_m2);
}

/// A line a sample.
template <class T>
bool append_sample(std::string& text, std::span<const std::byte> payload, const Wants& wants) {
  return dds::with_sample<T>(payload, [&](const T& sample) {
    if (wants(dds::text_of(sample.spacecraft))) {
      Line line(text);
      write(line, sample);
    }
  });
}

/// A line a member, whoever is wanted: the roster has their names.
bool append_fleet(std::string& text, std::span<const std::byte> payload, const Wants& /*wants*/) {
  return dds::with_sample<adstar_FleetState>(payload, [&](const adstar_FleetState& s) {
    for (std::uint32_t i = 0; i < s.members._length; ++i) {
      const adstar_FleetMember& m = s.members._buffer[i];
      Line line(text);
      line.word(dds::text_of(s.service)).count(s.first_spacecraft + i).count(s.step);
      line.seconds(s.time_ns).quaternion(m.attitude_body_to_inertial);
      line.vector(m.angular_velocity_body_rad_s).vector(m.momentum_inertial_n_m_s);
      line.number(m.rotational_energy_j).number(m.energy_residual_j).count(m.flags);
    }
  });
}

constexpr const char* kAttitudeColumns =
    "q_w,q_x,q_y,q_z,omega_body_x_rad_s,omega_body_y_rad_s,omega_body_z_rad_s";
constexpr const char* kMomentumColumns =
    "momentum_inertial_x_n_m_s,momentum_inertial_y_n_m_s,momentum_inertial_z_n_m_s";

std::vector<TopicTable> make_tables() {
  return {
      {"attitude_state", fmt::format("spacecraft,step,time_s,{},flags\n", kAttitudeColumns),
       &append_sample<adstar_AttitudeState>},
      {"momentum_state",
       fmt::format("spacecraft,step,time_s,{},momentum_body_x_n_m_s,momentum_body_y_n_m_s,"
                   "momentum_body_z_n_m_s,rotational_energy_j,work_j,energy_residual_j,"
                   "momentum_residual_inertial_x_n_m_s,momentum_residual_inertial_y_n_m_s,"
                   "momentum_residual_inertial_z_n_m_s,flags\n",
                   kMomentumColumns),
       &append_sample<adstar_MomentumState>},
      {"wheel_state", kWheelColumns, &append_sample<adstar_WheelState>},
      {"pointing_state", kPointingColumns, &append_sample<adstar_PointingState>},
      {"body_state", kBodyColumns, &append_sample<adstar_BodyState>},
      {"joint_state", kJointColumns, &append_sample<adstar_JointState>},
      {"fleet_state",
       fmt::format("service,spacecraft_index,step,time_s,{},{},rotational_energy_j,"
                   "energy_residual_j,flags\n",
                   kAttitudeColumns, kMomentumColumns),
       &append_fleet},
      {"command_status",
       "spacecraft,actuator,commander,sequence_number,step,time_s,verdict,reason,effective_start_s,"
       "effective_end_s,torque_x_n_m,torque_y_n_m,torque_z_n_m,speed_rad_s,dipole_body_x_a_m2,"
       "dipole_body_y_a_m2,dipole_body_z_a_m2\n",
       &append_sample<adstar_CommandStatus>},
  };
}

}  // namespace

const std::vector<TopicTable>& topic_tables() {
  static const std::vector<TopicTable> tables = make_tables();
  return tables;
}

}  // namespace adstar::cli
