#include "service/python/module/side_arrays.hpp"

#include <cstring>
#include <variant>

#include "service/python/module/columns.hpp"

namespace adstar::python {

namespace py = pybind11;

SideArrays::SideArrays(const propagation::SideTable& table, const scene::Scene& scene,
                       runtime::Fleet& fleet)
    : table_(table) {
  Columns first(table.columns);
  std::size_t spacecraft = 0;
  table.rows(scene, fleet, 0, 0, [&](const report::Fields& row) {
    first.add(row);
    const std::string& name = std::get<std::string>(row.all().front());
    if (owners_.empty() || scene.spacecraft[spacecraft].name != name) {
      while (scene.spacecraft[spacecraft].name != name) {
        ++spacecraft;
      }
      owners_.push_back({spacecraft, 0, {}});
    }
    ++owners_.back().rows;
  });
  pattern_ = first.array();
  const py::dtype row = pattern_.dtype();
  for (const py::handle name : row.attr("names")) {
    offsets_.push_back(row.attr("fields")[name].cast<py::tuple>()[1].cast<std::size_t>());
  }
}

double SideArrays::bytes_an_instant() const { return static_cast<double>(pattern_.nbytes()); }

void SideArrays::allocate(py::ssize_t instants) {
  const auto row_size = static_cast<std::size_t>(pattern_.itemsize());
  for (Owner& owner : owners_) {
    owner.array = py::array(pattern_.dtype(), instants * static_cast<py::ssize_t>(owner.rows));
    for (std::size_t i = 0; i < owner.rows; ++i) {
      places_.push_back(
          {static_cast<char*>(owner.array.mutable_data()) + i * row_size, owner.rows * row_size});
    }
  }
}

void SideArrays::add(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
                     std::int64_t time_ns) {
  std::size_t place = 0;
  table_.rows(scene, fleet, step, time_ns, [&](const report::Fields& row) { set(place++, row); });
}

void SideArrays::set(std::size_t place, const report::Fields& row) {
  Place& to = places_[place];
  const auto row_size = static_cast<std::size_t>(pattern_.itemsize());
  // With the words, which are text there.
  std::memcpy(to.next, static_cast<const char*>(pattern_.data()) + place * row_size, row_size);
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const report::Field& field = row.all()[i];
    if (const auto* const count = std::get_if<std::uint64_t>(&field)) {
      std::memcpy(to.next + offsets_[i], count, sizeof *count);
    } else if (!std::holds_alternative<std::string>(field)) {
      const double number = number_of(field);
      std::memcpy(to.next + offsets_[i], &number, sizeof number);
    }
  }
  to.next += to.to_next_instant;
}

void SideArrays::put_into(const py::list& motions) const {
  for (const Owner& owner : owners_) {
    motions[owner.spacecraft][table_.name] = owner.array;
  }
}

}  // namespace adstar::python
