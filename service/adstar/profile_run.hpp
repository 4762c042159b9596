#pragma once
// A profile on its way: one command a row, in order, a limited number of them waiting at the
// service.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "service/adstar/commander.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/torque_profile.hpp"

namespace adstar::cli {

struct ProfileRequest {
  std::optional<std::int64_t> start_ns;  ///< simulation time; none: as soon as possible
  std::int32_t priority = 0;
  bool wait = false;  ///< for the final verdict of the last rows too
  std::int64_t timeout_ns = 0;
};

class ProfileRun {
 public:
  ProfileRun(Commander& commander, std::vector<ProfileRow> rows, const ProfileRequest& request)
      : commander_(commander), rows_(std::move(rows)), request_(request) {}

  /// Prints a line for every row and a summary; returns the worst exit code.
  ExitCode run();

 private:
  enum class State { claiming, sending, over };

  void claim();
  void look_at_claim();
  void begin_after_claim();
  void give_next();
  Order asked(std::size_t row) const;
  void look_at_rows();
  void say_waiting();
  void report(std::uint64_t sequence, const Answer& answer);
  bool silent(std::uint64_t sequence) const;
  void summarise() const;

  Commander& commander_;
  std::vector<ProfileRow> rows_;
  ProfileRequest request_;
  State state_ = State::claiming;
  std::uint64_t claim_ = 0;
  std::int64_t base_ns_ = 0;
  std::size_t next_row_ = 0;
  bool said_waiting_ = false;
  std::map<std::uint64_t, std::size_t> on_their_way_;  ///< sequence → row
  std::map<runtime::Verdict, std::size_t> verdicts_;
  ExitCode worst_ = kDone;
};

}  // namespace adstar::cli
