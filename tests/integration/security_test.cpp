// DDS Security end to end: a secured adstard, and everybody who is or is not allowed to speak to it.
// The files are those of deploy/security/make.sh.

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "adstar/vec3.hpp"
#include "service/dashboard/server/site.hpp"
#include "service/dds/ros2.hpp"
#include "tests/dashboard/http_client.hpp"
#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::Outcome;
using testing::paper_scene;
using testing::private_corner;
using testing::TemporaryDirectory;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Our authorities and strangers', made once.
class Authorities {
 public:
  Authorities() {
    make({"ours"});
    make({"strangers"});
  }
  void make(std::vector<std::string> words) const {
    words[0] = (directory_.path() / words[0]).string();
    words.insert(words.begin(), {"bash", ADSTAR_SOURCE_DIR "/deploy/security/make.sh"});
    const Outcome outcome = testing::run(words);
    if (outcome.code != 0) {
      throw std::runtime_error(outcome.err);
    }
  }
  std::filesystem::path of(const std::string& who) const { return directory_.path() / who; }
  scene::SecurityFiles files(const std::string& who) const {
    return scene::security_files_in(of(who));
  }

 private:
  TemporaryDirectory directory_;
};

const Authorities& authorities() {
  static const Authorities made;
  return made;
}

std::string security_section(const scene::SecurityFiles& files) {
  std::string text = "[dds.security]\n";
  for (const scene::SecurityFile& file : scene::kSecurityFiles) {
    text += fmt::format("{} = \"{}\"\n", file.key, (files.*file.path).string());
  }
  return text;
}

std::string secured_scene(const dds::ParticipantOptions& where,
                          const scene::SecurityFiles& files = authorities().files("ours/daemon")) {
  return paper_scene(where, {.more = security_section(files)});
}

dds::ParticipantOptions as(dds::ParticipantOptions where, const scene::SecurityFiles& files) {
  where.security = files;
  return where;
}

/// `adstar VERB ...` on that domain; empty `security`: unauthenticated.
Outcome client(const dds::ParticipantOptions& where, std::vector<std::string> words,
               const std::filesystem::path& security) {
  words.insert(words.begin(), ADSTAR_CLI);
  words.insert(words.end(), {"--domain", std::to_string(where.domain), "--partition",
                             where.partition, "--interface", where.interface});
  std::vector<std::string> environment;
  if (!security.empty()) {
    environment.push_back("ADSTAR_SECURITY=" + security.string());
  }
  return testing::run(words, {{}, environment});
}

const std::vector<std::string> kPush{"torque", "sat1",  "--torque-n-m", "0",         "0",
                                     "0.05",   "--for", "10ms",         "--timeout", "4s"};

Vec3<double> momentum_of(const adstar_MomentumState& s) {
  const adstar_Vector3& H = s.momentum_inertial_n_m_s;
  return {H.x, H.y, H.z};
}

/// What the daemon says of sat1 now, heard by somebody who may.
std::optional<adstar_MomentumState> momentum_now(const dds::ParticipantOptions& where) {
  const dds::Participant participant(as(where, authorities().files("ours/watcher")));
  dds::Reader<adstar_MomentumState> reader(participant);
  std::optional<adstar_MomentumState> newest;
  testing::eventually([&] {
    reader.take([&](const adstar_MomentumState& s, const auto&) { newest = s; });
    return newest.has_value();
  });
  return newest;
}

const Vec3<double> kUnmoved{0.9144 * 0.45549, 1.098 * 0.82623, 1.66 * 0.03476};

/// What make.sh signed into somebody's permissions.
std::string permissions_of(const std::string& who) {
  std::ostringstream text;
  text << std::ifstream(authorities().files(who).permissions).rdbuf();
  return text.str();
}

TEST(Security, every_topic_there_is_has_a_place_in_the_permissions) {
  authorities().make({"ours", "flight_director", "operator"});
  const std::string daemon = permissions_of("ours/daemon");
  const std::string director = permissions_of("ours/flight_director");
  std::apply(
      [&](const auto&... topic) {
        for (const std::string& name : {std::string(topic.name)...}) {
          EXPECT_TRUE(contains(daemon, "<topic>" + name + "</topic>")) << name;
          const bool between_daemons = name.starts_with("adstar/standby_");
          EXPECT_EQ(contains(director, "<topic>" + name + "</topic>"), !between_daemons) << name;
        }
      },
      dds::kTopics);
}

TEST(Security, a_commander_moves_the_spacecraft_also_through_the_next_bridge) {
  const auto corner = private_corner();
  Daemon daemon(secured_scene(corner));
  {
    GroundStation ground(as(corner, authorities().files("ours/commander")));
    for (int bridges = 0; bridges < 2; ++bridges) {
      ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
      const Vec3<double> before = momentum_of(ground.momentum["sat1"]);
      auto command = ground.command("sat1", {0.1, 0, 0});
      command.duration_ns = 50'000'000;
      const auto answer = ground.send(command);
      ASSERT_TRUE(answer.has_value()) << daemon.log();
      EXPECT_EQ(answer->verdict, adstar_VERDICT_APPLIED);
      ASSERT_TRUE(ground.until([&] { return momentum_of(ground.momentum["sat1"]) != before; }));
      const pid_t bridge = daemon.bridge();
      ASSERT_EQ(kill(bridge, SIGKILL), 0);
      ASSERT_TRUE(ground.until([&] { return daemon.bridge() > 0 && daemon.bridge() != bridge; }));
      ground.momentum.clear();
    }
  }
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
  EXPECT_TRUE(contains(daemon.log(), "sockets, secured")) << daemon.log();
}

TEST(Security, a_watcher_sees_telemetry_and_answers_but_may_not_write_a_command) {
  const auto corner = private_corner();
  Daemon daemon(secured_scene(corner));
  {
    const dds::Participant participant(as(corner, authorities().files("ours/watcher")));
    dds::Reader<adstar_MomentumState> momentum(participant);
    const dds::Reader<adstar_CommandStatus> answers(participant);
    bool seen = false;
    ASSERT_TRUE(testing::eventually([&] {
      momentum.take([&](const auto&, const auto&) { seen = true; });
      return seen && answers.matched() > 0;
    })) << daemon.log();
    EXPECT_THROW(const dds::Writer<adstar_TorqueCommand> writer(participant), dds::NotAllowed);
    EXPECT_THROW(const dds::Reader<adstar_TorqueCommand> reader(participant), dds::NotAllowed);
    EXPECT_THROW(const dds::Writer<adstar_MomentumState> writer(participant), dds::NotAllowed);
  }
  const Outcome pushed = client(corner, kPush, authorities().of("ours/watcher"));
  EXPECT_EQ(pushed.code, 3) << pushed.err;
  EXPECT_TRUE(contains(pushed.err, "adstar/torque_command")) << pushed.err;
  EXPECT_TRUE(contains(pushed.err, "do not allow it")) << pushed.err;
  const auto now = momentum_now(corner);
  ASSERT_TRUE(now.has_value());
  EXPECT_EQ(momentum_of(*now), kUnmoved);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Security, a_dashboard_that_may_not_command_does_not_start_with_allow_commands) {
  for (const std::string who : {"watcher", "daemon"}) {
    const Outcome started =
        client(private_corner(), {"dashboard", "--port", "0", "--allow-commands"},
               authorities().of("ours/" + who));
    EXPECT_EQ(started.code, 3) << started.err;
    EXPECT_EQ(started.out, "");
    EXPECT_TRUE(
        contains(started.err, "ours/" + who + "' do not let it write adstar/torque_command"))
        << started.err;
  }
}

TEST(Security, a_dashboard_answers_403_to_a_command_that_it_may_not_send) {
  const dds::Participant participant(as(private_corner(), authorities().files("ours/watcher")));
  const dashboard::Bus bus(participant);
  dashboard::PulseDesk desk(participant);
  const dashboard::Site site(bus, desk, {0, true, "here"});
  const std::string host = "127.0.0.1:" + std::to_string(site.port());
  const std::string pulse =
      R"({"spacecraft":"sat1","actuator":"body","torque_n_m":[0,0,0.05],"duration_s":5})";
  const testing::HttpClient browser(site.port());
  browser.say("POST /command HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
              "\r\nContent-Type: application/json\r\nContent-Length: " +
              std::to_string(pulse.size()) + "\r\n\r\n" + pulse);
  const std::string heard = browser.hear();
  for (const char* part :
       {"HTTP/1.1 403 ", R"("verdict":"not_sent")", "adstar/torque_command", "do not allow it"}) {
    EXPECT_TRUE(contains(heard, part)) << part << " in " << heard;
  }
}

TEST(Security, topics_of_ros_2_are_for_those_for_whom_the_native_ones_are) {
  auto corner = private_corner();
  corner.partition.clear();
  Daemon daemon(secured_scene(corner) + "[ros2]\nenabled = true\n");
  const std::string torque = ros2::name_of("sat1", ros2::kTorque);
  const std::string attitude = ros2::name_of("sat1", ros2::kAttitude);
  using Torques = dds::Writer<ros2::WrenchStamped>;
  {
    GroundStation ground(as(corner, authorities().files("ours/commander")));
    Torques torques(ground.participant(), *ros2::kTorque.descriptor, torque.c_str(), ros2::kOut);
    std::string frame = ros2::body_frame("sat1");
    ASSERT_TRUE(ground.until([&] {
      torques.write({{{}, frame.data()}, {{}, {0.1, 0, 0}}});
      return ground.momentum.contains("sat1") && momentum_of(ground.momentum["sat1"]) != kUnmoved;
    })) << daemon.log();
  }
  {
    const dds::Participant watcher(as(corner, authorities().files("ours/watcher")));
    dds::Reader<ros2::QuaternionStamped> reader(watcher, *ros2::kAttitude.descriptor,
                                                attitude.c_str(), ros2::kIn);
    bool seen = false;
    EXPECT_TRUE(testing::eventually([&] {
      reader.take([&](const auto&, const auto&) { seen = true; });
      return seen;
    })) << daemon.log();
    EXPECT_THROW(
        const Torques writer(watcher, *ros2::kTorque.descriptor, torque.c_str(), ros2::kOut),
        dds::NotAllowed);
    EXPECT_THROW(const dds::Reader<ros2::WrenchStamped> spy(watcher, *ros2::kTorque.descriptor,
                                                            torque.c_str(), ros2::kIn),
                 dds::NotAllowed);
  }
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Security, whoever_has_no_certificate_of_our_authority_sees_nothing_and_moves_nothing) {
  const auto corner = private_corner();
  Daemon daemon(secured_scene(corner));
  ASSERT_TRUE(momentum_now(corner).has_value()) << daemon.log();
  for (const std::filesystem::path& who :
       {std::filesystem::path(), authorities().of("strangers/commander")}) {
    const Outcome pushed = client(corner, kPush, who);
    EXPECT_EQ(pushed.code, 4) << who << pushed.out << pushed.err;
    EXPECT_TRUE(contains(pushed.err, "nobody listens")) << pushed.err;
    // The side that answers the handshake tells; which one that is depends on random numbers.
    EXPECT_TRUE(who.empty() || contains(pushed.err + daemon.log(), "handshake")) << pushed.err;
    const Outcome listed = client(corner, {"list", "--timeout", "3s"}, who);
    EXPECT_EQ(listed.code, 4) << who << listed.out << listed.err;
  }
  const auto now = momentum_now(corner);
  ASSERT_TRUE(now.has_value());
  EXPECT_EQ(momentum_of(*now), kUnmoved);
  const Outcome ours = client(corner, kPush, authorities().of("ours/commander"));
  EXPECT_EQ(ours.code, 0) << ours.err << daemon.log();
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Security, permissions_that_somebody_signed_for_himself_move_nothing) {
  const auto corner = private_corner();
  authorities().make({"ours", "eve", "watcher"});
  authorities().make({"strangers", "eve", "commander"});
  scene::SecurityFiles forged = authorities().files("strangers/eve");
  forged.identity_ca = authorities().files("ours/eve").identity_ca;
  forged.identity_certificate = authorities().files("ours/eve").identity_certificate;
  forged.private_key = authorities().files("ours/eve").private_key;
  const std::filesystem::path directory = authorities().of("forged");
  std::filesystem::create_directory(directory);
  for (const scene::SecurityFile& file : scene::kSecurityFiles) {
    std::filesystem::copy(forged.*file.path, directory / file.file_name);
  }
  Daemon daemon(secured_scene(corner));
  ASSERT_TRUE(momentum_now(corner).has_value()) << daemon.log();
  const Outcome pushed = client(corner, kPush, directory);
  EXPECT_EQ(pushed.code, 4) << pushed.out << pushed.err;
  const auto now = momentum_now(corner);
  ASSERT_TRUE(now.has_value());
  EXPECT_EQ(momentum_of(*now), kUnmoved);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Security, carries_fleet_samples_of_the_largest_size) {
  const auto corner = private_corner();
  Daemon daemon(
      fmt::format("[simulation]\nstep = \"20ms\"\n[budget]\nadmission = "
                  "\"warn\"\n[telemetry]\nfleet_hz = 5\n[dds]\ndomain = {}\npartition = "
                  "\"{}\"\ninterface = \"{}\"\n{}[[spacecraft]]\nname = \"f{{:05}}\"\ncount = "
                  "1200\ninertia_body_kg_m2 = [0.9, 1.1, 1.6]\n",
                  corner.domain, corner.partition, corner.interface,
                  security_section(authorities().files("ours/daemon"))));
  {
    const dds::Participant participant(as(corner, authorities().files("ours/watcher")));
    dds::Reader<adstar_FleetState> reader(participant);
    std::map<std::uint32_t, std::uint32_t> members_by_chunk;
    EXPECT_TRUE(testing::eventually([&] {
      reader.take([&](const adstar_FleetState& s, const auto&) {
        members_by_chunk[s.chunk] = s.members._length;
      });
      return members_by_chunk.size() == 3;
    })) << daemon.log();
    EXPECT_EQ(members_by_chunk[0], 500U);
    EXPECT_EQ(members_by_chunk[2], 200U);
  }
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Security, a_half_configured_daemon_does_not_start) {
  const auto corner = private_corner();
  std::string scene = secured_scene(corner);
  const std::size_t line = scene.find("governance");
  scene.erase(line, scene.find('\n', line) - line);
  Daemon daemon(scene);
  EXPECT_EQ(daemon.exit_code(), 2);
  EXPECT_TRUE(contains(daemon.log(), "dds.security.governance: ")) << daemon.log();
}

TEST(Security, a_daemon_with_unreadable_files_or_an_open_key_does_not_start_and_names_them_all) {
  const auto corner = private_corner();
  const TemporaryDirectory copy;
  std::filesystem::copy(authorities().of("ours/daemon"), copy.path() / "daemon");
  scene::SecurityFiles files = scene::security_files_in(copy.path() / "daemon");
  chmod(files.private_key.c_str(), 0640);
  std::filesystem::remove(files.permissions_ca);
  Daemon daemon(secured_scene(corner, files));
  EXPECT_EQ(daemon.exit_code(), 2);
  EXPECT_TRUE(contains(daemon.log(), "dds.security.private_key: ")) << daemon.log();
  EXPECT_TRUE(contains(daemon.log(), "chmod 600")) << daemon.log();
  EXPECT_TRUE(contains(daemon.log(), "dds.security.permissions_ca: ")) << daemon.log();

  const Outcome pushed = client(corner, kPush, copy.path() / "daemon");
  EXPECT_EQ(pushed.code, 2) << pushed.err;
  EXPECT_TRUE(contains(pushed.err, "private_key: ")) << pushed.err;
}

TEST(Security, tampered_permissions_are_refused_at_the_start_of_daemon_and_client) {
  const auto corner = private_corner();
  const TemporaryDirectory copy;
  for (const std::string who : {"daemon", "watcher"}) {
    std::filesystem::copy(authorities().of("ours/" + who), copy.path() / who);
    const std::filesystem::path file = copy.path() / who / "permissions.p7s";
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    std::string tampered = text.str();
    // A right more than was signed.
    const std::size_t place = tampered.find("<topic>adstar/step_timing</topic>");
    ASSERT_NE(place, std::string::npos);
    tampered.replace(place, 33, "<topic>adstar/torque_command</topic>");
    std::ofstream(file) << tampered;
  }
  Daemon daemon(secured_scene(corner, scene::security_files_in(copy.path() / "daemon")));
  EXPECT_EQ(daemon.exit_code(), 2);
  EXPECT_TRUE(contains(daemon.log(), "dds_create_participant")) << daemon.log();
  EXPECT_TRUE(contains(daemon.log(), "permissions")) << daemon.log();
  const Outcome pushed = client(corner, kPush, copy.path() / "watcher");
  EXPECT_EQ(pushed.code, 2) << pushed.err;
}

}  // namespace
}  // namespace adstar
