#pragma once
// A recording as the verbs that read one take it: the argument, and its samples by their type.

#include <cstdint>
#include <string>
#include <vector>

#include "service/adstar/recorded_topics.hpp"
#include "service/bag/recording.hpp"
#include "service/dds/cdr.hpp"

namespace CLI {
class App;
}

namespace adstar::cli {

/// The positional RECORDING.
void add_recording(CLI::App& verb, std::string& directory);

/// Opens it, says when nobody has ended it, and writes its metadata.yaml where a killed recorder could not. Throws Failure.
bag::Recording open_recording(const std::string& directory, const char* verb);

/// Calls use(const T&, received_ns) for each sample of T, in order; returns how many could not be read.
template <class T, class Use>
std::uint64_t for_each_sample(const bag::Recording& recording, Use&& use) {
  std::uint64_t unreadable = 0;
  recording.for_each({recorded_name<T>()}, [&](const bag::Message& message) {
    const bool read = dds::with_sample<T>(
        message.payload, [&](const T& sample) { use(sample, message.received_ns); });
    unreadable += read ? 0 : 1;
  });
  return unreadable;
}

/// Throws Failure that says what helps when nothing in it is attitude or momentum of a single spacecraft.
void require_motion(const bag::Recording& recording);

/// On stderr, when there are any: recorded by another build of the types, or damaged.
void say_unreadable(std::uint64_t count, const char* verb);

}  // namespace adstar::cli
