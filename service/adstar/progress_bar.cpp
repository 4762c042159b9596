#include "service/adstar/progress_bar.hpp"

#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace adstar::cli {

using namespace std::chrono_literals;

ProgressBar::ProgressBar(std::uint64_t total)
    : total_(total), watched_(isatty(STDERR_FILENO) == 1), next_(begun_ + 2s) {}

ProgressBar::~ProgressBar() {
  if (drawn_) {
    std::fputs("\r\x1b[K", stderr);
  }
}

void ProgressBar::show(std::uint64_t done) {
  const auto now = Clock::now();
  if (!watched_ || now < next_ || done == 0) {
    return;
  }
  next_ = now + 200ms;
  drawn_ = true;
  constexpr double kWidth = 40;
  const double part = static_cast<double>(done) / static_cast<double>(total_);
  const double elapsed_s = std::chrono::duration<double>(now - begun_).count();
  const auto full = static_cast<std::size_t>(kWidth * part);
  fmt::print(stderr, "\r[{}{}] {:3.0f} %  {:.0f} s left\x1b[K", std::string(full, '#'),
             std::string(static_cast<std::size_t>(kWidth) - full, '.'), 100 * part,
             elapsed_s * (1 - part) / part);
  std::fflush(stderr);
}

}  // namespace adstar::cli
