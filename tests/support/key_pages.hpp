#pragma once
// What the pages on scenes say of keys, table by table of TOML. Where they say it, in a section:
//
//   a table headed `key` or "key of `[x]`"     the first column has the keys of x; without x, of the table that begins
//                                              a line of the section: `[[spacecraft.wheel]]`, as many as ...
//   a table headed "block"                     a row begins with its `[x]`, the second column has the keys
//   a table headed `[x] model`                 a row begins with a value of that key; the second column has the keys
//                                              that go with it, if "keys" is its heading
//   `[x]`: `one`, `other` (of which ...); ...  in the text
//
// A row that begins with none is about all rows above it. What stands in parentheses is no key.

#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adstar::test {

using Words = std::set<std::string>;

/// A table of TOML, `[[spacecraft.torque]]`, and what it must hold to have the keys that are meant: `model = "table"`.
struct KeyTable {
  std::string name, choice;
  auto operator<=>(const KeyTable&) const = default;
};

struct KeyPages {
  std::map<std::pair<std::string, KeyTable>, Words> keys;        ///< by page and section, and table
  std::map<std::pair<std::string, std::string>, Words> choices;  ///< by table and key
};

/// What matches in order, the first group of each.
inline std::vector<std::string> all_of(const std::string& text, const char* expression) {
  const std::regex regex(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
    found.push_back(i->str(1));
  }
  return found;
}

inline Words listed(const std::string& text) {
  std::string outside;
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : 0;
    outside += depth == 0 ? c : ' ';
    depth -= c == ')' ? 1 : 0;
  }
  const auto keys = all_of(outside, "`([a-z0-9_]+)(?: = [^`]*)?`");
  return {keys.begin(), keys.end()};
}

/// One table of Markdown at a time.
class KeyTableReader {
 public:
  KeyTableReader(KeyPages& pages, std::string section, std::string about,
                 const std::vector<std::string>& head)
      : pages_(pages), section_(std::move(section)), about_(std::move(about)) {
    if (const auto named = all_of(head[0], "(\\[+[a-z0-9_.]+\\]+)"); !named.empty()) {
      about_ = named[0];
    }
    const auto choice = all_of(head[0], "^`(?:\\[+[a-z0-9_.]+\\]+ )?([a-z_]+)`$");
    kind_ = head[0].starts_with("key") ? Kind::keys
            : head[0] == "block"       ? Kind::blocks
            : !choice.empty()          ? Kind::choices
                                       : Kind::none;
    key_ = choice.empty() ? "" : choice[0];
    choices_have_keys_ = head.size() > 1 && head[1].find("keys") != std::string::npos;
  }

  void read_row(const std::vector<std::string>& cells) {
    if (kind_ == Kind::keys) {
      add({about_, ""}, listed(cells[0]));
    } else if (kind_ == Kind::blocks) {
      std::vector<KeyTable> named;
      for (const std::string& name : all_of(cells[0], "`(\\[+[a-z0-9_.]+\\]+)`")) {
        named.push_back({name, ""});
      }
      add_row(named, listed(cells[1]));
    } else if (kind_ == Kind::choices) {
      std::vector<KeyTable> named;
      for (const std::string& value : all_of(cells[0], "`\"([a-z0-9_]+)\"`")) {
        pages_.choices[{about_, key_}].insert(value);
        named.push_back({about_, key_ + " = \"" + value + '"'});
      }
      if (choices_have_keys_) {
        Words keys = listed(cells[1]);
        keys.insert(key_);
        add_row(named, keys);
      }
    }
  }

 private:
  enum class Kind { none, keys, blocks, choices };

  void add(const KeyTable& table, const Words& keys) {
    pages_.keys[{section_, table}].insert(keys.begin(), keys.end());
  }
  void add_row(const std::vector<KeyTable>& named, const Words& keys) {
    for (const KeyTable& table : named.empty() ? above_ : named) {
      add(table, keys);
    }
    above_.insert(above_.end(), named.begin(), named.end());
  }

  KeyPages& pages_;
  std::string section_, about_, key_;
  Kind kind_ = Kind::none;
  bool choices_have_keys_ = false;
  std::vector<KeyTable> above_;
};

/// Adds what one page says. Throws std::runtime_error when there is no such file.
inline void read_key_page(const std::string& file, const std::string& name, KeyPages& pages) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::runtime_error("cannot read " + file);
  }
  std::string section, about;
  std::optional<KeyTableReader> table;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) {
      section = name + ", " + line.substr(line.find(' ') + 1);
      about.clear();
    }
    if (const auto begins = all_of(line, "^`(\\[+[a-z0-9_.]+\\]+)`"); !begins.empty()) {
      about = begins[0];
    }
    std::smatch match;
    if (std::regex_search(line, match, std::regex("`(\\[+[a-z0-9_.]+\\]+)`: (`[^;.]*)"))) {
      pages.keys[{section, {match[1], ""}}].merge(listed(match[2]));
    }
    if (!line.starts_with('|')) {
      table.reset();
      continue;
    }
    const std::vector<std::string> cells = all_of(line, "\\| *([^|]*[^| ])");
    if (!table) {
      table.emplace(pages, section, about, cells);
    } else if (!line.starts_with("|-")) {
      table->read_row(cells);
    }
  }
}

}  // namespace adstar::test
