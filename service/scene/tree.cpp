#include "service/scene/tree.hpp"

#include <algorithm>
#include <sstream>

#include "service/scene/scene.hpp"
#include "service/scene/toml_library.hpp"

namespace adstar::scene {
namespace {

Place place_of(const toml::source_region& source) {
  // Tables that nobody wrote down (the root, parents in dotted headers) have no position.
  return {std::max<std::uint32_t>(1, source.begin.line),
          std::max<std::uint32_t>(1, source.begin.column)};
}

template <class T>
std::string iso_text(const T& date_time) {
  std::ostringstream out;
  out << date_time;
  return out.str();
}

Node convert(const toml::node& source);

void convert_table(const toml::table& table, Node& node) {
  node.kind = Node::Kind::table;
  for (const auto& [key, value] : table) {
    node.entries.push_back({std::string(key.str()), place_of(key.source()), convert(value)});
  }
  std::stable_sort(node.entries.begin(), node.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.place < b.place; });
}

Node convert(const toml::node& source) {
  Node node;
  node.place = place_of(source.source());
  if (const toml::table* table = source.as_table()) {
    convert_table(*table, node);
  } else if (const toml::array* array = source.as_array()) {
    node.kind = Node::Kind::array;
    node.items.reserve(array->size());
    for (const toml::node& item : *array) {
      node.items.push_back(convert(item));
    }
  } else if (const auto* text = source.as_string()) {
    node.kind = Node::Kind::string;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.kind = Node::Kind::integer;
    node.integer = integer->get();
    node.real = static_cast<double>(node.integer);
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Node::Kind::real;
    node.real = real->get();
  } else if (const auto* boolean = source.as_boolean()) {
    node.kind = Node::Kind::boolean;
    node.boolean = boolean->get();
  } else {
    node.kind = Node::Kind::date_time;
    if (const auto* date_time = source.as_date_time()) {
      node.text = iso_text(date_time->get());
    } else if (const auto* date = source.as_date()) {
      node.text = iso_text(date->get());
    } else if (const auto* time = source.as_time()) {
      node.text = iso_text(time->get());
    }
  }
  return node;
}

std::string_view line_at(std::string_view text, std::uint32_t line) {
  for (std::uint32_t i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) {
      return {};
    }
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string syntax_remedy(std::string_view line, std::string_view description) {
  if (description.find("redefine") != std::string_view::npos) {
    return "removing or renaming one of the two";
  }
  if (description.find("parsing date") != std::string_view::npos ||
      description.find("parsing time") != std::string_view::npos) {
    return "a date of the calendar such as 2026-01-01T00:00:00Z";
  }
  const std::size_t equals = line.find('=');
  if (equals != std::string_view::npos) {
    const std::string_view key = trimmed(line.substr(0, equals));
    std::string_view value = line.substr(equals + 1);
    value = trimmed(value.substr(0, value.find('#')));
    constexpr std::string_view kBareKey =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.";
    if (!key.empty() && key.find_first_not_of(kBareKey) == std::string_view::npos &&
        !value.empty() && value.find_first_of("\"'[]{}=") == std::string_view::npos) {
      return std::string(key) + " = " + in_quotes(value) + " if it is meant as a text";
    }
  }
  return "key = value, with texts in quotes, brackets closed and one key a line";
}

}  // namespace

Node parse_tree(std::string_view text, const std::string& file) {
  try {
    const toml::table root = toml::parse(text, file);
    Node node;
    convert_table(root, node);
    return node;
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    std::string description(error.description());
    std::replace(description.begin(), description.end(), '\n', ' ');
    throw SceneError({complaint_line(file, place, "syntax", "\"" + description + "\"", "TOML 1.0",
                                     syntax_remedy(line_at(text, place.line), description))});
  }
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::table:
      return "a table";
    case Node::Kind::array: {
      constexpr std::size_t kShown = 4;
      const bool numbers = std::all_of(node.items.begin(), node.items.end(),
                                       [](const Node& item) { return item.is_number(); });
      if (!numbers || node.items.size() > kShown) {
        return "an array of " + std::to_string(node.items.size());
      }
      std::string list = "[";
      for (const Node& item : node.items) {
        list += (list.size() > 1 ? ", " : "") + describe(item);
      }
      return list + "]";
    }
    case Node::Kind::string:
      return in_quotes(node.text);
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::real:
      return number_text(node.real);
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::date_time:
      return node.text;
  }
  return "nothing";
}

}  // namespace adstar::scene
