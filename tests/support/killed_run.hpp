#pragma once
// A run in a directory of its own, which a test kills, damages and goes on with.

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/recorded_flight.hpp"

namespace adstar::run {

namespace fs = std::filesystem;
using test::RecordedFlight;

class KilledRun : public testing::Test {
 protected:
  KilledRun() {
    std::string pattern = (fs::temp_directory_path() / "adstar-run.XXXXXX").string();
    path_ = mkdtemp(pattern.data());
    static std::uint64_t next = 0;
    run_ = (static_cast<std::uint64_t>(getpid()) << 32) + ++next;
  }
  ~KilledRun() override {
    HotJournalFile::remove(facts_of_memory());
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path newest(const std::string& prefix) const {
    fs::path found;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
      if (entry.path().filename().string().starts_with(prefix) && entry.path() > found) {
        found = entry.path();
      }
    }
    return found;
  }

  RunFacts facts_of_memory() const { return {.run = run_}; }

  static void flip_a_bit(const fs::path& file, std::int64_t at) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    const std::int64_t size = static_cast<std::int64_t>(fs::file_size(file));
    const std::int64_t place = at < 0 ? size + at : at;
    stream.seekg(place);
    const char byte = static_cast<char>(stream.get() ^ 0x10);
    stream.seekp(place);
    stream.put(byte);
  }

  static void expect_same(const RecordedFlight& flight, std::uint64_t seed, std::uint64_t until) {
    RecordedFlight never_killed(seed);
    never_killed.run_to(until);
    ASSERT_EQ(flight.step(), until);
    EXPECT_EQ(flight.hash(), never_killed.hash());
    EXPECT_EQ(flight.schedule(), never_killed.schedule());
  }

  fs::path path_;
  std::uint64_t run_ = 0;
};

}  // namespace adstar::run
