// Recordings that have lost files or a part of one: what is left is read, what is lost is told, and its proof is kept.

#include <cstdlib>

#include <gtest/gtest.h>

#include "bags.hpp"
#include "service/bag/sqlite.hpp"

namespace adstar::bag {
namespace {

/// Four files of three messages each.
class Lost : public Bags {
 protected:
  void record() const {
    RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
    for (int i = 0; i < 12; ++i) {
      bag.add(0, i * kSecond, bytes(10, i));
    }
    ASSERT_EQ(bag.finish().files.size(), 4U);
  }
  fs::path file(const std::string& name) const { return home_ / "bag" / name; }
  void empty(const std::string& name) const { std::ofstream(file(name)).flush(); }
  void rewrite_metadata(const std::string& text) const {
    std::ofstream(file("metadata.yaml")) << text;
  }

  Recording::Ending ending() const { return Recording(home_ / "bag").ending(); }
  std::string lost() const { return Recording(home_ / "bag").lost(); }
  /// And is not mended.
  void expect_lost(const std::string& what) const {
    const std::string before = text_of("metadata.yaml");
    const Recording recording(home_ / "bag");
    EXPECT_EQ(recording.ending(), Recording::Ending::incomplete);
    EXPECT_EQ(recording.lost(),
              "'" + (home_ / "bag").string() + "' " + what +
                  "; this is what is left; bring the rest back if there is a copy");
    EXPECT_FALSE(recording.mend());
    EXPECT_EQ(text_of("metadata.yaml"), before);
  }
};

TEST_F(Lost, a_file_that_is_gone_is_told_until_it_is_back) {
  record();
  fs::rename(file("bag_1.db3"), home_ / "away");
  expect_lost("has 9 of the 12 messages that its metadata.yaml tells of: bag_1.db3 is missing");
  EXPECT_EQ(read().size(), 9U);
  fs::rename(home_ / "away", file("bag_1.db3"));
  EXPECT_EQ(ending(), Recording::Ending::ended);
  EXPECT_EQ(lost(), "");
}

TEST_F(Lost, files_that_are_empty_are_told_though_they_are_all) {
  record();
  empty("bag_3.db3");
  expect_lost("has 9 of the 12 messages that its metadata.yaml tells of: bag_3.db3 is empty");
  for (const char* name : {"bag_0.db3", "bag_1.db3", "bag_2.db3"}) {
    empty(name);
  }
  expect_lost(
      "has 0 of the 12 messages that its metadata.yaml tells of: bag_0.db3 is empty, bag_1.db3 is "
      "empty, bag_2.db3 is empty, bag_3.db3 is empty");
}

TEST_F(Lost, messages_of_a_file_are_told) {
  record();
  Database(file("bag_2.db3"), Database::Mode::open).run("DELETE FROM messages WHERE id > 1");
  expect_lost(
      "has 10 of the 12 messages that its metadata.yaml tells of: bag_2.db3 has 1 of its 3");
}

TEST_F(Lost, messages_that_nobody_can_read_because_their_topics_are_gone_are_told) {
  record();
  Database(file("bag_2.db3"), Database::Mode::open).run("DELETE FROM topics");
  expect_lost("has 9 of the 12 messages that its metadata.yaml tells of: bag_2.db3 has 0 of its 3");
}

TEST_F(Lost, a_file_is_told_though_another_has_more_than_was_told) {
  record();
  Database grown(file("bag_3.db3"), Database::Mode::open);
  for (int i = 0; i < 5; ++i) {
    grown.run("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, 2, x'00')");
  }
  fs::remove(file("bag_0.db3"));
  expect_lost("has lost a part, by its metadata.yaml: bag_0.db3 is missing");
}

TEST_F(Lost, files_are_told_by_their_numbers_where_there_is_no_metadata) {
  record();
  fs::remove(file("metadata.yaml"));
  empty("bag_3.db3");
  EXPECT_EQ(ending(), Recording::Ending::cut_off) << "its recorder was killed as it began the last";
  fs::remove(file("bag_0.db3"));
  empty("bag_1.db3");
  expect_lost(
      "has lost a part, by the numbers of its files: bag_0.db3 is missing, bag_1.db3 is empty");
  EXPECT_EQ(read().size(), 3U);
}

TEST_F(Lost, more_files_than_anybody_reads_are_counted) {
  record();
  fs::remove(file("metadata.yaml"));
  fs::rename(file("bag_3.db3"), file("bag_10.db3"));
  expect_lost(
      "has lost a part, by the numbers of its files: bag_3.db3 is missing, bag_4.db3 is missing, "
      "bag_5.db3 is missing, bag_6.db3 is missing, bag_7.db3 is missing, and 2 more");
}

TEST_F(Lost, numbers_that_no_recorder_counts_up_to_are_no_gap) {
  record();
  fs::remove(file("metadata.yaml"));
  fs::rename(file("bag_3.db3"), file("bag_20260101.db3"));
  EXPECT_EQ(ending(), Recording::Ending::cut_off);
}

TEST_F(Lost, files_that_were_renamed_are_not) {
  record();
  fs::rename(file("bag_1.db3"), file("monday_1.db3"));
  EXPECT_EQ(ending(), Recording::Ending::ended);
  EXPECT_EQ(read().size(), 12U);
}

TEST_F(Lost, names_are_understood_as_they_were_written) {
  const std::string name = "a \"b\" \\x41\n\x01_";
  {
    RollingWriter bag(home_ / "bag" / name, kTopics, {{}, kSecond});
    for (int i = 0; i < 2; ++i) {
      bag.add(0, i * kSecond, bytes(10, i));
    }
    bag.finish();
  }
  Database(home_ / "bag" / name / (name + "_1.db3"), Database::Mode::open)
      .run("DELETE FROM messages");
  EXPECT_NE(Recording(home_ / "bag" / name).lost().find(": " + name + "_1.db3 has 0 of its 1;"),
            std::string::npos);
}

TEST_F(Lost, metadata_of_rosbag2_has_names_without_quotes) {
  record();
  rewrite_metadata(
      "rosbag2_bagfile_information:\n  version: 5\n  message_count: 12\n"
      "  topics_with_message_count:\n    - topic_metadata:\n        name: /a\n"
      "      message_count: 12\n"
      "  relative_file_paths:\n    - bag_0.db3\n    - bag_1.db3\n"
      "  files:\n    - path: bag_0.db3\n      message_count: 9\n"
      "    - path: bag_1.db3\n      message_count: 3\n");
  EXPECT_EQ(ending(), Recording::Ending::ended);
  for (const char* name : {"bag_1.db3", "bag_2.db3", "bag_3.db3"}) {
    fs::remove(file(name));
  }
  expect_lost(
      "has 3 of the 12 messages that its metadata.yaml tells of: bag_0.db3 has 3 of its 9, "
      "bag_1.db3 is missing");
}

std::string refusal_of(const fs::path& directory) {
  try {
    const Recording recording(directory);
    recording.ending();
    return "read as good";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST_F(Lost, a_file_that_was_cut_short_is_refused_and_the_others_are_read_without_it) {
  record();
  const fs::path cut = file("bag_1.db3");
  for (const std::uintmax_t less : {1, 100, 3'996, 1, 4'095}) {
    fs::resize_file(cut, fs::file_size(cut) - less);
    EXPECT_EQ(
        refusal_of(home_ / "bag").rfind("'" + cut.string() + "': database disk image is malf", 0),
        0U)
        << refusal_of(home_ / "bag");
  }
  fs::rename(cut, file("bag_1.db3.damaged"));
  expect_lost("has 9 of the 12 messages that its metadata.yaml tells of: bag_1.db3 is missing");
  EXPECT_EQ(read().size(), 9U);
}

TEST_F(Lost, what_is_no_database_is_to_be_moved_away) {
  record();
  std::ofstream(file("bag_1.db3")) << std::string(8192, 'x');
  EXPECT_NE(refusal_of(home_ / "bag").find("file is not a database; is it a recording?"),
            std::string::npos);
  EXPECT_NE(refusal_of(home_ / "bag").find("move it away"), std::string::npos);
}

void replace(std::string& text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, what.size(), with);
}

TEST_F(Lost, a_damaged_file_is_saved_as_its_refusal_says) {
  if (std::system("command -v sqlite3 >/dev/null") != 0) {
    GTEST_SKIP() << "needs the program sqlite3";
  }
  record();
  const fs::path damaged = file("bag_1.db3");
  fs::resize_file(damaged, fs::file_size(damaged) - 4096);  // of the index
  const std::string refusal = refusal_of(home_ / "bag");
  const std::size_t begin = refusal.find('`') + 1;
  std::string command = refusal.substr(begin, refusal.find('`', begin) - begin);
  replace(command, "FILE", damaged.string());
  replace(command, "NEW", (home_ / "new").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  fs::rename(home_ / "new", damaged);
  EXPECT_EQ(ending(), Recording::Ending::ended);
  EXPECT_EQ(read().size(), 12U);
}

TEST_F(Lost, nothing_is_by_a_recorder_that_began_a_file_and_ended_after_it_was_opened) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
  bag.add(0, 0, bytes(10, 0));
  bag.commit();
  const Recording recording(home_ / "bag");
  bag.add(0, 3 * kSecond, bytes(10, 1));
  bag.finish();
  EXPECT_EQ(recording.ending(), Recording::Ending::still_recorded);
  EXPECT_FALSE(recording.mend());
  EXPECT_EQ(ending(), Recording::Ending::ended);
}

}  // namespace
}  // namespace adstar::bag
