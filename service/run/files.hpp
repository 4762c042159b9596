#pragma once
// Files that must not be lost: written whole, synced, and only then called by their name.

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include "service/run/bytes.hpp"

namespace adstar::run {

/// What is wrong with a run directory, and what to do: one sentence for a person.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An open file descriptor; closes it.
class File {
 public:
  File() = default;
  /// open(2) with O_CLOEXEC; throws RunError that names the file.
  File(const std::filesystem::path& path, int flags, int mode = 0644);
  File(File&& other) noexcept;
  File& operator=(File&& other) noexcept;
  ~File();

  int fd() const noexcept { return fd_; }
  const std::filesystem::path& path() const noexcept { return path_; }

  /// All of it, or RunError: then less may have been written.
  void write(std::span<const std::byte> bytes) const;
  /// Back to `length` bytes, and the next write goes there.
  void truncate(std::uint64_t length) const;
  void sync() const;

 private:
  std::filesystem::path path_;
  int fd_ = -1;
};

/// The bytes of a file; throws RunError.
Bytes read_bytes(const std::filesystem::path& path);

/// Beside it first, synced, renamed, the directory synced: after a crash there is the old file or the
/// new one. Throws RunError.
void replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace adstar::run
