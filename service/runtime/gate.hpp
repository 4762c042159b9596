#pragma once
// The command gate: judges every command on the tick's side, arbitrates between commanders, keeps
// each actuator's schedule, and answers. The rules are in service/pages/commands.md, "The life of a
// command".
//
// A function of the scene and the stream (command, beat) alone. All memory is made at construction;
// nothing here waits, allocates or throws afterwards.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "service/runtime/command_memory.hpp"
#include "service/runtime/fleet.hpp"
#include "service/runtime/journal.hpp"
#include "service/runtime/records.hpp"
#include "service/runtime/ring.hpp"
#include "service/scene/scene.hpp"

namespace adstar::runtime {

using VerdictRing = SpscRing<VerdictRecord, 8192>;

/// The step that a beat is about to compute.
struct Beat {
  std::uint64_t step = 0;
  std::int64_t t_ns = 0;  ///< where it begins, simulation time
  std::int64_t h_ns = 0;
  bool standing = false;  ///< the clock stands before it: what is to begin with it waits for that
};

struct GateCounters {
  std::uint64_t received = 0;
  std::uint64_t refused = 0;  ///< refused, expired or outranked
  std::uint64_t verdicts_lost =
      0;  ///< the verdict ring was full; the commander repeats and gets it
};

class CommandGate {
 public:
  static constexpr std::size_t kMaxWaiting = 64;  ///< per actuator

  /// `pool`: commands in force or waiting, over all actuators.
  CommandGate(const std::vector<scene::Spacecraft>& spacecraft, VerdictRing& verdicts,
              std::size_t pool = 16384);

  /// Judges one command. Answers at once, except what begins in this beat: begin_step answers that.
  void receive(const CommandRecord& command, const Beat& beat) noexcept;

  /// Answers without judging: `reason` holds for everybody.
  void refuse(const CommandRecord& command, const Beat& beat, Reason reason) noexcept;

  /// Ends, begins and answers what this beat's step reaches, and hands the torques to the vehicles.
  void begin_step(const Beat& beat, Fleet& fleet) noexcept { begin(beat, &fleet); }

  /// The same where nobody flies: the gate alone is carried on.
  void begin_step(const Beat& beat) noexcept { begin(beat, nullptr); }

  /// Nothing is in force and nothing waits: begin_step has nothing to do.
  bool idle() const noexcept { return busy_.empty(); }

  /// Every command that changes the gate is written there first; what finds no place there is refused
  /// (not_recorded).
  void record_in(JournalWriter* journal) noexcept { journal_ = journal; }

  /// All that later judgements depend on, and back into a gate of the same scene. load() gives false, and
  /// the gate is to be thrown away, when `words` cannot have come from save().
  std::vector<std::uint64_t> save() const;
  bool load(std::span<const std::uint64_t> words);

  /// The clock is set back: what waits is superseded, what is in force ends.
  void reset(const Beat& beat) noexcept;

  const GateCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  /// A command in force or waiting, in its actuator's list: ascending, disjoint.
  struct Live {
    VerdictRecord verdict;  ///< what it becomes when it begins, with its interval and torque
    std::uint32_t stream = 0;
    std::uint32_t next = kNone;
    bool begun = false;
  };

  struct Actuator {
    std::uint32_t spacecraft = 0;
    std::uint32_t index = 0;  ///< within its spacecraft
    std::uint32_t moves = 0;  ///< within Vehicle::torques, or its wheels
    scene::ActuatorKind kind = scene::ActuatorKind::torque;
    Vec3<double> limit;
    double max_speed_rad_s = 0;    ///< of a wheel
    std::int64_t least_on_ns = 0;  ///< of a thruster
    std::uint32_t head = kNone;
    bool busy = false;  ///< listed in busy_
  };

  const Actuator* find(const CommandRecord& command, std::uint32_t& number) const noexcept;
  static Vec3<double> limit_of(const Actuator& actuator, Quantity quantity) noexcept;
  VerdictRecord answer_to(const CommandRecord& command, const Beat& beat) const noexcept;
  void put(const VerdictRecord& verdict) noexcept;
  void conclude(Stream& stream, const VerdictRecord& verdict) noexcept;
  bool repeat(const Stream& stream, const Actuator& actuator, std::uint64_t sequence) noexcept;
  static bool displaced(const Live& live, std::int32_t priority, std::int64_t start_ns) noexcept;
  Reason make_room(const Actuator& actuator, std::int32_t priority, std::int64_t start_ns,
                   bool waits) const noexcept;
  void displace(Actuator& actuator, std::int32_t priority, std::int64_t start_ns,
                const Beat& beat) noexcept;
  void insert(Actuator& actuator, std::uint32_t entry) noexcept;
  void release(std::uint32_t entry) noexcept;
  void begin(const Beat& beat, Fleet* fleet) noexcept;
  template <class Window>
  void advance(Actuator& actuator, const Beat& beat, Window& window) noexcept;

  VerdictRing& verdicts_;
  JournalWriter* journal_ = nullptr;
  GateCounters counters_;
  std::uint64_t heard_ = 0;  ///< commands with a sequence number not heard before
  std::vector<Actuator> actuators_;
  std::vector<std::uint32_t> first_actuator_;  ///< of each spacecraft; one more entry at the end
  CommandMemory memory_;
  std::vector<Live> pool_;
  std::uint32_t free_ = kNone;       ///< chain of unused pool entries
  std::vector<std::uint32_t> busy_;  ///< actuators with something live, reserved to their number
};

}  // namespace adstar::runtime
