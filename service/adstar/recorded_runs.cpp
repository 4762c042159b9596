#include "service/adstar/recorded_runs.hpp"

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::cli {

NewVoices new_voices_in(const bag::Recording& recording) {
  NewVoices voices;
  samples::for_each_sample<adstar_ServiceStatus>(
      recording, [&](const adstar_ServiceStatus& status, std::int64_t received_ns) {
        voices.hear(status, received_ns);
      });
  return voices;
}

void say_left_out(const LeftOut& left_out, const char* verb) {
  if (left_out.before > 0) {
    fmt::print(stderr,
               "adstar {}: simulation time began anew in this recording; the last run is taken, {} "
               "samples before it are not\n",
               verb, report::counted(left_out.before));
  }
  if (left_out.older > 0) {
    fmt::print(stderr,
               "adstar {}: samples left out, older than those said before them: {}; a daemon took "
               "over, or had stood still\n",
               verb, report::counted(left_out.older));
  }
}

}  // namespace adstar::cli
