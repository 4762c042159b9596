#pragma once
// Scenes made of other scenes.

#include <stdexcept>
#include <string>

namespace adstar::testing {

/// `text` with the one place `what` replaced; throws when there is none.
inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) {
    throw std::runtime_error("'" + what + "' is not in the text");
  }
  return text.replace(at, what.size(), with);
}

}  // namespace adstar::testing
