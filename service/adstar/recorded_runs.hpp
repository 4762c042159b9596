#pragma once
// The runs in a recording, topic by topic, and what is said of those samples that are not of the last one.

#include <cstdint>
#include <map>
#include <string>

#include "service/adstar/last_run.hpp"
#include "service/adstar/new_voices.hpp"
#include "service/dds/convert.hpp"
#include "service/samples/recorded_topics.hpp"

namespace adstar::cli {

/// By spacecraft.
using Runs = std::map<std::string, RunFinder, std::less<>>;

/// Of all that its statuses tell of.
NewVoices new_voices_in(const bag::Recording& recording);

/// The voices must outlive them.
template <class T>
Runs runs_of(const bag::Recording& recording, const NewVoices& voices) {
  Runs runs;
  samples::for_each_sample<T>(recording, [&](const T& sample, std::int64_t received_ns) {
    runs.try_emplace(std::string(dds::text_of(sample.spacecraft)), voices)
        .first->second.add({sample.time_ns, dds::text_of(sample.service), received_ns});
  });
  return runs;
}

struct LeftOut {
  std::uint64_t before = 0, older = 0;

  void add(const RunReader& reader) {
    before += reader.before();
    older += reader.older();
  }
};

/// On stderr, when there are any.
void say_left_out(const LeftOut& left_out, const char* verb);

}  // namespace adstar::cli
