#include "service/samples/joiner.hpp"

#include <algorithm>

#include "adstar/attitude.hpp"
#include "service/dds/convert.hpp"

namespace adstar::samples {
namespace {

using report::kEnergy, report::kMomentumBody, report::kWork;
using report::Row, report::kAttitude, report::kAngularVelocity, report::kMomentumInertial;

/// Whoever can write to the domain could otherwise fill our memory with names.
constexpr std::size_t kMostTracks = 1'100'000;
constexpr std::size_t kMostLines = 4;
constexpr std::size_t kMostHalved = 32;

/// A line that got none of so many samples of its spacecraft gets no other half: they are no last words, but a new run.
constexpr std::uint64_t kLeftAfter = 64;

void put(Row& row, std::size_t first, const adstar_Vector3& v) {
  row.values[first] = v.x;
  row.values[first + 1] = v.y;
  row.values[first + 2] = v.z;
}

void put(Row& row, std::size_t first, const adstar_Quaternion& q) {
  row.values[first] = q.w;
  row.values[first + 1] = q.x;
  row.values[first + 2] = q.y;
  row.values[first + 3] = q.z;
}

}  // namespace

/// The row that this half belongs to; null when that was given out before.
template <class Sample>
Row* Joiner::place(const Sample& sample, Half half) {
  const std::string name(dds::text_of(sample.spacecraft));
  if (tracks_.size() >= kMostTracks && !tracks_.contains(name)) {
    return nullptr;
  }
  Track& track = tracks_[name];
  ++track.samples;
  leave_lines(track);
  Waiting* waiting = waiting_of(track, half, sample.step);
  if (waiting == nullptr) {
    return nullptr;
  }
  if (waiting->halves == 0) {
    waiting->came = track.samples;
  }
  waiting->halves |= half;
  waiting->row.spacecraft = name;
  waiting->row.step = sample.step;
  waiting->row.time_ns = sample.time_ns;
  waiting->row.flags |= sample.flags;
  return &waiting->row;
}

void Joiner::leave_lines(Track& track) {
  for (Line& line : track.lines) {
    if (track.samples - line.fed > kLeftAfter) {
      give_out(track, line, left_, true);
    }
  }
}

/// Null when the line that it continues has given that step out. A half whose row went without it is put aside, and
/// comes back when the other half is said anew.
Joiner::Waiting* Joiner::waiting_of(Track& track, Half half, std::uint64_t step) {
  Line* line = line_that_waits_for(track, half, step);
  if (line == nullptr) {
    Halved* const halved = halved_at(track, step);
    if (halved != nullptr && (halved->halves & half) == 0) {
      if (!halved->late) {
        halved->late = std::make_unique<Waiting>();
      }
      return halved->late.get();
    }
    line = line_of(track, half, step);
  }
  if (line == nullptr) {
    return nullptr;
  }
  std::uint64_t& newest = line->newest.try_emplace(half, step).first->second;
  newest = std::max(newest, step);
  line->fed = track.samples;
  Waiting& waiting = line->waiting[step];
  Halved* const halved = halved_at(track, step);
  if (halved != nullptr && halved->late) {
    if (waiting.halves == 0) {
      waiting = std::move(*halved->late);
    }
    halved->late.reset();
    halved->halves = kBoth;  // what comes next of that step is of the new run, and goes to its row
  }
  return &waiting;
}

Joiner::Halved* Joiner::halved_at(Track& track, std::uint64_t step) {
  const auto found = std::find_if(track.halved.begin(), track.halved.end(),
                                  [&](const Halved& row) { return row.step == step; });
  if (found == track.halved.end()) {
    return nullptr;
  }
  if (found->late && track.samples - found->late->came > kLeftAfter) {
    found->late.reset();
  }
  return &*found;
}

Joiner::Line* Joiner::line_that_waits_for(Track& track, Half half, std::uint64_t step) {
  const auto found = std::find_if(track.lines.begin(), track.lines.end(), [&](const Line& line) {
    const auto waiting = line.waiting.find(step);
    return waiting != line.waiting.end() && (waiting->second.halves & half) == 0;
  });
  return found == track.lines.end() ? nullptr : &*found;
}

/// Null when the line that it continues has given that step out.
Joiner::Line* Joiner::line_of(Track& track, Half half, std::uint64_t step) {
  bool is_late = false;
  for (Line& line : track.lines) {
    const auto newest = line.newest.find(half);
    if (step < (newest == line.newest.end() ? line.first : newest->second)) {
      continue;
    }
    if (!line.begun || step > line.done) {
      return &line;
    }
    is_late = true;
  }
  return is_late ? nullptr : &new_line(track, step);
}

Joiner::Line& Joiner::new_line(Track& track, std::uint64_t first) {
  if (track.lines.size() == kMostLines) {
    const auto longest_ago =
        std::min_element(track.lines.begin(), track.lines.end(),
                         [](const Line& a, const Line& b) { return a.fed < b.fed; });
    give_out(track, *longest_ago, left_, true);
    track.lines.erase(longest_ago);
  }
  track.lines.emplace_back().first = first;
  return track.lines.back();
}

void Joiner::add(const adstar_AttitudeState& sample) {
  if (Row* row = place(sample, kAttitudeHalf)) {
    put(*row, kAttitude, sample.attitude_body_to_inertial);
    put(*row, kAngularVelocity, sample.angular_velocity_body_rad_s);
  }
}

void Joiner::add(const adstar_MomentumState& sample) {
  if (Row* row = place(sample, kMomentumHalf)) {
    put(*row, kMomentumInertial, sample.momentum_inertial_n_m_s);
    put(*row, kMomentumBody, sample.momentum_body_n_m_s);
    row->values[kEnergy] = sample.rotational_energy_j;
    row->values[kWork] = sample.work_j;
  }
}

void Joiner::add(std::string_view spacecraft, const adstar_FleetState& fleet,
                 const adstar_FleetMember& member) {
  const auto [seen, fresh] = fleet_steps_.emplace(spacecraft, fleet.step);
  if (has_own_topics(spacecraft) || (!fresh && seen->second == fleet.step)) {
    return;
  }
  seen->second = fleet.step;
  Row row;
  row.spacecraft = spacecraft;
  row.step = fleet.step;
  row.time_ns = fleet.time_ns;
  row.flags = member.flags;
  const adstar_Quaternion& q = member.attitude_body_to_inertial;
  const adstar_Vector3& H = member.momentum_inertial_n_m_s;
  put(row, kAttitude, q);
  put(row, kAngularVelocity, member.angular_velocity_body_rad_s);
  put(row, kMomentumInertial, H);
  // Pi_B = R_IBᵀ H_I, as the daemon itself computes it.
  const Vec3<double> Pi_B =
      rotate_inverse(Quat<double>{q.w, q.x, q.y, q.z}, Vec3<double>{H.x, H.y, H.z});
  put(row, kMomentumBody, adstar_Vector3{Pi_B.x, Pi_B.y, Pi_B.z});
  row.values[kEnergy] = member.rotational_energy_j;
  fleet_rows_.push_back(std::move(row));
}

bool Joiner::has_own_topics(std::string_view spacecraft) const {
  return tracks_.find(spacecraft) != tracks_.end();
}

std::vector<Row> Joiner::ready(bool everything) {
  std::vector<Row> rows;
  std::swap(rows, left_);
  for (auto& [name, track] : tracks_) {
    for (Line* line : waiting_lines(track)) {
      give_out(track, *line, rows, everything);
    }
  }
  rows.insert(rows.end(), std::make_move_iterator(fleet_rows_.begin()),
              std::make_move_iterator(fleet_rows_.end()));
  fleet_rows_.clear();
  return rows;
}

/// In the order in which their oldest came.
std::vector<Joiner::Line*> Joiner::waiting_lines(Track& track) {
  std::vector<Line*> lines;
  for (Line& line : track.lines) {
    if (!line.waiting.empty()) {
      lines.push_back(&line);
    }
  }
  std::sort(lines.begin(), lines.end(), [](const Line* a, const Line* b) {
    return a->waiting.begin()->second.came < b->waiting.begin()->second.came;
  });
  return lines;
}

/// What waits longest will get no other half.
bool Joiner::is_overtaken(const Line& line) const {
  if (patience_ == Patience::rounds) {
    return line.waiting.size() > 1;
  }
  constexpr std::size_t kMostWaiting = 4096;
  const std::uint64_t oldest = line.waiting.begin()->first;
  return line.waiting.size() > kMostWaiting ||
         (line.newest.size() == 2 &&
          std::all_of(line.newest.begin(), line.newest.end(),
                      [&](const auto& topic) { return topic.second > oldest; }));
}

void Joiner::give_out(Track& track, Line& line, std::vector<Row>& rows, bool everything) const {
  while (!line.waiting.empty()) {
    const auto oldest = line.waiting.begin();
    if (oldest->second.halves != kBoth && !everything && !is_overtaken(line)) {
      return;
    }
    line.begun = true;
    line.done = oldest->first;
    if (oldest->second.halves != kBoth) {
      remember_halved(track, oldest->first, oldest->second.halves);
    }
    rows.push_back(std::move(oldest->second.row));
    line.waiting.erase(oldest);
  }
}

void Joiner::remember_halved(Track& track, std::uint64_t step, unsigned halves) {
  if (track.halved.size() < kMostHalved) {
    track.halved.push_back({step, halves, nullptr});
  } else {
    track.halved[track.oldest_halved] = {step, halves, nullptr};
    track.oldest_halved = (track.oldest_halved + 1) % kMostHalved;
  }
}

}  // namespace adstar::samples
