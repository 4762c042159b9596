#include "service/scene/oem_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "service/scene/decimal.hpp"
#include "service/scene/files.hpp"

namespace adstar::scene {
namespace {

constexpr std::size_t kMostComplaints = 20;
constexpr std::string_view kBlank = " \t";
constexpr std::string_view kRow = "an epoch, three numbers in km and three in km/s";
constexpr std::string_view kRowExample = "2026-01-01T00:00:00 6900.0 0.0 0.0 0.0 7.6 0.0";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(kBlank), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

std::optional<Clock> clock_of(std::string_view system) {
  constexpr std::array<std::pair<std::string_view, Clock>, 4> kClocks{
      {{"UTC", Clock::utc}, {"TAI", Clock::tai}, {"TT", Clock::tt}, {"GPS", Clock::gps}}};
  for (const auto& [name, clock] : kClocks) {
    if (name == system) {
      return clock;
    }
  }
  return std::nullopt;
}

/// One OEM from its first line to its last: what stands between META_START and META_STOP, then the rows.
class OemReader {
 public:
  OemReader(const Value& origin, std::string file, const TaiDate& epoch)
      : origin_(origin), file_(std::move(file)), epoch_(epoch) {}

  std::optional<Ephemeris<double>> read(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      line.remove_suffix(!line.empty() && line.back() == '\r' ? 1 : 0);
      line = trimmed(line);
      if (!line.empty() && !line.starts_with("COMMENT")) {
        read_line(line);
      }
    }
    if (!version_seen_ && wrong_ == 0) {
      complain("header", "no CCSDS_OEM_VERS", "an Orbit Ephemeris Message in KVN",
               "CCSDS_OEM_VERS = 2.0 as its first line");
    }
    if (wrong_ > 0) {
      return std::nullopt;
    }
    return std::move(table_);
  }

 private:
  void read_line(std::string_view line) {
    if (!version_seen_) {
      version_seen_ = line.starts_with("CCSDS_OEM_VERS");
      if (!version_seen_) {
        version_seen_ = true;
        complain("header", in_quotes(line), "an Orbit Ephemeris Message in KVN",
                 "CCSDS_OEM_VERS = 2.0 as its first line");
      }
    } else if (line == "META_START") {
      if (in_segment_) {
        complain("META_START", "a second segment", "one: an orbit is not joined across them",
                 "a file of its own for each, or one segment of their rows");
      }
      in_meta_ = true;
      in_segment_ = false;
    } else if (line == "META_STOP") {
      in_meta_ = false;
      in_segment_ = true;
      demand_meta();
    } else if (line == "COVARIANCE_START") {
      in_covariance_ = true;
    } else if (line == "COVARIANCE_STOP") {
      in_covariance_ = false;
    } else if (in_meta_) {
      read_meta(line);
    } else if (in_segment_ && !in_covariance_) {
      read_row(line);
    }
  }

  void read_meta(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      complain("metadata", in_quotes(line), "KEY = value", "CENTER_NAME = EARTH");
      return;
    }
    const std::string_view key = trimmed(line.substr(0, equals));
    const std::string_view value = trimmed(line.substr(equals + 1));
    has_centre_ = has_centre_ || key == "CENTER_NAME";
    has_frame_ = has_frame_ || key == "REF_FRAME";
    if (key == "CENTER_NAME" && value != "EARTH") {
      complain(key, in_quotes(value), "EARTH", "an orbit about the Earth");
    } else if (key == "REF_FRAME" && value != "EME2000" && value != "GCRF" && value != "ICRF") {
      complain(key, in_quotes(value), "EME2000, GCRF or ICRF: axes that do not turn",
               "the orbit in one of these");
    } else if (key == "TIME_SYSTEM") {
      clock_ = clock_of(value);
      if (!clock_) {
        complain(key, in_quotes(value), "UTC, TAI, TT or GPS", "TIME_SYSTEM = UTC");
      }
    } else if (key == "INTERPOLATION") {
      if (value != "HERMITE" && value != "LAGRANGE") {
        complain(key, in_quotes(value), "HERMITE or LAGRANGE", "INTERPOLATION = HERMITE");
      }
      table_.method = value == "LAGRANGE" ? EphemerisMethod::lagrange : EphemerisMethod::hermite;
    } else if (key == "INTERPOLATION_DEGREE") {
      const auto degree = finite_number(value);
      const bool good = degree && *degree >= 1 && *degree <= Ephemeris<double>::kMostDegree &&
                        *degree == std::floor(*degree);
      if (!good) {
        complain(key, in_quotes(value), "a whole degree from 1 to 15", "INTERPOLATION_DEGREE = 7");
      }
      table_.degree = good ? static_cast<int>(*degree) : table_.degree;
    }
  }

  void demand_meta() {
    if (!clock_ && wrong_ == 0) {
      complain("TIME_SYSTEM", "nothing", "UTC, TAI, TT or GPS", "TIME_SYSTEM = UTC");
    }
    if (!has_centre_) {
      complain("CENTER_NAME", "nothing", "EARTH", "CENTER_NAME = EARTH");
    }
    if (!has_frame_) {
      complain("REF_FRAME", "nothing", "EME2000, GCRF or ICRF: axes that do not turn",
               "REF_FRAME = EME2000");
    }
  }

  void read_row(std::string_view line) {
    const std::string_view when = take_word(line);
    const auto date = clock_ ? tai_date(when, *clock_) : std::nullopt;
    const auto t_ns = date ? nanoseconds_from(epoch_, *date) : std::nullopt;
    if (!t_ns && clock_) {
      complain("epoch", in_quotes(when), "a date and time as in 2026-01-01T00:00:00.000",
               "one within 290 years of the scene's epoch");
    }
    std::array<double, 9> numbers{};  // accelerations, which may follow, are not needed
    std::size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++count) {
      const auto value = finite_number(word);
      if (!value || count == numbers.size()) {
        complain("row", in_quotes(word), kRow, kRowExample);
        return;
      }
      numbers[count] = *value;
    }
    if (count != 6 && count != 9) {
      complain("row", std::to_string(count) + " numbers", kRow, kRowExample);
      return;
    }
    if (!t_ns) {
      return;
    }
    constexpr double kFastest_km_s = 100;  // beyond it they are m/s
    if (!(std::hypot(numbers[3], numbers[4], numbers[5]) < kFastest_km_s)) {
      complain("row", "a speed that no spacecraft has", kRow, kRowExample);
      return;
    }
    constexpr double kKilo = 1e3;
    const double t_s = static_cast<double>(*t_ns) * 1e-9;
    if (!table_.rows.empty() && table_.rows.back().t_s >= t_s) {
      complain("epoch", in_quotes(when), "an epoch after that of the row before",
               "sorting the rows by time");
      return;
    }
    table_.rows.push_back({t_s,
                           {kKilo * numbers[0], kKilo * numbers[1], kKilo * numbers[2]},
                           {kKilo * numbers[3], kKilo * numbers[4], kKilo * numbers[5]}});
  }

  void complain(std::string_view key, std::string_view got, std::string_view expected,
                std::string_view remedy) {
    if (++wrong_ <= kMostComplaints) {
      origin_.complaints().add_line(
          origin_.node().place, complaint_line(file_, {std::max<std::uint32_t>(line_, 1), 1}, key,
                                               got, expected, remedy));
    }
  }

  const Value& origin_;
  std::string file_;
  TaiDate epoch_;
  Ephemeris<double> table_;
  std::optional<Clock> clock_;
  std::uint32_t line_ = 0;
  std::size_t wrong_ = 0;
  bool version_seen_ = false, in_meta_ = false, in_segment_ = false, in_covariance_ = false;
  bool has_centre_ = false, has_frame_ = false;
};

/// The first epoch [s] from which to the next the way is not that of the mean velocity, to half of it.
std::optional<double> unlike_its_velocities(const Ephemeris<double>& table) {
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const auto &a = table.rows[i - 1], &b = table.rows[i];
    const Vec3<double> slope = (1 / (b.t_s - a.t_s)) * (b.r_I - a.r_I);
    const double speed = std::max(norm(a.v_I), norm(b.v_I));
    if (!(norm(slope - 0.5 * (a.v_I + b.v_I)) <= 0.5 * speed)) {
      return a.t_s;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::shared_ptr<const Ephemeris<double>>> read_oem_file(
    const Value& value, const std::filesystem::path& scene_file, const TaiDate& epoch,
    double gravity_m3_s2) {
  const std::filesystem::path file = scene_file.parent_path() / value.node().text;
  const FileText text = read_file(file);
  if (!text.error.empty()) {
    value.refuse_as(in_quotes(file.string()) + " (" + text.error + ")",
                    "a CCSDS OEM file, its path relative to the scene", nearest_file(file, ".oem"));
    return std::nullopt;
  }
  auto table = OemReader(value, file.string(), epoch).read(text.text);
  if (!table) {
    return std::nullopt;
  }
  table->gravity_m3_s2 = gravity_m3_s2;
  // The message may name a degree that its rows do not carry: then as high as they do.
  const auto rows = static_cast<int>(std::min<std::size_t>(table->rows.size(), 100));
  const bool hermite = table->method == EphemerisMethod::hermite;
  table->degree =
      std::min(hermite ? table->degree | 1 : table->degree, hermite ? 2 * rows - 1 : rows - 1);
  if (const char* const defect = defect_of(*table)) {
    value.refuse_as(in_quotes(file.string()) + ", of which " + defect,
                    "at least two epochs of an orbit", "a longer table");
    return std::nullopt;
  }
  if (const auto first = unlike_its_velocities(*table)) {
    value.refuse_as(in_quotes(file.string()) +
                        ", whose velocities are not those of its positions, " +
                        number_text(*first) + " s after the scene's epoch first",
                    "positions in km and velocities in km/s, and rows that follow the orbit",
                    "other units, or more rows");
    return std::nullopt;
  }
  return make_ephemeris(std::move(*table));
}

}  // namespace adstar::scene
