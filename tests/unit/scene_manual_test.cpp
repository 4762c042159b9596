// The pages that adstar-scene(5) is made of, held against the reader of scenes: it names its keys when it refuses one.

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

std::string page(const std::string& file) {
  std::ifstream stream(std::string(ADSTAR_SOURCE_DIR) + "/service/" + file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A scene with a key in every table that is none.
std::string scene_of_all_tables() {
  const std::string wrong = "xyzzy = 1\n";
  std::string text = wrong;
  for (const char* section : {"simulation", "earth", "telemetry", "budget", "run", "service",
                              "standby", "ros2", "dds", "dds.security", "log"}) {
    text += "[" + std::string(section) + "]\n" + wrong;
  }
  for (const char* orbit : {"kepler", "j2", "fixed", "oem"}) {
    text += "[[spacecraft]]\n" + wrong + "[spacecraft.orbit]\nmodel = \"" + orbit + "\"\n" + wrong;
  }
  text += "[spacecraft.pointing]\n" + wrong + "[spacecraft.box]\n" + wrong;
  for (const char* block : {"facet", "wheel"}) {
    text += "[[spacecraft." + std::string(block) + "]]\n" + wrong;
  }
  for (const char* model :
       {"constant", "harmonic", "table", "commanded", "damping", "gravity_gradient",
        "residual_dipole", "magnetorquer", "aerodynamic", "solar_pressure", "thruster"}) {
    text += "[[spacecraft.torque]]\nmodel = \"" + std::string(model) + "\"\n" + wrong;
  }
  text += "[[spacecraft]]\n" + wrong;
  for (const char* block : {"body", "joint", "chain"}) {
    text += "[[spacecraft." + std::string(block) + "]]\nkind = \"revolute\"\n" + wrong;
  }
  return text;
}

std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  const std::regex word("[a-z0-9_]+");
  for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i) {
    words.insert(i->str());
  }
  return words;
}

/// What stands between backticks.
std::set<std::string> words_in_code(const std::string& text) {
  std::string code;
  bool inside = false;
  for (const char c : text) {
    inside = inside != (c == '`');
    code += inside && c != '`' ? c : ' ';
  }
  return words_of(code);
}

struct Table {
  std::string path;
  std::set<std::string> keys;
};

std::vector<Table> tables_of_the_reader() {
  std::vector<Table> tables;
  std::istringstream complaints(refusal(scene_of_all_tables()));
  const std::regex unknown(R"((\S*)xyzzy: got an unknown key, expected one of (.*); try .*)");
  for (std::string line; std::getline(complaints, line);) {
    std::smatch match;
    if (std::regex_search(line, match, unknown)) {
      tables.push_back({match[1], words_of(match[2])});
    }
  }
  return tables;
}

TEST(SceneManual, has_every_key_that_the_reader_knows) {
  const std::set<std::string> pages =
      words_in_code(page("scene/README.md") + page("pages/models.md") + page("pages/timing.md") +
                    page("pages/runs.md") + page("pages/ros2.md"));
  const std::vector<Table> tables = tables_of_the_reader();
  EXPECT_EQ(tables.size(), 39U) << refusal(scene_of_all_tables());
  for (const Table& table : tables) {
    for (const std::string& key : table.keys) {
      EXPECT_TRUE(pages.contains(key))
          << table.path << key << " is in neither service/scene/README.md nor service/pages";
    }
  }
}

TEST(SceneManual, has_no_key_that_the_reader_does_not_know) {
  std::set<std::string> known{"min", "max", "w", "x", "y", "z"};  // within a value
  for (const Table& table : tables_of_the_reader()) {
    known.insert(table.keys.begin(), table.keys.end());
  }
  // First column of its tables; quotes are values.
  std::istringstream lines(page("scene/README.md"));
  const std::regex first_column(R"(^\| (`[^"|]*`) \|)");
  int keys = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, first_column)) {
      continue;
    }
    for (const std::string& key : words_in_code(match[1])) {
      EXPECT_TRUE(known.contains(key)) << key;
      ++keys;
    }
  }
  EXPECT_GT(keys, 50);
}

}  // namespace
}  // namespace adstar::scene
