#pragma once
// Reading a whole file, and what to suggest when that fails.

#include <filesystem>
#include <string>

namespace adstar::scene {

struct FileText {
  std::string text;
  std::string error;  ///< the system's reason; empty: none
};
FileText read_file(const std::filesystem::path& file);

/// For "try": the file with that extension in the same directory whose name is nearest, else a hint
/// at the directory.
std::string nearest_file(const std::filesystem::path& file, std::string_view extension);

}  // namespace adstar::scene
