#include "service/adstar/stop_signal.hpp"

#include <csignal>

namespace adstar::cli {
namespace {

volatile std::sig_atomic_t g_stop = 0;

void on_signal(int signal) {
  constexpr int kPatience = 2;
  g_stop = g_stop + 1;
  if (g_stop > kPatience) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = &on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() noexcept { return g_stop != 0; }

}  // namespace adstar::cli
