#include "service/adstard/scene_text.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "service/scene/scene.hpp"

namespace adstar::adstard {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream || std::filesystem::is_directory(file)) {
    // The loader has the words for what is wrong with a file.
    scene::load(file);
    throw scene::SceneError(
        {fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno))});
  }
  return text.str();
}

int make_sealed_memfd(const std::string& text) {
  const int fd = memfd_create("adstar-scene", MFD_ALLOW_SEALING | MFD_CLOEXEC);
  if (fd < 0) {
    throw std::system_error(errno, std::generic_category(), "memfd_create");
  }
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = write(fd, text.data() + written, text.size() - written);
    if (n <= 0) {
      const int error = errno;
      close(fd);
      throw std::system_error(error, std::generic_category(), "writing the scene's memfd");
    }
    written += static_cast<std::size_t>(n);
  }
  fcntl(fd, F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL);
  return fd;
}

}  // namespace adstar::adstard
