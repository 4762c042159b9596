#include "service/scene/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "service/scene/complaints.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::scene {

FileText read_file(const std::filesystem::path& file) {
  FileText result;
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    result.error = std::strerror(errno);
    return result;
  }
  constexpr std::size_t kChunk = 1U << 16U;
  for (;;) {
    const std::size_t size = result.text.size();
    result.text.resize(size + kChunk);
    const ssize_t got = read(descriptor, result.text.data() + size, kChunk);
    result.text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      result.error = std::strerror(errno);
    }
    if (got <= 0) {
      break;
    }
  }
  close(descriptor);
  return result;
}

std::string nearest_file(const std::filesystem::path& file, std::string_view extension) {
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    return "the path of a " + std::string(extension) + " file inside it";
  }
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator i(directory, error), end; !error && i != end;
       i.increment(error)) {
    if (i->path().extension() == extension) {
      names.push_back(i->path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());  // directories list in any order
  const std::vector<std::string_view> known(names.begin(), names.end());
  if (const auto near = nearest(file.filename().string(), known)) {
    return in_quotes((file.parent_path() / *near).string());
  }
  return "a path to a " + std::string(extension) + " file; there is none in " +
         in_quotes(directory.string());
}

}  // namespace adstar::scene
