#include "service/adstar/row.hpp"

#include <cmath>

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::cli {
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

/// Nothing that would begin a new field or line.
void append_csv_string(std::string& text, std::string_view value) {
  for (const char c : value) {
    const bool plain = c > ' ' && c != ',' && c != '"' && c != '\x7f';
    text += plain ? c : '?';
  }
}

}  // namespace

void append_csv_header(std::string& text) {
  text += "spacecraft,step,time_s";
  for (const std::string_view column : kColumns) {
    text += ',';
    text += column;
  }
  text += '\n';
}

void append_csv(std::string& text, const Row& row) {
  append_csv_string(text, row.spacecraft);
  fmt::format_to(std::back_inserter(text), FMT_STRING(",{},"), row.step);
  report::append_seconds(text, row.time_ns);
  for (const auto& value : row.values) {
    text += ',';
    if (value) {
      report::append_number(text, *value);
    }
  }
  text += '\n';
}

void append_json(std::string& text, const Row& row) {
  text += "{\"spacecraft\":";
  append_json_string(text, row.spacecraft);
  fmt::format_to(std::back_inserter(text), FMT_STRING(",\"step\":{},\"time_s\":"), row.step);
  report::append_seconds(text, row.time_ns);
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    fmt::format_to(std::back_inserter(text), FMT_STRING(",\"{}\":"), kColumns[i]);
    if (row.values[i] && std::isfinite(*row.values[i])) {
      report::append_number(text, *row.values[i]);
    } else {
      text += "null";
    }
  }
  text += "}\n";
}

}  // namespace adstar::cli
