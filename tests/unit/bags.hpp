#pragma once
// Recordings in a directory of the test's own: written, and read again.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "service/bag/recorder.hpp"
#include "service/bag/recording.hpp"

namespace adstar::bag {

namespace fs = std::filesystem;

inline constexpr std::int64_t kSecond = 1'000'000'000;

class Bags : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "adstar-bag-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    home_ = pattern;
  }
  void TearDown() override { fs::remove_all(home_); }

  RollingWriter writer(const Rolling& rolling = {}) const {
    return {home_ / "bag", kTopics, rolling};
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(home_ / "bag" / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// By the version of its format (sqlite.org/fileformat2.html, 1.3.3): 2 with a write-ahead log, 1 without.
  bool wants_log(const std::string& name) const {
    constexpr std::size_t kWriteVersion = 18, kReadVersion = 19;
    const std::string file = text_of(name);
    EXPECT_EQ(file.at(kWriteVersion), file.at(kReadVersion));
    return file.at(kWriteVersion) == 2;
  }

  static std::vector<std::byte> bytes(std::size_t count, int first) {
    std::vector<std::byte> block(count);
    for (std::size_t i = 0; i < count; ++i) {
      block[i] = static_cast<std::byte>(static_cast<std::size_t>(first) + i);
    }
    return block;
  }

  struct Read {
    std::string topic;
    std::int64_t received_ns;
    std::vector<std::byte> payload;
  };
  std::vector<Read> read(const std::vector<std::string>& topics = {"/a", "/b"}) const {
    std::vector<Read> all;
    Recording(home_ / "bag").for_each(topics, [&](const Message& m) {
      all.push_back({m.topic, m.received_ns, {m.payload.begin(), m.payload.end()}});
    });
    return all;
  }

  const std::vector<TopicInfo> kTopics{{"/a", "adstar/msg/A", "- history: 1\n  depth: 2"},
                                       {"/b", "adstar/msg/B", ""}};
  fs::path home_;
};

}  // namespace adstar::bag
