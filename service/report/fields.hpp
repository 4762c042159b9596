#pragma once
// One row of a table, whatever it is about: as a line of CSV, or as numbers for whoever has columns of their own.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace adstar::report {

/// Simulation time. Text has it exactly.
struct Seconds {
  std::int64_t ns = 0;
};
/// A number that is not known, or means nothing in this row.
struct Unknown {};

using Field = std::variant<std::string, std::uint64_t, Seconds, double, Unknown>;

/// A field after another.
class Fields {
 public:
  Fields& word(std::string_view value) { return add(std::string(value)); }
  Fields& count(std::uint64_t value) { return add(value); }
  Fields& seconds(std::int64_t ns) { return add(Seconds{ns}); }
  Fields& number(double value, bool known = true) { return known ? add(value) : add(Unknown{}); }
  template <class Numbers>
  Fields& numbers(const Numbers& values, bool known = true) {
    for (const double value : values) {
      number(value, known);
    }
    return *this;
  }

  void clear() noexcept { all_.clear(); }
  const std::vector<Field>& all() const noexcept { return all_; }

 private:
  template <class T>
  Fields& add(T&& value) {
    all_.emplace_back(std::forward<T>(value));
    return *this;
  }
  std::vector<Field> all_;
};

/// With nothing in it that would begin a new field or line.
void append_csv_word(std::string& text, std::string_view word);

/// A line; what is unknown is an empty field.
void append_csv(std::string& text, const Fields& fields);

}  // namespace adstar::report
