// The part of a run that is in memory: where it is, and what is not taken for it.

#include <system_error>

#include "tests/support/killed_run.hpp"

namespace adstar::run {
namespace {

TEST_F(KilledRun, does_not_take_memory_of_another_version_for_none) {
  std::optional<RecordedFlight> flight(std::in_place, 9, path_, run_);
  flight->run_to(20);
  flight->hot().layout += 1;
  flight.reset();
  EXPECT_THROW(HotJournalFile::open(facts_of_memory()), RunError);
  HotJournalFile::remove(facts_of_memory());
  EXPECT_FALSE(HotJournalFile::open(facts_of_memory()));
  HotJournalFile::create(facts_of_memory())->run = run_ + 1;
  EXPECT_THROW(HotJournalFile::open(facts_of_memory()), RunError);
}

TEST_F(KilledRun, says_where_its_memory_is_and_goes_on_with_it_from_there) {
  auto directory = RunDirectory::create(path_, {run_, "text", "scene.toml", "", ""});
  EXPECT_EQ(memory_file(directory.facts()).parent_path(), "/dev/shm");
  std::string elsewhere = "/dev/shm/adstar-memory.XXXXXX";
  ASSERT_NE(mkdtemp(elsewhere.data()), nullptr);
  directory.move_memory_to(elsewhere);
  EXPECT_FALSE(HotJournalFile::open(directory.facts()));
  HotJournalFile::create(directory.facts())->step.store(7);
  EXPECT_FALSE(HotJournalFile::open(facts_of_memory())) << "it is in /dev/shm itself";
  const RunFacts found = RunDirectory::open(path_, RunDirectory::Use::look).facts();
  EXPECT_EQ(memory_file(found).parent_path(), elsewhere);
  const auto hot = HotJournalFile::open(found);
  ASSERT_TRUE(hot);
  EXPECT_EQ((*hot)->step.load(), 7U);
  HotJournalFile::remove(found);
  EXPECT_TRUE(fs::remove(elsewhere)) << "something is left";
}

TEST(Memory, is_refused_where_there_is_none) {
  EXPECT_EQ(why_not_in_memory("/dev/shm"), "");
  EXPECT_NE(why_not_in_memory("/dev/shm/none").find("No such file"), std::string::npos);
  EXPECT_NE(why_not_in_memory("/proc").find("is no tmpfs"), std::string::npos);
}

TEST_F(KilledRun, does_not_take_memory_that_cannot_be_opened_for_none) {
  const fs::path there = memory_file(facts_of_memory());
  ASSERT_TRUE(fs::create_directory(there));  // which not even root opens to write
  EXPECT_THROW(HotJournalFile::open(facts_of_memory()), std::system_error);
  fs::remove(there);
  EXPECT_FALSE(HotJournalFile::open(facts_of_memory()));
}

}  // namespace
}  // namespace adstar::run
