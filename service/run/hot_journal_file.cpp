#include "service/run/hot_journal_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/magic.h>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace adstar::run {
namespace {

/// Null when it cannot be mapped; errno says why.
void* map(int fd) {
  void* const memory = mmap(nullptr, sizeof(runtime::HotJournal), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_POPULATE, fd, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

/// It is there, and may be whole: nothing is to be given up for it.
[[noreturn]] void cannot_read(const RunFacts& facts, int error) {
  throw std::system_error(
      error, std::generic_category(),
      fmt::format("what this run had in memory, {}, cannot be read", memory_file(facts).string()));
}

[[noreturn]] void cannot_make(const RunFacts& facts, int error) {
  throw std::system_error(error, std::generic_category(),
                          fmt::format("making the journal in {}", facts.memory.string()));
}

}  // namespace

std::string why_not_in_memory(const std::string& directory) {
  struct statfs info {};
  if (statfs(directory.c_str(), &info) != 0) {
    return fmt::format(
        "got '{}', which cannot be looked at ({}), expected a directory of a tmpfs; "
        "try /dev/shm",
        directory, std::strerror(errno));
  }
  // On a disk a page is write-protected again each time it was written back, and the tick's next store waits for that.
  if (info.f_type != TMPFS_MAGIC && info.f_type != static_cast<long>(RAMFS_MAGIC)) {
    return fmt::format("got '{}', which is no tmpfs, expected a directory of one; try /dev/shm",
                       directory);
  }
  return {};
}

HotJournalFile HotJournalFile::create(const RunFacts& facts) {
  remove(facts);
  const int fd =
      ::open(memory_file(facts).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd < 0) {
    cannot_make(facts, errno);
  }
  // posix_fallocate, not ftruncate: a full tmpfs is to be found out now, not by the tick.
  const int error = posix_fallocate(fd, 0, sizeof(runtime::HotJournal));
  void* const memory = error == 0 ? map(fd) : nullptr;
  close(fd);
  if (memory == nullptr) {
    remove(facts);
    cannot_make(facts, error != 0 ? error : ENOMEM);
  }
  auto* const hot = new (memory) runtime::HotJournal;
  hot->layout = runtime::kHotJournalLayout;
  hot->run = facts.run;
  return HotJournalFile(hot);
}

std::optional<HotJournalFile> HotJournalFile::open(const RunFacts& facts) {
  const int fd = ::open(memory_file(facts).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) {
    if (errno == ENOENT) {
      return std::nullopt;
    }
    cannot_read(facts, errno);
  }
  struct stat info {};
  const bool known = fstat(fd, &info) == 0;
  const bool whole = known && info.st_size == sizeof(runtime::HotJournal);
  void* const memory = whole ? map(fd) : nullptr;
  const int error = errno;
  close(fd);
  if (!known || (whole && memory == nullptr)) {
    cannot_read(facts, error);
  }
  if (info.st_size == 0) {
    return std::nullopt;  // its daemon fell while it made it
  }
  const RunError of_another_version(
      fmt::format("{} holds what this run had in memory, and is of another version of adstar",
                  memory_file(facts).string()));
  if (!whole) {
    throw of_another_version;
  }
  HotJournalFile file(static_cast<runtime::HotJournal*>(memory));
  if (file->layout == 0 && file->run == 0) {
    return std::nullopt;
  }
  if (file->layout != runtime::kHotJournalLayout || file->run != facts.run) {
    throw of_another_version;
  }
  return file;
}

void HotJournalFile::remove(const RunFacts& facts) noexcept { unlink(memory_file(facts).c_str()); }

HotJournalFile::~HotJournalFile() {
  if (hot_ != nullptr) {
    munmap(hot_, sizeof(runtime::HotJournal));
  }
}

}  // namespace adstar::run
