// A recorder that is killed, that stands still, that is told what to take.

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/integration/recording_harness.hpp"

namespace adstar {
namespace {

namespace fs = std::filesystem;
using testing::at_place;
using testing::client;
using testing::counts_in;
using testing::Daemon;
using testing::GroundStation;
using testing::has_begun;
using testing::Listener;
using testing::Outcome;
using testing::Process;
using testing::TemporaryDirectory;

TEST(Recorder, killed_leaves_a_recording_that_reads) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::string bag = (home.path() / "bag").string();
  Daemon daemon(testing::paper_scene(corner, {}));
  Listener listener(corner);
  ASSERT_TRUE(listener.hear(5)) << daemon.log();
  Process recorder(at_place({"record", bag}, corner));
  ASSERT_TRUE(has_begun(recorder)) << recorder.err();
  ASSERT_TRUE(listener.hear(200));  // four seconds
  recorder.send(SIGKILL);
  EXPECT_EQ(recorder.wait(), 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(bag + "/metadata.yaml"));
  const Outcome csv = client({"export", bag, "--to", "csv"});
  EXPECT_EQ(csv.code, 0) << csv.err;
  EXPECT_NE(csv.err.find("metadata.yaml was made from its files"), std::string::npos) << csv.err;
  EXPECT_GE(std::count(csv.out.begin(), csv.out.end(), '\n'), 130)
      << "of 200, all but the last second";
  EXPECT_TRUE(fs::exists(bag + "/metadata.yaml"));
  const Outcome again = client({"export", bag, "--to", "csv"});
  EXPECT_EQ(again.err, "");
  EXPECT_EQ(again.out, csv.out);
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Recorder, is_exported_while_it_records_and_ends_as_if_it_were_not) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::string bag = (home.path() / "bag").string();
  Daemon daemon(testing::paper_scene(corner, {}));
  Listener listener(corner);
  ASSERT_TRUE(listener.hear(5)) << daemon.log();
  Process recorder(at_place({"record", bag, "--max-duration", "3s"}, corner));
  ASSERT_TRUE(has_begun(recorder)) << recorder.err();
  ASSERT_TRUE(listener.hear(75));  // more than a commit, less than a file
  const bag::Database reader(bag + "/bag_0.db3", bag::Database::Mode::open);
  auto rows = reader.prepare("SELECT data FROM messages");
  ASSERT_TRUE(rows.step());
  const Outcome live = client({"export", bag, "--to", "csv"});
  EXPECT_EQ(live.code, 0) << live.err;
  EXPECT_NE(live.err.find("is still being recorded"), std::string::npos) << live.err;
  EXPECT_FALSE(fs::exists(bag + "/metadata.yaml"));
  ASSERT_TRUE(listener.hear(120));
  recorder.send(SIGINT);
  EXPECT_EQ(recorder.wait(), 0) << recorder.err();
  const Outcome ended = client({"export", bag, "--to", "csv"});
  EXPECT_EQ(ended.err, "");
  EXPECT_GT(ended.out.size(), live.out.size());
  EXPECT_TRUE(ended.out.starts_with(live.out.substr(0, live.out.size() / 2)));
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Recorder, that_stands_still_holds_nobody_up) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  Daemon daemon(testing::paper_scene(corner, {.telemetry_hz = 100}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum_samples > 10; })) << daemon.log();
  Process recorder(at_place({"record", (home.path() / "bag").string()}, corner));
  ASSERT_TRUE(has_begun(recorder)) << recorder.err();
  recorder.send(SIGSTOP);
  const std::uint64_t before = ground.momentum_samples;
  std::uint64_t last = ground.momentum["sat1"].step, gaps = 0;
  ground.on_momentum = [&](const adstar_MomentumState& s) {
    gaps += s.step > last + 1 ? 1 : 0;
    last = s.step;
  };
  ASSERT_TRUE(ground.until([&] { return ground.momentum_samples > before + 300; }));
  EXPECT_EQ(gaps, 0U) << "others miss samples while a recorder stands";
  EXPECT_EQ(ground.status->telemetry_lost, 0U);
  recorder.send(SIGCONT);
  recorder.send(SIGINT);
  EXPECT_EQ(recorder.wait(), 0) << recorder.err();
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Recorder, takes_the_topics_that_are_named_and_refuses_others) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const std::string bag = (home.path() / "bag").string();
  const Outcome wrong = testing::run(at_place({"record", bag, "--topic", "momentum_sate"}, corner));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean 'momentum_state'?"), std::string::npos) << wrong.err;
  EXPECT_FALSE(fs::exists(bag));
  Daemon daemon(testing::paper_scene(corner, {}));
  Listener listener(corner);
  ASSERT_TRUE(listener.hear(5)) << daemon.log();
  Process recorder(at_place({"record", bag, "--topic", "momentum_state"}, corner));
  ASSERT_TRUE(has_begun(recorder)) << recorder.err();
  ASSERT_TRUE(listener.hear(50));
  recorder.send(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0) << recorder.err();
  const auto counts = counts_in(bag + "/bag_0.db3");
  EXPECT_EQ(counts.size(), 1U);
  EXPECT_TRUE(counts.contains("/adstar/momentum_state"));
  const Outcome taken = testing::run(at_place({"record", bag}, corner));
  EXPECT_EQ(taken.code, 2);
  EXPECT_NE(taken.err.find("is there already"), std::string::npos) << taken.err;
  EXPECT_EQ(daemon.stop(), 0);
}

}  // namespace
}  // namespace adstar
