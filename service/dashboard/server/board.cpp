#include "service/dashboard/server/board.hpp"

#include <algorithm>

#include "adstar/attitude.hpp"
#include "service/adstar/services.hpp"
#include "service/dds/convert.hpp"

namespace adstar::dashboard {
namespace {

using cli::printable;

// Whoever can write to the domain could otherwise fill our memory.
constexpr std::size_t kMostServices = 256;
constexpr std::size_t kMostSpacecraft = 1'100'000;
constexpr std::size_t kMostChunks = 10'000;

Vector vector_of(const adstar_Vector3& v) { return {v.x, v.y, v.z}; }

std::array<double, 4> quaternion_of(const adstar_Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

template <std::size_t N>
std::string name_in(const char (&text)[N]) {
  return printable(dds::text_of(text));
}

/// The entry of that name; null when it is new and there is no room.
template <class Map>
typename Map::mapped_type* entry(Map& map, const std::string& name, std::size_t most) {
  const auto found = map.find(name);
  if (found != map.end()) {
    return &found->second;
  }
  return map.size() < most ? &map[name] : nullptr;
}

bool same_answer(const adstar_CommandStatus& a, const adstar_CommandStatus& b) {
  return a.commander.high == b.commander.high && a.commander.low == b.commander.low &&
         a.sequence_number == b.sequence_number && a.verdict == b.verdict &&
         dds::text_of(a.service) == dds::text_of(b.service) &&
         dds::text_of(a.spacecraft) == dds::text_of(b.spacecraft) &&
         dds::text_of(a.actuator) == dds::text_of(b.actuator);
}

}  // namespace

void Board::learn(const adstar_AttitudeState& sample, Clock::time_point now) {
  if (Motion* motion = entry(own_, name_in(sample.spacecraft), kMostSpacecraft)) {
    motion->service = name_in(sample.service);
    motion->step = sample.step;
    motion->time_ns = sample.time_ns;
    motion->q_IB = quaternion_of(sample.attitude_body_to_inertial);
    motion->omega_B = vector_of(sample.angular_velocity_body_rad_s);
    motion->flags = sample.flags;
    motion->heard = now;
  }
}

void Board::learn(const adstar_MomentumState& sample, Clock::time_point now) {
  if (Motion* motion = entry(own_, name_in(sample.spacecraft), kMostSpacecraft)) {
    motion->service = name_in(sample.service);
    motion->step = sample.step;
    motion->time_ns = sample.time_ns;
    motion->H_I = vector_of(sample.momentum_inertial_n_m_s);
    motion->Pi_B = vector_of(sample.momentum_body_n_m_s);
    motion->momentum_residual_I = vector_of(sample.momentum_residual_inertial_n_m_s);
    motion->energy_j = sample.rotational_energy_j;
    motion->work_j = sample.work_j;
    motion->energy_residual_j = sample.energy_residual_j;
    motion->flags = sample.flags;
    motion->heard = now;
  }
}

void Board::learn(const adstar_FleetState& sample, Clock::time_point now) {
  auto* fleet = entry(fleets_, name_in(sample.service), kMostServices);
  if (fleet == nullptr || (fleet->size() >= kMostChunks && !fleet->contains(sample.chunk))) {
    return;
  }
  Chunk& chunk = (*fleet)[sample.chunk];
  chunk.first = sample.first_spacecraft;
  chunk.step = sample.step;
  chunk.time_ns = sample.time_ns;
  chunk.members.assign(sample.members._buffer, sample.members._buffer + sample.members._length);
  chunk.heard = now;
}

void Board::learn(const adstar_ServiceStatus& sample, Clock::time_point now) {
  if (ServiceRecord* service = entry(services_, name_in(sample.service), kMostServices)) {
    service->status = sample;
    service->heard = now;
    missed_.erase(name_in(sample.service));
  }
}

void Board::learn(const adstar_StepTiming& sample, Clock::time_point now) {
  const auto found = services_.find(name_in(sample.service));
  if (found != services_.end()) {
    found->second.timing = sample;
    found->second.heard = now;
  }
}

void Board::learn(const adstar_ServiceRoster& sample) {
  const std::string service = name_in(sample.service);
  Roster* roster = entry(rosters_, service, kMostServices);
  if (roster == nullptr) {
    return;
  }
  const std::pair instance(sample.instance_high, sample.instance_low);
  if (instances_[service] != instance) {  // another process under that name: another scene perhaps
    instances_[service] = instance;
    std::erase_if(places_, [&](const auto& place) { return place.second.first == service; });
    roster->clear();
  }
  for (std::uint32_t i = 0; i < sample.spacecraft._length; ++i) {
    const adstar_RosterEntry& listed = sample.spacecraft._buffer[i];
    const std::uint32_t index = sample.first_spacecraft + i;
    if (roster->size() >= kMostSpacecraft && !roster->contains(index)) {
      return;
    }
    Member& member = (*roster)[index];
    member.name = name_in(listed.name);
    member.actuators.clear();
    for (std::uint32_t a = 0; a < listed.actuators._length; ++a) {
      member.actuators.push_back(printable(listed.actuators._buffer[a]));
    }
    places_.insert_or_assign(member.name, std::pair(service, index));
  }
}

void Board::learn(const adstar_CommandStatus& sample) {
  const bool repeated = std::any_of(verdicts_.begin(), verdicts_.end(), [&](const auto& known) {
    return same_answer(known.status, sample);
  });
  if (repeated || static_cast<std::size_t>(sample.verdict) >= kVerdicts) {
    return;
  }
  verdicts_.push_back({++last_verdict_, sample});
  if (verdicts_.size() > kMostVerdicts) {
    verdicts_.pop_front();
  }
  const std::string service = name_in(sample.service);
  if (verdict_counts_.size() < kMostServices || verdict_counts_.contains(service)) {
    ++verdict_counts_[service].at(static_cast<std::size_t>(sample.verdict));
  }
}

void Board::forget_spacecraft(std::string_view name) {
  const auto found = own_.find(printable(name));
  if (found != own_.end()) {
    own_.erase(found);
  }
}

void Board::forget_fleet(std::string_view service, std::uint32_t chunk) {
  const auto found = fleets_.find(printable(service));
  if (found != fleets_.end()) {
    found->second.erase(chunk);
  }
}

void Board::forget_service(std::string_view name, Clock::time_point now) {
  const auto found = services_.find(printable(name));
  if (found == services_.end()) {
    return;
  }
  const auto& status = found->second.status;
  std::erase_if(missed_, [&](const auto& missed) { return now - missed.second >= kMissedFor; });
  if (!(status && status->state == adstar_SERVICE_STOPPED) && missed_.size() < kMostServices) {
    missed_.insert_or_assign(found->first, now);
  }
  services_.erase(found);
}

std::vector<std::string> Board::missed_services(Clock::time_point now) const {
  std::vector<std::string> names;
  for (const auto& [name, since] : missed_) {
    if (now - since < kMissedFor && !services_.contains(name)) {
      names.push_back(name);
    }
  }
  return names;
}

void Board::forget_roster(std::string_view name, std::uint64_t instance_high,
                          std::uint64_t instance_low) {
  const std::string service = printable(name);
  const auto known = instances_.find(service);
  if (known == instances_.end() || known->second != std::pair(instance_high, instance_low)) {
    return;
  }
  instances_.erase(known);
  rosters_.erase(service);
  std::erase_if(places_, [&](const auto& place) { return place.second.first == service; });
}

std::optional<Motion> Board::motion(std::string_view spacecraft) const {
  const auto own = own_.find(spacecraft);
  if (own != own_.end()) {
    return own->second;
  }
  const auto place = places_.find(spacecraft);
  return place == places_.end() ? std::nullopt
                                : motion_of(place->second.first, place->second.second, spacecraft);
}

std::optional<Motion> Board::motion_of(std::string_view service, std::uint32_t index,
                                       std::string_view name) const {
  const auto own = own_.find(name);
  if (own != own_.end()) {
    return own->second;
  }
  const auto fleet = fleets_.find(service);
  if (fleet == fleets_.end()) {
    return std::nullopt;
  }
  for (const auto& [number, chunk] : fleet->second) {
    if (index < chunk.first || index - chunk.first >= chunk.members.size()) {
      continue;
    }
    const adstar_FleetMember& member = chunk.members[index - chunk.first];
    Motion motion;
    motion.service = service;
    motion.step = chunk.step;
    motion.time_ns = chunk.time_ns;
    motion.q_IB = quaternion_of(member.attitude_body_to_inertial);
    motion.omega_B = vector_of(member.angular_velocity_body_rad_s);
    motion.H_I = vector_of(member.momentum_inertial_n_m_s);
    // Pi_B = R_IBᵀ H_I, as the daemon itself computes it.
    const auto& [w, x, y, z] = motion.q_IB;
    const Vec3<double> Pi_B = rotate_inverse(
        Quat<double>{w, x, y, z}, Vec3<double>{motion.H_I[0], motion.H_I[1], motion.H_I[2]});
    motion.Pi_B = {Pi_B.x, Pi_B.y, Pi_B.z};
    motion.energy_j = member.rotational_energy_j;
    motion.energy_residual_j = member.energy_residual_j;
    motion.flags = member.flags;
    motion.heard = chunk.heard;
    return motion;
  }
  return std::nullopt;
}

const Member* Board::member(std::string_view spacecraft) const {
  const auto place = places_.find(spacecraft);
  if (place == places_.end()) {
    return nullptr;
  }
  const auto roster = rosters_.find(place->second.first);
  if (roster == rosters_.end()) {
    return nullptr;
  }
  const auto found = roster->second.find(place->second.second);
  return found == roster->second.end() ? nullptr : &found->second;
}

std::string Board::first_spacecraft() const {
  if (!own_.empty()) {
    return own_.begin()->first;
  }
  for (const auto& [service, roster] : rosters_) {
    if (!roster.empty()) {
      return roster.begin()->second.name;
    }
  }
  return {};
}

}  // namespace adstar::dashboard
