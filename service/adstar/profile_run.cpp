#include "service/adstar/profile_run.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "service/adstar/stop_signal.hpp"
#include "service/adstar/verdict_sentence.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

/// Of the 64 that a schedule holds, so that others find room.
constexpr std::size_t kMostOnTheirWay = 32;

/// Between the answer that tells the simulation time and the first row: a round trip and then some.
constexpr std::int64_t kLead_ns = 250'000'000;

}  // namespace

ExitCode ProfileRun::run() {
  if (request_.start_ns) {
    base_ns_ = *request_.start_ns;
    state_ = State::sending;
  } else {
    claim();
  }
  while (state_ != State::over) {
    commander_.work(50ms);
    if (stop_requested()) {
      fmt::print(stderr, "adstar torque: interrupted; {}\n",
                 next_row_ == 0 ? "no row was sent" : "rows that were accepted still run");
      worst_ = std::max(worst_, kFailed);
      break;
    }
    if (state_ == State::claiming) {
      look_at_claim();
    } else {
      look_at_rows();
      give_next();
    }
  }
  summarise();
  return worst_;
}

// Zero torque from now on takes the actuator, and its answer tells the time: the first row begins
// where it ends. While the clock stands that time is known too, though the claim waits for a step.
void ProfileRun::claim() {
  Order order;
  order.priority = request_.priority;
  order.duration_ns = kLead_ns;
  claim_ = commander_.give(order);
}

void ProfileRun::look_at_claim() {
  const auto& dispatch = commander_.at(claim_);
  if (dispatch.ended() && exit_code_of(*dispatch.answer) != kDone) {
    worst_ = exit_code_of(*dispatch.answer);
    fmt::print("profile not begun: {}\n", verdict_sentence(*dispatch.answer, {}));
    state_ = State::over;
  } else if (dispatch.ended() || commander_.waits(claim_)) {
    begin_after_claim();
  } else if (silent(claim_)) {
    worst_ = kNoAnswer;
    state_ = State::over;
  }
}

void ProfileRun::begin_after_claim() {
  base_ns_ = commander_.at(claim_).answer->start_ns + kLead_ns;
  commander_.forget(claim_);
  fmt::print("profile begins at {} s\n", report::seconds_text(base_ns_));
  std::fflush(stdout);
  state_ = State::sending;
  give_next();
}

// One unanswered row at a time: a later sequence number that arrived first would make the service
// refuse the earlier one for good.
void ProfileRun::give_next() {
  const bool unanswered =
      std::any_of(on_their_way_.begin(), on_their_way_.end(),
                  [&](const auto& row) { return !commander_.at(row.first).answer; });
  if (state_ == State::over || unanswered) {
    return;
  }
  if (on_their_way_.size() >= kMostOnTheirWay) {
    say_waiting();
  } else if (next_row_ < rows_.size()) {
    on_their_way_.emplace(commander_.give(asked(next_row_)), next_row_);
    ++next_row_;
  } else if (on_their_way_.empty() || !request_.wait) {
    state_ = State::over;
  } else {
    say_waiting();
  }
}

// Where the clock stands this lasts until somebody lets it go on.
void ProfileRun::say_waiting() {
  if (!said_waiting_) {
    said_waiting_ = true;
    fmt::print(stderr, "adstar torque: {} rows are accepted and wait for their start{}\n",
               on_their_way_.size(),
               next_row_ < rows_.size() ? "; the next ones are sent as those begin" : "");
  }
}

Order ProfileRun::asked(std::size_t row) const {
  Order order;
  order.priority = request_.priority;
  order.start_ns = base_ns_ + rows_[row].start_ns;
  order.end_ns = base_ns_ + rows_[row].end_ns;
  order.torque_n_m = rows_[row].torque_n_m;
  return order;
}

void ProfileRun::look_at_rows() {
  for (auto row = on_their_way_.begin(); row != on_their_way_.end() && state_ != State::over;) {
    const auto& dispatch = commander_.at(row->first);
    if (dispatch.ended()) {
      report(row->first, *dispatch.answer);
      // What this row met, the rows after it would meet too.
      state_ = dispatch.answer->verdict == runtime::Verdict::refused ? State::over : state_;
      commander_.forget(row->first);
      row = on_their_way_.erase(row);
    } else {
      if (silent(row->first)) {
        worst_ = kNoAnswer;
        state_ = State::over;
      }
      ++row;
    }
  }
}

void ProfileRun::report(std::uint64_t sequence, const Answer& answer) {
  const std::size_t row = on_their_way_.at(sequence);
  fmt::print("row {}: {}\n", row + 1, verdict_sentence(answer, asked(row)));
  std::fflush(stdout);
  ++verdicts_[answer.verdict];
  worst_ = std::max(worst_, exit_code_of(answer));
}

bool ProfileRun::silent(std::uint64_t sequence) const {
  return commander_.silent(sequence, std::chrono::nanoseconds(request_.timeout_ns));
}

void ProfileRun::summarise() const {
  auto verdicts = verdicts_;
  std::size_t known = 0;
  for (const auto& [sequence, row] : on_their_way_) {
    if (commander_.at(sequence).answer) {
      fmt::print("row {}: {}\n", row + 1,
                 verdict_sentence(*commander_.at(sequence).answer, asked(row)));
      ++verdicts[runtime::Verdict::accepted];
    }
  }
  std::string text;
  for (const auto& [verdict, count] : verdicts) {
    known += count;
    text += fmt::format(", {} {}", count, dds::verdict_text(verdict));
  }
  if (known < rows_.size()) {
    text += fmt::format(", {} without an answer or not sent", rows_.size() - known);
  }
  fmt::print("profile of {} rows: {}\n", rows_.size(), text.substr(2));
}

}  // namespace adstar::cli
