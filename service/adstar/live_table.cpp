#include "service/adstar/live_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sys/ioctl.h>
#include <telemetry.h>
#include <unistd.h>

#include <fmt/format.h>

#include "service/adstar/services.hpp"
#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

struct Column {
  const char* title;
  std::size_t value;
  bool fixed;  ///< of order one: a fixed number of decimals does not jump
};

constexpr std::array<Column, 15> kShown{{{"q_w", 0, true},
                                         {"q_x", 1, true},
                                         {"q_y", 2, true},
                                         {"q_z", 3, true},
                                         {"omega_x", 4, false},
                                         {"omega_y", 5, false},
                                         {"omega_z", 6, false},
                                         {"H_x", 7, false},
                                         {"H_y", 8, false},
                                         {"H_z", 9, false},
                                         {"E [J]", 13, false},
                                         {"W [J]", 14, false},
                                         {"Pi_x", 10, false},
                                         {"Pi_y", 11, false},
                                         {"Pi_z", 12, false}}};
constexpr std::size_t kCell = 11, kTime = 12;
constexpr std::size_t kFrame = 4;  ///< lines that are no row: title, header, a cut, the note

std::string cell(const std::optional<double>& value, bool fixed) {
  if (!value) {
    return fmt::format("{:>{}}", "-", kCell);
  }
  return fixed ? fmt::format("{:>{}.6f}", *value, kCell) : fmt::format("{:>{}.4g}", *value, kCell);
}

std::string cut(std::string line, std::size_t width) {
  if (line.size() > width) {
    line.resize(width);
  }
  return line + '\n';
}

std::string state_of(const report::Row& row, double age_s) {
  if ((row.flags & adstar_FLAG_FINAL) != 0) {
    return "  ended";
  }
  if ((row.flags & (adstar_FLAG_UNRESOLVED_ANGLE | adstar_FLAG_UNRESOLVED_EDGES |
                    adstar_FLAG_UNRESOLVED_DAMPING)) != 0) {
    return "  UNRESOLVED";
  }
  constexpr double kStale_s = 3;
  return age_s > kStale_s ? fmt::format("  silent for {:.0f} s", age_s) : "";
}

}  // namespace

void LiveTable::update(const report::Row& row, Clock::time_point now) {
  const std::string name = printable(row.spacecraft);
  Entry& entry = entries_[name];
  const auto before = entry.row.values;
  entry.row = row;
  entry.row.spacecraft = name;
  entry.heard = now;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!entry.row.values[i]) {
      entry.row.values[i] = before[i];
    }
  }
}

std::string LiveTable::text(TerminalSize size, Clock::time_point now) const {
  const auto age = [now](const Entry& entry) {
    return std::chrono::duration<double>(now - entry.heard).count();
  };
  std::size_t name_width = 10;
  const std::size_t room = size.lines > kFrame ? size.lines - kFrame : 1;
  const std::size_t rows = std::min(entries_.size(), room);
  std::size_t state_width = 0;
  auto last = entries_.begin();
  for (std::size_t i = 0; i < rows; ++i, ++last) {
    name_width = std::max(name_width, last->first.size());
    state_width = std::max(state_width, state_of(last->second.row, age(last->second)).size());
  }
  const std::size_t left = name_width + kTime + state_width;
  const std::size_t columns =
      std::min(kShown.size(), size.columns > left ? (size.columns - left) / kCell : 0);

  std::string text =
      cut(fmt::format("{}, {} spacecraft; Ctrl-C ends", title_, report::counted(entries_.size())),
          size.columns);
  std::string line = fmt::format("{:<{}}{:>{}}", "spacecraft", name_width, "time [s]", kTime);
  for (std::size_t i = 0; i < columns; ++i) {
    line += fmt::format("{:>{}}", kShown[i].title, kCell);
  }
  text += cut(line, size.columns);
  for (auto entry = entries_.begin(); entry != last; ++entry) {
    const report::Row& row = entry->second.row;
    line = fmt::format("{:<{}}{:>{}}", entry->first, name_width,
                       fmt::format("{:.3f}", static_cast<double>(row.time_ns) * 1e-9), kTime);
    for (std::size_t i = 0; i < columns; ++i) {
      line += cell(row.values[kShown[i].value], kShown[i].fixed);
    }
    line += state_of(row, age(entry->second));
    text += cut(line, size.columns);
  }
  if (rows < entries_.size()) {
    text += cut(fmt::format("... {} more", report::counted(entries_.size() - rows)), size.columns);
  }
  if (!note_.empty()) {
    text += cut(note_, size.columns);
  }
  return text;
}

Screen::Screen() { std::fputs("\x1b[?1049h\x1b[?25l\x1b[2J", stdout); }

Screen::~Screen() {
  std::fputs("\x1b[?25h\x1b[?1049l", stdout);
  std::fputs(last_.c_str(), stdout);
  std::fflush(stdout);
}

void Screen::draw(const std::string& text) {
  last_ = text;
  std::string shown = "\x1b[H";
  for (const char c : text) {
    // Each line clears what was longer before; no newline scrolls the last one away.
    shown += c == '\n' ? std::string("\x1b[K\r\n") : std::string(1, c);
  }
  shown.resize(shown.size() >= 2 ? shown.size() - 2 : 0);
  shown += "\x1b[J";
  std::fputs(shown.c_str(), stdout);
  std::fflush(stdout);
}

TerminalSize Screen::size() {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) {
    return {};
  }
  return {window.ws_col, window.ws_row};
}

}  // namespace adstar::cli
