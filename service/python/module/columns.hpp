#pragma once
// Rows become one NumPy structured array, a field a column of the CSV: words as text, counts as integers, the rest as
// doubles, NaN where a number is unknown. Rows are added without the GIL.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/numpy.h>

#include "service/report/fields.hpp"

namespace adstar::python {

/// As arrays have it: NaN is a number that is not known. Of a word it means nothing.
double number_of(const report::Field& field);

class Columns {
 public:
  /// `names` between commas, as the CSV has them.
  explicit Columns(std::string_view names);

  void add(const report::Fields& row);
  bool empty() const noexcept { return rows_ == 0; }

  /// Under the GIL. There is a row.
  pybind11::object array() const;

 private:
  struct Column {
    std::string name;
    std::vector<double> numbers;
    std::vector<std::uint64_t> counts;
    std::vector<std::uint32_t> words;  ///< which of known_
    std::map<std::string, std::uint32_t, std::less<>> known;
  };

  std::vector<Column> columns_;
  std::size_t rows_ = 0;
};

}  // namespace adstar::python
