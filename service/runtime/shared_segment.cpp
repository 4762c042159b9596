#include "service/runtime/shared_segment.hpp"

#include <cerrno>
#include <climits>
#include <ctime>
#include <fcntl.h>
#include <linux/futex.h>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace adstar::runtime {
namespace {

std::size_t total_bytes(std::size_t fleet_size) {
  return sizeof(SharedSegment) + 2 * fleet_words(fleet_size) * sizeof(std::uint64_t);
}

[[noreturn]] void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// One system call when the other side sleeps on the word, none when not.
void rise(std::atomic<std::uint32_t>& word, const std::atomic<std::uint32_t>& sleeps) noexcept {
  word.fetch_add(1, std::memory_order_seq_cst);
  if (sleeps.load(std::memory_order_seq_cst) != 0) {
    // FUTEX_WAKE never waits, whatever the other side does with the word.
    syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
  }
}

void sleep_on(std::atomic<std::uint32_t>& word, std::atomic<std::uint32_t>& sleeps,
              std::uint32_t seen, int timeout_ms) noexcept {
  sleeps.store(1, std::memory_order_seq_cst);
  const timespec timeout{timeout_ms / 1000, (timeout_ms % 1000) * 1'000'000L};
  syscall(SYS_futex, &word, FUTEX_WAIT, seen, &timeout, nullptr, 0);
  sleeps.store(0, std::memory_order_seq_cst);
}

}  // namespace

MappedSegment MappedSegment::create(std::size_t fleet_size) {
  const int fd = memfd_create("adstar", MFD_ALLOW_SEALING | MFD_CLOEXEC);
  if (fd < 0) {
    throw_errno("memfd_create");
  }
  const std::size_t bytes = total_bytes(fleet_size);
  if (ftruncate(fd, static_cast<off_t>(bytes)) != 0 ||
      fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
    const int error = errno;
    close(fd);
    throw std::system_error(error, std::generic_category(), "sizing the shared segment");
  }
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd, 0);
  if (memory == MAP_FAILED) {
    const int error = errno;
    close(fd);
    throw std::system_error(error, std::generic_category(), "mapping the shared segment");
  }
  auto* const segment = new (memory) SharedSegment;
  MappedSegment mapped(fd, segment, bytes, fleet_size);
  mapped.restore_header();
  return mapped;
}

MappedSegment MappedSegment::attach(int fd) {
  struct stat info {};
  if (fstat(fd, &info) != 0) {
    throw_errno("fstat of the shared segment");
  }
  const auto bytes = static_cast<std::size_t>(info.st_size);
  if (bytes < sizeof(SharedSegment)) {
    throw std::runtime_error("the shared segment is too small: adstard is of another build");
  }
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) {
    throw_errno("mapping the shared segment");
  }
  auto* const segment = static_cast<SharedSegment*>(memory);
  const std::uint64_t fleet_size = segment->fleet_size;
  if (segment->layout != kLayout || fleet_size > bytes || total_bytes(fleet_size) != bytes) {
    munmap(memory, bytes);
    throw std::runtime_error("the shared segment has another layout: adstard is of another build");
  }
  return {fd, segment, bytes, fleet_size};
}

MappedSegment::MappedSegment(MappedSegment&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      segment_(std::exchange(other.segment_, nullptr)),
      bytes_(other.bytes_),
      fleet_size_(other.fleet_size_) {}

MappedSegment::~MappedSegment() {
  if (segment_ != nullptr) {
    munmap(segment_, bytes_);
  }
  if (fd_ >= 0) {
    close(fd_);
  }
}

void MappedSegment::restore_header() const noexcept {
  segment_->layout = kLayout;
  segment_->fleet_size = fleet_size_;
}

std::span<std::uint64_t> MappedSegment::fleet_storage() const noexcept {
  return {reinterpret_cast<std::uint64_t*>(segment_ + 1), 2 * fleet_words(fleet_size_)};
}

void wake_bridge(SharedSegment& segment) noexcept {
  rise(segment.wake_count, segment.bridge_sleeps);
}

void sleep_until_woken(SharedSegment& segment, std::uint32_t seen, int timeout_ms) noexcept {
  sleep_on(segment.wake_count, segment.bridge_sleeps, seen, timeout_ms);
}

void wake_tick(SharedSegment& segment) noexcept { rise(segment.push_count, segment.tick_sleeps); }

void sleep_until_pushed(SharedSegment& segment, std::uint32_t seen, int timeout_ms) noexcept {
  sleep_on(segment.push_count, segment.tick_sleeps, seen, timeout_ms);
}

}  // namespace adstar::runtime
