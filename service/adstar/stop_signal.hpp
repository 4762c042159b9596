#pragma once
// Ctrl-C and SIGTERM as a question that loops may ask.

namespace adstar::cli {

/// From now on the two signals only set the answer; a third one ends the process as usual.
void catch_stop_signals();

bool stop_requested() noexcept;

}  // namespace adstar::cli
