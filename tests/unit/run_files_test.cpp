// Checkpoints and journals as bytes: whole ones come back, no others do.

#include <fcntl.h>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "service/run/checkpoint.hpp"
#include "service/run/files.hpp"
#include "service/run/journal_file.hpp"
#include "service/run/run_directory.hpp"

namespace adstar::run {
namespace {

Checkpoint some_checkpoint() {
  Checkpoint checkpoint{1, 2, {0, 3}, 4, 5, {}, {10, 11, 12}, {13, 14}};
  checkpoint.fleet.vehicles.resize(2);
  checkpoint.fleet.vehicles[1].E_0 = 0.5;
  checkpoint.fleet.vehicles[0].state.H_I.add({1, 2, 3});
  checkpoint.fleet.wheel_momenta = {{1, 2}, {3, 4}, {5, 6}};
  return checkpoint;
}

TEST(Checkpoint, comes_back_from_its_bytes) {
  const Checkpoint before = some_checkpoint();
  const Checkpoint after = checkpoint_from(to_bytes(before));
  EXPECT_EQ(to_bytes(after), to_bytes(before));
  EXPECT_EQ(after.at, (runtime::Instant{0, 3}));
  EXPECT_EQ(after.first_journal, 5U);
  EXPECT_EQ(after.gate, before.gate);
  EXPECT_EQ(after.controls, before.controls);
  EXPECT_EQ(state_hash(3, after.fleet), state_hash(3, before.fleet));
}

TEST(Checkpoint, with_any_bit_changed_is_refused) {
  const Bytes good = to_bytes(some_checkpoint());
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{1};
    EXPECT_THROW((void)checkpoint_from(bad), RunError) << i;
  }
}

TEST(Checkpoint, cut_off_anywhere_or_longer_is_refused) {
  Bytes bytes = to_bytes(some_checkpoint());
  bytes.push_back(std::byte{0});
  EXPECT_THROW((void)checkpoint_from(bytes), RunError);
  bytes.pop_back();
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_THROW((void)checkpoint_from(bytes), RunError) << bytes.size();
  }
}

std::string complaint_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const RunError& error) {
    return error.what();
  }
  return "it went well";
}

TEST(RunFiles, say_what_to_do_where_there_is_no_room_or_no_permission) {
  const std::string full = complaint_of([] { File("/dev/full", O_WRONLY).write(Bytes(1)); });
  EXPECT_EQ(full, "/dev/full: cannot be written: No space left on device; make room there");
  const std::string none = complaint_of([] { RunDirectory::create("/proc/none/run", {}); });
  EXPECT_EQ(none.rfind("/proc/none/run: cannot be made: ", 0), 0U) << none;
  EXPECT_TRUE(none.ends_with("; name a directory that you may write to")) << none;
}

TEST(StateHash, sees_every_bit_and_the_step) {
  runtime::FleetState state;
  state.vehicles.resize(2);
  state.wheel_momenta.resize(3);
  const std::uint64_t hash = state_hash(1, state);
  EXPECT_NE(hash, state_hash(2, state));
  state.vehicles[1].state.q_IB.z = -0.0;
  const std::uint64_t other = state_hash(1, state);
  EXPECT_NE(hash, other);
  state.wheel_momenta[2].carry = -0.0;
  const std::uint64_t third = state_hash(1, state);
  EXPECT_NE(other, third);
  state.memory = {0, 0, 0};
  const std::uint64_t remembering = state_hash(1, state);
  EXPECT_NE(third, remembering);
  state.memory[2] = 1;
  EXPECT_NE(remembering, state_hash(1, state));
}

class JournalInBytes : public testing::Test {
 protected:
  JournalInBytes() {
    std::string pattern = (std::filesystem::temp_directory_path() / "adstar-j.XXXXXX").string();
    path_ = mkdtemp(pattern.data());
    JournalFile file(path_ / "journal", 99);
    std::vector<runtime::JournalRecord> records;
    for (std::uint64_t n = 1; n <= 5; ++n) {
      records.push_back(
          runtime::make_journal_record(runtime::JournalKind::command, n, 10 * n, 0, n * n));
    }
    file.append(std::span(records).first(2));
    file.append(std::span(records).subspan(2));
    bytes_ = read_bytes(path_ / "journal");
  }
  ~JournalInBytes() override { std::filesystem::remove_all(path_); }
  std::filesystem::path path_;
  Bytes bytes_;
};

TEST_F(JournalInBytes, comes_back) {
  const JournalText text = journal_from(bytes_);
  EXPECT_EQ(text.run, 99U);
  EXPECT_TRUE(text.damage.empty());
  ASSERT_EQ(text.records.size(), 5U);
  EXPECT_EQ(text.records[4].step, 50U);
  EXPECT_EQ(runtime::payload_of<std::uint64_t>(text.records[4]), 25U);
}

TEST_F(JournalInBytes, is_believed_up_to_where_it_was_cut_off) {
  const std::size_t record = (bytes_.size() - 32) / 5;
  for (std::size_t length = 0; length < bytes_.size(); ++length) {
    const JournalText text = journal_from(std::span(bytes_).first(length));
    const bool between_two = length >= 32 && (length - 32) % record == 0;
    EXPECT_EQ(text.damage.empty(), between_two) << length;
    EXPECT_EQ(text.records.size(), length < 32 ? 0 : (length - 32) / record) << length;
  }
}

/// Those behind it tell that it is missing.
TEST_F(JournalInBytes, is_believed_but_for_the_record_with_the_changed_bit) {
  const std::size_t record = (bytes_.size() - 32) / 5;
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    Bytes bad = bytes_;
    bad[i] ^= std::byte{0x80};
    const JournalText text = journal_from(bad);
    EXPECT_FALSE(text.damage.empty()) << i;
    EXPECT_EQ(text.records.size(), i < 32 ? 0U : 4U) << i;
    for (const runtime::JournalRecord& left : text.records) {
      EXPECT_NE(left.number, 1 + (i - 32) / record) << i;
    }
  }
}

}  // namespace
}  // namespace adstar::run
