#include "service/scene/fleet.hpp"

#include <cmath>

#include "adstar/trig.hpp"

namespace adstar::scene {
namespace {

/// One output of splitmix64 (Steele, Lea, Flood 2014): neighbouring inputs give unrelated seeds.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

double between(double min, double max, Draws& draws) { return min + draws.unit() * (max - min); }

}  // namespace

double Draws::unit() {
  if (!generator_) {
    generator_.emplace(mix(mix(seed_) + index_));
  }
  return static_cast<double>((*generator_)() >> 11U) * 0x1p-53;
}

Quat<double> draw_rotation(Draws& draws) {
  constexpr double kTwoPi = 0x1.921fb54442d18p+2;
  const double split = draws.unit();
  const SinCos<double> a = sincos(kTwoPi * draws.unit());
  const SinCos<double> b = sincos(kTwoPi * draws.unit());
  const double r = std::sqrt(1.0 - split), s = std::sqrt(split);
  return {s * b.cos, r * a.sin, r * a.cos, s * b.sin};
}

Vec3<double> RangedVector::value(Draws& draws) const {
  if (!drawn) {
    return min;
  }
  // Braces would do, but a reader need not know that they fix the order of evaluation.
  const double x = between(min.x, max.x, draws);
  const double y = between(min.y, max.y, draws);
  const double z = between(min.z, max.z, draws);
  return {x, y, z};
}

std::optional<RangedVector> read_ranged_vector(const Value& value, std::string_view example) {
  if (!value.is(Node::Kind::table)) {
    const auto fixed = read_vector(value, example);
    return fixed ? std::optional(RangedVector{*fixed, *fixed, false}) : std::nullopt;
  }
  Keys keys(value, example);
  const Value min_value = keys.required("min", {"an array of 3 numbers", example});
  const Value max_value = keys.required("max", {"an array of 3 numbers", example});
  keys.refuse_unknown();
  const auto min = read_vector(min_value, example);
  const auto max = read_vector(max_value, example);
  if (!min || !max) {
    return std::nullopt;
  }
  const Vec3<double> width = *max - *min;
  const double widths[] = {width.x, width.y, width.z};
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (widths[i] < 0.0) {
      min_value.item(i).refuse("a number up to max, " + describe(max_value.node().items[i]),
                               "exchanging the two");
      good = false;
    } else if (!std::isfinite(widths[i])) {
      min_value.item(i).refuse("a range whose width is a finite number", "a narrower range");
      good = false;
    }
  }
  return good ? std::optional(RangedVector{*min, *max, true}) : std::nullopt;
}

std::string NamePattern::name(std::uint64_t index) const {
  const std::string digits = std::to_string(index);
  std::string name = before;
  name.append(digits.size() < width ? width - digits.size() : 0, '0');
  return name + digits + after;
}

namespace {

constexpr std::string_view kPatternRule =
    "a name of 1 to 63 characters out of A-Z a-z 0-9 _ . - with one {} or {:05} for the index";

/// The braces' content: "" or ":0N".
std::optional<std::size_t> width_in(std::string_view format) {
  if (format.empty()) {
    return 0;
  }
  if (format.size() < 3 || format.size() > 4 || format.substr(0, 2) != ":0") {
    return std::nullopt;
  }
  std::size_t width = 0;
  for (const char c : format.substr(2)) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    width = width * 10 + static_cast<std::size_t>(c - '0');
  }
  return width;
}

std::optional<NamePattern> parse_pattern(std::string_view text) {
  const std::size_t open = text.find('{');
  const std::size_t close = text.find('}');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
    return std::nullopt;
  }
  const auto width = width_in(text.substr(open + 1, close - open - 1));
  if (!width) {
    return std::nullopt;
  }
  return NamePattern{std::string(text.substr(0, open)), std::string(text.substr(close + 1)),
                     *width};
}

std::string pattern_remedy(const std::string& text) {
  const std::string stem = as_name(text.substr(0, text.find('{')));
  constexpr std::size_t kRoom = kLongestName - 7;  // a million needs seven digits
  return in_quotes((text.empty() || text[0] == '{' ? "sat" : stem.substr(0, kRoom)) + "{}");
}

}  // namespace

std::optional<NamePattern> read_name_pattern(const Value& value, std::int64_t count) {
  const auto text = read_text(value, {kPatternRule, "\"sat{}\""});
  if (!text) {
    return std::nullopt;
  }
  const auto pattern = parse_pattern(*text);
  if (!pattern || !is_name(pattern->name(static_cast<std::uint64_t>(count - 1)))) {
    value.refuse(kPatternRule, pattern_remedy(*text));
    return std::nullopt;
  }
  return pattern;
}

}  // namespace adstar::scene
