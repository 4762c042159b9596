#include "service/scene/table_file.hpp"

#include <array>

#include "service/scene/decimal.hpp"
#include "service/scene/files.hpp"

namespace adstar::scene {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"time_s", "torque_x_n_m", "torque_y_n_m",
                                                   "torque_z_n_m"};
constexpr std::string_view kHeader = "time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m";
/// Differences of two knot times must fit 64 bits.
constexpr std::int64_t kFarthest = std::int64_t{1} << 62U;
/// A file in a wrong format is wrong in every line.
constexpr std::size_t kMostComplaints = 20;

struct Field {
  std::string_view text;
  std::uint32_t column;
};

/// Field i of the line, blanks trimmed; fields beyond the fourth count only.
std::size_t split(std::string_view line, std::array<Field, 4>& fields) {
  std::size_t count = 0;
  for (std::size_t begin = 0;; ++count) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    if (count < fields.size()) {
      std::size_t first = begin, last = end;
      while (first < last && line[first] == ' ') {
        ++first;
      }
      while (last > first && line[last - 1] == ' ') {
        --last;
      }
      fields[count] = {line.substr(first, last - first), static_cast<std::uint32_t>(first + 1)};
    }
    if (end == line.size()) {
      return count + 1;
    }
    begin = end + 1;
  }
}

class TableReader {
 public:
  TableReader(const Value& origin, std::string file) : origin_(origin), file_(std::move(file)) {}

  std::optional<TableKnots> read(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    text.remove_prefix(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      line.remove_suffix(!line.empty() && line.back() == '\r' ? 1 : 0);
      const std::size_t first = line.find_first_not_of(" \t");
      if (first != std::string_view::npos && line[first] != '#') {
        read_line(line);
      }
    }
    if (!header_seen_ || (knots_.time_ns.empty() && wrong_ == 0)) {
      line_ = std::max<std::uint32_t>(line_, 1);
      complain(1, header_seen_ ? "rows" : "header", "nothing",
               header_seen_ ? "at least one row" : in_quotes(kHeader),
               header_seen_ ? "0.0,0.0,0.0,0.01" : "that as the first line");
    }
    if (wrong_ > kMostComplaints) {
      origin_.complaints().add_line(
          origin_.node().place,
          complaint_line(file_, {line_, 1}, "file",
                         std::to_string(wrong_ - kMostComplaints) + " more wrong values",
                         "rows as above", "correcting those first"));
    }
    return wrong_ == 0 ? std::optional(std::move(knots_)) : std::nullopt;
  }

 private:
  void read_line(std::string_view line) {
    std::array<Field, 4> fields{};
    const std::size_t count = split(line, fields);
    if (!header_seen_) {
      header_seen_ = true;
      bool good = count == fields.size();
      for (std::size_t i = 0; i < fields.size(); ++i) {
        good = good && fields[i].text == kColumns[i];
      }
      if (!good) {
        complain(1, "header", in_quotes(line), in_quotes(kHeader), "that as the first line");
      }
    } else if (count != fields.size()) {
      complain(1, "row", std::to_string(count) + (count == 1 ? " field" : " fields"),
               "4: " + std::string(kHeader), "0.0,0.0,0.0,0.01");
    } else {
      read_row(fields);
    }
  }

  void read_row(const std::array<Field, 4>& fields) {
    const auto time_ns = read_time(fields[0]);
    std::array<std::optional<double>, 3> torque;
    for (std::size_t i = 0; i < 3; ++i) {
      const Field& field = fields[i + 1];
      torque[i] = finite_number(field.text);
      if (!torque[i]) {
        complain(field.column, kColumns[i + 1], in_quotes(field.text), "a finite number in N m",
                 "0.0");
      }
    }
    if (time_ns && torque[0] && torque[1] && torque[2]) {
      knots_.time_ns.push_back(*time_ns);
      knots_.torque_n_m.push_back({*torque[0], *torque[1], *torque[2]});
    }
  }

  std::optional<std::int64_t> read_time(const Field& field) {
    const auto ns = exact_ns(field.text, kSecond);
    if (!ns || *ns > kFarthest || *ns < -kFarthest) {
      complain(field.column, kColumns[0], in_quotes(field.text),
               "decimal seconds in whole nanoseconds, within 4e9 s", time_remedy(field.text));
      return std::nullopt;
    }
    const std::string previous(previous_);
    const bool rises = !previous_ns_ || *ns > *previous_ns_;
    if (!rises) {
      complain(field.column, kColumns[0], in_quotes(field.text),
               "a time after the " + previous + " of the row before",
               *ns == *previous_ns_ ? "removing one of the two rows" : "sorting the rows by time");
      return std::nullopt;
    }
    previous_ns_ = ns;
    previous_ = field.text;
    return ns;
  }

  /// The nearest time of whole nanoseconds, if it is only too fine.
  static std::string time_remedy(std::string_view text) {
    const std::size_t point = text.find('.');
    constexpr std::size_t kDecimals = 9;
    if (point != std::string_view::npos && text.size() > point + 1 + kDecimals) {
      const std::string_view cut = text.substr(0, point + 1 + kDecimals);
      if (finite_number(text) && exact_ns(cut, kSecond)) {
        return std::string(cut);
      }
    }
    return "0.5";
  }

  void complain(std::uint32_t column, std::string_view key, std::string_view got,
                std::string_view expected, std::string_view remedy) {
    if (++wrong_ <= kMostComplaints) {
      origin_.complaints().add_line(
          origin_.node().place, complaint_line(file_, {line_, column}, key, got, expected, remedy));
    }
  }

  const Value& origin_;
  std::string file_;
  TableKnots knots_;
  std::uint32_t line_ = 0;
  std::size_t wrong_ = 0;
  bool header_seen_ = false;
  std::optional<std::int64_t> previous_ns_;
  std::string_view previous_;
};

}  // namespace

std::optional<TableKnots> read_table_file(const Value& value,
                                          const std::filesystem::path& scene_file) {
  const std::filesystem::path file = scene_file.parent_path() / value.node().text;
  const FileText text = read_file(file);
  if (!text.error.empty()) {
    value.refuse_as(in_quotes(file.string()) + " (" + text.error + ")",
                    "a CSV file, its path relative to the scene", nearest_file(file, ".csv"));
    return std::nullopt;
  }
  return TableReader(value, file.string()).read(text.text);
}

}  // namespace adstar::scene
