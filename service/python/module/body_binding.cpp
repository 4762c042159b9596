// Body: one rigid body and one scheme, a step at a time, as the fleet of a scene steps it. And which schemes there are.

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "adstar/so3.hpp"
#include "service/propagation/plan.hpp"
#include "service/python/module/asked.hpp"
#include "service/python/module/bindings.hpp"
#include "service/python/module/motion_arrays.hpp"
#include "service/python/module/whole.hpp"
#include "service/report/numbers.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::python {
namespace {

class Body : public Whole {
 public:
  Body(const Eigen::Matrix3d& inertia_body_kg_m2, const Quat<double>& q_IB,
       const Vec3<double>& omega_B, const std::string& scheme)
      : scheme_(known(scheme)), fleet_({craft_of(inertia_body_kg_m2, q_IB, omega_B)}, scheme_, {}) {
    if (!std::isfinite(now().rotational_energy_j)) {
      throw std::invalid_argument(
          "angular_velocity_body_rad_s: got a rotation beyond the range of double, expected one "
          "whose energy and momentum are finite; try a smaller vector");
    }
  }

  bool step(double h_s, const std::optional<Doubles>& torque_body_n_m,
            const std::optional<Doubles>& torque_inertial_n_m) {
    const std::int64_t h_ns = whole_nanoseconds("h_s", h_s);
    if (h_ns > kFarthestNs - time_ns_) {
      throw std::invalid_argument(
          fmt::format("h_s: got {}, expected at most the {} that this body's clock has left; try a "
                      "new Body, from where this one is",
                      report::seconds_text(h_ns), report::seconds_text(kFarthestNs - time_ns_)));
    }
    std::vector<Torque<double>>& torques = fleet_.vehicles().front().torques;
    torques.clear();
    if (torque_body_n_m) {
      torques.emplace_back(
          Constant<double>{Frame::body, vector_of("torque_body_n_m", *torque_body_n_m)});
    }
    if (torque_inertial_n_m) {
      torques.emplace_back(Constant<double>{
          Frame::inertial, vector_of("torque_inertial_n_m", *torque_inertial_n_m)});
    }
    if (!torques.empty() && claims_of(scheme_).free_only) {
      torques.clear();
      throw std::invalid_argument(fmt::format(
          "scheme '{}' knows no torque; take another, for example {}", scheme_, scheme_names()[0]));
    }
    const bool resolved = fleet_.step(time_ns_, h_ns) == 0;
    time_ns_ += h_ns;
    return resolved;
  }

  runtime::TelemetryRecord now() const { return runtime::sample(fleet_.vehicles().front()); }
  double time_s() const { return seconds<double>(time_ns_); }
  const std::string& scheme() const { return scheme_; }

 private:
  static const std::string& known(const std::string& scheme) {
    propagation::require_scheme(scheme, words().scheme, scene::Scene{});
    return scheme;
  }

  static scene::Spacecraft craft_of(const Eigen::Matrix3d& inertia_body_kg_m2,
                                    const Quat<double>& q_IB, const Vec3<double>& omega_B) {
    scene::Spacecraft craft;
    craft.inertia_body_kg_m2 = inertia_body_kg_m2;
    const RigidBody<double> body(inertia_body_kg_m2);
    craft.initial = make_state(q_IB, rotate(normalised(q_IB), body.momentum(omega_B)));
    return craft;
  }

  std::string scheme_;
  runtime::Fleet fleet_;
  std::int64_t time_ns_ = 0;
};

py::list schemes() {
  py::list all;
  for (const std::string_view name : scheme_names()) {
    const Claims claims = claims_of(name);
    int order = 0;
    with_scheme(name, [&](auto scheme) { order = decltype(scheme)::kOrder; });
    py::dict scheme;
    scheme["name"] = name;
    scheme["order"] = order == kExactOrder ? py::object(py::none()) : py::object(py::int_(order));
    scheme["exact_momentum"] = claims.exact_momentum;
    scheme["exact_energy"] = claims.exact_energy;
    scheme["free_only"] = claims.free_only;
    scheme["carries_wheels"] = carries_wheels(name);
    scheme["links_bodies"] = multibody::links_bodies(name);
    all.append(scheme);
  }
  return all;
}

py::array_t<double> rotation_matrices(const Doubles& q_IB) {
  if (q_IB.ndim() != 2 || q_IB.shape(1) != 4) {
    throw std::invalid_argument("q_IB: expected shape (n, 4): w, x, y, z; try q_IB.reshape(-1, 4)");
  }
  py::array_t<double> R_IB({q_IB.shape(0), py::ssize_t{3}, py::ssize_t{3}});
  for (py::ssize_t i = 0; i < q_IB.shape(0); ++i) {
    const double* const q = q_IB.data() + 4 * i;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R_IB.mutable_data() + 9 * i) =
        rotation_matrix(Quat<double>{q[0], q[1], q[2], q[3]});
  }
  return R_IB;
}

}  // namespace

void bind_body(py::module_& module) {
  using runtime::TelemetryRecord;
  py::class_<Body> body(module, "Body");
  body.def(py::init([](const Doubles& inertia_body_kg_m2, const Doubles& q_IB,
                       const Doubles& angular_velocity_body_rad_s, const std::string& scheme) {
             return ::new Body(
                 inertia_of("inertia_body_kg_m2", inertia_body_kg_m2), quaternion_of("q_IB", q_IB),
                 vector_of("angular_velocity_body_rad_s", angular_velocity_body_rad_s), scheme);
           }),
           py::arg("inertia_body_kg_m2"), py::arg("q_IB"), py::arg("angular_velocity_body_rad_s"),
           py::arg("scheme"))
      .def("step", &Body::step, py::arg("h_s"), py::arg("torque_body_n_m"),
           py::arg("torque_inertial_n_m"))
      .def_property_readonly("scheme", &Body::scheme)
      .def_property_readonly("time_s", &Body::time_s);
  const auto vector = [&body](const char* name, auto field) {
    body.def_property_readonly(name, [field](const Body& b) { return array_of(b.now().*field); });
  };
  vector("q_IB", &TelemetryRecord::q_IB);
  vector("angular_velocity_body_rad_s", &TelemetryRecord::omega_B_rad_s);
  vector("momentum_inertial_n_m_s", &TelemetryRecord::H_I_n_m_s);
  vector("momentum_body_n_m_s", &TelemetryRecord::Pi_B_n_m_s);
  vector("momentum_residual_inertial_n_m_s", &TelemetryRecord::momentum_residual_I_n_m_s);
  const auto number = [&body](const char* name, auto field) {
    body.def_property_readonly(name, [field](const Body& b) { return b.now().*field; });
  };
  number("rotational_energy_j", &TelemetryRecord::rotational_energy_j);
  number("work_j", &TelemetryRecord::work_j);
  number("energy_residual_j", &TelemetryRecord::energy_residual_j);
  module.def("schemes", schemes);
  module.def("rotation_matrices", rotation_matrices, py::arg("q_IB"));
}

}  // namespace adstar::python
