#pragma once
// The text of the scene, read once and kept: the daemon and every bridge it starts see the same,
// whatever becomes of the file meanwhile.

#include <filesystem>
#include <string>

namespace adstar::adstard {

/// The whole file. Throws scene::SceneError when it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// A sealed memfd holding `text`, close-on-exec. Throws std::system_error.
int make_sealed_memfd(const std::string& text);

}  // namespace adstar::adstard
