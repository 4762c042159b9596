#pragma once
// A recording as the verbs that read one take it: the argument, and its samples by their type.

#include <cstdint>
#include <string>

#include "service/bag/recording.hpp"

namespace CLI {
class App;
}

namespace adstar::cli {

/// The positional RECORDING.
void add_recording(CLI::App& verb, std::string& directory);

/// Opens it, with a bar on stderr where reading lasts, says when nobody has ended it or a part of it is lost, and writes its metadata.yaml where a killed recorder could not. Throws Failure.
bag::Recording open_recording(const std::string& directory, const char* verb);

/// What may be the cause that a topic is not in it, as a question.
std::string why_absent(const bag::Recording& recording);

/// Throws Failure that says what helps when nothing in it is attitude or momentum of a single spacecraft.
void require_motion(const bag::Recording& recording);

/// On stderr, when there are any: recorded by another build of the types, or damaged.
void say_unreadable(std::uint64_t count, const char* verb);

}  // namespace adstar::cli
