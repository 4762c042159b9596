// A live daemon recorded off the bus: what is on disk is what a subscriber heard, to the bit, and reads back as CSV, AEM and SVG.

#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/integration/recording_harness.hpp"
#include "tests/support/aem_parser.hpp"

namespace adstar {
namespace {

namespace fs = std::filesystem;
using testing::at_place;
using testing::client;
using testing::counts_in;
using testing::Daemon;
using testing::has_begun;
using testing::Listener;
using testing::Outcome;
using testing::Process;
using testing::TemporaryDirectory;
using testing::text_of;

/// The fields of a CDR payload one after another, as the OMG's CDR has them; little-endian.
class CdrCursor {
 public:
  explicit CdrCursor(std::span<const std::byte> payload) : bytes_(payload.subspan(4)) {
    EXPECT_EQ(payload[0], std::byte{0});
    EXPECT_EQ(payload[1], std::byte{1}) << "plain CDR, little-endian";
  }
  template <class T>
  T next() {
    at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    T value{};
    std::memcpy(&value, bytes_.subspan(at_, sizeof(T)).data(), sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  std::string text() {
    const auto length = next<std::uint32_t>();
    std::string value(reinterpret_cast<const char*>(bytes_.subspan(at_, length).data()),
                      length - 1);
    at_ += length;
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

/// A recording of a few seconds with a command in it, and what a subscriber heard meanwhile.
class Recorded : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    home_ = std::make_unique<TemporaryDirectory>();
    const auto corner = testing::private_corner();
    Daemon daemon(testing::full_scene(corner));
    Listener listener(corner);
    ASSERT_TRUE(listener.hear(5)) << daemon.log();
    Process recorder(at_place({"record", bag().string()}, corner));
    ASSERT_TRUE(has_begun(recorder)) << recorder.err();
    ASSERT_TRUE(listener.hear(50));
    ASSERT_TRUE(listener.push(2));
    ASSERT_TRUE(listener.hear(100));
    recorder.send(SIGINT);
    EXPECT_EQ(recorder.wait(), 0) << recorder.err();
    EXPECT_EQ(recorder.out().find("recorded "), 0U) << recorder.out();
    EXPECT_EQ(recorder.err().find("lost"), std::string::npos) << recorder.err();
    heard_attitude_ = listener.attitude;
    heard_momentum_ = listener.momentum;
    EXPECT_EQ(daemon.stop(), 0) << daemon.log();
  }
  static void TearDownTestSuite() { home_.reset(); }

  static fs::path bag() { return home_->path() / "bag"; }
  static fs::path file() { return bag() / "bag_0.db3"; }
  static fs::path out(const std::string& name) { return home_->path() / name; }

  static std::unique_ptr<TemporaryDirectory> home_;
  static std::map<std::uint64_t, adstar_AttitudeState> heard_attitude_;
  static std::map<std::uint64_t, adstar_MomentumState> heard_momentum_;
};
std::unique_ptr<TemporaryDirectory> Recorded::home_;
std::map<std::uint64_t, adstar_AttitudeState> Recorded::heard_attitude_;
std::map<std::uint64_t, adstar_MomentumState> Recorded::heard_momentum_;

TEST_F(Recorded, has_every_topic_that_spoke_and_counts_them_in_its_metadata) {
  const auto counts = counts_in(file());
  for (const char* topic : {"torque_command", "command_status", "attitude_state", "momentum_state",
                            "wheel_state", "pointing_state", "body_state", "joint_state",
                            "service_status", "step_timing", "service_roster"}) {
    EXPECT_TRUE(counts.contains(std::string("/adstar/") + topic)) << topic;
  }
  const std::string yaml = text_of(bag() / "metadata.yaml");
  std::int64_t all = 0;
  for (const auto& [topic, count] : counts) {
    all += count;
    const std::size_t at = yaml.find("name: " + topic + "\n");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(yaml.find(fmt::format("message_count: {}\n", count), at),
              yaml.find("message_count: ", at))
        << topic;
  }
  EXPECT_NE(yaml.find(fmt::format("\n  message_count: {}\n", all)), std::string::npos);
  EXPECT_FALSE(fs::exists(bag() / "bag_0.db3-wal"));
}

TEST_F(Recorded, payloads_are_the_samples_that_a_subscriber_heard_to_the_bit) {
  const bag::Database database(file(), bag::Database::Mode::open);
  auto rows = database.prepare(
      "SELECT data FROM messages WHERE topic_id = "
      "(SELECT id FROM topics WHERE name = '/adstar/momentum_state') ORDER BY id");
  std::vector<std::uint64_t> steps;
  std::size_t compared = 0;
  while (rows.step()) {
    CdrCursor cdr(rows.bytes(0));
    if (cdr.text() != "sat1") {
      continue;
    }
    EXPECT_EQ(cdr.text(), "fly");
    steps.push_back(cdr.next<std::uint64_t>());
    const auto heard = heard_momentum_.find(steps.back());
    if (heard == heard_momentum_.end()) {
      continue;
    }
    const adstar_MomentumState& s = heard->second;
    EXPECT_EQ(cdr.next<std::int64_t>(), s.time_ns);
    for (const double value :
         {s.momentum_inertial_n_m_s.x, s.momentum_inertial_n_m_s.y, s.momentum_inertial_n_m_s.z,
          s.momentum_body_n_m_s.x, s.momentum_body_n_m_s.y, s.momentum_body_n_m_s.z,
          s.rotational_energy_j, s.work_j, s.energy_residual_j}) {
      EXPECT_EQ(cdr.next<double>(), value);
    }
    ++compared;
  }
  EXPECT_GE(compared, 140U);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i], steps[i - 1] + 2) << "50 Hz at 10 ms: a sample is missing";
  }
}

TEST_F(Recorded, exported_as_csv_has_the_rows_of_the_monitor) {
  const Outcome csv = client({"export", bag().string(), "--to", "csv", "--spacecraft", "sat1"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  std::istringstream lines(csv.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.find("spacecraft,step,time_s,q_w,"), 0U);
  std::size_t rows = 0, compared = 0;
  std::vector<std::size_t> halved;
  for (; std::getline(lines, line); ++rows) {
    if (line.find(",,") != std::string::npos || line.ends_with(',')) {
      halved.push_back(rows);
      continue;
    }
    std::vector<double> v;
    std::istringstream fields(line.substr(line.find(',') + 1));
    for (std::string field; std::getline(fields, field, ',');) {
      v.push_back(std::stod(field));
    }
    ASSERT_EQ(v.size(), 17U) << line;
    const auto step = static_cast<std::uint64_t>(v[0]);
    if (heard_attitude_.contains(step) && heard_momentum_.contains(step)) {
      EXPECT_EQ(v[2], heard_attitude_[step].attitude_body_to_inertial.w);
      EXPECT_EQ(v[8], heard_attitude_[step].angular_velocity_body_rad_s.z);
      EXPECT_EQ(v[9], heard_momentum_[step].momentum_inertial_n_m_s.x);
      EXPECT_EQ(v[16], heard_momentum_[step].work_j);
      ++compared;
    }
  }
  EXPECT_GE(compared, 140U);
  for (const std::size_t row : halved) {
    EXPECT_TRUE(row == 0 || row + 1 == rows) << "a half is missing in row " << row;
  }
}

TEST_F(Recorded, exported_as_aem_says_what_was_heard_by_the_words_of_the_standard) {
  const fs::path file = out("sat1.aem");
  const Outcome aem = client({"export", bag().string(), "--to", "aem", "--spacecraft", "sat1",
                              "--epoch-utc", "2026-01-01T00:00:00Z", "--output", file.string()});
  ASSERT_EQ(aem.code, 0) << aem.err;
  const testing::Aem read = testing::parse_aem(text_of(file));
  EXPECT_EQ(read.of("OBJECT_NAME"), "sat1");
  EXPECT_EQ(read.of("TIME_SYSTEM"), "UTC");
  EXPECT_EQ(read.of("ANGVEL_FRAME"), read.of("REF_FRAME_B"));
  std::size_t compared = 0;
  for (const testing::AemLine& line : read.lines) {
    // The run is shorter than a minute.
    const auto time_ns = std::llround(std::stod(line.epoch.substr(17)) * 1e9);
    const auto step = static_cast<std::uint64_t>(time_ns / 10'000'000);
    if (!heard_attitude_.contains(step) || !heard_momentum_.contains(step)) {
      continue;
    }
    const adstar_AttitudeState& s = heard_attitude_[step];
    ASSERT_EQ(s.time_ns, time_ns);
    EXPECT_NEAR(line.q1, s.attitude_body_to_inertial.x, 1e-15);
    EXPECT_NEAR(line.q2, s.attitude_body_to_inertial.y, 1e-15);
    EXPECT_NEAR(line.q3, s.attitude_body_to_inertial.z, 1e-15);
    EXPECT_NEAR(line.qc, s.attitude_body_to_inertial.w, 1e-15);
    EXPECT_NEAR(line.angular_velocity_deg_s[1] * std::numbers::pi / 180,
                s.angular_velocity_body_rad_s.y, 1e-15);
    // The direction: momentum as the daemon gives it in I, taken to B by the standard's own matrix.
    const auto& H = heard_momentum_[step].momentum_inertial_n_m_s;
    const auto& Pi = heard_momentum_[step].momentum_body_n_m_s;
    const auto in_b = line.to_b({H.x, H.y, H.z});
    EXPECT_NEAR(in_b[0], Pi.x, 1e-14);
    EXPECT_NEAR(in_b[1], Pi.y, 1e-14);
    EXPECT_NEAR(in_b[2], Pi.z, 1e-14);
    ++compared;
  }
  EXPECT_GE(compared, 140U);
}

TEST_F(Recorded, an_aem_needs_an_epoch_and_one_spacecraft) {
  const Outcome no_epoch = client({"export", bag().string(), "--to", "aem"});
  EXPECT_EQ(no_epoch.code, 2);
  EXPECT_NE(no_epoch.err.find("--to aem needs --epoch-utc"), std::string::npos) << no_epoch.err;
  const Outcome two =
      client({"export", bag().string(), "--to", "aem", "--epoch-utc", "2026-01-01T00:00:00Z"});
  EXPECT_EQ(two.code, 2);
  EXPECT_NE(two.err.find("sat1, sat2"), std::string::npos) << two.err;
  const Outcome nobody = client({"export", bag().string(), "--to", "csv", "--spacecraft", "sat9"});
  EXPECT_EQ(nobody.code, 2);
  EXPECT_NE(nobody.err.find("no 'sat9'"), std::string::npos) << nobody.err;
}

TEST_F(Recorded, every_table_of_a_topic_has_as_many_rows_as_messages) {
  const auto counts = counts_in(file());
  for (const char* topic : {"attitude_state", "momentum_state", "wheel_state", "pointing_state",
                            "body_state", "joint_state", "command_status"}) {
    const Outcome csv = client({"export", bag().string(), "--to", "csv", "--topic", topic});
    EXPECT_EQ(csv.code, 0) << csv.err;
    const auto lines = std::count(csv.out.begin(), csv.out.end(), '\n');
    EXPECT_EQ(lines - 1, counts.at(std::string("/adstar/") + topic)) << topic;
    const auto fields = [&](std::size_t from) {
      return std::count(csv.out.begin() + static_cast<std::ptrdiff_t>(from),
                        csv.out.begin() + static_cast<std::ptrdiff_t>(csv.out.find('\n', from)),
                        ',');
    };
    EXPECT_EQ(fields(0), fields(csv.out.find('\n') + 1)) << topic << "\n" << csv.out.substr(0, 900);
  }
}

TEST_F(Recorded, plotted_shows_momentum_rates_and_residuals_of_each_spacecraft) {
  const fs::path file = out("bag.svg");
  const Outcome plot = client({"plot", bag().string(), "--output", file.string()});
  ASSERT_EQ(plot.code, 0) << plot.err;
  const std::string svg = text_of(file);
  for (const char* title :
       {"sat1: angular momentum", "sat1: angular velocity", "sat1: energy residual",
        "sat1: momentum residual", "sat2: angular momentum"}) {
    EXPECT_NE(svg.find(title), std::string::npos) << title;
  }
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

}  // namespace
}  // namespace adstar
