#include "service/scene/duration_key.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "service/scene/decimal.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {
namespace {

/// Units people write that are not ours.
struct Alias {
  std::string_view written, unit;
};
constexpr std::array<Alias, 20> kAliases{
    {{"nsec", "ns"}, {"nanoseconds", "ns"}, {"usec", "us"},         {"microseconds", "us"},
     {"msec", "ms"}, {"millisecond", "ms"}, {"milliseconds", "ms"}, {"S", "s"},
     {"sec", "s"},   {"secs", "s"},         {"second", "s"},        {"seconds", "s"},
     {"m", "min"},   {"mins", "min"},       {"minute", "min"},      {"minutes", "min"},
     {"hr", "h"},    {"hour", "h"},         {"hours", "h"},         {"days", "d"}}};

/// The nearest duration to a text that is none.
std::string duration_remedy(const Node& node, std::string_view example) {
  const std::string fallback = in_quotes(example);
  if (node.is_number()) {
    const auto seconds = exact_ns(number_text(node.real), kSecond);
    return seconds && *seconds > 0 ? in_quotes(format_duration(*seconds)) + " if seconds are meant"
                                   : fallback;
  }
  const std::string_view text = node.text;
  const std::size_t end = text.find_first_not_of("0123456789.");
  if (end == 0 || end == std::string_view::npos) {
    return end == 0 || text.empty() ? fallback
                                    : in_quotes(node.text + "s") + " if seconds are meant";
  }
  const std::string number(text.substr(0, end));
  std::string_view unit = text.substr(end);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const Alias& alias : kAliases) {
    const std::string meant = number + std::string(alias.unit);
    if (alias.written == unit && parse_duration(meant).value_or(0) > 0) {
      return in_quotes(meant);
    }
  }
  // A fraction too fine: cut digits until it is whole.
  for (std::size_t length = number.size(); length > 0; --length) {
    const auto ns = parse_duration(number.substr(0, length) + std::string(unit));
    if (ns) {
      return *ns > 0 ? in_quotes(format_duration(*ns)) : "\"1ns\"";
    }
  }
  return fallback;
}

std::optional<std::int64_t> read_duration(const Value& value, std::string_view rule,
                                          std::string_view example) {
  if (!value) {
    return std::nullopt;
  }
  const auto ns = value.is(Node::Kind::string) ? parse_duration(value.node().text) : std::nullopt;
  if (!ns || *ns <= 0) {
    value.refuse(rule, duration_remedy(value.node(), example));
    return std::nullopt;
  }
  return ns;
}

}  // namespace

std::optional<std::int64_t> read_duration(const Value& value, std::string_view example) {
  return read_duration(value, kDurationRule, example);
}

void read_duration_or_off(const Value& value, std::string_view example,
                          std::optional<std::int64_t>& ns) {
  if (value && value.is(Node::Kind::string) && value.node().text == "off") {
    ns.reset();
  } else if (const auto read =
                 read_duration(value, fmt::format("{}, or \"off\"", kDurationRule), example)) {
    ns = *read;
  }
}

}  // namespace adstar::scene
