#include "service/report/row.hpp"

#include <cmath>

#include <fmt/format.h>

#include "service/report/fields.hpp"
#include "service/report/numbers.hpp"

namespace adstar::report {
namespace {

/// A sample off the network may carry any bytes as its name.
void append_json_string(std::string& text, std::string_view value) {
  text += '"';
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char kSpace = 0x20, kDelete = 0x7f;
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (byte < kSpace || byte >= kDelete) {
      fmt::format_to(std::back_inserter(text), FMT_STRING("\\u{:04x}"), byte);
    } else {
      text += c;
    }
  }
  text += '"';
}

}  // namespace

std::string motion_columns() {
  std::string text = "spacecraft,step,time_s";
  for (const std::string_view column : kColumns) {
    text += ',';
    text += column;
  }
  return text;
}

void append_csv_header(std::string& text) { text += motion_columns() + "\n"; }

void append_csv(std::string& text, const Row& row) {
  append_csv_word(text, row.spacecraft);
  fmt::format_to(std::back_inserter(text), FMT_STRING(",{},"), row.step);
  append_seconds(text, row.time_ns);
  for (const auto& value : row.values) {
    text += ',';
    if (value) {
      append_number(text, *value);
    }
  }
  text += '\n';
}

void append_json(std::string& text, const Row& row) {
  text += "{\"spacecraft\":";
  append_json_string(text, row.spacecraft);
  fmt::format_to(std::back_inserter(text), FMT_STRING(",\"step\":{},\"time_s\":"), row.step);
  append_seconds(text, row.time_ns);
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    fmt::format_to(std::back_inserter(text), FMT_STRING(",\"{}\":"), kColumns[i]);
    if (row.values[i] && std::isfinite(*row.values[i])) {
      append_number(text, *row.values[i]);
    } else {
      text += "null";
    }
  }
  text += "}\n";
}

}  // namespace adstar::report
