#pragma once
// Rows of motion in NumPy arrays, made under the GIL, filled without it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pybind11/numpy.h>

#include "adstar/torques/frame.hpp"
#include "service/runtime/records.hpp"

namespace adstar::python {

namespace py = pybind11;

template <std::size_t N>
py::array_t<double> array_of(const std::array<double, N>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(N), values.data());
}

/// Of all spacecraft of a run.
struct TimeArrays {
  static constexpr double kBytesARow = 8 + 8;

  py::array_t<std::uint64_t> step;
  py::array_t<double> time_s;

  explicit TimeArrays(py::ssize_t rows)
      : step(rows), time_s(rows), step_(step.mutable_data()), time_s_(time_s.mutable_data()) {}

  void set(std::size_t row, std::uint64_t n, std::int64_t time_ns) noexcept {
    step_[row] = n;
    time_s_[row] = seconds<double>(time_ns);
  }

  /// Under the GIL: read-only from then on, since what is written to one motion would be in all.
  void close() {
    for (const py::object& array : {py::object(step), py::object(time_s)}) {
      array.attr("flags").attr("writeable") = false;
    }
  }

 private:
  std::uint64_t* step_;
  double* time_s_;
};

/// Of one spacecraft, by the names that Motion (motion.py) has.
class MotionArrays {
 public:
  static constexpr double kBytesARow = (4 + 3 + 3 + 3 + 1 + 1 + 1 + 3) * sizeof(double);

  explicit MotionArrays(py::ssize_t rows)
      : q_IB_(rows, 4),
        omega_B_(rows, 3),
        H_I_(rows, 3),
        Pi_B_(rows, 3),
        energy_(rows, 1),
        work_(rows, 1),
        energy_residual_(rows, 1),
        momentum_residual_(rows, 3) {}

  void set(std::size_t row, const runtime::TelemetryRecord& record) noexcept {
    q_IB_.set(row, record.q_IB);
    omega_B_.set(row, record.omega_B_rad_s);
    H_I_.set(row, record.H_I_n_m_s);
    Pi_B_.set(row, record.Pi_B_n_m_s);
    energy_.set(row, std::array{record.rotational_energy_j});
    work_.set(row, std::array{record.work_j});
    energy_residual_.set(row, std::array{record.energy_residual_j});
    momentum_residual_.set(row, record.momentum_residual_I_n_m_s);
  }

  py::dict dictionary() const {
    py::dict all;
    all["q_IB"] = q_IB_.values;
    all["angular_velocity_body_rad_s"] = omega_B_.values;
    all["momentum_inertial_n_m_s"] = H_I_.values;
    all["momentum_body_n_m_s"] = Pi_B_.values;
    all["rotational_energy_j"] = energy_.values;
    all["work_j"] = work_.values;
    all["energy_residual_j"] = energy_residual_.values;
    all["momentum_residual_inertial_n_m_s"] = momentum_residual_.values;
    return all;
  }

 private:
  /// (rows, width); (rows,) when that is 1.
  struct Numbers {
    py::array_t<double> values;
    double* data;

    Numbers(py::ssize_t rows, py::ssize_t width)
        : values(width == 1 ? std::vector<py::ssize_t>{rows}
                            : std::vector<py::ssize_t>{rows, width}),
          data(values.mutable_data()) {}

    template <std::size_t N>
    void set(std::size_t row, const std::array<double, N>& numbers) noexcept {
      std::copy(numbers.begin(), numbers.end(), data + row * N);
    }
  };

  Numbers q_IB_, omega_B_, H_I_, Pi_B_, energy_, work_, energy_residual_, momentum_residual_;
};

}  // namespace adstar::python
