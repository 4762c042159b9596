#include "service/runtime/gate.hpp"

#include <algorithm>
#include <numeric>

#include "adstar/torques/thruster.hpp"
#include "service/runtime/judge.hpp"

namespace adstar::runtime {
namespace {

std::size_t count_actuators(const std::vector<scene::Spacecraft>& spacecraft) {
  return std::accumulate(spacecraft.begin(), spacecraft.end(), std::size_t{0},
                         [](std::size_t sum, const auto& s) { return sum + s.actuators.size(); });
}

}  // namespace

CommandGate::CommandGate(const std::vector<scene::Spacecraft>& spacecraft, VerdictRing& verdicts,
                         std::size_t pool)
    : verdicts_(verdicts), memory_(count_actuators(spacecraft)), pool_(pool) {
  for (std::uint32_t i = 0; i < spacecraft.size(); ++i) {
    first_actuator_.push_back(static_cast<std::uint32_t>(actuators_.size()));
    const auto& declared = spacecraft[i].actuators;
    for (std::uint32_t j = 0; j < declared.size(); ++j) {
      const scene::Actuator& each = declared[j];
      actuators_.push_back({i, j, static_cast<std::uint32_t>(each.index), each.kind, each.limit,
                            each.max_speed_rad_s, each.least_on_ns, kNone, false});
    }
  }
  first_actuator_.push_back(static_cast<std::uint32_t>(actuators_.size()));
  busy_.reserve(actuators_.size());
  for (std::uint32_t entry = static_cast<std::uint32_t>(pool_.size()); entry-- > 0;) {
    pool_[entry].next = free_;
    free_ = entry;
  }
}

const CommandGate::Actuator* CommandGate::find(const CommandRecord& command,
                                               std::uint32_t& number) const noexcept {
  if (command.spacecraft >= first_actuator_.size() - 1) {
    return nullptr;
  }
  number = first_actuator_[command.spacecraft] + command.actuator;
  if (command.actuator >= actuators_.size() || number >= first_actuator_[command.spacecraft + 1]) {
    return nullptr;
  }
  return &actuators_[number];
}

/// Zero of what it does not have: no authority.
Vec3<double> CommandGate::limit_of(const Actuator& actuator, Quantity quantity) noexcept {
  using scene::ActuatorKind;
  switch (quantity) {
    case Quantity::torque:
      return actuator.kind == ActuatorKind::torque || actuator.kind == ActuatorKind::wheel ||
                     actuator.kind == ActuatorKind::joint
                 ? actuator.limit
                 : Vec3<double>{};
    case Quantity::wheel_speed:
      return {actuator.max_speed_rad_s, 0, 0};
    case Quantity::dipole:
      return actuator.kind == ActuatorKind::magnetorquer ? actuator.limit : Vec3<double>{};
    case Quantity::thrust:
      return actuator.kind == ActuatorKind::thruster ? actuator.limit : Vec3<double>{};
  }
  return {};
}

VerdictRecord CommandGate::answer_to(const CommandRecord& command,
                                     const Beat& beat) const noexcept {
  VerdictRecord verdict;
  verdict.commander = command.commander;
  verdict.sequence = command.sequence;
  verdict.spacecraft = command.spacecraft;
  verdict.actuator = command.actuator;
  verdict.priority = command.priority;
  verdict.quantity = command.quantity;
  verdict.step = beat.step;
  verdict.time_ns = beat.t_ns;
  return verdict;
}

void CommandGate::put(const VerdictRecord& verdict) noexcept {
  if (!verdicts_.push(verdict)) {
    ++counters_.verdicts_lost;
  }
}

/// A final verdict: said, remembered, counted.
void CommandGate::conclude(Stream& stream, const VerdictRecord& verdict) noexcept {
  if (verdict.verdict == Verdict::refused || verdict.verdict == Verdict::expired ||
      verdict.verdict == Verdict::outranked) {
    ++counters_.refused;
  }
  stream.remember(verdict);
  put(verdict);
}

/// Answers a sequence number that was heard before as it was answered then; false when that is
/// forgotten.
bool CommandGate::repeat(const Stream& stream, const Actuator& actuator,
                         std::uint64_t sequence) noexcept {
  for (std::uint32_t entry = actuator.head; entry != kNone; entry = pool_[entry].next) {
    const Live& live = pool_[entry];
    if (!live.begun && live.stream == memory_.index_of(stream) &&
        live.verdict.sequence == sequence) {
      VerdictRecord verdict = live.verdict;
      verdict.verdict = Verdict::accepted;
      put(verdict);
      return true;
    }
  }
  const VerdictRecord* const known = stream.recall(sequence);
  if (known != nullptr) {
    put(*known);
  }
  return known != nullptr;
}

void CommandGate::refuse(const CommandRecord& command, const Beat& beat, Reason reason) noexcept {
  ++counters_.received;
  ++counters_.refused;
  std::uint32_t number = 0;
  if (find(command, number) != nullptr) {
    VerdictRecord verdict = answer_to(command, beat);
    verdict.reason = reason;
    put(verdict);
  }
}

void CommandGate::receive(const CommandRecord& command, const Beat& beat) noexcept {
  ++counters_.received;
  VerdictRecord verdict = answer_to(command, beat);
  std::uint32_t number = 0;
  if (find(command, number) == nullptr) {
    // The bridge resolves names to indices; one out of range is the bridge's fault and nobody's
    // command.
    ++counters_.refused;
    return;
  }
  Actuator& actuator = actuators_[number];
  const Stream* const known = memory_.find(command.commander, number);
  if (command.sequence <= (known == nullptr ? 0 : known->last_sequence)) {
    if (known == nullptr || !repeat(*known, actuator, command.sequence)) {
      ++counters_.refused;
      verdict.reason = Reason::old_sequence;
      put(verdict);
    }
    return;
  }
  // From here on the gate changes: not before that is written down.
  if (journal_ != nullptr) {
    if (!journal_->has_room()) {
      ++counters_.refused;
      verdict.reason = Reason::not_recorded;
      put(verdict);
      return;
    }
    journal_->write(JournalKind::command, beat.step, 0, command);
  }
  Stream* const stream = memory_.find_or_make(command.commander, number, ++heard_);
  if (stream == nullptr) {
    ++counters_.refused;
    verdict.reason = Reason::capacity;
    put(verdict);
    return;
  }
  stream->last_sequence = command.sequence;

  const Judgement judgement = judge(command, limit_of(actuator, command.quantity), beat.t_ns);
  verdict.verdict = judgement.verdict;
  verdict.reason = judgement.reason;
  verdict.start_ns = judgement.start_ns;
  verdict.end_ns = judgement.end_ns;
  verdict.value = judgement.value;
  if (verdict.verdict == Verdict::refused || verdict.verdict == Verdict::expired) {
    conclude(*stream, verdict);
    return;
  }
  verdict.end_ns = off_at({verdict.start_ns, verdict.end_ns}, actuator.least_on_ns);
  for (std::uint32_t entry = actuator.head; entry != kNone; entry = pool_[entry].next) {
    const VerdictRecord& other = pool_[entry].verdict;
    // What has ended stays listed until begin_step; it holds nothing.
    if (other.priority > command.priority && other.end_ns > beat.t_ns) {
      verdict.verdict = Verdict::outranked;
      conclude(*stream, verdict);
      return;
    }
  }
  const bool waits = verdict.start_ns >= beat.t_ns + beat.h_ns;
  verdict.reason = make_room(actuator, command.priority, verdict.start_ns, waits);
  if (verdict.reason != Reason::none) {
    verdict.verdict = Verdict::refused;
    conclude(*stream, verdict);
    return;
  }
  displace(actuator, command.priority, verdict.start_ns, beat);
  const std::uint32_t entry = free_;
  free_ = pool_[entry].next;
  pool_[entry] = {verdict, memory_.index_of(*stream), kNone, false};
  ++stream->live;
  insert(actuator, entry);
  if (!actuator.busy) {
    actuator.busy = true;
    busy_.push_back(number);
  }
  // Standing changes what is said, never what is decided: a recorded run does not know of it.
  if (waits || beat.standing) {
    verdict.verdict = Verdict::accepted;
    put(verdict);
  }
}

/// Whether it gives way wholly to a newer command of that rank and start; else it is cut there.
bool CommandGate::displaced(const Live& live, std::int32_t priority,
                            std::int64_t start_ns) noexcept {
  const bool below = live.verdict.priority < priority;
  return live.verdict.start_ns >= start_ns || (below && !live.begun);
}

/// Whether a command of that rank and start finds a place, before anything is changed.
Reason CommandGate::make_room(const Actuator& actuator, std::int32_t priority,
                              std::int64_t start_ns, bool waits) const noexcept {
  std::size_t waiting = waits ? 1 : 0;
  bool has_place = free_ != kNone;
  for (std::uint32_t entry = actuator.head; entry != kNone; entry = pool_[entry].next) {
    const bool stays = !displaced(pool_[entry], priority, start_ns);
    waiting += stays && !pool_[entry].begun ? 1 : 0;
    has_place = has_place || !stays;
  }
  if (!has_place) {
    return Reason::capacity;
  }
  return waiting > kMaxWaiting ? Reason::schedule_full : Reason::none;
}

/// The newest of the highest rank overrides from its own start: what began before is cut there,
/// what would begin after is superseded, and what waits below its rank is outranked.
void CommandGate::displace(Actuator& actuator, std::int32_t priority, std::int64_t start_ns,
                           const Beat& beat) noexcept {
  std::uint32_t* link = &actuator.head;
  while (*link != kNone) {
    const std::uint32_t entry = *link;
    Live& live = pool_[entry];
    if (!displaced(live, priority, start_ns)) {
      live.verdict.end_ns = std::min(live.verdict.end_ns, start_ns);
      link = &live.next;
      continue;
    }
    if (!live.begun) {
      VerdictRecord verdict = live.verdict;
      verdict.verdict = live.verdict.priority < priority ? Verdict::outranked : Verdict::superseded;
      verdict.step = beat.step;
      verdict.time_ns = beat.t_ns;
      conclude(memory_.at(live.stream), verdict);
    }
    *link = live.next;
    release(entry);
  }
}

void CommandGate::insert(Actuator& actuator, std::uint32_t entry) noexcept {
  std::uint32_t* link = &actuator.head;
  while (*link != kNone && pool_[*link].verdict.start_ns < pool_[entry].verdict.start_ns) {
    link = &pool_[*link].next;
  }
  pool_[entry].next = *link;
  *link = entry;
}

void CommandGate::release(std::uint32_t entry) noexcept {
  --memory_.at(pool_[entry].stream).live;
  pool_[entry].next = free_;
  free_ = entry;
}

namespace {

void set(TorqueInterval<double>& interval, const VerdictRecord& v) noexcept {
  interval = {v.start_ns, v.end_ns, {v.value[0], v.value[1], v.value[2]}};
}
void set(DipoleInterval<double>& interval, const VerdictRecord& v) noexcept {
  interval = {v.start_ns, v.end_ns, {v.value[0], v.value[1], v.value[2]}};
}
void set(OnInterval& interval, const VerdictRecord& v) noexcept {
  interval = {v.start_ns, v.end_ns};
}
void set(MotorInterval<double>& interval, const VerdictRecord& v) noexcept {
  interval = {v.start_ns, v.end_ns, {v.quantity == Quantity::wheel_speed, v.value[0]}};
}

}  // namespace

void CommandGate::begin(const Beat& beat, Fleet* fleet) noexcept {
  for (std::size_t i = 0; i < busy_.size();) {
    Actuator& actuator = actuators_[busy_[i]];
    if (fleet == nullptr) {
      Commanded<double> nobodys;
      advance(actuator, beat, nobodys);
    } else {
      Vehicle& vehicle = fleet->vehicles()[actuator.spacecraft];
      switch (actuator.kind) {
        case scene::ActuatorKind::torque:
          advance(actuator, beat, std::get<Commanded<double>>(vehicle.torques[actuator.moves]));
          break;
        case scene::ActuatorKind::wheel:
          advance(actuator, beat, vehicle.wheels->spinning[actuator.moves].motor);
          break;
        case scene::ActuatorKind::magnetorquer:
          advance(actuator, beat, std::get<Magnetorquer<double>>(vehicle.torques[actuator.moves]));
          break;
        case scene::ActuatorKind::thruster:
          advance(actuator, beat, std::get<Thruster<double>>(vehicle.torques[actuator.moves]));
          break;
        case scene::ActuatorKind::joint:
          advance(actuator, beat, vehicle.linked->motors[actuator.moves].window);
          break;
      }
    }
    if (actuator.head == kNone) {
      actuator.busy = false;
      busy_[i] = busy_.back();
      busy_.pop_back();
    } else {
      ++i;
    }
  }
}

void CommandGate::reset(const Beat& beat) noexcept {
  for (const std::uint32_t number : busy_) {
    Actuator& actuator = actuators_[number];
    while (actuator.head != kNone) {
      const std::uint32_t entry = actuator.head;
      const Live& live = pool_[entry];
      if (!live.begun) {
        VerdictRecord verdict = live.verdict;
        verdict.verdict = Verdict::superseded;
        verdict.step = beat.step;
        verdict.time_ns = beat.t_ns;
        conclude(memory_.at(live.stream), verdict);
      }
      actuator.head = live.next;
      release(entry);
    }
    actuator.busy = false;
  }
  busy_.clear();
}

/// `window`: a Commanded, or the Motor of a wheel.
template <class Window>
void CommandGate::advance(Actuator& actuator, const Beat& beat, Window& window) noexcept {
  window.intervals = 0;
  std::uint32_t* link = &actuator.head;
  while (*link != kNone) {
    const std::uint32_t entry = *link;
    Live& live = pool_[entry];
    VerdictRecord& v = live.verdict;
    if (v.start_ns >= beat.t_ns + beat.h_ns || window.intervals == Window::kWindow) {
      break;  // the list ascends; what the window cannot hold begins, late, at the next beat
    }
    if (!live.begun) {
      v.step = beat.step;
      v.time_ns = beat.t_ns;
      if (v.start_ns < beat.t_ns) {
        v.start_ns = beat.t_ns;
        v.verdict = v.verdict == Verdict::clamped ? Verdict::clamped : Verdict::applied_late;
      }
      if (v.end_ns <= v.start_ns) {
        v.verdict = Verdict::expired;
      }
      live.begun = true;
      conclude(memory_.at(live.stream), v);
    }
    if (v.end_ns <= beat.t_ns) {
      *link = live.next;
      release(entry);
      continue;
    }
    set(window.window[window.intervals++], v);
    link = &live.next;
  }
}

}  // namespace adstar::runtime
