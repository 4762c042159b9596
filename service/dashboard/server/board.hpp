#pragma once
// The newest of everything that the dashboard shows: filled by one thread off the bus, read by those
// that serve pages. Frames: I inertial, B body; q_IB maps body to inertial, w first; SI units.
//
// Not synchronised: whoever shares it between threads locks around it (bus.hpp does).

#include <array>
#include <chrono>
#include <command.h>
#include <cstdint>
#include <deque>
#include <health.h>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <telemetry.h>
#include <utility>
#include <vector>

namespace adstar::dashboard {

using Clock = std::chrono::steady_clock;
using Vector = std::array<double, 3>;

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr Vector kUnknownVector{kUnknown, kUnknown, kUnknown};

/// One spacecraft, from topics of its own or out of a fleet's; what was not heard is NaN.
struct Motion {
  std::string service;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;  ///< simulation time
  std::array<double, 4> q_IB{kUnknown, kUnknown, kUnknown, kUnknown};
  Vector omega_B = kUnknownVector;
  Vector H_I = kUnknownVector;
  Vector Pi_B = kUnknownVector;
  Vector momentum_residual_I = kUnknownVector;
  double energy_j = kUnknown;
  double work_j = kUnknown;
  double energy_residual_j = kUnknown;
  std::uint32_t flags = 0;
  Clock::time_point heard;
};

struct ServiceRecord {
  std::optional<adstar_ServiceStatus> status;
  std::optional<adstar_StepTiming> timing;
  Clock::time_point heard;
};

inline constexpr std::size_t kVerdicts = 8;

struct VerdictEntry {
  std::uint64_t number = 0;  ///< rises from 1, in the order of hearing
  adstar_CommandStatus status;
};

/// A spacecraft as its roster lists it.
struct Member {
  std::string name;
  std::vector<std::string> actuators;
};

class Board {
 public:
  static constexpr std::size_t kMostVerdicts = 200;
  static constexpr std::chrono::minutes kMissedFor{10};

  void learn(const adstar_AttitudeState& sample, Clock::time_point now);
  void learn(const adstar_MomentumState& sample, Clock::time_point now);
  void learn(const adstar_FleetState& sample, Clock::time_point now);
  void learn(const adstar_ServiceStatus& sample, Clock::time_point now);
  /// Of those alone whose status is there: a late one brings nobody back who has gone.
  void learn(const adstar_StepTiming& sample, Clock::time_point now);
  void learn(const adstar_ServiceRoster& sample);
  /// A repeated answer counts once.
  void learn(const adstar_CommandStatus& sample);

  /// Its last writer has gone.
  void forget_spacecraft(std::string_view name);
  void forget_fleet(std::string_view service, std::uint32_t chunk);
  /// It is missed from then on, unless its last word was that it ends.
  void forget_service(std::string_view name, Clock::time_point now);
  /// Of that process; one that has taken its name since stays.
  void forget_roster(std::string_view service, std::uint64_t instance_high,
                     std::uint64_t instance_low);

  /// Nothing when that spacecraft was not heard.
  std::optional<Motion> motion(std::string_view spacecraft) const;
  const Member* member(std::string_view spacecraft) const;
  /// Of those that speak for themselves, else of a fleet; empty: none.
  std::string first_spacecraft() const;

  /// visit(name, const Motion&) in the order of services and scenes.
  template <class Visit>
  void each_motion(Visit&& visit) const {
    for (const auto& [service, members] : rosters_) {
      for (const auto& [index, member] : members) {
        if (const auto found = motion_of(service, index, member.name)) {
          visit(member.name, *found);
        }
      }
    }
    for (const auto& [name, found] : own_) {
      if (member(name) == nullptr) {
        visit(name, found);
      }
    }
  }

  const std::map<std::string, ServiceRecord, std::less<>>& services() const { return services_; }
  /// Those that went without a word within the last `kMissedFor`, and have not come back.
  std::vector<std::string> missed_services(Clock::time_point now) const;
  const std::map<std::string, Motion, std::less<>>& own_topics() const { return own_; }
  const std::deque<VerdictEntry>& verdicts() const { return verdicts_; }
  /// By service, then by the value of adstar_Verdict.
  const std::map<std::string, std::array<std::uint64_t, kVerdicts>>& verdict_counts() const {
    return verdict_counts_;
  }

 private:
  struct Chunk {
    std::uint32_t first = 0;
    std::uint64_t step = 0;
    std::int64_t time_ns = 0;
    std::vector<adstar_FleetMember> members;
    Clock::time_point heard;
  };
  using Roster = std::map<std::uint32_t, Member>;  ///< by index in the scene

  std::optional<Motion> motion_of(std::string_view service, std::uint32_t index,
                                  std::string_view name) const;

  std::map<std::string, ServiceRecord, std::less<>> services_;
  std::map<std::string, Clock::time_point, std::less<>> missed_;  ///< since when
  std::map<std::string, Motion, std::less<>> own_;                ///< by name of the spacecraft
  std::map<std::string, std::map<std::uint32_t, Chunk>, std::less<>> fleets_;
  std::map<std::string, Roster, std::less<>> rosters_;
  std::map<std::string, std::pair<std::string, std::uint32_t>, std::less<>> places_;
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>, std::less<>> instances_;
  std::deque<VerdictEntry> verdicts_;
  std::uint64_t last_verdict_ = 0;
  std::map<std::string, std::array<std::uint64_t, kVerdicts>> verdict_counts_;
};

}  // namespace adstar::dashboard
