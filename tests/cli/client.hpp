#pragma once
// The client as the tests run it: from the root of the sources, compared with golden files.
//
// ADSTAR_UPDATE_GOLDEN=1 writes the golden files instead of comparing with them.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/process.hpp"

namespace adstar::testing {

inline std::vector<std::string> client_argv(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ADSTAR_CLI);
  return arguments;
}

inline Outcome client(std::vector<std::string> arguments) {
  return run(client_argv(std::move(arguments)), {ADSTAR_SOURCE_DIR, {}});
}

/// Through bash, for pipes; $ADSTAR is the client.
inline Outcome shell(const std::string& script) {
  return run({"bash", "-c", script}, {ADSTAR_SOURCE_DIR, {std::string("ADSTAR=") + ADSTAR_CLI}});
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void expect_golden(const std::string& name, const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(ADSTAR_SOURCE_DIR) / "tests/cli/golden" / (name + ".txt");
  if (std::getenv("ADSTAR_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file, std::ios::binary) << text;
    return;
  }
  ASSERT_TRUE(std::filesystem::exists(file)) << file << " is missing";
  EXPECT_EQ(text, read_text(file)) << "differs from " << file;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

/// A directory of this test's own, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "adstar-cli-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("mkdtemp failed");
    }
    path_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace adstar::testing
