// Numbers, rows and the live table as text.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "service/adstar/live_table.hpp"
#include "service/adstar/reflight_text.hpp"
#include "service/report/numbers.hpp"
#include "service/report/row.hpp"

namespace adstar::cli {
namespace {

using report::append_csv, report::append_json, report::kAttitude, report::kWork, report::Row;

std::string number(double value) {
  std::string text;
  report::append_number(text, value);
  return text;
}

TEST(Numbers, have_17_significant_digits) {
  EXPECT_EQ(number(0.1), "0.10000000000000001");
  EXPECT_EQ(number(-1e-300), "-1e-300");
  EXPECT_EQ(number(1), "1");
  EXPECT_EQ(number(1.0 / 3), "0.33333333333333331");
  EXPECT_EQ(number(-0.0), "-0");
  EXPECT_EQ(number(-std::nan("")), "nan");
  EXPECT_EQ(number(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Numbers, seconds_come_from_nanoseconds_without_rounding) {
  EXPECT_EQ(report::seconds_text(0), "0");
  EXPECT_EQ(report::seconds_text(10'000'000), "0.01");
  EXPECT_EQ(report::seconds_text(100'000'000'000), "100");
  EXPECT_EQ(report::seconds_text(1), "0.000000001");
  EXPECT_EQ(report::seconds_text(-1'500'000'000), "-1.5");
  EXPECT_EQ(report::seconds_text(std::numeric_limits<std::int64_t>::max()), "9223372036.854775807");
  EXPECT_EQ(report::seconds_text(std::numeric_limits<std::int64_t>::min()),
            "-9223372036.854775808");
}

TEST(Numbers, are_counted_in_thousands) {
  EXPECT_EQ(report::counted(0), "0");
  EXPECT_EQ(report::counted(999), "999");
  EXPECT_EQ(report::counted(1'000), "1,000");
  EXPECT_EQ(report::counted(1'234'567), "1,234,567");
}

Row some_row() {
  Row row;
  row.spacecraft = "sat1";
  row.step = 7;
  row.time_ns = 70'000'000;
  row.values[kAttitude] = 0.5;
  row.values[kWork] = std::nan("");
  return row;
}

TEST(Rows, csv_leaves_the_unknown_empty) {
  std::string text;
  append_csv(text, some_row());
  EXPECT_EQ(text, "sat1,7,0.07,0.5,,,,,,,,,,,,,,nan\n");
}

TEST(Rows, json_says_null_for_what_is_no_number) {
  std::string text;
  append_json(text, some_row());
  EXPECT_EQ(
      text.find("{\"spacecraft\":\"sat1\",\"step\":7,\"time_s\":0.07,\"q_w\":0.5,\"q_x\":null,"),
      0U)
      << text;
  EXPECT_NE(text.find("\"work_j\":null}\n"), std::string::npos) << text;
}

TEST(Rows, a_hostile_name_breaks_neither_format) {
  Row row = some_row();
  row.spacecraft = "a,\"b\"\n\x1b[2J\xff";
  std::string csv, json;
  append_csv(csv, row);
  append_json(json, row);
  EXPECT_EQ(csv.find("a??b???[2J"), 0U) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1);
  EXPECT_EQ(json.find("{\"spacecraft\":\"a,\\\"b\\\"\\u000a\\u001b[2J\\u00ff\","), 0U) << json;
}

LiveTable table_of(int spacecraft, LiveTable::Clock::time_point now) {
  LiveTable table("monitor");
  for (int i = 0; i < spacecraft; ++i) {
    Row row = some_row();
    row.spacecraft = "sat" + std::to_string(i);
    table.update(row, now);
  }
  return table;
}

TEST(LiveTables, fit_the_terminal_whatever_its_size) {
  const auto now = LiveTable::Clock::now();
  LiveTable table = table_of(100, now);
  table.set_note("a note that is rather long, so that a narrow terminal has to cut it");
  for (const std::size_t columns : {20U, 40U, 80U, 200U, 400U}) {
    for (const std::size_t lines : {5U, 24U, 60U, 200U}) {
      const std::string text = table.text({columns, lines}, now);
      std::size_t count = 0, begin = 0;
      for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;
           begin = end + 1) {
        ++count;
        EXPECT_LE(end - begin, columns);
      }
      EXPECT_LE(count, lines);
    }
  }
}

TEST(LiveTables, keep_a_value_that_the_next_row_does_not_know) {
  const auto now = LiveTable::Clock::now();
  LiveTable table = table_of(1, now);
  Row row = some_row();
  row.spacecraft = "sat0";
  row.values[kAttitude].reset();
  table.update(row, now);
  EXPECT_NE(table.text({200, 24}, now).find("0.500000"), std::string::npos);
}

TEST(LiveTables, say_which_spacecraft_fell_silent) {
  const auto now = LiveTable::Clock::now();
  const LiveTable table = table_of(1, now);
  EXPECT_EQ(table.text({200, 24}, now).find("silent"), std::string::npos);
  EXPECT_NE(table.text({200, 24}, now + std::chrono::seconds(10)).find("silent for 10 s"),
            std::string::npos);
}

TEST(ReflightText, tells_a_run_that_was_short_from_one_whose_beginning_is_not_kept) {
  run::Reflight flight;
  flight.to = {0, 700};
  EXPECT_EQ(reflight_text(flight),
            "step 0 to step 700, 0 commands, compared at 0 state hashes and 0 checkpoints\n"
            "nothing to compare with: the run ended before its first second\n");
  flight.from = flight.to = {0, 5893};
  EXPECT_NE(reflight_text(flight).find("what came before step 5893, its oldest checkpoint, is "
                                       "not kept; [run] history = \"whole\""),
            std::string::npos);
  flight.hashes = 1;
  EXPECT_NE(reflight_text(flight).find("compared at 1 state hash and 0 checkpoints\nsame bits\n"),
            std::string::npos);
  flight.differs_at = {0, 5893};
  EXPECT_NE(reflight_text(flight).find("differs: the same at step 0, not at step 5893"),
            std::string::npos);
}

}  // namespace
}  // namespace adstar::cli
