// adstard killed -9 at random moments, gone on with --resume, commanded all the while: what it published
// is never taken back, and in the end `adstar replay`, which flies the run from its scene without a
// break, finds the same bits. ADSTAR_KILLS sets how often (target kill_resume: 100).

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "service/run/hot_journal_file.hpp"
#include "service/run/run_directory.hpp"
#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::TemporaryDirectory;

int kills_wanted() {
  const char* const asked = std::getenv("ADSTAR_KILLS");
  return asked == nullptr ? 8 : std::atoi(asked);
}

std::string kept_scene(const dds::ParticipantOptions& where, const std::filesystem::path& run,
                       const std::string& more = "") {
  return testing::paper_scene(
      where, {.step = "10ms",
              .rate = 20,
              .telemetry_hz = 100,
              .more = fmt::format("[run]\ndirectory = \"{}\"\ncheckpoint_every = \"3s\"\n"
                                  "history = \"whole\"\n{}",
                                  run.string(), more)});
}

/// What was said of a step once must be said again if it is said again.
class Witness {
 public:
  void hear(const adstar_MomentumState& s) {
    const auto& H = s.momentum_inertial_n_m_s;
    const std::array<double, 3> heard{H.x, H.y, H.z};
    const auto [known, is_new] = heard_.emplace(s.step, heard);
    EXPECT_EQ(known->second, heard) << "step " << s.step << " was published with other bits";
  }

 private:
  std::map<std::uint64_t, std::array<double, 3>> heard_;
};

TEST(KillResume, a_run_killed_at_any_moment_has_the_bits_of_one_that_was_not) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  GroundStation ground(corner);
  Witness witness;
  ground.on_momentum = [&](const adstar_MomentumState& s) { witness.hear(s); };
  std::mt19937_64 random(11);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const auto command_something = [&] {
    auto command = ground.command("sat1", {1e-3 * between(-20, 20), 1e-3 * between(-20, 20), 5e-3});
    command.duration_ns = between(1, 3000) * std::int64_t{1'000'000};
    return ground.send(command);
  };

  auto daemon = std::make_unique<Daemon>(kept_scene(corner, run));
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon->log();
  std::uint64_t newest = 0;
  for (int kills = 0; kills < kills_wanted(); ++kills) {
    const auto samples = ground.momentum_samples;
    for (int left = between(1, 5); left > 0; --left) {
      ASSERT_TRUE(command_something()) << "kill " << kills << "\n" << daemon->log();
    }
    const auto wanted = samples + static_cast<std::uint64_t>(between(1, 200));
    ASSERT_TRUE(ground.until([&] { return ground.momentum_samples >= wanted; })) << daemon->log();
    newest = std::max<std::uint64_t>(newest, ground.momentum["sat1"].step);
    daemon->signal(SIGKILL);
    ASSERT_EQ(daemon->exit_code(), -SIGKILL);
    daemon = Daemon::resuming(run);
    const auto before = ground.momentum_samples;
    ASSERT_TRUE(ground.until([&] {
      return ground.momentum_samples > before && ground.momentum["sat1"].step > newest;
    })) << "kill "
        << kills << "\n"
        << daemon->log();
  }
  ASSERT_TRUE(command_something());
  ASSERT_EQ(daemon->stop(), 0) << daemon->log();

  testing::Process replay({ADSTAR, "replay", run.string()});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.out() << replay.err();
  EXPECT_TRUE(replay.out().starts_with("step 0 to ")) << replay.out();
  EXPECT_NE(replay.out().find("same bits"), std::string::npos) << replay.out();
  std::printf("%d kills; %s", kills_wanted(), replay.out().c_str());
}

TEST(KillResume, a_run_that_ended_goes_on_where_it_ended) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  GroundStation ground(corner);
  std::uint64_t stopped_at = 0;
  {
    Daemon daemon(kept_scene(corner, run));
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > 100; })) << daemon.log();
    ASSERT_EQ(daemon.stop(), 0) << daemon.log();
    ASSERT_TRUE(ground.until(
        [&] { return ground.status && ground.status->state == adstar_SERVICE_STOPPED; }));
    stopped_at = ground.status->step;
    EXPECT_EQ(ground.status->state_hash_step, stopped_at);
  }
  const auto daemon = Daemon::resuming(run);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > stopped_at; }))
      << daemon->log();
  EXPECT_NE(daemon->log().find(fmt::format("the run goes on at step {}", stopped_at)),
            std::string::npos)
      << daemon->log();
  EXPECT_EQ(daemon->stop(), 0);
}

/// A machine that is started anew forgets what was in memory; a run that ended in good order had nothing there.
TEST(KillResume, says_that_memory_is_gone_only_when_it_is) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  const auto flies = [&] {
    GroundStation ground(corner);
    return ground.until([&] { return ground.momentum.contains("sat1"); });
  };
  const auto says_gone = [](const Daemon& daemon) {
    return daemon.log().find("what the run had in memory is gone") != std::string::npos;
  };
  {
    Daemon daemon(kept_scene(corner, run));
    ASSERT_TRUE(flies()) << daemon.log();
    ASSERT_EQ(daemon.stop(), 0);
  }
  // A start that is refused changes nothing: the scene is not that of the checkpoint for a while.
  const auto scene = run / "scene.toml";
  const auto length = std::filesystem::file_size(scene);
  std::ofstream(scene, std::ios::app) << "# another text\n";
  EXPECT_EQ(Daemon::resuming(run)->exit_code(), 3);
  std::filesystem::resize_file(scene, length);
  {
    const auto daemon = Daemon::resuming(run);
    ASSERT_TRUE(flies()) << daemon->log();
    EXPECT_FALSE(says_gone(*daemon)) << daemon->log();
    daemon->signal(SIGKILL);
    EXPECT_EQ(daemon->exit_code(), -SIGKILL);
  }
  run::HotJournalFile::remove(run::RunDirectory::open(run, run::RunDirectory::Use::look).facts());
  const auto daemon = Daemon::resuming(run);
  ASSERT_TRUE(flies()) << daemon->log();
  EXPECT_TRUE(says_gone(*daemon)) << daemon->log();
  EXPECT_EQ(daemon->stop(), 0);
}

/// What it keeps there is found by whoever goes on with the run, also without being told where.
TEST(KillResume, keeps_its_memory_where_it_is_told_to) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  std::string memory = "/dev/shm/adstar-memory.XXXXXX";
  ASSERT_NE(mkdtemp(memory.data()), nullptr);
  const auto flies = [&] {
    GroundStation ground(corner);
    return ground.until([&] { return ground.momentum.contains("sat1"); });
  };
  const auto kept = [&] { return !std::filesystem::is_empty(memory); };
  {
    Daemon daemon(kept_scene(corner, run), {"--memory", memory});
    ASSERT_TRUE(flies()) << daemon.log();
    EXPECT_TRUE(kept());
    daemon.signal(SIGKILL);
    ASSERT_EQ(daemon.exit_code(), -SIGKILL);
  }
  {
    const auto daemon = Daemon::resuming(run);
    ASSERT_TRUE(flies()) << daemon->log();
    EXPECT_EQ(daemon->log().find("is gone"), std::string::npos) << daemon->log();
    EXPECT_EQ(daemon->stop(), 0);
  }
  EXPECT_FALSE(kept());
  {
    const auto daemon = Daemon::resuming(run);
    ASSERT_TRUE(flies()) << daemon->log();
    EXPECT_FALSE(kept()) << "it ended in good order; now it is where this one was told";
    EXPECT_EQ(daemon->stop(), 0);
  }
  std::filesystem::remove(memory);
}

/// Between two tries the journal is written; that the run is recorded again is said when the checkpoint is there.
TEST(KillResume, a_checkpoint_that_cannot_be_written_is_told_once_and_again_when_it_can) {
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  const std::filesystem::path in_its_way = run / "checkpoint-000001.bin.new";
  std::filesystem::create_directories(in_its_way);
  const auto corner = testing::private_corner();
  GroundStation ground(corner);
  Daemon daemon(kept_scene(corner, run));
  const auto comes_to_step = [&](std::uint64_t step) {
    return ground.until([&] { return ground.momentum["sat1"].step >= step; });
  };
  ASSERT_TRUE(comes_to_step(650))
      << daemon.log();  // it was due at 300, and tried each second since
  const std::string told = daemon.log();
  const std::size_t first = told.find("the run cannot be recorded: " + in_its_way.string());
  ASSERT_NE(first, std::string::npos) << told;
  EXPECT_EQ(told.find("the run cannot be recorded", first + 1), std::string::npos) << told;
  EXPECT_EQ(told.find("is recorded again"), std::string::npos) << told;
  std::filesystem::remove(in_its_way);
  ASSERT_TRUE(comes_to_step(850)) << daemon.log();
  EXPECT_NE(daemon.log().find("the run is recorded again; nothing was lost"), std::string::npos)
      << daemon.log();
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(KillResume, memory_that_is_none_is_refused_before_anything_is_begun) {
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  Daemon daemon(kept_scene(testing::private_corner(), run), {"--memory", "/proc"});
  EXPECT_EQ(daemon.exit_code(), 2);
  EXPECT_NE(daemon.log().find("--memory: got '/proc', which is no tmpfs"), std::string::npos)
      << daemon.log();
  EXPECT_FALSE(std::filesystem::exists(run));
}

TEST(KillResume, a_directory_in_use_or_used_is_refused_with_the_remedy) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::filesystem::path run = home.path() / "run";
  GroundStation ground(corner);
  Daemon first(kept_scene(corner, run));
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << first.log();
  const auto second = Daemon::resuming(run);
  EXPECT_EQ(second->exit_code(), 3);
  EXPECT_NE(second->log().find("is flown by another adstard"), std::string::npos) << second->log();
  ASSERT_EQ(first.stop(), 0);
  Daemon third(kept_scene(corner, run));
  EXPECT_EQ(third.exit_code(), 3);
  EXPECT_NE(third.log().find("--resume"), std::string::npos) << third.log();
}

}  // namespace
}  // namespace adstar
