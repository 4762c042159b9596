#include "service/run/files.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace adstar::run {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path) {
  const int error = errno;
  const bool full = error == ENOSPC || error == EDQUOT;
  throw RunError(fmt::format("{}: {}: {}{}", path.string(), what, std::strerror(error),
                             full ? "; make room there" : ""));
}

}  // namespace

File::File(const std::filesystem::path& path, int flags, int mode)
    : path_(path), fd_(open(path.c_str(), flags | O_CLOEXEC, mode)) {
  if (fd_ < 0) {
    fail("cannot be opened", path);
  }
}

File::File(File&& other) noexcept
    : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}

File& File::operator=(File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(fd_, other.fd_);
  return *this;
}

File::~File() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

void File::write(std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) {
        continue;
      }
      fail("cannot be written", path_);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void File::truncate(std::uint64_t length) const {
  if (ftruncate(fd_, static_cast<off_t>(length)) != 0 ||
      lseek(fd_, static_cast<off_t>(length), SEEK_SET) < 0) {
    fail("cannot be cut", path_);
  }
}

void File::sync() const {
  if (fdatasync(fd_) != 0) {
    fail("cannot be synced", path_);
  }
}

Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) {
    fail("cannot be read", path);
  }
  Bytes bytes(static_cast<std::size_t>(in.tellg()));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    fail("cannot be read", path);
  }
  return bytes;
}

void replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::path beside = path;
  beside += ".new";
  {
    const File file(beside, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(bytes);
    file.sync();
  }
  if (rename(beside.c_str(), path.c_str()) != 0) {
    fail("cannot take its name", beside);
  }
  File(path.parent_path(), O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace adstar::run
