// The pages that adstar-scene(5) is made of, held against the reader of scenes: it names its keys when it refuses one.

#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "tests/support/key_pages.hpp"

namespace adstar::scene {
namespace {

using test::KeyPages;
using test::KeyTable;
using test::Words;

KeyPages pages() {
  KeyPages all;
  for (const char* page : {"scene/README.md", "pages/models.md", "pages/runs.md", "pages/ros2.md",
                           "pages/timing.md"}) {
    read_key_page(std::string(ADSTAR_SOURCE_DIR) + "/service/" + page, page, all);
  }
  return all;
}

const std::string kTorque = "[[spacecraft.torque]]", kBody = "[[spacecraft.body]]",
                  kJoint = "[[spacecraft.joint]]", kChain = "[[spacecraft.chain]]";

/// `line` in a table that needs no other key, as far as its own keys go.
std::string in_table(const KeyTable& table, const std::string& line) {
  const bool in_spacecraft = table.name.find("[spacecraft.") != std::string::npos;
  std::string outer = in_spacecraft ? "[[spacecraft]]\n" : "";
  for (const char* const block : {"body", "chain"}) {
    if (table.name.find("[spacecraft." + std::string(block) + '.') != std::string::npos) {
      outer += "[[spacecraft." + std::string(block) + "]]\n";
    }
  }
  const bool jointed = table.name == kJoint || table.name == kChain;
  return outer + table.name + '\n' + table.choice + '\n' +
         (jointed && line.find("kind") != 0 ? "kind = \"revolute\"\n" : "") + line + '\n';
}

/// What the reader expects in place of what is wrong; empty when it says nothing of it.
std::string expected_by_the_reader(const std::string& text, const std::string& wrong) {
  std::istringstream complaints(refusal(text));
  const std::regex sought(wrong + ", expected (.*); try .*");
  for (std::string line; std::getline(complaints, line);) {
    if (std::smatch match; std::regex_search(line, match, sought)) {
      return match[1];
    }
  }
  return {};
}

Words words_of_choice(const std::string& expected) {
  const auto words = test::all_of(expected, "([a-z0-9_]+)");
  return expected.starts_with("one of ") ? Words(words.begin() + 2, words.end()) : Words{};
}

Words keys_in(const std::string& text) {
  return words_of_choice(expected_by_the_reader(text, "xyzzy: got an unknown key"));
}

Words keys_of(const KeyTable& table) { return keys_in(in_table(table, "xyzzy = 1")); }

Words choices_of(const KeyTable& table, const std::string& key) {
  return words_of_choice(
      expected_by_the_reader(in_table(table, key + " = \"xyzzy\""), key + ": got \"xyzzy\""));
}

/// What linked bodies add to a torque.
Words keys_of_torques_on_bodies() {
  const KeyTable damping{kTorque, "model = \"damping\""};
  const std::string text = in_table(damping, "xyzzy = 1");
  const std::string spacecraft = "[[spacecraft]]\n";
  Words keys = keys_in(spacecraft + kBody + '\n' + text.substr(spacecraft.size()));
  for (const std::string& key : keys_of(damping)) {
    keys.erase(key);
  }
  return keys;
}

TEST(SceneManual, has_the_keys_of_each_table_that_the_reader_has) {
  for (auto [where, keys] : pages().keys) {
    const auto& [section, table] = where;
    if (table.name == kChain) {
      keys.merge(keys_of({kBody, ""}));
      keys.merge(keys_of({kJoint, ""}));
      keys.erase("to");
    }
    const bool on_bodies = table.name == kTorque && table.choice.empty();
    EXPECT_EQ(keys, on_bodies ? keys_of_torques_on_bodies() : keys_of(table))
        << section << ", " << table.name << ' ' << table.choice;
  }
}

/// A key for which the reader expects a table, or some, has a list of its own.
TEST(SceneManual, has_every_table_that_the_reader_has) {
  Words on_pages, expected;
  for (const auto& [where, keys] : pages().keys) {
    const std::string& name = where.second.name;
    const std::string plain = test::all_of(name, "([a-z0-9_.]+)").at(0);
    on_pages.insert(plain);
    for (const std::string& key : keys_of(where.second)) {
      const std::string asked =
          expected_by_the_reader(in_table(where.second, key + " = 1"), key + ": got 1");
      if (asked == "a table" || asked == "an array of tables") {
        expected.insert(plain + '.' + key);
      }
    }
  }
  expected.merge(keys_in("xyzzy = 1"));
  EXPECT_EQ(on_pages, expected);
}

TEST(SceneManual, has_the_values_of_each_key_that_has_a_table_of_them) {
  const auto choices = pages().choices;
  Words which;
  for (const auto& [of, values] : choices) {
    const auto& [table, key] = of;
    which.insert(table + ' ' + key);
    EXPECT_EQ(values, choices_of({table, ""}, key)) << table << ' ' << key;
  }
  EXPECT_EQ(which, (Words{kTorque + " model", kJoint + " kind", "[budget] on_overrun",
                          "[spacecraft.orbit] model"}));
}

}  // namespace
}  // namespace adstar::scene
