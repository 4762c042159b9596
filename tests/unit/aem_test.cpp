// The writer of Attitude Ephemeris Messages against a reader made from the standard.

#include "service/report/aem.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/aem_parser.hpp"

namespace adstar::report {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

AemHeader some_header(std::string_view epoch = "2026-01-01T00:00:00Z") {
  AemHeader header;
  header.creation_utc = "2026-02-03T04:05:06";
  header.object_name = "sat1";
  header.epoch = *scene::tai_date(epoch, scene::Clock::utc);
  return header;
}

AttitudePoint at(std::int64_t time_ns) { return {time_ns, {1, 0, 0, 0}, {0, 0, 0}}; }

std::string aem_text(const AemHeader& header, const std::vector<AttitudePoint>& points) {
  std::string text;
  AemWriter aem(header, points.empty() ? 0 : points.front().time_ns,
                points.empty() ? 0 : points.back().time_ns, text);
  for (const AttitudePoint& point : points) {
    aem.add(point);
  }
  aem.end();
  return text;
}

TEST(AemText, is_what_the_standard_orders) {
  const AttitudePoint point{kSecond / 2, {0.5, -0.5, 0.5, 0.5}, {0.1, -0.0, 1e-12}};
  EXPECT_EQ(aem_text(some_header(), {point}),
            "CCSDS_AEM_VERS = 2.0\n"
            "CREATION_DATE = 2026-02-03T04:05:06\n"
            "ORIGINATOR = ADSTAR\n"
            "\n"
            "META_START\n"
            "OBJECT_NAME = sat1\n"
            "OBJECT_ID = UNKNOWN\n"
            "REF_FRAME_A = GCRF\n"
            "REF_FRAME_B = SC_BODY_1\n"
            "TIME_SYSTEM = UTC\n"
            "START_TIME = 2026-01-01T00:00:00.500000000\n"
            "STOP_TIME = 2026-01-01T00:00:00.500000000\n"
            "ATTITUDE_TYPE = QUATERNION/ANGVEL\n"
            "ANGVEL_FRAME = SC_BODY_1\n"
            "META_STOP\n"
            "\n"
            "DATA_START\n"
            "2026-01-01T00:00:00.500000000 -5.000000000000000E-01 5.000000000000000E-01 "
            "5.000000000000000E-01 5.000000000000000E-01 5.729577951308233E+00 "
            "0.000000000000000E+00 5.729577951308232E-11\n"
            "DATA_STOP\n");
}

TEST(AemText, has_the_direction_of_the_example_in_annex_f2) {
  // Frame B is A turned by +90 degrees about Z: X of B is (0, 1, 0) in A, and so q_IB turns x to y.
  const double half = std::numbers::sqrt2 / 2;
  const AttitudePoint point{0, {half, 0, 0, half}, {0, 0, 0}};
  const auto line = testing::parse_aem(aem_text(some_header(), {point})).lines.at(0);
  EXPECT_NEAR(line.q3, 0.7071, 1e-4);
  EXPECT_NEAR(line.qc, 0.7071, 1e-4);
  const auto x_b = line.to_b({1, 0, 0});
  EXPECT_NEAR(x_b[0], 0, 1e-15);
  EXPECT_NEAR(x_b[1], -1, 1e-15);
  EXPECT_NEAR(x_b[2], 0, 1e-15);
}

TEST(AemText, keeps_sixteen_digits_and_gives_rates_in_degrees) {
  const AttitudePoint point{1, {std::sqrt(0.7), 0.1, -0.2, 0.5}, {0.45549, -0.82623, 3.476e-5}};
  const auto line = testing::parse_aem(aem_text(some_header(), {point})).lines.at(0);
  EXPECT_EQ(line.epoch, "2026-01-01T00:00:00.000000001");
  EXPECT_NEAR(line.qc, std::sqrt(0.7), 1e-15);
  EXPECT_EQ(line.q1, 0.1);
  EXPECT_EQ(line.q2, -0.2);
  EXPECT_EQ(line.q3, 0.5);
  EXPECT_NEAR(line.angular_velocity_deg_s[1], -0.82623 * 180 / std::numbers::pi, 1e-13);
}

TEST(AemText, goes_through_a_leap_second_as_utc_does) {
  const auto text = aem_text(some_header("2016-12-31T23:59:59Z"),
                             {at(0), at(kSecond), at(3 * kSecond / 2), at(2 * kSecond)});
  const auto aem = testing::parse_aem(text);
  EXPECT_EQ(aem.lines[1].epoch, "2016-12-31T23:59:60.000000000");
  EXPECT_EQ(aem.lines[2].epoch, "2016-12-31T23:59:60.500000000");
  EXPECT_EQ(aem.lines[3].epoch, "2017-01-01T00:00:00.000000000");
}

TEST(AemText, keeps_its_nanoseconds_over_years) {
  const std::int64_t later = std::int64_t{3} * 365 * 86'400 * kSecond + 123'456'789;
  const auto aem = testing::parse_aem(aem_text(some_header("2026-01-01T00:00:00.1Z"), {at(later)}));
  EXPECT_EQ(aem.of("START_TIME"), "2028-12-31T00:00:00.223456789");
}

TEST(AemText, refuses_what_the_standard_has_no_words_for) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(aem_text(some_header(), {}), std::invalid_argument);
  EXPECT_THROW(aem_text(some_header(), {at(1), at(1)}), std::invalid_argument);
  EXPECT_THROW(aem_text(some_header(), {at(2), at(1)}), std::invalid_argument);
  EXPECT_THROW(aem_text(some_header(), {{0, {nan, 0, 0, 0}, {}}}), std::invalid_argument);
  EXPECT_THROW(aem_text(some_header("9999-12-31T23:59:59Z"), {at(2 * kSecond)}),
               std::invalid_argument);
}

TEST(AemText, is_of_the_time_that_its_metadata_says) {
  std::string text;
  AemWriter aem(some_header(), 1, 3, text);
  EXPECT_THROW(aem.add(at(2)), std::invalid_argument);
  aem.add(at(1));
  aem.add(at(2));
  EXPECT_THROW(aem.end(), std::invalid_argument);
  aem.add(at(3));
  aem.end();
  EXPECT_EQ(testing::parse_aem(text).lines.size(), 3U);
}

TEST(AemName, is_of_one_case) {
  EXPECT_EQ(aem_name("sat_1"), "sat_1");
  EXPECT_EQ(aem_name("Sat-1b"), "SAT-1B");
  EXPECT_EQ(aem_name("a\tb"), "a?b");
}

}  // namespace
}  // namespace adstar::report
