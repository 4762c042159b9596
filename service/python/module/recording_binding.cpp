// read_recording(): the rows of `adstar export --to csv`, into NumPy.

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "service/bag/recording.hpp"
#include "service/bag/sqlite.hpp"
#include "service/python/module/attention.hpp"
#include "service/python/module/bindings.hpp"
#include "service/python/module/columns.hpp"
#include "service/report/numbers.hpp"
#include "service/samples/topic_rows.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::python {

namespace py = pybind11;

namespace {

using Names = std::set<std::string, std::less<>>;

/// All of them, or those asked for, in their order.
std::vector<const samples::Table*> tables_of(const std::optional<Names>& asked) {
  std::vector<const samples::Table*> tables;
  std::vector<std::string_view> known;
  for (const samples::Table& table : samples::tables()) {
    known.push_back(table.name);
    if (!asked || asked->contains(table.name)) {
      tables.push_back(&table);
    }
  }
  for (const std::string& name : asked.value_or(Names{})) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw std::invalid_argument(
          fmt::format("topics: got '{}', expected some of {}; try {}", name, scene::joined(known),
                      scene::nearest_plausible(name, known).value_or(known.front())));
    }
  }
  return tables;
}

struct Read {
  std::vector<Columns> columns;  ///< of each table
  std::string unreadable;        ///< "3 of motion, 2 of wheel_state"
  Names spacecraft;              ///< that it tells of
};

/// Without the GIL.
Read read(const bag::Recording& recording, const std::vector<const samples::Table*>& tables,
          const std::optional<Names>& spacecraft) {
  const py::gil_scoped_release without_gil;
  Read all;
  Attention attention;
  const auto wants = [&](std::string_view name) {
    attention.pay();
    if (!all.spacecraft.contains(name)) {
      all.spacecraft.emplace(name);
    }
    return !spacecraft || spacecraft->contains(name);
  };
  for (const samples::Table* table : tables) {
    Columns& columns = all.columns.emplace_back(table->columns);
    const auto add = [&](const report::Fields& row) {
      attention.pay();
      columns.add(row);
    };
    const std::uint64_t unreadable = samples::for_each_row(recording, table->name, wants, add);
    if (unreadable > 0) {
      all.unreadable += fmt::format("{}{} of {}", all.unreadable.empty() ? "" : ", ",
                                    report::counted(unreadable), table->name);
    }
  }
  return all;
}

std::string how_it_ended(const bag::Recording& recording, const std::string& directory) {
  switch (recording.ending()) {
    case bag::Recording::Ending::ended:
      break;
    case bag::Recording::Ending::still_recorded:
      return fmt::format("'{}' is still being recorded; this is what was committed so far",
                         directory);
    case bag::Recording::Ending::incomplete:
      return recording.lost();
    case bag::Recording::Ending::cut_off:
      return fmt::format("'{}' was not ended: was its recorder killed? What it has was read",
                         directory);
  }
  return {};
}

/// The tables that have rows, by name, and what is to be warned of.
py::tuple read_recording(const std::string& directory, const std::optional<Names>& topics,
                         const std::optional<Names>& spacecraft) {
  const std::vector<const samples::Table*> tables = tables_of(topics);
  const bag::Recording recording(directory);
  std::vector<std::string> warnings;
  if (std::string ending = how_it_ended(recording, directory); !ending.empty()) {
    warnings.push_back(std::move(ending));
  }
  const Read all = read(recording, tables, spacecraft);
  for (const std::string& name : spacecraft.value_or(Names{})) {
    if (!all.spacecraft.contains(name)) {
      const std::vector<std::string_view> known(all.spacecraft.begin(), all.spacecraft.end());
      throw std::invalid_argument(fmt::format(
          "spacecraft: there is no '{}' in the recording; {}", name,
          known.empty() ? "it tells of no spacecraft" : "there are " + scene::joined(known)));
    }
  }
  if (!all.unreadable.empty()) {
    warnings.push_back(
        fmt::format("samples that are not of the types that this program knows were left out: {}; "
                    "was it recorded with another version?",
                    all.unreadable));
  }
  py::dict found;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (!all.columns[i].empty()) {
      found[py::str(tables[i]->name)] = all.columns[i].array();
    }
  }
  return py::make_tuple(found, warnings);
}

}  // namespace

void bind_recording(py::module_& module) {
  const py::object error =
      py::register_exception<bag::Error>(module, "RecordingError", PyExc_OSError);
  error.attr("__module__") = "adstar";
  error.doc() =
      "There is no recording there, or it cannot be read: which file, why, and what helps.";
  module.def("read_recording", read_recording, py::arg("directory"), py::arg("topics"),
             py::arg("spacecraft"));
}

}  // namespace adstar::python
