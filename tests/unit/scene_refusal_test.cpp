// What is refused, word for word: file:line:col: key: got X, expected Y; try Z.

#include <unistd.h>

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

constexpr const char* kDuration =
    "expected a duration above zero in whole nanoseconds (units ns, us, ms, s, min, h, d); try ";

std::string with_step(const std::string& step) {
  return refusal("[simulation]\nstep = " + step + '\n' + kSpacecraft);
}

TEST(SceneLoader, refuses_a_syntax_error_in_one_line) {
  EXPECT_EQ(refusal("[simulation]\nstep = 10ms\n"),
            "scene.toml:2:10: syntax: got \"Error while parsing decimal integer: expected digit, "
            "saw 'm'\", expected TOML 1.0; try step = \"10ms\" if it is meant as a text");
  EXPECT_EQ(refusal("a = 1\na = 2\n"),
            "scene.toml:2:5: syntax: got \"Error while parsing key-value pair: cannot redefine "
            "existing integer 'a'\", expected TOML 1.0; try removing or renaming one of the two");
  EXPECT_EQ(refusal("[?]\n"),
            "scene.toml:1:2: syntax: got \"Error while parsing key: expected bare key starting "
            "character or string delimiter, saw '?'\", expected TOML 1.0; try key = value, with "
            "texts in quotes, brackets closed and one key a line");
  EXPECT_EQ(refusal("a = \u00b5\n"),
            "scene.toml:1:5: syntax: got \"Error while parsing value: could not determine value "
            "type\", expected TOML 1.0; try a = \"\u00b5\" if it is meant as a text");
  EXPECT_EQ(refusal("a = [1, 2\n"),
            "scene.toml:1:11: syntax: got \"Error while parsing array: encountered end-of-file\", "
            "expected TOML 1.0; try key = value, with texts in quotes, brackets closed and one key "
            "a line");
}

TEST(SceneLoader, refuses_a_file_that_is_not_there) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("adstar_scene_missing_" + std::to_string(getpid()));
  std::filesystem::create_directories(directory);
  const std::string file = (directory / "demo.toml").string();
  std::string text;
  try {
    load(file);
  } catch (const SceneError& error) {
    text = error.what();
  }
  std::filesystem::remove_all(directory);
  EXPECT_EQ(text, file +
                      ":1:1: file: got No such file or directory, expected a scene that can be "
                      "read; try a path to a .toml file; there is none in \"" +
                      directory.string() + '"');
}

TEST(SceneLoader, refuses_an_unknown_key_and_names_the_nearest) {
  EXPECT_EQ(refusal(in_section("dds", "domian = 3")),
            "scene.toml:7:1: dds.domian: got an unknown key, expected one of domain, partition, "
            "interface, security; try domain");
  EXPECT_EQ(
      refusal(in_section("lgo", "")),
      "scene.toml:6:2: lgo: got an unknown key, expected one of simulation, earth, spacecraft, "
      "telemetry, budget, run, service, standby, dds, ros2, log; try log");
  EXPECT_EQ(refusal(in_section("log", "colour = \"red\"")),
            "scene.toml:7:1: log.colour: got an unknown key, expected one of level, file; try "
            "removing it");
  EXPECT_EQ(refusal(in_section("log", "\"a\\nb\" = 1")),
            "scene.toml:7:1: log.\"a\\x0ab\": got an unknown key, expected one of level, file; try "
            "removing it");
  EXPECT_EQ(refusal(in_torque("model = \"constant\"\nframe = \"body\"\ntorque_n_m = [0, 0, 1]\n"
                              "fram = 1")),
            "scene.toml:10:1: spacecraft[0].torque[0].fram: got an unknown key, expected one of "
            "model, frame, torque_n_m; try frame");
  EXPECT_EQ(
      refusal(in_spacecraft("attitude_body_to_inertial = { w = 1, x = 0, y = 0, z = 0, v = 1 }")),
      "scene.toml:6:59: spacecraft[0].attitude_body_to_inertial.v: got an unknown key, expected "
      "one of w, x, y, z; try w");
}

TEST(SceneLoader, refuses_a_scene_without_step_or_spacecraft) {
  EXPECT_EQ(refusal(""),
            "scene.toml:1:1: simulation.step: got nothing, expected a duration above zero in whole "
            "nanoseconds (units ns, us, ms, s, min, h, d); try step = \"10ms\" under [simulation]\n"
            "scene.toml:1:1: spacecraft: got nothing, expected at least one [[spacecraft]]; try "
            "[[spacecraft]] with a name and inertia_body_kg_m2");
  EXPECT_EQ(refusal(std::string("spacecraft = []\n") + kSimulation),
            "scene.toml:1:14: spacecraft: got [], expected at least one [[spacecraft]]; try "
            "[[spacecraft]], in double brackets");
  EXPECT_EQ(refusal(std::string("\n[simulation]\n") + kSpacecraft),
            "scene.toml:2:1: simulation.step: got nothing, " + std::string(kDuration) +
                "step = \"10ms\"");
}

TEST(SceneLoader, refuses_single_brackets_where_blocks_repeat) {
  EXPECT_EQ(refusal(std::string(kSimulation) + "[spacecraft]\nname = \"a\"\n"),
            "scene.toml:3:1: spacecraft: got a table, expected at least one [[spacecraft]]; try "
            "[[spacecraft]], in double brackets");
  EXPECT_EQ(refusal(in_section("spacecraft.torque", "model = \"constant\"")),
            "scene.toml:6:1: spacecraft[0].torque: got a table, expected an array of tables; try "
            "[[spacecraft.torque]], in double brackets");
  EXPECT_EQ(refusal(std::string("dds = 1\n") + in_spacecraft("")),
            "scene.toml:1:7: dds: got 1, expected a table; try [dds] on a line of its own");
}

TEST(SceneLoader, refuses_steps_that_are_none) {
  const std::string at = "scene.toml:2:8: simulation.step: got ";
  EXPECT_EQ(with_step("\"0s\""), at + "\"0s\", " + kDuration + "\"1ns\"");
  EXPECT_EQ(with_step("\"-10ms\""), at + "\"-10ms\", " + kDuration + "\"10ms\"");
  EXPECT_EQ(with_step("\"0.5ns\""), at + "\"0.5ns\", " + kDuration + "\"1ns\"");
  EXPECT_EQ(with_step("\"1.00000000049s\""), at + "\"1.00000000049s\", " + kDuration + "\"1s\"");
  EXPECT_EQ(with_step("\"5 minutes\""), at + "\"5 minutes\", " + kDuration + "\"5min\"");
  EXPECT_EQ(with_step("\"10\""), at + "\"10\", " + kDuration + "\"10s\" if seconds are meant");
  EXPECT_EQ(with_step("0.01"), at + "0.01, " + kDuration + "\"10ms\" if seconds are meant");
  EXPECT_EQ(with_step("true"), at + "true, " + kDuration + "\"10ms\"");
  EXPECT_EQ(with_step("\"fast\""), at + "\"fast\", " + kDuration + "\"10ms\"");
}

TEST(SceneLoader, refuses_a_duration_that_cuts_a_step_and_names_its_neighbours) {
  EXPECT_EQ(
      refusal(in_simulation("duration = \"1.005s\"")),
      "scene.toml:3:12: simulation.duration: got \"1.005s\", expected a whole multiple of the "
      "step 10ms; try \"1s\" or \"1.01s\"");
  EXPECT_EQ(refusal(in_simulation("duration = \"3ms\"")),
            "scene.toml:3:12: simulation.duration: got \"3ms\", expected a whole multiple of the "
            "step 10ms; try \"10ms\"");
}

TEST(SceneLoader, refuses_a_scheme_for_free_bodies_when_a_spacecraft_names_a_torque) {
  EXPECT_EQ(
      refusal("[simulation]\nstep = \"10ms\"\nscheme = \"free_exact\"\n"
              "[[spacecraft]]\nname = \"a\"\ninertia_body_kg_m2 = [1.0, 1.1, 1.2]\n"
              "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"body\"\n"
              "torque_n_m = [0.0, 0.0, 0.01]\n"),
      "scene.toml:3:10: simulation.scheme: got \"free_exact\", which knows no torque, expected "
      "a scheme that does, since \"a\" names one; try \"coadjoint_rk4\"");
}

TEST(SceneLoader, refuses_unknown_schemes_and_paces) {
  const std::string unknown = refusal(in_simulation("scheme = \"rk4\""));
  EXPECT_TRUE(unknown.starts_with(
      "scene.toml:3:10: simulation.scheme: got \"rk4\", expected one of coadjoint_rk4, "))
      << unknown;
  EXPECT_TRUE(unknown.ends_with("; try \"coadjoint_rk4\"")) << unknown;
  EXPECT_EQ(refusal(in_simulation("pace = \"fre\"")),
            "scene.toml:3:8: simulation.pace: got \"fre\", expected one of clock, free, lockstep; "
            "try \"free\"");
  EXPECT_EQ(
      refusal(in_simulation("lockstep_timeout = \"1s\"")),
      "scene.toml:3:20: simulation.lockstep_timeout: got \"1s\", expected no lockstep_timeout "
      "beside pace = \"clock\"; try removing it, or pace = \"lockstep\"");
}

TEST(SceneLoader, refuses_a_rate_that_is_none_or_has_no_clock) {
  EXPECT_EQ(refusal(in_simulation("rate = 0")),
            "scene.toml:3:8: simulation.rate: got 0, expected a number from 1e-06 to 1e+06, "
            "simulated seconds per second; try 1.0");
  EXPECT_EQ(refusal(in_simulation("rate = 1e9")),
            "scene.toml:3:8: simulation.rate: got 1e+09, expected a number from 1e-06 to 1e+06, "
            "simulated seconds per second; try 1e+06");
  EXPECT_EQ(refusal(in_simulation("pace = \"free\"\nrate = 2.0")),
            "scene.toml:4:8: simulation.rate: got 2, expected no rate beside pace = \"free\"; try "
            "removing it, or pace = \"clock\"");
}

TEST(SceneLoader, refuses_dates_that_are_none_and_two_epochs) {
  const std::string utc =
      ", expected a date and time in UTC, of 1972 or later; try 2026-01-01T00:00:00Z";
  for (const char* text : {"2026-02-30T00:00:00", "2026-13-01T00:00:00", "2026-01-01",
                           "2026-01-01T24:00:00", "2026-01-01T00:00:60", "2026-01-01T00:00:00.",
                           "2026-01-01T01:00:00+01:00", "tomorrow", "1971-12-31T23:59:59"}) {
    EXPECT_EQ(refusal(in_simulation(std::string("epoch_utc = \"") + text + '"')),
              std::string("scene.toml:3:13: simulation.epoch_utc: got \"") + text + '"' + utc);
  }
  EXPECT_EQ(refusal(in_simulation("epoch_utc = 2026-01-01")),
            "scene.toml:3:13: simulation.epoch_utc: got 2026-01-01" + utc);
  EXPECT_EQ(refusal(in_simulation("epoch_tai = 2026-01-01T00:00:00Z")),
            "scene.toml:3:13: simulation.epoch_tai: got 2026-01-01T00:00:00Z, expected a date and "
            "time in TAI, without an offset; try 2026-01-01T00:00:00");
  EXPECT_EQ(refusal(in_simulation("epoch_utc = 2026-01-01T00:00:00Z\n"
                                  "epoch_tai = 2026-01-01T00:00:37")),
            "scene.toml:4:13: simulation.epoch_tai: got a second epoch, expected epoch_utc or "
            "epoch_tai, not both; try removing one of the two");
}

TEST(SceneLoader, refuses_limits_out_of_range) {
  EXPECT_EQ(
      refusal(in_simulation("accuracy_rad = 0")),
      "scene.toml:3:16: simulation.accuracy_rad: got 0, expected an angle above 0 rad; try 1e-6");
  EXPECT_EQ(
      refusal(in_simulation("substep_angle_limit_rad = 3.5")),
      "scene.toml:3:27: simulation.substep_angle_limit_rad: got 3.5, expected an angle above 0 "
      "and at most 3 rad; try 3");
  EXPECT_EQ(
      refusal(in_simulation("substep_limit = 0\nedge_limit = 100001")),
      "scene.toml:3:17: simulation.substep_limit: got 0, expected an integer from 1 to 100000; "
      "try 1\n"
      "scene.toml:4:14: simulation.edge_limit: got 100001, expected an integer from 1 to "
      "100000; try 100000");
}

TEST(SceneLoader, refuses_rates_that_whole_steps_cannot_give) {
  const auto attitude = [](const std::string& hz) {
    return refusal(in_section("telemetry", "attitude_hz = " + hz));
  };
  const std::string at = "scene.toml:7:15: telemetry.attitude_hz: got ";
  EXPECT_EQ(attitude("30"),
            at + "30, expected a rate that whole steps of 10ms give; try 33.3333333333 or 25");
  EXPECT_EQ(attitude("101"), at + "101, expected at most 100 Hz, every step; try 100");
  EXPECT_EQ(attitude("-1"), at + "-1, expected a rate in Hz, 0 for none; try 0");
  EXPECT_EQ(attitude("1e-300"),
            at + "1e-300, expected at least a sample in 1e+15 steps, 0 for none; try 0");
  EXPECT_EQ(attitude("33.3333333333"), "");
}

TEST(SceneLoader, refuses_to_watch_a_spacecraft_that_is_not_there) {
  EXPECT_EQ(
      refusal(in_section("telemetry", "spacecraft = [\"sta1\", \"sat1\", \"sat1\", 4]")),
      "scene.toml:7:15: telemetry.spacecraft[0]: got \"sta1\", expected a spacecraft of this "
      "scene; try \"sat1\"\n"
      "scene.toml:7:31: telemetry.spacecraft[2]: got \"sat1\", expected each spacecraft once; "
      "try removing it\n"
      "scene.toml:7:39: telemetry.spacecraft[3]: got 4, expected the name of a spacecraft; try "
      "\"sat1\"");
}

TEST(SceneLoader, refuses_service_dds_and_log_out_of_range) {
  const std::string last = std::to_string(sysconf(_SC_NPROCESSORS_CONF) - 1);
  EXPECT_EQ(refusal(in_section("service", "priority = 100\ncpu = 100000\nname = \"a/b\"")),
            "scene.toml:7:12: service.priority: got 100, expected an integer from 0 (ordinary "
            "scheduling) to 99; try 99\n"
            "scene.toml:8:7: service.cpu: got 100000, expected a processor of this machine, 0 to " +
                last + "; try " + last + "\n" +
                "scene.toml:9:8: service.name: got \"a/b\", expected 1 to 63 characters out of A-Z "
                "a-z 0-9 _ . -; try \"a_b\"");
  EXPECT_EQ(
      refusal(in_section("dds", "domain = 231\npartition = 1\ninterface = \"\"")),
      "scene.toml:7:10: dds.domain: got 231, expected an integer from 0 to 230; try 230\n"
      "scene.toml:8:13: dds.partition: got 1, expected a string; try \"simulation\"\n"
      "scene.toml:9:13: dds.interface: got \"\", expected the name of a network interface; try "
      "\"lo\"");
  EXPECT_EQ(refusal(in_section("log", "level = \"warning\"\nfile = 3")),
            "scene.toml:7:9: log.level: got \"warning\", expected one of trace, debug, info, warn, "
            "error; try \"warn\"\n"
            "scene.toml:8:8: log.file: got 3, expected the path of a file; try \"adstar.log\"");
}

TEST(SceneLoader, says_everything_at_once_in_the_order_of_the_file) {
  const std::string text = refusal(
      "[log]\nlevel = 1\n[simulation]\nstep = \"0s\"\nspeed = 2\n[[spacecraft]]\nname = \"a b\"\n"
      "inertia_body_kg_m2 = [1, 1, 3]\n[[spacecraft.torque]]\nmodel = \"none\"\n");
  std::vector<std::string> places;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    places.push_back(line.substr(0, line.find(": got")));
    begin = end + 1;
  }
  EXPECT_EQ(places, (std::vector<std::string>{
                        "scene.toml:2:9: log.level", "scene.toml:4:8: simulation.step",
                        "scene.toml:5:1: simulation.speed", "scene.toml:7:8: spacecraft[0].name",
                        "scene.toml:8:22: spacecraft[0].inertia_body_kg_m2",
                        "scene.toml:10:9: spacecraft[0].torque[0].model"}));
}

}  // namespace
}  // namespace adstar::scene
