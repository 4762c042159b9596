#pragma once
// Ctrl-C in the midst of work that runs without the GIL.

#include <chrono>

#include <pybind11/pybind11.h>

namespace adstar::python {

/// Cheap enough to be called some thousand times a second.
class Attention {
 public:
  /// Every 50 ms it takes the GIL and lets Python hear its signals: throws what a handler raised, as a rule
  /// KeyboardInterrupt.
  void pay() {
    const Clock::time_point now = Clock::now();
    if (now < next_) {
      return;
    }
    next_ = now + kEvery;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) {
      throw pybind11::error_already_set();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kEvery{50};
  Clock::time_point next_ = Clock::now() + kEvery;
};

}  // namespace adstar::python
