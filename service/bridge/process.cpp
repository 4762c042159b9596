#include "service/bridge/process.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace adstar::bridge {
namespace {

std::atomic<bool> g_end_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

bool die_with_parent(pid_t parent) {
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) {
    throw std::system_error(errno, std::generic_category(), "prctl(PR_SET_PDEATHSIG)");
  }
  // It may have died before the call.
  return getppid() == parent;
}

void install_signal_handlers() {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGTERM, [](int) { g_end_requested.store(true); });
}

bool end_requested() noexcept { return g_end_requested.load(); }

std::string read_whole(int fd) {
  struct stat info {};
  if (fstat(fd, &info) != 0) {
    throw std::system_error(errno, std::generic_category(), "fstat of the scene's descriptor");
  }
  std::string text(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = pread(fd, text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      throw std::system_error(errno, std::generic_category(), "reading the scene");
    }
    if (got == 0) {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

}  // namespace adstar::bridge
