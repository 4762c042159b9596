#include "service/scene/complaints.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace adstar::scene {

std::string complaint_line(std::string_view file, Place place, std::string_view key,
                           std::string_view got, std::string_view expected,
                           std::string_view remedy) {
  std::string line(file);
  line += ':' + std::to_string(place.line) + ':' + std::to_string(place.column) + ": ";
  line += key;
  line += ": got ";
  line += got;
  line += ", expected ";
  line += expected;
  line += "; try ";
  line += remedy;
  return line;
}

void Complaints::add(Place place, std::string_view key, std::string_view got,
                     std::string_view expected, std::string_view remedy) {
  found_.push_back({place, complaint_line(file_, place, key, got, expected, remedy)});
}

std::vector<std::string> Complaints::lines() const {
  std::vector<const Found*> order;
  order.reserve(found_.size());
  for (const Found& found : found_) {
    order.push_back(&found);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Found* a, const Found* b) { return a->place < b->place; });
  std::vector<std::string> lines;
  lines.reserve(order.size());
  for (const Found* found : order) {
    lines.push_back(found->line);
  }
  return lines;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  constexpr std::string_view kHex = "0123456789abcdef";
  const bool cut = text.size() > kLongest;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += "\\x";
      result += kHex[byte >> 4U];
      result += kHex[byte & 15U];
    } else {
      if (c == '"' || c == '\\') {
        result += '\\';
      }
      result += c;
    }
  }
  result += cut ? "...\"" : "\"";
  return result;
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace adstar::scene
