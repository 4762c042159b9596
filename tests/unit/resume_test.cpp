// A run that is killed and gone on with has the bits of one that was never killed.

#include <csignal>
#include <random>
#include <sys/resource.h>

#include "tests/support/killed_run.hpp"

namespace adstar::run {
namespace {

TEST_F(KilledRun, goes_on_with_the_same_bits_wherever_it_was_killed) {
  test::Generator random(4);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  std::optional<RecordedFlight> flight(std::in_place, 5, path_, run_);
  constexpr std::uint64_t kEnd = 3000;
  int kills = 0;
  while (flight->step() < kEnd) {
    if (between(0, 25) == 0) {
      // Killed somewhere in a beat, or in what the recorder does.
      switch (between(0, 4)) {
        case 0:
          break;
        case 1:
          flight->hear(static_cast<std::size_t>(between(0, 3)));
          break;
        case 2:
          flight->hear();
          flight->compute();
          break;
        case 3:
          flight->hear();
          flight->log().move_records();
          break;
        case 4:
          std::ofstream(path_ / "checkpoint-999999.bin.new") << "half of one";
          break;
      }
      const std::uint64_t killed_at = flight->step();
      flight.reset();
      flight.emplace(5, path_);
      ASSERT_EQ(flight->step(), killed_at);
      ++kills;
    }
    flight->beat();
    if (between(0, 9) == 0) {
      flight->log().move_records();
    }
    if (between(0, 99) == 0) {
      flight->checkpoint();
    }
  }
  EXPECT_GT(kills, 50);
  expect_same(*flight, 5, kEnd);
  // Each life begins a journal file; those before the third newest checkpoint are gone.
  EXPECT_LE(std::distance(fs::directory_iterator(path_), {}), kills / 2) << "old files pile up";
}

TEST_F(KilledRun, a_repeated_command_gets_its_old_answer) {
  runtime::CommandRecord command;
  command.commander = {1, 2};
  command.sequence = 1;
  command.duration_ns = 100 * test::kMs;
  command.value = {1e-3, 0, 0};
  std::optional<RecordedFlight> flight(std::in_place, 1, path_, run_);
  flight->gate().receive(command, flight->now());
  flight->compute();
  flight->conclude();
  flight.emplace(1, path_);
  flight->verdicts().skip_all();
  flight->gate().receive(command, flight->now());
  const auto verdict = flight->verdicts().pop();
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->verdict, runtime::Verdict::applied);
  EXPECT_EQ(verdict->step, 0U);
}

TEST_F(KilledRun, says_its_last_verdicts_again_for_the_bridge_may_have_died_with_them) {
  runtime::CommandRecord command;
  command.commander = {1, 2};
  command.sequence = 1;
  command.duration_ns = 100 * test::kMs;
  std::optional<RecordedFlight> flight(std::in_place, 1, path_, run_);
  flight->gate().receive(command, flight->now());
  flight->compute();
  flight->conclude();
  flight.emplace(1, path_);
  bool said = false;
  while (const auto verdict = flight->verdicts().pop()) {
    said = said || (verdict->sequence == 1 && verdict->commander == command.commander &&
                    verdict->verdict == runtime::Verdict::applied);
  }
  EXPECT_TRUE(said);
}

TEST_F(KilledRun, uses_an_older_checkpoint_when_the_newest_was_changed_and_says_so) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  flight->run_to(100);
  flight->checkpoint();
  flight->run_to(200);
  flight->checkpoint();
  flight->run_to(250);
  flight.reset();
  const fs::path newest_checkpoint = newest("checkpoint-");
  flip_a_bit(newest_checkpoint, 200);
  flight.emplace(9, path_);
  EXPECT_EQ(flight->resumed.checkpoint.step, 100U);
  ASSERT_FALSE(flight->resumed.notes.empty());
  EXPECT_NE(flight->resumed.notes[0].find(newest_checkpoint.string() + " was changed"),
            std::string::npos)
      << flight->resumed.notes[0];
  flight->run_to(300);
  expect_same(*flight, 9, 300);
}

TEST_F(KilledRun, goes_back_to_the_scene_when_no_checkpoint_is_whole) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  flight->run_to(100);
  flight->checkpoint(true);
  flight->run_to(120);
  flight.reset();
  fs::resize_file(newest("checkpoint-"), 50);
  flight.emplace(9, path_);
  EXPECT_EQ(flight->resumed.checkpoint.step, 0U);
  expect_same(*flight, 9, 120);
}

TEST_F(KilledRun, goes_back_to_the_scene_while_it_has_fewer_than_three_checkpoints) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  for (const std::uint64_t step : {50U, 100U}) {
    flight->run_to(step);
    flight->checkpoint();
  }
  flight->run_to(120);
  flight.reset();
  for (const Numbered& file : RunDirectory::open(path_, RunDirectory::Use::look).checkpoints()) {
    flip_a_bit(file.path, 200);
  }
  flight.emplace(9, path_);
  EXPECT_EQ(flight->resumed.checkpoint.step, 0U);
  expect_same(*flight, 9, 120);
}

/// The number of the format stands behind eight bytes that say what the file is.
constexpr std::int64_t kFormat = 8;

TEST_F(KilledRun, that_another_version_wrote_is_refused_and_left_as_it_is) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  for (const std::uint64_t step : {50U, 100U, 150U, 200U, 250U}) {
    flight->run_to(step);
    flight->checkpoint();
  }
  flight.reset();
  HotJournalFile::remove(facts_of_memory());
  const auto files = [&] {
    const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
    std::vector<fs::path> all;
    for (const Numbered& file : directory.checkpoints()) {
      all.push_back(file.path);
    }
    for (const Numbered& file : directory.journals()) {
      all.push_back(file.path);
    }
    return all;
  };
  const std::vector<fs::path> before = files();
  ASSERT_FALSE(fs::exists(path_ / "journal-000001.bin")) << "it could be flown from its beginning";
  const auto expect_refusal = [&](const std::string& words) {
    try {
      flight.emplace(9, path_);
      ADD_FAILURE() << "it went on at step " << flight->step();
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--accept-loss"), std::string::npos);
    }
    EXPECT_EQ(files(), before);
  };
  for (const fs::path& file : before) {
    if (file.filename().string().starts_with("checkpoint-")) {
      flip_a_bit(file, kFormat);
    }
  }
  expect_refusal("is a checkpoint of another format");
  for (const fs::path& file : before) {
    if (file.filename().string().starts_with("journal-")) {
      flip_a_bit(file, kFormat);
    }
  }
  expect_refusal("cannot be read");
  flight.emplace(9, path_, true);
  EXPECT_EQ(flight->step(), 0U) << "all is lost, and was accepted";
}

TEST_F(KilledRun, refuses_to_begin_anew_where_nothing_can_be_read) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  flight->run_to(100);
  flight->checkpoint();
  flight.reset();
  HotJournalFile::remove(facts_of_memory());
  flip_a_bit(newest("checkpoint-"), 200);
  for (fs::path journal = newest("journal-"); !journal.empty(); journal = newest("journal-")) {
    fs::remove(journal);
  }
  EXPECT_THROW(flight.emplace(9, path_), RunError);
  flight.emplace(9, path_, true);
  EXPECT_EQ(flight->step(), 0U);
}

TEST_F(KilledRun, refuses_a_last_journal_of_which_nothing_is_known) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  flight->run_to(100);
  flight->checkpoint();
  flight->run_to(150);
  flight->log().move_records();
  flight.reset();
  HotJournalFile::remove(facts_of_memory());
  flip_a_bit(newest("journal-"), kFormat);
  EXPECT_THROW(flight.emplace(9, path_), RunError);
  flight.emplace(9, path_, true);
  EXPECT_EQ(flight->step(), 100U);
}

TEST_F(KilledRun, without_its_memory_goes_on_from_what_the_disk_has) {
  std::optional<RecordedFlight> flight(std::in_place, 2, path_, run_);
  flight->run_to(100);
  flight->checkpoint();
  flight->run_to(150);
  flight->log().move_records();
  flight->run_to(170);
  flight.reset();
  HotJournalFile::remove(facts_of_memory());  // the machine was started anew
  flight.emplace(2, path_);
  EXPECT_GE(flight->step(), 100U);
  EXPECT_LE(flight->step(), 150U);
  // Up to the last moved command all is as it was; what that beat had heard is heard.
  flight->run_to(200);
  expect_same(*flight, 2, 200);
}

TEST_F(KilledRun, without_its_memory_goes_on_from_the_last_step_that_left_a_digest_on_the_disk) {
  std::optional<RecordedFlight> flight(std::in_place, 2, path_, run_);
  flight->digest_every_step();
  flight->run_to(100);
  flight->checkpoint();
  flight->run_to(100 + 3 * runtime::DigestBlock::kMost);
  flight->end_digests();
  flight->log().move_records();
  flight->run_to(170);
  flight.reset();
  HotJournalFile::remove(facts_of_memory());
  flight.emplace(2, path_);
  EXPECT_EQ(flight->step(), 100 + 3 * runtime::DigestBlock::kMost);
}

TEST_F(KilledRun, refuses_to_go_on_across_a_hole_in_the_journal_unless_told_to) {
  std::optional<RecordedFlight> flight(std::in_place, 2, path_, run_);
  flight->run_to(60);
  flight->log().move_records();
  flight->run_to(100);
  flight.reset();
  const fs::path journal = newest("journal-");
  flip_a_bit(journal, static_cast<std::int64_t>(fs::file_size(journal) / 2));
  try {
    flight.emplace(2, path_);
    FAIL() << "went on";
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("of the journal are missing"), std::string::npos) << text;
    EXPECT_NE(text.find(journal.string() + " was changed in record"), std::string::npos) << text;
    EXPECT_NE(text.find("--accept-loss"), std::string::npos) << text;
  }
  flight.reset();
  flight.emplace(2, path_, true);
  EXPECT_LT(flight->step(), 60U);
  EXPECT_GT(flight->step(), 0U);
  // From there on it is a run like any other, though the old records still lie about.
  flight->run_to(200);
  flight->log().move_records();
  const std::uint64_t hash = flight->hash();
  flight.reset();
  flight.emplace(2, path_);
  EXPECT_EQ(flight->step(), 200U);
  EXPECT_EQ(flight->hash(), hash);
}

/// Nothing of it is in memory any more: what stands behind it in the file, a hash at the least, tells of it.
TEST_F(KilledRun, refuses_to_go_on_without_the_last_command_that_the_file_had) {
  std::optional<RecordedFlight> flight(std::in_place, 2, path_, run_);
  flight->run_to(100);
  flight->log().move_records();
  const fs::path journal = newest("journal-");
  const auto last_command = static_cast<std::int64_t>(fs::file_size(journal)) - 50;
  flight->log().note_hash(flight->at(), flight->hash());
  flight.reset();
  flip_a_bit(journal, last_command);
  try {
    flight.emplace(2, path_);
    FAIL() << "went on";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("of the journal are missing"), std::string::npos)
        << error.what();
  }
}

/// Hashes of steps that it does not go on from stand in files of before.
TEST_F(KilledRun, that_went_on_across_a_hole_is_not_where_it_was_before_it) {
  std::optional<RecordedFlight> flight(std::in_place, 2, path_, run_);
  flight->run_to(150);
  flight->log().move_records();
  flight->log().note_hash(flight->at(), flight->hash());
  flight.reset();
  const fs::path journal = newest("journal-");
  flip_a_bit(journal, static_cast<std::int64_t>(fs::file_size(journal) / 4));
  flight.emplace(2, path_, true);
  const std::uint64_t after = flight->step() + 10;
  ASSERT_LT(after, 150U);
  flight->run_to(after);
  const std::uint64_t hash = flight->hash();
  flight.emplace(2, path_);
  EXPECT_EQ(flight->step(), after);
  EXPECT_EQ(flight->hash(), hash);
}

TEST_F(KilledRun, a_torn_end_of_the_journal_is_no_loss_while_the_memory_has_it) {
  std::optional<RecordedFlight> flight(std::in_place, 3, path_, run_);
  flight->run_to(50);
  // As if the process died while it moved: half a record in the file, all of them still in memory.
  flight.reset();
  std::ofstream(newest("journal-"), std::ios::app | std::ios::binary) << "half a record";
  flight.emplace(3, path_);
  ASSERT_FALSE(flight->resumed.notes.empty());
  EXPECT_NE(flight->resumed.notes[0].find("is cut off in record 0"), std::string::npos);
  flight->run_to(90);
  expect_same(*flight, 3, 90);
}

TEST_F(KilledRun, refuses_the_checkpoint_of_another_scene) {
  std::optional<RecordedFlight> flight(std::in_place, 3, path_, run_);
  flight->run_to(10);
  flight->checkpoint();
  flight.reset();
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  std::vector<std::string> refused;
  EXPECT_THROW((void)newest_checkpoint(directory, test::recorded_scene(), 8, refused), RunError);
}

TEST_F(KilledRun, is_held_by_the_one_that_flies_it) {
  const RecordedFlight flight(1, path_, run_);
  EXPECT_THROW((void)RunDirectory::open(path_, RunDirectory::Use::fly), RunError);
  EXPECT_NO_THROW((void)RunDirectory::open(path_, RunDirectory::Use::look));
}

TEST_F(KilledRun, a_directory_that_holds_a_run_is_not_begun_again) {
  { const RecordedFlight flight(1, path_, run_); }
  try {
    const RecordedFlight again(1, path_, run_);
    FAIL() << "begun again";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("--resume"), std::string::npos) << error.what();
  }
}

TEST_F(KilledRun, a_full_disk_loses_nothing_and_what_finds_no_place_is_refused) {
  std::signal(SIGXFSZ, SIG_IGN);
  RecordedFlight flight(6, path_, run_);
  flight.run_to(20);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{fs::file_size(newest("journal-")) + 100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const std::size_t waiting = flight.hot().ring.size();
  EXPECT_THROW(flight.log().move_records(), RunError);
  EXPECT_EQ(flight.hot().ring.size(), waiting);

  runtime::CommandRecord command;
  command.commander = {77, 77};
  command.duration_ns = test::kMs;
  flight.verdicts().skip_all();
  runtime::Verdict verdict = runtime::Verdict::applied;
  for (std::uint64_t n = 1; n <= 2 * runtime::HotJournal::Ring::kCapacity; ++n) {
    command.sequence = n;
    flight.gate().receive(command, flight.now());
    if (const auto answer = flight.verdicts().pop();
        answer && answer->reason == runtime::Reason::not_recorded) {
      verdict = answer->verdict;
      break;
    }
  }
  EXPECT_EQ(verdict, runtime::Verdict::refused);

  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(flight.log().move_records());
  EXPECT_EQ(flight.hot().ring.size(), 0U);
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const RunRecords records = read_records(directory, nullptr, 1);
  EXPECT_TRUE(records.damage.empty());
  EXPECT_EQ(records.heard.size(), runtime::HotJournal::Ring::kCapacity);
}

}  // namespace
}  // namespace adstar::run
