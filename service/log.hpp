#pragma once
// The log of a long-running program: to stderr, or to the file that the scene names.

#include <string_view>

#include "service/scene/scene.hpp"

namespace adstar {

/// Makes it spdlog's default logger. A file that cannot be opened is said on stderr and stderr used
/// instead.
void set_up_log(const scene::Log& log, std::string_view program);

}  // namespace adstar
