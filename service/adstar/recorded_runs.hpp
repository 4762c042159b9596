#pragma once
// The runs in a recording, topic by topic, and what is said of those samples that are not of the last one.

#include <cstdint>
#include <map>
#include <string>

#include "service/adstar/last_run.hpp"
#include "service/dds/convert.hpp"
#include "service/samples/recorded_topics.hpp"

namespace adstar::cli {

/// By spacecraft.
using Runs = std::map<std::string, RunFinder, std::less<>>;

template <class T>
Runs runs_of(const bag::Recording& recording) {
  Runs runs;
  samples::for_each_sample<T>(recording, [&](const T& sample, std::int64_t /*received_ns*/) {
    runs[std::string(dds::text_of(sample.spacecraft))].add(sample.time_ns);
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
