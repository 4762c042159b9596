// Table torques: exact knots from CSV files, and what is refused of them.

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

constexpr const char* kHeader = "time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m\n";

class TableTorque : public testing::Test {
 protected:
  TableTorque()
      : directory_(std::filesystem::temp_directory_path() /
                   ("adstar_scene_table_" + std::to_string(getpid()))),
        csv_((directory_ / "profile.csv").string()),
        scene_((directory_ / "scene.toml").string()) {
    std::filesystem::create_directories(directory_);
  }
  ~TableTorque() override { std::filesystem::remove_all(directory_); }

  void write(const std::string& csv) const { std::ofstream(csv_) << csv; }

  Table<double> table(const std::string& csv, const std::string& extra = "") const {
    write(csv);
    return std::get<Table<double>>(parse(text(extra), scene_).spacecraft.at(0).torques.at(0));
  }
  std::string refused(const std::string& csv, const std::string& extra = "") const {
    write(csv);
    return refusal(text(extra), scene_);
  }
  static std::string text(const std::string& extra, const std::string& file = "profile.csv") {
    return in_torque("model = \"table\"\nframe = \"inertial\"\nfile = \"" + file + "\"\n" + extra);
  }

  std::filesystem::path directory_;
  std::string csv_, scene_;
};

TEST_F(TableTorque, reads_knots_exactly) {
  const Table<double> t = table("# slew\n\n" + std::string(kHeader) +
                                "0.0,0.1,-2e-3,3\r\n"
                                "  0.000000001 , +1 , 0 , 0\n"
                                "9007199.254740993,1,2,3\n"
                                "1e7,1.5,2,3");
  EXPECT_EQ(t.frame, Frame::inertial);
  EXPECT_EQ(t.interpolation, Interpolation::hold);
  EXPECT_EQ(t.after_end, AfterEnd::zero);
  EXPECT_EQ(t.time_ns,
            (std::vector<std::int64_t>{0, 1, 9'007'199'254'740'993, 10'000'000'000'000'000}));
  EXPECT_EQ(t.torque_n_m,
            (std::vector<Vec3<double>>{{0.1, -2e-3, 3}, {1, 0, 0}, {1, 2, 3}, {1.5, 2, 3}}));
}

TEST_F(TableTorque, reads_interpolation_and_end) {
  const Table<double> t = table(std::string(kHeader) + "0,0,0,0\n1,1,1,1\n",
                                "interpolation = \"linear\"\nafter_end = \"hold\"");
  EXPECT_EQ(t.interpolation, Interpolation::linear);
  EXPECT_EQ(t.after_end, AfterEnd::hold);
}

TEST_F(TableTorque, stays_unread_when_told_so) {
  const Scene scene = parse(text("", "not_there.csv"), scene_, Tables::skip);
  EXPECT_TRUE(std::get<Table<double>>(scene.spacecraft.at(0).torques.at(0)).time_ns.empty());
}

TEST_F(TableTorque, is_found_beside_the_scene) {
  write(std::string(kHeader) + "0,0,0,1\n");
  std::ofstream(scene_) << text("");
  EXPECT_EQ(std::get<Table<double>>(load(scene_).spacecraft.at(0).torques.at(0)).time_ns.size(),
            1U);
}

TEST_F(TableTorque, refuses_time_that_runs_backwards) {
  EXPECT_EQ(refused(std::string(kHeader) + "0,0,0,0\n2.5,0,0,0\n1.5,0,0,0\n"),
            csv_ +
                ":4:1: time_s: got \"1.5\", expected a time after the 2.5 of the row before; try "
                "sorting the rows by time");
}

TEST_F(TableTorque, refuses_time_that_repeats) {
  EXPECT_EQ(refused(std::string(kHeader) + "1,0,0,0\n1.000,0,0,0\n"),
            csv_ +
                ":3:1: time_s: got \"1.000\", expected a time after the 1 of the row before; try "
                "removing one of the two rows");
}

TEST_F(TableTorque, refuses_times_finer_than_a_nanosecond) {
  EXPECT_EQ(refused(std::string(kHeader) + "0.1234567891,0,0,0\n"),
            csv_ +
                ":2:1: time_s: got \"0.1234567891\", expected decimal seconds in whole "
                "nanoseconds, within 4e9 s; try 0.123456789");
}

TEST_F(TableTorque, refuses_what_is_no_number_at_its_column) {
  EXPECT_EQ(
      refused(std::string(kHeader) + "0,0,nan,0\nx,0,0,1e999\n"),
      csv_ + ":2:5: torque_y_n_m: got \"nan\", expected a finite number in N m; try 0.0\n" + csv_ +
          ":3:1: time_s: got \"x\", expected decimal seconds in whole nanoseconds, "
          "within 4e9 s; try 0.5\n" +
          csv_ + ":3:7: torque_z_n_m: got \"1e999\", expected a finite number in N m; try 0.0");
}

TEST_F(TableTorque, refuses_rows_of_another_length) {
  EXPECT_EQ(refused(std::string(kHeader) + "0,0,0\n"),
            csv_ +
                ":2:1: row: got 3 fields, expected 4: time_s,torque_x_n_m,torque_y_n_m,"
                "torque_z_n_m; try 0.0,0.0,0.0,0.01");
}

TEST_F(TableTorque, refuses_another_header_and_no_header_and_no_rows) {
  const std::string expected =
      ", expected \"time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m\"; try that as the first line";
  EXPECT_EQ(refused("t,x,y,z\n0,0,0,0\n"), csv_ + ":1:1: header: got \"t,x,y,z\"" + expected);
  EXPECT_EQ(refused(""), csv_ + ":1:1: header: got nothing" + expected);
  EXPECT_EQ(refused(kHeader),
            csv_ + ":1:1: rows: got nothing, expected at least one row; try 0.0,0.0,0.0,0.01");
}

TEST_F(TableTorque, counts_the_rest_of_a_file_that_is_wrong_in_every_line) {
  std::string csv = kHeader;
  for (int i = 0; i < 100; ++i) {
    csv += std::to_string(i) + ",a,0,0\n";
  }
  const std::string text = refused(csv);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 20);
  EXPECT_NE(text.find(csv_ + ":101:1: file: got 80 more wrong values, expected rows as above; try "
                             "correcting those first"),
            std::string::npos)
      << text;
}

TEST_F(TableTorque, refuses_slopes_beyond_double) {
  EXPECT_EQ(refused(std::string(kHeader) + "0,-1.7e308,0,0\n1,1.7e308,0,0\n",
                    "interpolation = \"linear\""),
            scene_ +
                ":9:8: spacecraft[0].torque[0].file: got a slope beyond the range of double "
                "after knot 1, expected torques that a line can join; try smaller torques, or "
                "interpolation = \"hold\"");
}

TEST_F(TableTorque, names_the_nearest_file_when_its_own_is_missing) {
  write(kHeader);
  EXPECT_EQ(refusal(text("", "profil.csv"), scene_),
            scene_ + ":9:8: spacecraft[0].torque[0].file: got \"" +
                (directory_ / "profil.csv").string() +
                "\" (No such file or directory), expected a CSV file, its path relative to the "
                "scene; try \"" +
                csv_ + '"');
}

TEST_F(TableTorque, refuses_unknown_choices_and_an_empty_path) {
  EXPECT_EQ(refused(std::string(kHeader) + "0,0,0,0\n",
                    "interpolation = \"spline\"\nafter_end = \"stop\""),
            scene_ +
                ":10:17: spacecraft[0].torque[0].interpolation: got \"spline\", expected one of "
                "hold, linear; try \"linear\"\n" +
                scene_ +
                ":11:13: spacecraft[0].torque[0].after_end: got \"stop\", expected one of "
                "zero, hold; try \"zero\"");
  EXPECT_EQ(refusal(text("", ""), scene_),
            scene_ +
                ":9:8: spacecraft[0].torque[0].file: got \"\", expected the path of a CSV file, "
                "relative to the scene; try \"profile.csv\"");
}

}  // namespace
}  // namespace adstar::scene
