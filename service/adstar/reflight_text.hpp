#pragma once
// What `adstar replay` says of a run that was flown again.

#include <string>

#include "service/run/refly.hpp"

namespace adstar::cli {

std::string reflight_text(const run::Reflight& flight);

}  // namespace adstar::cli
