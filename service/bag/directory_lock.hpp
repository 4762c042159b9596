#pragma once
// Who records into a directory holds it (flock on the directory itself: nothing is left in it, and a kill lets
// go). Whoever mends a recording shares it, which fails as long as it is recorded.

#include <filesystem>

namespace adstar::bag {

class DirectoryLock {
 public:
  enum class Kind { recorder, mender };
  /// Never waits. On a file system that has no locks it is as if nobody held it.
  DirectoryLock(const std::filesystem::path& directory, Kind kind);
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&& other) noexcept;
  ~DirectoryLock();

  /// Somebody else holds it in the other way.
  bool refused() const { return refused_; }

 private:
  int fd_ = -1;
  bool refused_ = false;
};

}  // namespace adstar::bag
