#pragma once
// A typed reader over one table: every wrong value becomes a complaint under its full path, every
// key that nobody asked for is refused by the name of the nearest that somebody did ask for.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adstar/vec3.hpp"
#include "service/scene/tree.hpp"

namespace adstar::scene {

/// What a key should hold, and an example that would do.
struct Want {
  std::string_view expected;
  std::string_view example;
};

/// A node and its path; empty when the key is absent.
class Value {
 public:
  Value() = default;
  Value(const Node& node, std::string path, Complaints& complaints)
      : node_(&node), path_(std::move(path)), complaints_(&complaints) {}

  explicit operator bool() const { return node_ != nullptr; }
  const Node& node() const { return *node_; }
  const std::string& path() const { return path_; }
  bool is(Node::Kind kind) const { return node_ != nullptr && node_->kind == kind; }
  Complaints& complaints() const { return *complaints_; }

  Value item(std::size_t i) const {
    return {node_->items[i], path_ + '[' + std::to_string(i) + ']', *complaints_};
  }
  void refuse(std::string_view expected, std::string_view remedy) const {
    refuse_as(describe(*node_), expected, remedy);
  }
  void refuse_as(std::string_view got, std::string_view expected, std::string_view remedy) const {
    complaints_->add(node_->place, path_, got, expected, remedy);
  }

 private:
  const Node* node_ = nullptr;
  std::string path_;
  Complaints* complaints_ = nullptr;
};

class Keys {
 public:
  /// The root of a file.
  Keys(const Node& root, Complaints& complaints) : table_(&root), complaints_(&complaints) {}
  /// `value` holds a table: else a complaint with `example`, and every key counts as absent without
  /// another word.
  Keys(const Value& value, std::string_view example);
  /// A section that the file leaves out: required keys are missed at the top of the file.
  Keys(std::string path, Complaints& complaints)
      : path_(std::move(path)), complaints_(&complaints) {}

  Value optional(std::string_view key);
  Value required(std::string_view key, const Want& want);

  /// The table `key`; when absent, as if it stood there empty.
  Keys section(std::string_view key, std::string_view example);

  /// Call last: complains of every key that was not asked for.
  void refuse_unknown() const;

  void miss(std::string_view key, const Want& want) const;
  const std::string& path() const { return path_; }
  Place place() const { return table_ != nullptr ? table_->place : Place{}; }
  Complaints& complaints() const { return *complaints_; }

 private:
  std::string path_of(std::string_view key) const;

  const Node* table_ = nullptr;
  bool broken_ = false;
  std::string path_;
  Complaints* complaints_;
  std::vector<std::string_view> asked_;
};

// Each of these gives nothing for an absent value, and a complaint and nothing for a wrong one.

std::optional<std::string> read_text(const Value& value, const Want& want);

std::optional<bool> read_flag(const Value& value, std::string_view example);

struct IntegerRange {
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};
std::optional<std::int64_t> read_integer(const Value& value, IntegerRange range, const Want& want);

/// Finite; integers too.
std::optional<double> read_number(const Value& value, const Want& want);

struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};
std::optional<double> read_number(const Value& value, NumberRange range, const Want& want);

/// Above zero, at most `most`.
std::optional<double> read_positive(const Value& value, const Want& want,
                                    double most = std::numeric_limits<double>::infinity());

std::optional<Vec3<double>> read_vector(const Value& value, std::string_view example);

/// The index of one of `names`.
std::optional<std::size_t> read_choice(const Value& value, std::span<const std::string_view> names);

/// 1 to 63 of A-Z a-z 0-9 _ . - as the DDS types carry them.
std::optional<std::string> read_name(const Value& value, std::string_view example);
bool is_name(std::string_view text);
inline constexpr std::size_t kLongestName = 63;
inline constexpr std::string_view kNameRule = "1 to 63 characters out of A-Z a-z 0-9 _ . -";
/// `text` with what no name may hold replaced and cut to length; never empty.
std::string as_name(std::string_view text);
/// `name` with the next number that is not taken: "sat1" → "sat2", "body" → "body2".
std::string free_name(std::string_view name, const std::function<bool(const std::string&)>& taken);

}  // namespace adstar::scene
