#pragma once
// A StepTiming in words, for people and for machines.

#include <health.h>
#include <string>

namespace adstar::cli {

/// A small table with what it means.
std::string timing_table(const adstar_StepTiming& timing);
/// One line of JSON, durations in nanoseconds.
std::string timing_json(const adstar_StepTiming& timing);

}  // namespace adstar::cli
