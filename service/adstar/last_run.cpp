#include "service/adstar/last_run.hpp"

#include <algorithm>
#include <utility>

namespace adstar::cli {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

}  // namespace

void RunFinder::add(const Heard& sample) {
  const std::uint64_t number = count_++;
  const std::int64_t before_received_ns = std::exchange(received_ns_, sample.received_ns);
  const std::int64_t time_ns = sample.time_ns;
  if (number == 0) {
    listened_since_ns_ = sample.received_ns;
    run_ = {0, 1, time_ns, time_ns};
    return;
  }
  run_.end = count_;
  if (time_ns >= run_.last_ns) {
    if (detour_ && is_new_run(*detour_) &&
        time_ns - detour_->last_ns <= detour_->last_ns - detour_->first_ns) {
      begin_run_at(*detour_);
    }
    run_.last_ns = time_ns;
    detour_.reset();
  } else if (detour_ && time_ns >= detour_->last_ns) {
    if (detour_->last_ns == detour_->first_ns) {
      detour_->second_ns = time_ns;
    }
    detour_->last_ns = time_ns;
  } else {
    if (detour_ && is_new_run(*detour_)) {
      begin_run_at(*detour_);
    }
    detour_ = Detour{number,
                     time_ns,
                     time_ns,
                     time_ns,
                     std::string(sample.service),
                     before_received_ns,
                     sample.received_ns};
  }
}

void RunFinder::begin_run_at(const Detour& detour) {
  last_voice_ = new_voice(detour).value_or(last_voice_);
  run_ = {detour.begin, run_.end, detour.first_ns, detour.last_ns};
}

bool RunFinder::is_new_run(const Detour& detour) const {
  return detour.last_ns > detour.first_ns && detour.first_ns < run_.last_ns / 2 &&
         has_new_voice(detour);
}

bool RunFinder::has_new_voice(const Detour& detour) const {
  return voices_->know(detour.service)
             ? new_voice(detour).has_value()
             : detour.first_ns <= kSecond_ns + (detour.second_ns - detour.first_ns);
}

/// A status is said once a second, and the topics are taken off the bus one after the other. The clock may have been set
/// back just then.
std::optional<std::uint64_t> RunFinder::new_voice(const Detour& detour) const {
  const auto [earlier, later] = std::minmax(detour.before_received_ns, detour.received_ns);
  return voices_->next(detour.service, last_voice_, {earlier - kSecond_ns, later + 3 * kSecond_ns},
                       listened_since_ns_);
}

RunSpan RunFinder::last_run() const {
  return detour_ && is_new_run(*detour_)
             ? RunSpan{detour_->begin, run_.end, detour_->first_ns, detour_->last_ns}
             : run_;
}

bool RunReader::takes(std::int64_t time_ns) {
  const std::uint64_t number = count_++;
  if (number < run_.begin || number >= run_.end) {
    return false;
  }
  if (newest_ns_ && time_ns <= *newest_ns_) {
    older_ += time_ns < *newest_ns_ ? 1 : 0;
    return false;
  }
  newest_ns_ = time_ns;
  return true;
}

}  // namespace adstar::cli
