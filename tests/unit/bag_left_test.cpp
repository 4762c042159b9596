// Recordings that nobody ended, and what is no recording: mended, waited for, or left as it is.

#include <map>
#include <optional>

#include <gtest/gtest.h>

#include "bags.hpp"
#include "service/bag/sqlite.hpp"

namespace adstar::bag {
namespace {

using namespace std::chrono_literals;

TEST_F(Bags, lost_metadata_is_made_anew_from_the_files_to_the_letter) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 4 * kSecond});
  for (int i = 0; i < 11; ++i) {
    bag.add(static_cast<std::size_t>(i % 3 == 0), i * kSecond, bytes(20, i));
  }
  bag.finish();
  const std::string before = text_of("metadata.yaml");
  EXPECT_EQ(Recording(home_ / "bag").ending(), Recording::Ending::ended);
  fs::remove(home_ / "bag" / "metadata.yaml");
  const Recording recording(home_ / "bag");
  EXPECT_EQ(recording.ending(), Recording::Ending::cut_off);
  EXPECT_TRUE(recording.mend());
  EXPECT_EQ(text_of("metadata.yaml"), before);
}

TEST_F(Bags, metadata_older_than_a_file_that_nobody_ended_is_made_anew) {
  fs::create_directory(home_ / "bag");
  FileWriter file(home_ / "bag" / "bag_0.db3", kTopics);
  file.add(0, 1, bytes(3, 1));
  file.commit();
  EXPECT_TRUE(Recording(home_ / "bag").mend());
  file.add(0, 2, bytes(3, 2));
  file.commit();
  const Recording recording(home_ / "bag");
  EXPECT_EQ(recording.ending(), Recording::Ending::cut_off);
  EXPECT_TRUE(recording.mend());
  EXPECT_NE(text_of("metadata.yaml").find("  message_count: 2"), std::string::npos);
}

TEST_F(Bags, metadata_of_a_recording_that_goes_on_is_its_recorders_to_write) {
  std::optional<RollingWriter> bag(writer());
  bag->add(0, 1, bytes(3, 1));
  bag->commit();
  const Recording recording(home_ / "bag");
  EXPECT_EQ(recording.ending(), Recording::Ending::still_recorded);
  EXPECT_FALSE(recording.mend());
  EXPECT_FALSE(fs::exists(home_ / "bag" / "metadata.yaml"));
  bag.reset();  // as a kill leaves it
  EXPECT_EQ(recording.ending(), Recording::Ending::cut_off);
  EXPECT_TRUE(recording.mend());
  EXPECT_EQ(recording.ending(), Recording::Ending::ended);
}

TEST_F(Bags, metadata_that_tells_less_than_the_files_have_is_made_anew) {
  RollingWriter bag = writer();
  bag.add(0, 1, bytes(3, 1));
  bag.finish();
  const Recording recording(home_ / "bag");
  EXPECT_EQ(recording.ending(), Recording::Ending::ended);
  {
    Database file(home_ / "bag" / "bag_0.db3", Database::Mode::open);
    file.run("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, 2, x'00')");
  }
  EXPECT_FALSE(fs::exists(home_ / "bag" / "bag_0.db3-wal"));
  EXPECT_EQ(recording.ending(), Recording::Ending::cut_off);
}

TEST_F(Bags, whoever_reads_stops_neither_a_new_file_nor_the_end) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
  struct HalfRead {
    explicit HalfRead(const fs::path& path)
        : file(path, Database::Mode::open), rows(file.prepare("SELECT data FROM messages")) {
      EXPECT_TRUE(rows.step());
    }
    Database file;
    Statement rows;
  };
  bag.add(0, 0, bytes(10, 0));
  bag.add(0, kSecond, bytes(10, 1));
  bag.commit();
  std::optional<HalfRead> first(home_ / "bag" / "bag_0.db3");
  bag.add(0, 3 * kSecond, bytes(10, 2));
  bag.commit();
  std::optional<HalfRead> second(home_ / "bag" / "bag_1.db3");
  bag.add(0, 4 * kSecond, bytes(10, 3));
  const Metadata& metadata = bag.finish();
  ASSERT_EQ(metadata.files.size(), 2U);
  EXPECT_EQ(metadata.messages(), 4U);
  EXPECT_NE(text_of("metadata.yaml").find("message_count: 4"), std::string::npos);
  EXPECT_EQ(read().size(), 4U) << "while they still read";
  first.reset();
  second.reset();
  EXPECT_EQ(read().size(), 4U);
  for (const char* name : {"bag_0.db3-wal", "bag_1.db3-wal"}) {
    EXPECT_FALSE(fs::exists(home_ / "bag" / name)) << "merged by whoever closed last";
  }
  EXPECT_TRUE(wants_log("bag_0.db3"));
  EXPECT_EQ(Recording(home_ / "bag").ending(), Recording::Ending::ended);
  EXPECT_FALSE(wants_log("bag_0.db3"));
  EXPECT_FALSE(wants_log("bag_1.db3"));
}

TEST_F(Bags, what_a_killed_recorder_left_is_plain_files_once_it_is_mended) {
  {
    RollingWriter killed = writer();
    killed.add(0, 1, bytes(3, 1));
    killed.commit();
  }
  EXPECT_TRUE(wants_log("bag_0.db3"));
  const Recording recording(home_ / "bag");
  EXPECT_TRUE(recording.mend());
  EXPECT_FALSE(wants_log("bag_0.db3"));
  EXPECT_EQ(read().size(), 1U);
}

TEST_F(Bags, a_file_that_was_only_begun_is_passed_over) {
  RollingWriter bag = writer();
  bag.add(0, 1, bytes(3, 1));
  bag.finish();
  std::ofstream(home_ / "bag" / "bag_1.db3").flush();
  EXPECT_EQ(read().size(), 1U);
}

/// Names and contents of all that is there.
std::map<std::string, std::string> files_in(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    std::ifstream file(entry.path(), std::ios::binary);
    files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

/// What is there is copied as a kill of its writer leaves it: without the log's index.
void copy_without_index(const fs::path& from, const fs::path& to) {
  fs::create_directory(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    if (!entry.path().string().ends_with("-shm")) {
      fs::copy(entry.path(), to / entry.path().filename());
    }
  }
}

std::string refusal_of(const fs::path& directory) {
  try {
    const Recording recording(directory);
    recording.ending();
    recording.mend();
    return "taken for a recording";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST_F(Bags, a_database_of_somebody_else_is_refused_and_left_as_it_is) {
  constexpr const char* kIsNone = "no tables 'topics' and 'messages'";
  fs::create_directory(home_ / "open");
  {
    // The URI's own letters are no part of it.
    Database theirs(home_ / "open" / "50%41?x#1.db3", Database::Mode::make);
    theirs.run("PRAGMA journal_mode=WAL");
    theirs.run("CREATE TABLE topics(mine TEXT)");
    theirs.run("INSERT INTO topics VALUES ('kept')");
    copy_without_index(home_ / "open", home_ / "killed");
    const auto before = files_in(home_ / "open");
    EXPECT_NE(refusal_of(home_ / "open").find(kIsNone), std::string::npos);
    auto after = files_in(home_ / "open");
    ASSERT_EQ(after.size(), 3U) << "it has a log and an index";
    for (const auto& [name, content] : before) {
      EXPECT_TRUE(name.ends_with("-shm") || after[name] == content) << name;
    }
    theirs.run("INSERT INTO topics VALUES ('and goes on')");
  }
  for (const auto& [directory, count] :
       {std::pair(home_ / "open", 1U), std::pair(home_ / "killed", 2U)}) {
    const auto before = files_in(directory);
    ASSERT_EQ(before.size(), count) << directory;
    EXPECT_NE(refusal_of(directory).find(kIsNone), std::string::npos) << refusal_of(directory);
    EXPECT_EQ(refusal_of(directory).rfind("'" + (directory / "50%41?x#1.db3").string(), 0), 0U);
    EXPECT_NE(refusal_of("/" + directory.string()).find(kIsNone), std::string::npos);
    EXPECT_TRUE(files_in(directory) == before) << directory;
  }
}

TEST_F(Bags, what_a_killed_recorder_left_is_known_by_its_log) {
  RollingWriter bag = writer();
  bag.add(0, 1, bytes(3, 1));
  bag.commit();
  copy_without_index(home_ / "bag", home_ / "killed");
  ASSERT_TRUE(fs::exists(home_ / "killed" / "bag_0.db3-wal"));
  const Recording recording(home_ / "killed");
  EXPECT_EQ(recording.ending(), Recording::Ending::cut_off);
  EXPECT_EQ(recording.count().messages(), 1U);
}

}  // namespace
}  // namespace adstar::bag
