#pragma once
// Everything that is wrong with a scene, one line each, in the order of the file.

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace adstar::scene {

struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// "file:line:col: key: got X, expected Y; try Z"
std::string complaint_line(std::string_view file, Place place, std::string_view key,
                           std::string_view got, std::string_view expected,
                           std::string_view remedy);

class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  std::size_t count() const { return found_.size(); }

  void add(Place place, std::string_view key, std::string_view got, std::string_view expected,
           std::string_view remedy);

  /// A finished line about another file, which the scene names at `place`.
  void add_line(Place place, std::string line) { found_.push_back({place, std::move(line)}); }

  std::vector<std::string> lines() const;

 private:
  struct Found {
    Place place;
    std::string line;
  };

  std::string file_;
  std::vector<Found> found_;
};

/// In double quotes, control characters escaped, cut when long.
std::string in_quotes(std::string_view text);

/// The shortest decimal that reads back as `value`.
std::string number_text(double value);

}  // namespace adstar::scene
