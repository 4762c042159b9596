#include "service/run/hot_journal_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "service/run/files.hpp"

namespace adstar::run {
namespace {

std::string name_of(std::uint64_t run) { return fmt::format("/adstar-{:016x}", run); }

/// Null when it cannot be mapped; errno says why.
void* map(int fd) {
  void* const memory = mmap(nullptr, sizeof(runtime::HotJournal), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_POPULATE, fd, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

/// It is there, and may be whole: nothing is to be given up for it.
[[noreturn]] void cannot_read(std::uint64_t run, int error) {
  throw std::system_error(
      error, std::generic_category(),
      fmt::format("what this run had in memory, /dev/shm{}, cannot be read", name_of(run)));
}

}  // namespace

HotJournalFile HotJournalFile::create(std::uint64_t run) {
  remove(run);
  const int fd = shm_open(name_of(run).c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  if (fd < 0) {
    throw std::system_error(errno, std::generic_category(), "making the journal in /dev/shm");
  }
  // posix_fallocate, not ftruncate: a full /dev/shm is to be found out now, not by the tick.
  const int error = posix_fallocate(fd, 0, sizeof(runtime::HotJournal));
  void* const memory = error == 0 ? map(fd) : nullptr;
  close(fd);
  if (memory == nullptr) {
    remove(run);
    throw std::system_error(error != 0 ? error : ENOMEM, std::generic_category(),
                            "making the journal in /dev/shm");
  }
  auto* const hot = new (memory) runtime::HotJournal;
  hot->layout = runtime::kHotJournalLayout;
  hot->run = run;
  return HotJournalFile(hot);
}

std::optional<HotJournalFile> HotJournalFile::open(std::uint64_t run) {
  const int fd = shm_open(name_of(run).c_str(), O_RDWR, 0);
  if (fd < 0) {
    if (errno == ENOENT) {
      return std::nullopt;
    }
    cannot_read(run, errno);
  }
  struct stat info {};
  const bool known = fstat(fd, &info) == 0;
  const bool whole = known && info.st_size == sizeof(runtime::HotJournal);
  void* const memory = whole ? map(fd) : nullptr;
  const int error = errno;
  close(fd);
  if (!known || (whole && memory == nullptr)) {
    cannot_read(run, error);
  }
  if (info.st_size == 0) {
    return std::nullopt;  // its daemon fell while it made it
  }
  const RunError of_another_version(
      fmt::format("/dev/shm{} holds what this run had in memory, and is of another version of "
                  "adstar",
                  name_of(run)));
  if (!whole) {
    throw of_another_version;
  }
  HotJournalFile file(static_cast<runtime::HotJournal*>(memory));
  if (file->layout == 0 && file->run == 0) {
    return std::nullopt;
  }
  if (file->layout != runtime::kHotJournalLayout || file->run != run) {
    throw of_another_version;
  }
  return file;
}

void HotJournalFile::remove(std::uint64_t run) noexcept { shm_unlink(name_of(run).c_str()); }

HotJournalFile::~HotJournalFile() {
  if (hot_ != nullptr) {
    munmap(hot_, sizeof(runtime::HotJournal));
  }
}

}  // namespace adstar::run
