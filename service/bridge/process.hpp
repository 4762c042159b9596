#pragma once
// The bridge as a child: it dies with its parent, and leaves Ctrl-C to it.

#include <string>
#include <sys/types.h>

namespace adstar::bridge {

/// Asks the kernel for SIGKILL when the parent dies. False when `parent` is not the parent (any
/// more).
bool die_with_parent(pid_t parent);

/// SIGINT is adstard's to act upon; SIGTERM asks for a clean end; SIGPIPE must not kill for a lost
/// log.
void install_signal_handlers();

/// SIGTERM has come.
bool end_requested() noexcept;

/// The whole of a file, from its beginning, wherever its offset stands. Throws std::system_error.
std::string read_whole(int fd);

}  // namespace adstar::bridge
