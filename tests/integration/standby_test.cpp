// A primary killed -9 under its standby, over and over: whoever listens sees every step, with the bits of
// a flight that nobody interrupted. ADSTAR_KILLS sets how often (target standby: 20).

#include <cstdlib>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "service/run/hot_journal_file.hpp"
#include "service/run/resume.hpp"
#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::TemporaryDirectory;
using Records = std::map<std::uint64_t, runtime::JournalRecord>;

int kills_wanted() {
  const char* const asked = std::getenv("ADSTAR_KILLS");
  return asked == nullptr ? 3 : std::atoi(asked);
}

std::string pair_scene(const dds::ParticipantOptions& where) {
  return testing::paper_scene(where,
                              {.step = "5ms",
                               .telemetry_hz = 200,
                               .more = "[run]\ncheckpoint_every = \"3s\"\nhistory = \"whole\"\n"
                                       "[standby]\nlead = \"30ms\"\nlease = \"150ms\"\n"});
}

/// What the run in that directory heard. Where it differs from one before it, it is the later one that flew on.
void add_records(Records& all, const std::filesystem::path& path) {
  const auto directory = run::RunDirectory::open(path, run::RunDirectory::Use::look);
  const auto hot = run::HotJournalFile::open(directory.facts());
  std::uint64_t from = 1;
  for (const run::Numbered& file : directory.checkpoints()) {
    from =
        run::checkpoint_from(run::read_bytes(file.path)).next_number;  // of the oldest, in the end
  }
  all.erase(all.lower_bound(from), all.end());
  for (const auto& record : run::read_records(directory, hot ? &**hot : nullptr, from).heard) {
    all[record.number] = record;
  }
}

/// H_I after every step of a flight that nobody interrupted.
class Uninterrupted {
 public:
  Uninterrupted(const std::string& scene, const Records& records)
      : scene_(scene::parse(scene, "scene.toml")) {
    for (const auto& [number, record] : records) {
      records_.push_back(record);
    }
  }

  std::array<double, 3> momentum_at(std::uint64_t step) {
    const std::size_t taken =
        run::carry_on(flight_, std::span(records_).subspan(heard_), {0, step});
    heard_ += taken;
    verdicts_->skip_all();
    return runtime::sample(fleet_.vehicles().front()).H_I_n_m_s;
  }

 private:
  scene::Scene scene_;
  std::vector<runtime::JournalRecord> records_;
  std::size_t heard_ = 0;
  std::unique_ptr<runtime::VerdictRing> verdicts_ = std::make_unique<runtime::VerdictRing>();
  std::unique_ptr<runtime::ControlAnswerRing> answers_ =
      std::make_unique<runtime::ControlAnswerRing>();
  runtime::Fleet fleet_{scene_.spacecraft, scene_.simulation.scheme, scene_.simulation.limits};
  runtime::CommandGate gate_{scene_.spacecraft, *verdicts_};
  runtime::ControlMemory controls_{*answers_};
  run::Flight flight_{gate_, controls_, &fleet_, scene_.simulation.step_ns, {}};
};

/// Every sample that came: its bits by step, and how long the longest silence between two was.
class Listener {
 public:
  void hear(const adstar_MomentumState& s) {
    const auto& H = s.momentum_inertial_n_m_s;
    const std::array<double, 3> bits{H.x, H.y, H.z};
    const auto [known, is_new] = heard_.emplace(s.step, bits);
    EXPECT_EQ(known->second, bits) << "step " << s.step << " was published with other bits";
    const auto now = std::chrono::steady_clock::now();
    if (last_) {
      longest_ = std::max(longest_, now - *last_);
    }
    last_ = now;
  }
  std::chrono::milliseconds longest_silence() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::exchange(longest_, {}));
  }
  const std::map<std::uint64_t, std::array<double, 3>>& heard() const { return heard_; }

 private:
  std::map<std::uint64_t, std::array<double, 3>> heard_;
  std::optional<std::chrono::steady_clock::time_point> last_;
  std::chrono::steady_clock::duration longest_{};
};

bool says(const Daemon& daemon, std::string_view words) {
  return daemon.log().find(words) != std::string::npos;
}

TEST(Standby, goes_on_with_every_step_and_every_bit_when_the_primary_is_killed) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::string scene = pair_scene(corner);
  GroundStation ground(corner);
  Listener listener;
  ground.on_momentum = [&](const adstar_MomentumState& s) { listener.hear(s); };
  std::mt19937_64 random(5);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const auto run_of = [&](int n) { return home.path() / fmt::format("run{}", n); };
  const auto begin = [&](int n, std::vector<std::string> words) {
    words.insert(words.end(), {"--run", run_of(n).string()});
    return std::make_unique<Daemon>(scene, words);
  };
  std::vector<std::uint64_t> commanded;
  const auto command_something = [&] {
    auto command = ground.command("sat1", {1e-3 * between(-20, 20), 1e-3 * between(-20, 20), 5e-3});
    command.duration_ns = between(1, 1500) * std::int64_t{1'000'000};
    commanded.push_back(command.sequence_number);
    return ground.send(command).has_value();
  };

  auto primary = begin(0, {});
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << primary->log();
  std::vector<std::int64_t> silences;
  for (int kills = 0; kills < kills_wanted(); ++kills) {
    auto standby = begin(kills + 1, {"--standby"});
    ASSERT_TRUE(ground.until([&] { return says(*standby, "follows from step"); }))
        << standby->log();
    for (int left = between(1, 6); left > 0; --left) {
      ASSERT_TRUE(command_something()) << "kill " << kills << "\n" << primary->log();
    }
    // Some more that nobody waits for: the kill may come before they are heard, or told.
    for (int left = between(0, 3); left > 0; --left) {
      auto command = ground.command("sat1", {0, 1e-3 * between(-9, 9), 1e-3});
      command.duration_ns = 40'000'000;
      ground.write(command);
    }
    const auto wanted = ground.momentum_samples + static_cast<std::uint64_t>(between(1, 200));
    ASSERT_TRUE(ground.until([&] { return ground.momentum_samples >= wanted; }));
    listener.longest_silence();
    primary->signal(SIGKILL);
    ASSERT_EQ(primary->exit_code(), -SIGKILL);
    const std::uint64_t newest = ground.momentum["sat1"].step;
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > newest + 100; }))
        << "kill " << kills << "\n"
        << standby->log();
    EXPECT_TRUE(says(*standby, "flies in its place")) << standby->log();
    silences.push_back(listener.longest_silence().count());
    primary = std::move(standby);
  }
  ASSERT_TRUE(command_something());
  ASSERT_EQ(primary->stop(), 0) << primary->log();
  ground.until([] { return false; }, std::chrono::milliseconds(200));

  Records records;
  for (int n = 0; n <= kills_wanted(); ++n) {
    add_records(records, run_of(n));
  }
  EXPECT_GE(records.size(), static_cast<std::size_t>(kills_wanted()));
  Uninterrupted flight(scene, records);
  std::uint64_t expected = listener.heard().begin()->first;
  std::uint64_t missing = 0;
  for (const auto& [step, bits] : listener.heard()) {
    missing += step - expected;
    expected = step + 1;
    ASSERT_EQ(flight.momentum_at(step), bits) << "step " << step;
  }
  EXPECT_EQ(missing, 0u) << "steps that nobody published";
  for (const std::uint64_t sequence : commanded) {
    EXPECT_FALSE(ground.answers[sequence].empty()) << "command " << sequence;
  }

  testing::Process replay({ADSTAR, "replay", run_of(kills_wanted()).string()});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.out() << replay.err();
  EXPECT_NE(replay.out().find("same bits"), std::string::npos) << replay.out();
  std::sort(silences.begin(), silences.end());
  std::printf(
      "%d kills, lease 150 ms: longest silence median %ld ms, most %ld ms; %zu steps, %zu "
      "commands, same bits\n",
      kills_wanted(), static_cast<long>(silences[silences.size() / 2]),
      static_cast<long>(silences.back()), listener.heard().size(), records.size());
}

/// A primary and a standby that follows it.
class StandbyPair : public ::testing::Test {
 protected:
  void fly() {
    const std::string scene = pair_scene(corner);
    primary.emplace(scene, std::vector<std::string>{"--run", (home.path() / "a").string()});
    ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << primary->log();
    standby.emplace(scene,
                    std::vector<std::string>{"--run", (home.path() / "b").string(), "--standby"});
    ASSERT_TRUE(ground.until([&] { return says(*standby, "follows from step"); }))
        << standby->log();
  }
  bool flies_on() {
    const std::uint64_t newest = ground.momentum["sat1"].step;
    return ground.until([&] { return ground.momentum["sat1"].step > newest + 50; });
  }

  const dds::ParticipantOptions corner = testing::private_corner();
  const TemporaryDirectory home;
  GroundStation ground{corner};
  std::optional<Daemon> primary, standby;
};

TEST_F(StandbyPair, takes_over_at_once_from_a_primary_that_stops_in_good_order) {
  ASSERT_NO_FATAL_FAILURE(fly());
  ASSERT_EQ(primary->stop(), 0) << primary->log();
  ASSERT_TRUE(flies_on()) << standby->log();
  EXPECT_EQ(standby->stop(), 0) << standby->log();
}

TEST_F(StandbyPair, a_primary_that_stood_still_gives_way_to_whoever_took_over) {
  ASSERT_NO_FATAL_FAILURE(fly());
  primary->signal(SIGSTOP);  // its bridge lives on, and tells of no new beat
  ASSERT_TRUE(ground.until([&] { return says(*standby, "flies in its place"); })) << standby->log();
  primary->signal(SIGCONT);
  EXPECT_EQ(primary->exit_code(), 3) << primary->log();
  EXPECT_TRUE(says(*primary, "another daemon took over in term 2")) << primary->log();
  EXPECT_TRUE(flies_on());
  EXPECT_EQ(standby->stop(), 0) << standby->log();
}

TEST(Standby, a_primary_whose_commands_were_waiting_is_resumed_with_the_bits_it_would_have_had) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const auto run = home.path() / "a";
  GroundStation ground(corner);
  Listener listener;
  ground.on_momentum = [&](const adstar_MomentumState& s) { listener.hear(s); };
  auto daemon =
      std::make_unique<Daemon>(pair_scene(corner), std::vector<std::string>{"--run", run.string()});
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon->log();
  for (int kills = 0; kills < 3; ++kills) {
    for (int left = 0; left < 8; ++left) {  // not waited for
      auto command = ground.command("sat1", {1e-3 * left, 2e-3, 0});
      command.duration_ns = 70'000'000;
      ground.write(command);
    }
    const auto wanted = ground.momentum_samples + 3;
    ASSERT_TRUE(ground.until([&] { return ground.momentum_samples >= wanted; }));
    daemon->signal(SIGKILL);
    ASSERT_EQ(daemon->exit_code(), -SIGKILL);
    const std::uint64_t newest = ground.momentum["sat1"].step;
    daemon = Daemon::resuming(run);
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > newest + 20; }))
        << daemon->log();
  }
  ASSERT_EQ(daemon->stop(), 0) << daemon->log();
  testing::Process replay({ADSTAR, "replay", run.string()});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.out() << replay.err();
  EXPECT_NE(replay.out().find("same bits"), std::string::npos) << replay.out();
}

TEST_F(StandbyPair, takes_over_though_its_own_bridge_fell_while_it_followed) {
  Listener listener;
  ground.on_momentum = [&](const adstar_MomentumState& s) { listener.hear(s); };
  ASSERT_NO_FATAL_FAILURE(fly());
  kill(standby->bridge(), SIGKILL);
  auto command = ground.command("sat1", {0.01, 0, 0.02});  // told while nobody listens
  command.duration_ns = 50'000'000;
  ASSERT_TRUE(ground.send(command).has_value());
  const auto follows_again = [&] {
    const std::string log = standby->log();
    const auto first = log.find("follows the primary");
    return log.find("follows the primary", first + 1) != std::string::npos;
  };
  ASSERT_TRUE(ground.until(follows_again)) << standby->log();
  const auto wanted = ground.momentum_samples + 100;
  ASSERT_TRUE(ground.until([&] { return ground.momentum_samples >= wanted; }));
  primary->signal(SIGKILL);
  ASSERT_EQ(primary->exit_code(), -SIGKILL);
  ASSERT_TRUE(flies_on()) << standby->log();
  EXPECT_EQ(standby->stop(), 0) << standby->log();
  std::uint64_t expected = listener.heard().begin()->first;
  for (const auto& [step, bits] : listener.heard()) {
    EXPECT_EQ(step, expected);
    expected = step + 1;
  }
}

TEST(Standby, that_never_had_a_state_ends_well_and_leaves_nothing_to_go_on_with) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const auto run = home.path() / "a";
  GroundStation ground(corner);
  Daemon alone(pair_scene(corner), {"--run", run.string(), "--standby"});
  ASSERT_TRUE(ground.until([&] { return says(alone, "waits for its primary"); })) << alone.log();
  EXPECT_EQ(alone.stop(), 0) << alone.log();
  const auto resumed = Daemon::resuming(run);
  EXPECT_EQ(resumed->exit_code(), 3);
  EXPECT_TRUE(says(*resumed, "is a standby's that had no state yet")) << resumed->log();
}

TEST(Standby, says_what_is_missing_or_does_not_go_together) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  Daemon without_run(pair_scene(corner));
  EXPECT_EQ(without_run.exit_code(), 3);
  EXPECT_TRUE(says(without_run, "add --run DIRECTORY")) << without_run.log();

  GroundStation ground(corner);
  Daemon primary(pair_scene(corner), {"--run", (home.path() / "a").string()});
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << primary.log();
  Daemon other(pair_scene(corner) + "# another text\n",
               {"--run", (home.path() / "b").string(), "--standby"});
  EXPECT_EQ(other.exit_code(), 3);
  EXPECT_TRUE(says(other, "the primary flies another scene")) << other.log();
  Daemon second(pair_scene(corner), {"--run", (home.path() / "c").string()});
  EXPECT_EQ(second.exit_code(), 3);
  EXPECT_TRUE(says(second, "already flown by service 'fly'")) << second.log();
  EXPECT_EQ(primary.stop(), 0);
}

}  // namespace
}  // namespace adstar
