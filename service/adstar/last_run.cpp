#include "service/adstar/last_run.hpp"

namespace adstar::cli {

void RunFinder::add(std::int64_t time_ns) {
  const std::uint64_t number = count_++;
  if (number == 0) {
    run_ = {0, 1, time_ns, time_ns};
    return;
  }
  run_.end = count_;
  if (time_ns >= run_.last_ns) {
    if (detour_ && is_new_run(*detour_) &&
        time_ns - detour_->last_ns <= detour_->last_ns - detour_->first_ns) {
      run_.begin = detour_->begin;
      run_.first_ns = detour_->first_ns;
    }
    run_.last_ns = time_ns;
    detour_.reset();
  } else if (detour_ && time_ns >= detour_->last_ns) {
    detour_->last_ns = time_ns;
  } else {
    if (detour_ && is_new_run(*detour_)) {
      run_ = last_run();
    }
    detour_ = Detour{number, time_ns, time_ns};
  }
}

bool RunFinder::is_new_run(const Detour& detour) const {
  return detour.last_ns > detour.first_ns && detour.first_ns < run_.last_ns / 2;
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
