// Recordings that were made up, exported: what a daemon says twice, late, or anew.

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/made_recording.hpp"
#include "tests/support/aem_parser.hpp"

namespace adstar::testing {
namespace {

Outcome export_aem(const MadeRecording& recording, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"export", recording.directory(), "--to",
                                 "aem",    "--epoch-utc",         "2026-01-01T00:00:00Z"};
  words.insert(words.end(), more.begin(), more.end());
  return client(words);
}

TEST(Export, keeps_rows_whole_and_in_their_order_though_the_clock_was_set_back) {
  MadeRecording recording;
  recording.fly(1, 300);
  recording.now_ns -= 400'000'000;
  recording.fly(301, 600);
  recording.finish();
  const Outcome csv = client({"export", recording.directory(), "--to", "csv"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  const auto lines = lines_of(csv.out);
  ASSERT_EQ(lines.size(), 601U);
  for (std::size_t step = 1; step <= 600; ++step) {
    EXPECT_EQ(lines[step].rfind(fmt::format("sat1,{},", step), 0), 0U) << lines[step];
    EXPECT_EQ(lines[step].find(",,"), std::string::npos) << lines[step];
  }
  EXPECT_EQ(parse_aem(export_aem(recording).out).lines.size(), 600U);
}

/// Of a hundred spacecraft that have no topics of their own.
void add_fleet(MadeRecording& recording) {
  std::vector<adstar_FleetMember> members(100);
  adstar_FleetState fleet{};
  dds::set_text(fleet.service, "fly");
  fleet.members._length = fleet.members._maximum = 100;
  fleet.members._buffer = members.data();
  recording.add(fleet);
}

TEST(Recording, of_a_fleet_alone_says_which_topic_has_it) {
  MadeRecording recording;
  add_fleet(recording);
  recording.finish();
  const std::vector<std::string> csv{"export", recording.directory(), "--to", "csv"};
  for (const Outcome& motion :
       {client(csv), export_aem(recording), export_aem(recording, {"--spacecraft", "cube7"}),
        client({"plot", recording.directory()}),
        client({"plot", recording.directory(), "--spacecraft", "cube7"})}) {
    EXPECT_EQ(motion.code, 2);
    EXPECT_EQ(motion.out, "");
    EXPECT_NE(motion.err.find("--topic fleet_state"), std::string::npos) << motion.err;
  }
  std::vector<std::string> fleet = csv;
  fleet.insert(fleet.end(), {"--topic", "fleet_state"});
  const Outcome rows = client(fleet);
  EXPECT_EQ(rows.code, 0) << rows.err;
  EXPECT_EQ(lines_of(rows.out).size(), 101U);
  fleet.insert(fleet.end(), {"--spacecraft", "cube7"});
  const Outcome named = client(fleet);
  EXPECT_EQ(named.code, 2);
  EXPECT_EQ(named.out, "");
  EXPECT_NE(named.err.find("--spacecraft: "), std::string::npos) << named.err;
}

TEST(Recording, without_motion_asks_whether_it_was_left_out) {
  MadeRecording recording;
  recording.finish();
  const Outcome csv = client({"export", recording.directory(), "--to", "csv"});
  EXPECT_EQ(csv.code, 2);
  EXPECT_NE(csv.err.find("left out by --topic?"), std::string::npos) << csv.err;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Recording, that_has_lost_a_file_is_read_with_a_warning_each_time_and_stays_as_it_is) {
  MadeRecording recording({.max_bytes = {}, .max_duration_ns = 200'000'000});
  recording.fly(1, 300);  // 100 steps a file
  recording.finish();
  const std::string metadata = text_of(recording.directory() + "/metadata.yaml");
  std::filesystem::remove(recording.directory() + "/bag_1.db3");
  for (int time = 0; time < 2; ++time) {
    const Outcome csv = client({"export", recording.directory(), "--to", "csv"});
    EXPECT_EQ(csv.code, 0) << csv.err;
    EXPECT_EQ(lines_of(csv.out).size(), 201U);
    const Outcome plot = client({"plot", recording.directory()});
    EXPECT_EQ(plot.code, 0) << plot.err;
    for (const std::string& err : {csv.err, plot.err, export_aem(recording).err}) {
      EXPECT_NE(
          err.find("has 400 of the 600 messages that its metadata.yaml tells of: bag_1.db3 is "
                   "missing; this is what is left"),
          std::string::npos)
          << err;
      EXPECT_EQ(err.find("not ended"), std::string::npos) << err;
    }
  }
  EXPECT_EQ(text_of(recording.directory() + "/metadata.yaml"), metadata);
}

TEST(Recording, that_has_lost_everything_does_not_ask_whether_it_was_left_out) {
  MadeRecording recording;
  recording.fly(1, 10);
  recording.finish();
  std::filesystem::resize_file(recording.directory() + "/bag_0.db3", 0);
  for (const Outcome& motion : {client({"export", recording.directory(), "--to", "csv"}),
                                export_aem(recording), client({"plot", recording.directory()})}) {
    EXPECT_EQ(motion.code, 2);
    EXPECT_NE(motion.err.find("has 0 of the 20 messages that its metadata.yaml tells of: bag_0.db3 "
                              "is empty"),
              std::string::npos)
        << motion.err;
    EXPECT_NE(motion.err.find("in what the recording has lost"), std::string::npos) << motion.err;
    EXPECT_EQ(motion.err.find("--topic"), std::string::npos) << motion.err;
  }
}

TEST(ExportAem, goes_on_after_a_daemon_that_had_stood_still_said_something_old) {
  MadeRecording recording;
  recording.fly(1, 500);
  recording.add(attitude_at(347));
  recording.fly(501, 600);
  recording.finish();
  const Outcome aem = export_aem(recording);
  ASSERT_EQ(aem.code, 0) << aem.err;
  EXPECT_EQ(parse_aem(aem.out).lines.size(), 600U);
  EXPECT_EQ(aem.err.find("began anew"), std::string::npos) << aem.err;
  EXPECT_NE(aem.err.find("older than those said before them: 1;"), std::string::npos) << aem.err;
}

TEST(ExportAem, is_of_the_last_run_where_a_daemon_began_anew) {
  MadeRecording recording;
  recording.fly(1, 500);
  recording.fly(1, 300);
  recording.finish();
  const Outcome aem = export_aem(recording);
  ASSERT_EQ(aem.code, 0) << aem.err;
  const Aem read = parse_aem(aem.out);
  EXPECT_EQ(read.lines.size(), 300U);
  EXPECT_EQ(read.of("STOP_TIME"), "2026-01-01T00:00:03.000000000");
  EXPECT_NE(aem.err.find("500 samples before it are not"), std::string::npos) << aem.err;
}

adstar_ServiceStatus status_of(std::uint64_t instance, std::string_view service = "fly") {
  adstar_ServiceStatus status{};
  dds::set_text(status.service, service);
  status.instance_low = instance;
  return status;
}

TEST(ExportAem, is_of_all_that_was_flown_though_a_primary_that_had_hung_speaks_last) {
  MadeRecording recording;
  recording.add(status_of(1));
  recording.add(status_of(2, "fly.standby"));
  recording.fly(1, 200);
  recording.add(status_of(2));
  recording.fly(201, 500);
  recording.add(status_of(1));
  recording.fly(3, 5);
  recording.finish();
  const Outcome aem = export_aem(recording);
  ASSERT_EQ(aem.code, 0) << aem.err;
  EXPECT_EQ(parse_aem(aem.out).lines.size(), 500U);
  EXPECT_EQ(aem.err.find("began anew"), std::string::npos) << aem.err;
  EXPECT_NE(aem.err.find("older than those said before them: 3;"), std::string::npos) << aem.err;
}

TEST(ExportAem, is_of_the_run_that_a_new_daemon_began_late) {
  MadeRecording recording;
  recording.add(status_of(1));
  recording.fly(1, 500);
  recording.add(status_of(2));
  recording.fly(150, 300);
  recording.finish();
  const Outcome aem = export_aem(recording);
  ASSERT_EQ(aem.code, 0) << aem.err;
  EXPECT_EQ(parse_aem(aem.out).lines.size(), 151U);
  EXPECT_NE(aem.err.find("500 samples before it are not"), std::string::npos) << aem.err;
}

/// A host whose daemon flies so many seconds of simulation from 0 on, and says its status once a second.
void fly_host(MadeRecording& recording, std::uint64_t instance, std::uint64_t seconds,
              bool says_status = true) {
  constexpr std::uint64_t kSteps = 100;  // a second
  for (std::uint64_t step = 0; step < seconds * kSteps; ++step) {
    if (says_status && step % kSteps == kSteps / 2) {
      recording.add(status_of(instance));
    }
    recording.fly(step, step);
    recording.now_ns += kStep_ns - 2'000'000;
  }
}

TEST(ExportAem, is_of_the_second_hosts_flight_where_it_began_after_the_firsts_had_ended) {
  for (const bool first_says_status : {true, false}) {
    MadeRecording recording;
    fly_host(recording, 1, 7, first_says_status);
    fly_host(recording, 2, 3);
    recording.finish();
    const Outcome aem = export_aem(recording);
    ASSERT_EQ(aem.code, 0) << aem.err;
    const Aem read = parse_aem(aem.out);
    EXPECT_EQ(read.lines.size(), 300U) << first_says_status;
    EXPECT_EQ(read.of("STOP_TIME"), "2026-01-01T00:00:02.990000000");
    EXPECT_NE(aem.err.find("700 samples before it are not"), std::string::npos) << aem.err;
  }
}

TEST(ExportAem, refuses_values_that_would_break_its_lines) {
  MadeRecording recording;
  recording.fly(1, 2);
  recording.finish();
  for (const char* option : {"--frame", "--object-id", "--originator"}) {
    for (const std::string& value : {std::string("x\nDATA_STOP"), std::string(), std::string("  "),
                                     std::string("\xc3\xa4"), std::string(201, 'x')}) {
      const Outcome refused = export_aem(recording, {option, value});
      EXPECT_EQ(refused.code, 2) << option << " '" << value << "'";
      EXPECT_EQ(refused.out, "");
      EXPECT_NE(refused.err.find(option), std::string::npos) << refused.err;
    }
  }
  const Outcome aem = export_aem(recording, {"--frame", "Eme2000", "--object-id", "2026-001A"});
  ASSERT_EQ(aem.code, 0) << aem.err;
  EXPECT_EQ(parse_aem(aem.out).of("REF_FRAME_A"), "EME2000");
}

TEST(Export, to_csv_refuses_what_only_an_aem_has) {
  MadeRecording recording;
  recording.fly(1, 2);
  recording.finish();
  for (const char* option : {"--epoch-utc", "--frame", "--object-id", "--originator"}) {
    const Outcome csv = client({"export", recording.directory(), "--to", "csv", option, "x"});
    EXPECT_EQ(csv.code, 2) << option;
    EXPECT_NE(csv.err.find(std::string(option) + ": "), std::string::npos) << csv.err;
  }
}

TEST(Export, ends_at_ctrl_c_though_the_reader_of_its_pipe_stands_still) {
  for (const int signal : {SIGINT, SIGTERM}) {
    MadeRecording recording;
    recording.fly(1, 1'500);
    recording.finish();
    const std::string pipe = recording.out("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDWR | O_CLOEXEC);  // which never reads
    ASSERT_GE(fcntl(reader, F_SETPIPE_SZ, 4096), 4096);
    Process process({"bash", "-c", "exec \"$0\" export \"$1\" --to csv > \"$2\"", ADSTAR_CLI,
                     recording.directory(), pipe});
    pollfd room{reader, POLLOUT, 0};
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (poll(&room, 1, 0) == 1 && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(poll(&room, 1, 0), 0) << "the pipe is full; " << process.err();
    process.send(signal);
    EXPECT_EQ(process.wait(), 1);
    EXPECT_EQ(
        process.err(),
        "adstar export: interrupted; standard output takes no more, and the rest is not there\n");
    close(reader);
  }
}

/// The drawing, without the name of the recording above it.
std::string below_title(const std::string& svg) { return svg.substr(svg.find("</text>")); }

TEST(Plot, is_of_the_last_run_where_a_daemon_began_anew) {
  MadeRecording anew, alone;
  anew.fly(1, 500);
  anew.fly(1, 300);
  anew.finish();
  alone.fly(1, 300);
  alone.finish();
  const Outcome drawn = client({"plot", anew.directory(), "--output", anew.out("p.svg")});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_NE(drawn.err.find("1,000 samples before it are not"), std::string::npos) << drawn.err;
  const Outcome expected = client({"plot", alone.directory(), "--output", alone.out("p.svg")});
  EXPECT_EQ(expected.err, "");
  EXPECT_TRUE(below_title(read_text(anew.out("p.svg"))) ==
              below_title(read_text(alone.out("p.svg"))));
}

/// Of all programs that this test has run so far, the most that one had at once.
long most_memory_kB() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss;
}

TEST(Recording, of_any_length_is_exported_and_plotted_in_the_same_memory) {
  const auto export_and_plot = [](std::uint64_t steps) {
    MadeRecording recording;
    recording.fly(1, steps);
    recording.finish();
    const Outcome aem = export_aem(recording, {"--output", recording.out("a.aem")});
    EXPECT_EQ(aem.code, 0) << aem.err;
    const Outcome plot =
        client({"plot", recording.directory(), "--output", recording.out("p.svg")});
    EXPECT_EQ(plot.code, 0) << plot.err;
    return most_memory_kB();
  };
  const long short_kB = export_and_plot(1'000);
  EXPECT_LT(export_and_plot(100'000), short_kB + 8'000);
}

}  // namespace
}  // namespace adstar::testing
