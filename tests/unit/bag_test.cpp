// Recordings on disk: what is written is what is read, whatever file it is in, and nothing is lost in silence.

#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include <gtest/gtest.h>

#include "bags.hpp"
#include "service/bag/size.hpp"
#include "service/bag/sqlite.hpp"

namespace adstar::bag {
namespace {

using namespace std::chrono_literals;

TEST_F(Bags, what_was_written_is_read_in_its_order_over_all_files) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
  for (int i = 0; i < 25; ++i) {
    bag.add(static_cast<std::size_t>(i % 2), i * kSecond, bytes(10, i));
  }
  EXPECT_EQ(bag.finish().files.size(), 9U);
  const auto all = read();
  ASSERT_EQ(all.size(), 25U);
  for (int i = 0; i < 25; ++i) {
    const Read& m = all[static_cast<std::size_t>(i)];
    EXPECT_EQ(m.topic, i % 2 == 0 ? "/a" : "/b");
    EXPECT_EQ(m.received_ns, i * kSecond);
    EXPECT_EQ(m.payload, bytes(10, i));
  }
  EXPECT_EQ(read({"/b"}).size(), 12U);
  EXPECT_TRUE(read({"/never"}).empty());
}

TEST_F(Bags, what_was_written_is_read_in_its_order_though_the_clock_was_set_back) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
  for (int i = 0; i < 10; ++i) {
    bag.add(0, (i < 5 ? 100 + i : 90 + i) * kSecond, bytes(1, i));
  }
  const Metadata& metadata = bag.finish();
  EXPECT_EQ(metadata.first_ns(), 95 * kSecond);
  EXPECT_EQ(metadata.last_ns(), 104 * kSecond);
  const auto all = read();
  ASSERT_EQ(all.size(), 10U);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(all[static_cast<std::size_t>(i)].payload, bytes(1, i));
  }
}

TEST_F(Bags, whoever_reads_is_told_how_far_they_are_over_all_files) {
  RollingWriter out = writer({{}, 10 * kSecond});
  for (int i = 0; i < 20'000; ++i) {
    out.add(i % 2 == 0 ? 0 : 1, i * kSecond / 1000, bytes(3, i));
  }
  out.finish();
  Recording recording(home_ / "bag");
  std::vector<double> parts;
  recording.watch([&](double part) { parts.push_back(part); });
  for (const char* topic : {"/a", "/never"}) {
    parts.clear();
    recording.for_each({topic}, [](const Message&) {});
    ASSERT_EQ(parts.size(), 7U) << "each 4,096 rows of a file, whoever wants them";
    EXPECT_EQ(parts.front(), 0);
    EXPECT_NEAR(parts[1], 4096.0 / 20'000, 1e-3);
    EXPECT_NEAR(parts[4], (10'000 + 4096.0) / 20'000, 1e-3);
    EXPECT_EQ(parts.back(), 1);
  }
  recording.watch([](double part) {
    if (part > 0) {
      throw Error("enough");
    }
  });
  int read_rows = 0;
  EXPECT_THROW(recording.for_each({"/a"}, [&](const Message&) { ++read_rows; }), Error);
  EXPECT_EQ(read_rows, 4096 / 2) << "the others are of /b";
}

TEST_F(Bags, rows_that_stand_far_apart_are_read_like_others) {
  writer().finish();
  Database file(home_ / "bag" / "bag_0.db3", Database::Mode::open);
  for (const std::int64_t id : {std::int64_t{1}, std::int64_t{2}, std::int64_t{4'000'000'000'000},
                                std::numeric_limits<std::int64_t>::max()}) {
    file.prepare("INSERT INTO messages (id, topic_id, timestamp, data) VALUES (?, 1, ?, x'00')")
        .bind(1, id)
        .bind(2, id)
        .run();
  }
  const auto all = read();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[2].received_ns, 4'000'000'000'000);
  EXPECT_EQ(all[3].received_ns, std::numeric_limits<std::int64_t>::max());
}

TEST_F(Bags, a_file_spans_no_longer_than_it_may) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 3 * kSecond});
  for (int i = 0; i < 7; ++i) {
    bag.add(0, i * kSecond, bytes(1, i));
  }
  const Metadata& metadata = bag.finish();
  ASSERT_EQ(metadata.files.size(), 3U);
  EXPECT_EQ(metadata.files[0].name, "bag_0.db3");
  EXPECT_EQ(metadata.files[1].name, "bag_1.db3");
  EXPECT_EQ(metadata.files[1].first_ns, 3 * kSecond);
  EXPECT_EQ(metadata.files[1].last_ns, 5 * kSecond);
  EXPECT_EQ(metadata.files[2].messages, 1U);
}

TEST_F(Bags, a_file_grows_little_beyond_the_size_it_may_have) {
  constexpr std::uint64_t kMost = 200'000;
  RollingWriter bag = writer({.max_bytes = kMost, .max_duration_ns = {}});
  for (int i = 0; i < 2000; ++i) {
    bag.add(0, i, bytes(500, i));
  }
  const Metadata metadata = bag.finish();
  EXPECT_GT(metadata.files.size(), 4U);
  for (const FileInfo& file : metadata.files) {
    const auto size = fs::file_size(home_ / "bag" / file.name);
    EXPECT_LT(size, kMost + 20'000);
    if (file.name != metadata.files.back().name) {
      EXPECT_GE(size, kMost) << file.name;
    }
    EXPECT_FALSE(fs::exists(home_ / "bag" / (file.name + "-wal")));
  }
  EXPECT_EQ(read().size(), 2000U);
}

TEST_F(Bags, metadata_is_spelt_as_rosbag2_reads_it) {
  RollingWriter bag = writer({.max_bytes = {}, .max_duration_ns = 2 * kSecond});
  bag.add(0, 10 * kSecond, bytes(4, 0));
  bag.add(1, 11 * kSecond, bytes(4, 0));
  bag.add(0, 12 * kSecond, bytes(4, 0));
  bag.finish();
  EXPECT_EQ(text_of("metadata.yaml"), R"(rosbag2_bagfile_information:
  version: 5
  storage_identifier: sqlite3
  duration:
    nanoseconds: 2000000000
  starting_time:
    nanoseconds_since_epoch: 10000000000
  message_count: 3
  topics_with_message_count:
    - topic_metadata:
        name: /a
        type: adstar/msg/A
        serialization_format: cdr
        offered_qos_profiles: "- history: 1\n  depth: 2"
      message_count: 2
    - topic_metadata:
        name: /b
        type: adstar/msg/B
        serialization_format: cdr
        offered_qos_profiles: ""
      message_count: 1
  compression_format: ""
  compression_mode: ""
  relative_file_paths:
    - "bag_0.db3"
    - "bag_1.db3"
  files:
    - path: "bag_0.db3"
      starting_time:
        nanoseconds_since_epoch: 10000000000
      duration:
        nanoseconds: 1000000000
      message_count: 2
    - path: "bag_1.db3"
      starting_time:
        nanoseconds_since_epoch: 12000000000
      duration:
        nanoseconds: 0
      message_count: 1
)");
}

TEST_F(Bags, an_empty_recording_is_one) {
  writer().finish();
  EXPECT_TRUE(read().empty());
  EXPECT_NE(text_of("metadata.yaml").find("message_count: 0"), std::string::npos);
}

TEST_F(Bags, what_was_committed_is_there_without_an_end) {
  FileWriter file(home_ / "cut_0.db3", kTopics);
  file.add(0, 1, bytes(3, 1));
  file.commit();
  file.add(0, 2, bytes(3, 2));  // and nobody commits it
  std::size_t seen = 0;
  Recording(home_).for_each({"/a"}, [&](const Message& m) {
    ++seen;
    EXPECT_EQ(m.received_ns, 1);
  });
  EXPECT_EQ(seen, 1U);
}

TEST_F(Bags, nothing_is_written_over_and_nothing_else_is_taken_for_a_recording) {
  writer().finish();
  EXPECT_THROW(writer(), Error);
  EXPECT_THROW(Recording(home_ / "nowhere"), Error);
  fs::create_directory(home_ / "empty");
  EXPECT_THROW(Recording(home_ / "empty"), Error);
  std::ofstream(home_ / "empty" / "x_0.db3") << "this is no database, whatever its name says of it";
  EXPECT_THROW(Recording(home_ / "empty").for_each({"/a"}, [](const Message&) {}), Error);
}

TEST_F(Bags, the_directories_above_a_recording_are_made_with_it) {
  RollingWriter(home_ / "runs" / "may" / "monday", kTopics, {}).finish();
  EXPECT_TRUE(fs::exists(home_ / "runs" / "may" / "monday" / "monday_0.db3"));
  std::ofstream(home_ / "file").flush();
  EXPECT_THROW(RollingWriter(home_ / "file" / "monday", kTopics, {}), Error);
}

TEST(Intake, counts_what_does_not_fit_and_gives_out_the_rest) {
  Intake intake(2, Intake::kBatch_bytes);
  const std::vector<std::byte> half(Intake::kBatchPayload_bytes / 2);
  EXPECT_TRUE(intake.offer(0, 1, half));
  EXPECT_TRUE(intake.offer(1, 2, half));
  EXPECT_FALSE(intake.offer(1, 3, half));
  EXPECT_EQ(intake.lost(), (std::vector<std::uint64_t>{0, 1}));
  Batch batch;
  ASSERT_TRUE(intake.take(batch, 0ms));
  ASSERT_EQ(batch.entries.size(), 2U);
  EXPECT_EQ(batch.entries[1].received_ns, 2);
  EXPECT_EQ(batch.payload(batch.entries[1]).size(), half.size());
  ASSERT_TRUE(intake.take(batch, 0ms));
  EXPECT_TRUE(batch.entries.empty());
  EXPECT_TRUE(intake.offer(1, 4, half)) << "there is room again";
  intake.close();
  EXPECT_FALSE(intake.offer(1, 5, half));
  EXPECT_TRUE(intake.take(batch, 0ms)) << "what waited is still given out";
  EXPECT_EQ(batch.entries.size(), 1U);
  EXPECT_FALSE(intake.take(batch, 0ms));
}

TEST(Intake, holds_no_more_memory_than_it_may_with_what_is_being_written) {
  constexpr std::size_t kMost = 8 * Intake::kBatch_bytes;
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{300}, std::size_t{100'000}, Intake::kBatchPayload_bytes * 2}) {
    Intake intake(1, kMost);
    const std::vector<std::byte> payload(size);
    std::uint64_t taken = 0;
    while (intake.offer(0, 1, payload)) {
      ++taken;
    }
    Batch batch;
    ASSERT_TRUE(intake.take(batch, 0ms));
    EXPECT_FALSE(intake.offer(0, 1, payload)) << "the writer still has it";
    std::size_t memory_bytes = 0;
    for (; !batch.entries.empty(); intake.take(batch, 0ms)) {
      memory_bytes += batch.memory_bytes();
      taken -= batch.entries.size();
    }
    EXPECT_LE(memory_bytes, kMost);
    EXPECT_GT(memory_bytes, kMost / 2);
    EXPECT_EQ(taken, 0U);
    EXPECT_TRUE(intake.offer(0, 1, payload));
  }
}

TEST_F(Bags, every_sample_offered_is_recorded_or_counted_as_lost) {
  constexpr std::uint64_t kOffered = 20'000;
  Recorder recorder(writer(), kTopics.size(), 2 * Intake::kBatch_bytes);
  const auto payload = bytes(40, 0);
  for (std::uint64_t i = 0; i < kOffered; ++i) {
    recorder.offer(1, static_cast<std::int64_t>(i), payload);
  }
  const std::uint64_t recorded = recorder.finish().messages();
  EXPECT_EQ(recorded + recorder.lost()[1], kOffered);
  EXPECT_EQ(recorder.lost()[0], 0U);
  EXPECT_EQ(read().size(), recorded);
}

TEST(Size, is_read_as_people_write_it) {
  EXPECT_EQ(parse_size("100MB"), 100'000'000U);
  EXPECT_EQ(parse_size("1.5 GiB"), 1'610'612'736U);
  EXPECT_EQ(parse_size("86016B"), 86'016U);
  for (const char* wrong : {"", "100", "MB", "-1MB", "1e3MB", "1 mb", "nanMB", "1e30GB"}) {
    EXPECT_FALSE(parse_size(wrong)) << wrong;
  }
  EXPECT_EQ(format_size(3'200'000), "3.2 MB");
}

}  // namespace
}  // namespace adstar::bag
