#pragma once
// The monitor's table on a terminal: drawn in place on the alternate screen, cut to its size, and
// left behind once when it ends.

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

#include "service/report/row.hpp"

namespace adstar::cli {

struct TerminalSize {
  std::size_t columns = 80;
  std::size_t lines = 24;
};

/// Newest values by spacecraft. Pure text: the terminal is Screen's.
class LiveTable {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LiveTable(std::string title) : title_(std::move(title)) {}

  /// What a row does not know stays as it was.
  void update(const report::Row& row, Clock::time_point now);
  void set_note(std::string note) { note_ = std::move(note); }

  /// No line is wider or the whole higher than the terminal.
  std::string text(TerminalSize size, Clock::time_point now) const;

 private:
  struct Entry {
    report::Row row;
    Clock::time_point heard;
  };

  std::string title_;
  std::string note_;
  std::map<std::string, Entry> entries_;
};

/// The alternate screen without a cursor, until it goes out of scope.
class Screen {
 public:
  Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  ~Screen();

  void draw(const std::string& text);
  static TerminalSize size();

 private:
  std::string last_;
};

}  // namespace adstar::cli
