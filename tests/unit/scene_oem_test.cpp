// [spacecraft.orbit] model = "oem": a CCSDS Orbit Ephemeris Message as the orbit, read whole or refused with the place.

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "service/report/scene_report.hpp"

namespace adstar::scene {
namespace {

const std::string kEpoch = "epoch_utc = 2026-01-01T00:00:00Z\n";

class Oem : public ::testing::Test {
 protected:
  Oem() {
    std::string pattern = (std::filesystem::temp_directory_path() / "adstar-oem.XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
  }
  ~Oem() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  std::string scene(const std::string& simulation = kEpoch) const {
    return std::string(kSimulation) + simulation + kSpacecraft +
           "[spacecraft.orbit]\nmodel = \"oem\"\nfile = \"orbit.oem\"\n";
  }
  void write(const std::string& text) const { std::ofstream(directory_ / "orbit.oem") << text; }
  std::string refused(const std::string& text) const {
    write(text);
    return refusal(scene(), directory_ / "scene.toml");
  }
  std::filesystem::path directory_;
};

/// With rows of that many of its minutes.
std::string rows_of(const KeplerOrbit<double>& orbit, int minutes, const char* end = "\n",
                    const char* epoch = "2026-01-01T00:%02d:00.000", int later = 0) {
  std::string text;
  for (int minute = 0; minute < minutes; ++minute) {
    const OrbitMotion<double> at = motion_at(orbit, 60.0 * minute);
    char when[60], row[300];
    std::snprintf(when, sizeof when, epoch, minute + later);
    std::snprintf(row, sizeof row, "%s %.12f %.12f %.12f %.15f %.15f %.15f%s", when, at.r_I.x / 1e3,
                  at.r_I.y / 1e3, at.r_I.z / 1e3, at.v_I.x / 1e3, at.v_I.y / 1e3, at.v_I.z / 1e3,
                  end);
    text += row;
  }
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

const std::string kHead =
    "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-01-01T00:00:00\nORIGINATOR = A\n"
    "META_START\nOBJECT_NAME = SAT\nCENTER_NAME = EARTH\nREF_FRAME = EME2000\n"
    "TIME_SYSTEM = UTC\nINTERPOLATION = HERMITE\nINTERPOLATION_DEGREE = 7\nMETA_STOP\n";

const KeplerOrbit<double> kOrbit = make_orbit<double>({7e6, 0.01, 1, 0.5, 0.2, 0});

TEST_F(Oem, gives_the_orbit_of_its_rows_between_them) {
  const std::string text = kHead + "COMMENT one row a minute\n" + rows_of(kOrbit, 20);
  write(text);
  const Scene read = parse(scene(), directory_ / "scene.toml");
  const Orbit<double>& given = *read.spacecraft[0].orbit;
  for (const double t : {0.0, 90.0, 333.3, 1139.0}) {
    const OrbitMotion<double> a = motion_at(given, t), b = motion_at(kOrbit, t);
    EXPECT_LT(norm(a.r_I - b.r_I), 1e-3) << t;
    EXPECT_LT(norm(a.v_I - b.v_I), 1e-4) << t;
  }
  const std::string warning = "its orbit is known from 0 s to 1140 s, and not over the whole run";
  EXPECT_NE(report::scene_report(read).find(warning), std::string::npos) << "endless";
  const Scene shorter = parse(scene(kEpoch + "duration = \"1140s\"\n"), directory_ / "scene.toml");
  EXPECT_EQ(report::scene_report(shorter).find("WARNING   its orbit"), std::string::npos);
}

TEST_F(Oem, interpolates_by_position_alone_where_it_says_lagrange) {
  write(replaced(kHead, "HERMITE", "LAGRANGE") + rows_of(kOrbit, 20));
  const Scene read = parse(scene(), directory_ / "scene.toml");
  const Orbit<double>& given = *read.spacecraft[0].orbit;
  EXPECT_EQ(std::get<std::shared_ptr<const Ephemeris<double>>>(given)->method,
            EphemerisMethod::lagrange);
  EXPECT_LT(norm(motion_at(given, 333.3).r_I - motion_at(kOrbit, 333.3).r_I), 0.1);
}

TEST_F(Oem, takes_dates_in_the_time_system_that_it_names) {
  struct {
    const char *system, *epoch;
    int minutes;
  } const cases[] = {{"TAI", "2026-01-01T00:%02d:37.000", 0},
                     {"GPS", "2026-01-01T00:%02d:18.000", 0},
                     {"TT", "2026-01-01T00:%02d:09.184", 1}};
  for (const auto& [system, epoch, minutes] : cases) {
    write(replaced(kHead, "TIME_SYSTEM = UTC", std::string("TIME_SYSTEM = ") + system) +
          rows_of(kOrbit, 20, "\n", epoch, minutes));
    const Scene read = parse(scene(), directory_ / "scene.toml");
    EXPECT_LT(norm(motion_at(*read.spacecraft[0].orbit, 333.3).r_I - motion_at(kOrbit, 333.3).r_I),
              1e-3)
        << system;
  }
}

TEST_F(Oem, passes_over_accelerations_and_covariances) {
  write(kHead + rows_of(kOrbit, 20, " 0.1 0.2 0.3\n") +
        "COVARIANCE_START\nEPOCH = 2026-01-01T00:00:00\n1\n0 1\nCOVARIANCE_STOP\n");
  const Scene read = parse(scene(), directory_ / "scene.toml");
  EXPECT_LT(norm(motion_at(*read.spacecraft[0].orbit, 333.3).r_I - motion_at(kOrbit, 333.3).r_I),
            1e-3);
}

TEST_F(Oem, refuses_what_is_none_with_the_place) {
  const auto expect = [&](const std::string& text, const char* words) {
    const std::string complaint = refused(text);
    EXPECT_NE(complaint.find(words), std::string::npos) << complaint;
  };
  const std::string rows = rows_of(kOrbit, 20);
  expect("", "no CCSDS_OEM_VERS");
  expect("x,y\n", "orbit.oem:1:1: header: got \"x,y\"");
  expect(kHead + "2026-01-01T00:00:00 1 2 3\n", "orbit.oem:12:1: row: got 3 numbers");
  expect(kHead + "2026-01-01T00:00:00 1 2 3 4 5 6 7\n", "orbit.oem:12:1: row: got 7 numbers");
  expect(kHead + "2026-01-01T00:00:00 1 2 3 4 5 six\n", "orbit.oem:12:1: row: got \"six\"");
  expect(replaced(kHead, "EME2000", "ITRF") + rows, "axes that do not turn");
  expect(replaced(kHead, "REF_FRAME = EME2000\n", "") + rows, "REF_FRAME: got nothing");
  expect(replaced(kHead, "CENTER_NAME = EARTH\n", "") + rows, "CENTER_NAME: got nothing");
  expect(replaced(kHead, "DEGREE = 7", "DEGREE = 7.5") + rows, "a whole degree from 1 to 15");
  expect(kHead + "2026-01-01T00:00:00 7000 0 0 0 7 0\n", "fewer epochs");
  expect(kHead + "2026-01-01T00:01:00 7000 0 0 0 7 0\n2026-01-01T00:00:00 7000 0 0 0 7 0\n",
         "an epoch after that of the row before");
  expect(kHead + rows + rows.substr(rows.rfind('\n', rows.size() - 2) + 1),
         "an epoch after that of the row before");
  EXPECT_NE(refusal(scene(""), directory_ / "scene.toml").find("an orbit with dates in a scene"),
            std::string::npos);
  std::filesystem::remove(directory_ / "orbit.oem");
  EXPECT_NE(refusal(scene(), directory_ / "scene.toml").find("a CCSDS OEM file"),
            std::string::npos);
}

/// Between two segments lies what the standard forbids to interpolate over: a manoeuvre.
TEST_F(Oem, refuses_a_second_segment_by_its_line) {
  const std::string complaint =
      refused(kHead + rows_of(kOrbit, 10) + kHead.substr(kHead.find("META_START")));
  EXPECT_NE(complaint.find("orbit.oem:22:1: META_START: got a second segment"), std::string::npos)
      << complaint;
}

TEST_F(Oem, refuses_velocities_that_are_not_of_the_positions) {
  // Of the wrong unit, and of rows half a revolution apart.
  for (const char* const text : {"2026-01-01T00:00:00 7000000 0 0 0 7.5 0\n"
                                 "2026-01-01T00:01:00 6986000 449000 0 -0.5 7.48 0\n",
                                 "2026-01-01T00:00:00 7000 0 0 0 7.5 0\n"
                                 "2026-01-01T00:48:30 -7000 0 0 0 -7.5 0\n"}) {
    const std::string complaint = refused(kHead + text);
    EXPECT_NE(complaint.find("whose velocities are not those of its positions, 0 s after"),
              std::string::npos)
        << complaint;
  }
  EXPECT_NE(refused(kHead + "2026-01-01T00:00:00 7000 0 0 0 7500 0\n")
                .find("orbit.oem:12:1: row: got "
                      "a speed that no spacecraft"),
            std::string::npos);
}

/// A manoeuvre, or too few rows: flown as they are, and warned of.
TEST_F(Oem, that_its_polynomial_follows_badly_is_warned_of) {
  const auto report = [&](const std::string& text) {
    write(text);
    return report::scene_report(parse(scene(), directory_ / "scene.toml"));
  };
  const std::string warning = "WARNING   its polynomial follows the epochs badly";
  const std::string good = report(kHead + rows_of(kOrbit, 40));
  EXPECT_NE(good.find("; from every other one it meets the rest within 3e-05 m"), std::string::npos)
      << good;
  EXPECT_EQ(good.find(warning), std::string::npos);
  // 100 m/s more from minute 20 on.
  std::string pushed = rows_of(kOrbit, 20);
  const OrbitMotion<double> at = motion_at(kOrbit, 60.0 * 20);
  for (int minute = 20; minute < 40; ++minute) {
    char row[300];
    const Vec3<double> v = at.v_I + (100 / norm(at.v_I)) * at.v_I;
    const Vec3<double> r = at.r_I + (60.0 * (minute - 20)) * v;
    std::snprintf(row, sizeof row, "2026-01-01T00:%02d:00 %.6f %.6f %.6f %.9f %.9f %.9f\n", minute,
                  r.x / 1e3, r.y / 1e3, r.z / 1e3, v.x / 1e3, v.y / 1e3, v.z / 1e3);
    pushed += row;
  }
  EXPECT_NE(report(kHead + pushed).find(warning), std::string::npos);
  EXPECT_NE(report(replaced(replaced(kHead, "HERMITE", "LAGRANGE"), "DEGREE = 7", "DEGREE = 1") +
                   rows_of(kOrbit, 40))
                .find(warning),
            std::string::npos);
  EXPECT_NE(report(kHead + rows_of(kOrbit, 5)).find("; too few to tell"), std::string::npos);
}

}  // namespace
}  // namespace adstar::scene
