#include "service/adstar/output.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <fcntl.h>
#include <poll.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/stop_signal.hpp"

namespace adstar::cli {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

Output Output::to_stdout() { return {STDOUT_FILENO, {}, {}}; }

Output Output::to_file(const fs::path& file) {
  std::error_code none;
  // The link stays a link: what it points to is replaced.
  const fs::path target = fs::is_symlink(file, none) ? fs::weakly_canonical(file, none) : file;
  const bool in_place = fs::exists(target, none) && !fs::is_regular_file(target, none);
  const fs::path temporary =
      in_place
          ? fs::path()
          : target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), getpid());
  const int fd = in_place ? open(target.c_str(), O_WRONLY | O_CLOEXEC)
                          : open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) {
    throw Failure(kFailed, fmt::format("cannot write '{}': {}; choose a directory that you may "
                                       "write to",
                                       file.string(), reason(errno)));
  }
  return {fd, target, temporary};
}

Output::Output(Output&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      name_(std::move(other.name_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)) {}

Output::~Output() {
  if (fd_ >= 0 && fd_ != STDOUT_FILENO) {
    close(fd_);
  }
  if (!temporary_.empty()) {
    unlink(temporary_.c_str());
  }
}

/// Whoever wants us to stop does not wait for a reader who stands still.
void Output::wait_for_room() const {
  constexpr int kPatience_ms = 1000;  // a reader who is merely slow gets the last of it
  pollfd output{fd_, POLLOUT, 0};
  for (int ready = 0; ready == 0;) {
    ready = poll(&output, 1, kPatience_ms);
    if (ready == 0 && stop_requested()) {
      throw Failure(kFailed, fmt::format("interrupted; {} takes no more, and the rest is not there",
                                         printed_name()));
    }
    if (ready < 0 && errno == EINTR) {
      ready = 0;
    }
  }
}

void Output::flush() {
  // To a file of our own at once; so much goes into a pipe without waiting, where there is room (pipe(7)).
  const std::size_t at_once = temporary_.empty() ? PIPE_BUF : buffer_.size();
  for (std::size_t written = 0; written < buffer_.size();) {
    wait_for_room();
    const ssize_t n =
        write(fd_, buffer_.data() + written, std::min(at_once, buffer_.size() - written));
    if (n < 0 && errno == EINTR) {
      continue;
    }
    if (n < 0) {
      fail(errno, "write");
    }
    written += static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void Output::commit() {
  flush();
  if (!temporary_.empty()) {
    // Data before name: after a power cut there is the old file or the new one.
    if (fsync(fd_) != 0) {
      fail(errno, "write");
    }
    if (rename(temporary_.c_str(), name_.c_str()) != 0) {
      fail(errno, "rename the finished file to");
    }
    temporary_.clear();
  }
}

std::string Output::printed_name() const {
  return name_.empty() ? "standard output" : "'" + name_.string() + "'";
}

void Output::fail(int error, std::string_view doing) const {
  if (error == EPIPE) {
    throw ReaderGone{};
  }
  throw Failure(kFailed,
                fmt::format("cannot {} {}: {}; nothing was kept, make room and run it again", doing,
                            printed_name(), reason(error)));
}

}  // namespace adstar::cli
