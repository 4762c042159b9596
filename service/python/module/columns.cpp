#include "service/python/module/columns.hpp"

#include <algorithm>
#include <limits>
#include <variant>

namespace adstar::python {

namespace py = pybind11;

double number_of(const report::Field& field) {
  if (const auto* const number = std::get_if<double>(&field)) {
    return *number;
  }
  const auto* const time = std::get_if<report::Seconds>(&field);
  return time != nullptr ? static_cast<double>(time->ns) / 1e9
                         : std::numeric_limits<double>::quiet_NaN();
}

Columns::Columns(std::string_view names) {
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(','), names.size());
    columns_.emplace_back().name = names.substr(0, end);
    names.remove_prefix(std::min(end + 1, names.size()));
  }
}

void Columns::add(const report::Fields& row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    const report::Field& field = row.all()[i];
    if (const auto* const word = std::get_if<std::string>(&field)) {
      const auto next = static_cast<std::uint32_t>(column.known.size());
      column.words.push_back(column.known.emplace(*word, next).first->second);
    } else if (const auto* const count = std::get_if<std::uint64_t>(&field)) {
      column.counts.push_back(*count);
    } else {
      column.numbers.push_back(number_of(field));
    }
  }
  ++rows_;
}

py::object Columns::array() const {
  const py::module_ numpy = py::module_::import("numpy");
  py::list dtype, values;
  for (const Column& column : columns_) {
    py::object all;
    if (!column.known.empty()) {
      py::list known(column.known.size());
      for (const auto& [word, index] : column.known) {
        // Off the network any bytes may come.
        known[index] = py::reinterpret_steal<py::object>(
            PyUnicode_DecodeUTF8(word.data(), static_cast<py::ssize_t>(word.size()), "replace"));
      }
      all = numpy.attr("array")(known).attr("take")(
          py::array(static_cast<py::ssize_t>(column.words.size()), column.words.data()));
    } else if (!column.counts.empty()) {
      all = py::array(static_cast<py::ssize_t>(column.counts.size()), column.counts.data());
    } else {
      all = py::array(static_cast<py::ssize_t>(column.numbers.size()), column.numbers.data());
    }
    dtype.append(py::make_tuple(column.name, all.attr("dtype")));
    values.append(std::move(all));
  }
  py::object table = numpy.attr("empty")(rows_, dtype);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    table[py::str(columns_[i].name)] = values[i];
  }
  return table;
}

}  // namespace adstar::python
