#pragma once
// One side table of a run in NumPy: a structured array for each spacecraft that has rows in it, allocated whole under the
// GIL and filled in place without it. Every instant has the rows of the first, with the same words, in the same order.

#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include "service/propagation/side_rows.hpp"

namespace adstar::python {

class SideArrays {
 public:
  /// Under the GIL. What its rows are is heard from the fleet at its start; there is one at least.
  SideArrays(const propagation::SideTable& table, const scene::Scene& scene, runtime::Fleet& fleet);

  double bytes_an_instant() const;

  /// Under the GIL.
  void allocate(pybind11::ssize_t instants);

  /// All rows of the next instant.
  void add(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
           std::int64_t time_ns);

  /// Under the GIL: into each one's dictionary, those of `motions` being in the order of the scene.
  void put_into(const pybind11::list& motions) const;

 private:
  struct Owner {
    std::size_t spacecraft = 0;  ///< by its index in the scene
    std::size_t rows = 0;        ///< an instant
    pybind11::array array;
  };
  /// Where a row of an instant goes.
  struct Place {
    char* next = nullptr;
    std::size_t to_next_instant = 0;
  };

  void set(std::size_t place, const report::Fields& row);

  const propagation::SideTable& table_;
  pybind11::array pattern_;           ///< the first instant, of all spacecraft
  std::vector<std::size_t> offsets_;  ///< of the fields in a row
  std::vector<Owner> owners_;
  std::vector<Place> places_;  ///< of each row of the pattern
};

}  // namespace adstar::python
