#pragma once
// Reads an Attitude Ephemeris Message in keyword = value notation as CCSDS 504.0-B-2 has it: written from the standard, knowing
// nothing of who writes. Throws std::runtime_error with the paragraph that the text goes against.

#include <array>
#include <cctype>
#include <cstddef>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace adstar::testing {

struct AemLine {
  std::string epoch;
  double q1, q2, q3, qc;
  std::array<double, 3> angular_velocity_deg_s;

  /// Annex F2.1: coordinates in B of what has coordinates x in A.
  std::array<double, 3> to_b(const std::array<double, 3>& x) const {
    const double m[3][3] = {
        {q1 * q1 - q2 * q2 - q3 * q3 + qc * qc, 2 * (q1 * q2 + q3 * qc), 2 * (q1 * q3 - q2 * qc)},
        {2 * (q1 * q2 - q3 * qc), -q1 * q1 + q2 * q2 - q3 * q3 + qc * qc, 2 * (q2 * q3 + q1 * qc)},
        {2 * (q1 * q3 + q2 * qc), 2 * (q2 * q3 - q1 * qc), -q1 * q1 - q2 * q2 + q3 * q3 + qc * qc}};
    std::array<double, 3> y{};
    for (std::size_t i = 0; i < 3; ++i) {
      y[i] = m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2];
    }
    return y;
  }
};

struct Aem {
  std::vector<std::pair<std::string, std::string>> header, metadata;
  std::vector<AemLine> lines;

  std::string of(const std::string& keyword) const {
    for (const auto* part : {&header, &metadata}) {
      for (const auto& [key, value] : *part) {
        if (key == keyword) {
          return value;
        }
      }
    }
    return {};
  }
};

class AemParser {
 public:
  explicit AemParser(const std::string& text) : text_(text) {}

  Aem parse() {
    Aem aem;
    aem.header = pairs_until(
        "META_START",
        {"CCSDS_AEM_VERS", "CLASSIFICATION", "CREATION_DATE", "ORIGINATOR", "MESSAGE_ID"},
        {"CCSDS_AEM_VERS", "CREATION_DATE", "ORIGINATOR"}, "4.2.2, table 4-2");
    aem.metadata = pairs_until(
        "META_STOP",
        {"OBJECT_NAME", "OBJECT_ID", "CENTER_NAME", "REF_FRAME_A", "REF_FRAME_B", "TIME_SYSTEM",
         "START_TIME", "USEABLE_START_TIME", "USEABLE_STOP_TIME", "STOP_TIME", "ATTITUDE_TYPE",
         "EULER_ROT_SEQ", "ANGVEL_FRAME", "INTERPOLATION_METHOD", "INTERPOLATION_DEGREE"},
        {"OBJECT_NAME", "OBJECT_ID", "REF_FRAME_A", "REF_FRAME_B", "TIME_SYSTEM", "START_TIME",
         "STOP_TIME", "ATTITUDE_TYPE"},
        "4.2.3, table 4-3");
    require(aem.of("CCSDS_AEM_VERS") == "2.0", "4.2.2.1.2");
    require(aem.of("ATTITUDE_TYPE") == "QUATERNION/ANGVEL", "this parser: table 4-4");
    for (const char* time : {"CREATION_DATE", "START_TIME", "STOP_TIME"}) {
      require(is_time(aem.of(time)), std::string("6.8.9 ") + time);
    }
    for (const char* name :
         {"OBJECT_NAME", "OBJECT_ID", "ORIGINATOR", "REF_FRAME_A", "REF_FRAME_B"}) {
      require(is_one_case(aem.of(name)), std::string("6.8.6 ") + name);
    }
    require(next() == "DATA_START", "4.2.4.1");
    for (std::string line = next(); line != "DATA_STOP"; line = next()) {
      aem.lines.push_back(data_line(line));
      require(
          aem.lines.size() < 2 || aem.lines[aem.lines.size() - 2].epoch < aem.lines.back().epoch,
          "4.2.4.8.1");
    }
    require(!aem.lines.empty() && aem.lines.front().epoch == aem.of("START_TIME") &&
                aem.lines.back().epoch == aem.of("STOP_TIME"),
            "table 4-3, START_TIME and STOP_TIME");
    return aem;
  }

 private:
  static void require(bool holds, const std::string& paragraph) {
    if (!holds) {
      throw std::runtime_error("against " + paragraph);
    }
  }

  static bool is_time(const std::string& text) {
    static const std::regex shape(R"(\d{4}-(\d{2}-\d{2}|\d{3})T\d{2}:\d{2}:\d{2}(\.\d{1,16})?Z?)");
    return std::regex_match(text, shape);
  }
  static bool is_one_case(const std::string& text) {
    bool upper = false, lower = false;
    for (const char c : text) {
      upper = upper || std::isupper(static_cast<unsigned char>(c)) != 0;
      lower = lower || std::islower(static_cast<unsigned char>(c)) != 0;
    }
    return !text.empty() && !(upper && lower);
  }
  /// 6.8.4.2: at most sixteen digits, the point in second place.
  static double number(const std::string& text) {
    static const std::regex shape(R"([+-]?\d\.\d{0,15}([Ee][+-]?\d+)?)");
    require(std::regex_match(text, shape), "6.8.4.2 " + text);
    return std::stod(text);
  }

  /// 6.3: at most 254 characters, no tabs; blank lines are skipped.
  std::string next() {
    std::string line;
    do {
      require(static_cast<bool>(std::getline(text_, line)), "the end of the text came too soon");
      require(line.size() <= 254, "6.3");
    } while (line.find_first_not_of(' ') == std::string::npos);
    for (const char c : line) {
      require(c >= ' ' && c <= '~', "6.3, printable ASCII");
    }
    return line;
  }

  std::vector<std::pair<std::string, std::string>> pairs_until(
      const std::string& end, const std::vector<std::string>& order,
      const std::vector<std::string>& mandatory, const std::string& paragraph) {
    std::vector<std::pair<std::string, std::string>> pairs;
    std::size_t place = 0;
    for (std::string line = next(); line != end; line = next()) {
      const std::size_t equals = line.find('=');
      require(equals != std::string::npos, "6.6 " + line);
      const std::string key = trimmed(line.substr(0, equals)),
                        value = trimmed(line.substr(equals + 1));
      while (place < order.size() && order[place] != key) {
        ++place;
      }
      require(place < order.size(), fmt::format("{}: order of {}", paragraph, key));
      require(!value.empty(), "6.8.7 " + key);
      pairs.emplace_back(key, value);
    }
    for (const std::string& key : mandatory) {
      bool found = false;
      for (const auto& pair : pairs) {
        found = found || pair.first == key;
      }
      require(found, fmt::format("{}: {} is missing", paragraph, key));
    }
    return pairs;
  }

  static std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? std::string()
                                      : text.substr(first, text.find_last_not_of(' ') - first + 1);
  }

  AemLine data_line(const std::string& line) {
    std::istringstream words(line);
    std::vector<std::string> w;
    for (std::string word; words >> word;) {
      w.push_back(word);
    }
    require(w.size() == 8, "table 4-4, QUATERNION/ANGVEL");
    require(is_time(w[0]), "6.8.9 " + w[0]);
    return {w[0],         number(w[1]), number(w[2]),
            number(w[3]), number(w[4]), {number(w[5]), number(w[6]), number(w[7])}};
  }

  std::istringstream text_;
};

inline Aem parse_aem(const std::string& text) { return AemParser(text).parse(); }

}  // namespace adstar::testing
