#include "service/scene/keys.hpp"

#include <algorithm>

#include "service/scene/nearest.hpp"

namespace adstar::scene {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || c == '-';
}

/// Keys in quotes may hold anything, line breaks too.
std::string as_written(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), is_name_character) ? std::string(key)
                                                                                : in_quotes(key);
}

}  // namespace

Keys::Keys(const Value& value, std::string_view example)
    : path_(value.path()), complaints_(&value.complaints()) {
  if (value.is(Node::Kind::table)) {
    table_ = &value.node();
  } else {
    broken_ = true;
    value.refuse("a table", example);
  }
}

std::string Keys::path_of(std::string_view key) const {
  std::string path = path_;
  if (!path.empty()) {
    path += '.';
  }
  path += key;
  return path;
}

Value Keys::optional(std::string_view key) {
  asked_.push_back(key);
  if (table_ != nullptr) {
    for (const Entry& entry : table_->entries) {
      if (entry.key == key) {
        return {entry.node, path_of(key), *complaints_};
      }
    }
  }
  return {};
}

Value Keys::required(std::string_view key, const Want& want) {
  Value value = optional(key);
  if (!value) {
    miss(key, want);
  }
  return value;
}

void Keys::miss(std::string_view key, const Want& want) const {
  if (!broken_) {
    std::string remedy = std::string(key) + " = " + std::string(want.example);
    remedy += table_ == nullptr ? " under [" + path_ + ']' : "";
    complaints_->add(place(), path_of(key), "nothing", want.expected, remedy);
  }
}

Keys Keys::section(std::string_view key, std::string_view example) {
  const Value value = optional(key);
  return value ? Keys(value, example) : Keys(path_of(key), *complaints_);
}

void Keys::refuse_unknown() const {
  if (table_ == nullptr) {
    return;
  }
  for (const Entry& entry : table_->entries) {
    if (std::find(asked_.begin(), asked_.end(), entry.key) != asked_.end()) {
      continue;
    }
    const auto near = nearest_plausible(entry.key, asked_);
    complaints_->add(entry.place, path_of(as_written(entry.key)), "an unknown key",
                     "one of " + joined(asked_), near ? std::string(*near) : "removing it");
  }
}

std::optional<std::string> read_text(const Value& value, const Want& want) {
  if (!value) {
    return std::nullopt;
  }
  if (!value.is(Node::Kind::string)) {
    value.refuse(want.expected, want.example);
    return std::nullopt;
  }
  return value.node().text;
}

std::optional<bool> read_flag(const Value& value, std::string_view example) {
  if (!value) {
    return std::nullopt;
  }
  if (!value.is(Node::Kind::boolean)) {
    value.refuse("true or false", example);
    return std::nullopt;
  }
  return value.node().boolean;
}

std::optional<std::int64_t> read_integer(const Value& value, IntegerRange range, const Want& want) {
  if (!value) {
    return std::nullopt;
  }
  if (!value.is(Node::Kind::integer)) {
    value.refuse(want.expected, want.example);
    return std::nullopt;
  }
  const std::int64_t integer = value.node().integer;
  if (integer < range.least || integer > range.most) {
    value.refuse(want.expected, std::to_string(std::clamp(integer, range.least, range.most)));
    return std::nullopt;
  }
  return integer;
}

std::optional<double> read_number(const Value& value, const Want& want) {
  if (!value) {
    return std::nullopt;
  }
  if (!value.node().is_number() || !std::isfinite(value.node().real)) {
    value.refuse(want.expected, want.example);
    return std::nullopt;
  }
  return value.node().real;
}

std::optional<double> read_number(const Value& value, NumberRange range, const Want& want) {
  const auto number = read_number(value, want);
  if (number && (*number < range.least || *number > range.most)) {
    value.refuse(want.expected, number_text(std::clamp(*number, range.least, range.most)));
    return std::nullopt;
  }
  return number;
}

std::optional<double> read_positive(const Value& value, const Want& want, double most) {
  const auto number = read_number(value, want);
  if (number && (*number <= 0.0 || *number > most)) {
    value.refuse(want.expected, *number > most ? number_text(most) : std::string(want.example));
    return std::nullopt;
  }
  return number;
}

std::optional<Vec3<double>> read_vector(const Value& value, std::string_view example) {
  if (!value) {
    return std::nullopt;
  }
  if (!value.is(Node::Kind::array) || value.node().items.size() != 3) {
    value.refuse("an array of 3 numbers", example);
    return std::nullopt;
  }
  const Want component{"a finite number", "0.0"};
  const auto x = read_number(value.item(0), component);
  const auto y = read_number(value.item(1), component);
  const auto z = read_number(value.item(2), component);
  if (!x || !y || !z) {
    return std::nullopt;
  }
  return Vec3<double>{*x, *y, *z};
}

std::optional<std::size_t> read_choice(const Value& value,
                                       std::span<const std::string_view> names) {
  if (!value) {
    return std::nullopt;
  }
  const std::string& text = value.node().text;
  const auto found = std::find(names.begin(), names.end(), text);
  if (value.is(Node::Kind::string) && found != names.end()) {
    return static_cast<std::size_t>(found - names.begin());
  }
  value.refuse("one of " + joined(names), in_quotes(*nearest(text, names)));
  return std::nullopt;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= kLongestName &&
         std::all_of(text.begin(), text.end(), is_name_character);
}

std::string as_name(std::string_view text) {
  std::string name(text.substr(0, kLongestName));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_name_character(c); }, '_');
  return name.empty() ? "unnamed" : name;
}

std::string free_name(std::string_view name, const std::function<bool(const std::string&)>& taken) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t digits = 0;
  while (digits < std::min(kMostDigits, name.size()) && name[name.size() - 1 - digits] >= '0' &&
         name[name.size() - 1 - digits] <= '9') {
    ++digits;
  }
  const std::string stem(name.substr(0, name.size() - digits));
  unsigned long number = digits == 0 ? 1 : std::stoul(std::string(name.substr(stem.size())));
  std::string next;
  do {
    next = stem + std::to_string(++number);
  } while (taken(next));
  return next;
}

std::optional<std::string> read_name(const Value& value, std::string_view example) {
  const auto name = read_text(value, {kNameRule, example});
  if (name && !is_name(*name)) {
    value.refuse(kNameRule, name->empty() ? std::string(example) : in_quotes(as_name(*name)));
    return std::nullopt;
  }
  return name;
}

}  // namespace adstar::scene
