#pragma once
// A parsed TOML text as plain nodes that know their place. Only tree.cpp sees toml++, which is slow
// to compile.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "service/scene/complaints.hpp"

namespace adstar::scene {

struct Entry;

struct Node {
  enum class Kind { table, array, string, integer, real, boolean, date_time };

  Kind kind = Kind::table;
  Place place;
  std::string text;  ///< of a string; of a date-time in ISO 8601
  std::int64_t integer = 0;
  double real = 0.0;  ///< of an integer too
  bool boolean = false;
  std::vector<Node> items;     ///< of an array
  std::vector<Entry> entries;  ///< of a table, in the order of the file

  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
};

struct Entry {
  std::string key;
  Place place;
  Node node;
};

/// The root table; throws SceneError with one line when `text` is not TOML.
Node parse_tree(std::string_view text, const std::string& file);

/// For the "got" of a complaint: a short value itself, else what it is.
std::string describe(const Node& node);

}  // namespace adstar::scene
