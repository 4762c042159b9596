// Scene, SceneError, propagate() and accuracy(): what `adstar propagate` and `adstar trade` do, into NumPy.

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "service/propagation/fly.hpp"
#include "service/propagation/side_rows.hpp"
#include "service/python/module/asked.hpp"
#include "service/python/module/attention.hpp"
#include "service/python/module/bindings.hpp"
#include "service/python/module/motion_arrays.hpp"
#include "service/python/module/room.hpp"
#include "service/python/module/side_arrays.hpp"
#include "service/python/module/whole.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/complaints.hpp"
#include "service/scene/nearest.hpp"
#include "service/trade/grid.hpp"
#include "service/trade/measure.hpp"

namespace adstar::python {
namespace {

/// With its text, for whoever has to make it again.
struct ReadScene : Whole {
  scene::Scene scene;
  std::string text;
};

std::unique_ptr<ReadScene> parse(const std::string& text, const std::string& file) {
  return std::unique_ptr<ReadScene>(::new ReadScene{{}, scene::parse(text, file), text});
}

std::unique_ptr<ReadScene> load(const std::string& file) {
  return parse(scene::text_of(file), file);
}

struct AddedTorque : Whole {
  std::size_t spacecraft = 0;  ///< by its index in the scene
  Table<double> table;
};

/// Throws std::invalid_argument for a name that there is not.
std::size_t index_of(const ReadScene& read, const std::string& name) {
  const std::vector<scene::Spacecraft>& spacecraft = read.scene.spacecraft;
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < spacecraft.size(); ++i) {
    if (spacecraft[i].name == name) {
      return i;
    }
    known.push_back(spacecraft[i].name);
  }
  constexpr std::size_t kMostNamed = 10;
  const auto near = scene::nearest_plausible(name, known);
  const std::string all = known.size() > kMostNamed ? fmt::format("one of the {} of the scene",
                                                                  report::counted(known.size()))
                                                    : "one of " + scene::joined(known);
  throw std::invalid_argument(fmt::format("spacecraft: got {}, expected {}; try '{}'",
                                          scene::in_quotes(name), all,
                                          near.value_or(known.front())));
}

/// The scene as if it had these spacecraft alone, pushed by these torques too. They do not see each other.
scene::Scene part_of(const scene::Scene& whole, const std::vector<std::size_t>& chosen,
                     const std::vector<AddedTorque>& added) {
  scene::Scene part = whole;
  part.spacecraft.clear();
  for (const std::size_t i : chosen) {
    scene::Spacecraft& craft = part.spacecraft.emplace_back(whole.spacecraft[i]);
    for (const AddedTorque& torque : added) {
      if (torque.spacecraft != i) {
        continue;
      }
      if (craft.linked != nullptr) {
        throw std::invalid_argument(
            fmt::format("torque: '{}' is made of linked bodies, which take torques of the scene "
                        "alone; name it there, with the body that it acts on",
                        craft.name));
      }
      craft.torques.emplace_back(torque.table);
    }
  }
  return part;
}

runtime::Fleet fleet_of(const scene::Scene& scene, const propagation::Plan& plan,
                        std::size_t threads) {
  const py::gil_scoped_release without_gil;
  return {scene.spacecraft, plan.scheme, scene.simulation.limits, runtime::Lanewise::automatic,
          threads};
}

struct Flown {
  const scene::Scene& scene;
  const propagation::Plan& plan;
  runtime::Fleet& fleet;
};

/// Without the GIL. Fills the arrays, a spacecraft each, and the tables; returns the warning, if there is one.
std::string fly_into(const Flown& flown, std::vector<MotionArrays>& motions, TimeArrays& times,
                     std::vector<SideArrays>& tables) {
  const py::gil_scoped_release without_gil;
  runtime::Fleet& fleet = flown.fleet;
  std::size_t row = 0;
  Attention attention;
  const propagation::Unresolved unresolved = propagation::fly(
      fleet, flown.plan,
      {[&](std::uint64_t step, std::int64_t time_ns) {
         times.set(row, step, time_ns);
         for (std::size_t i = 0; i < motions.size(); ++i) {
           motions[i].set(row, runtime::sample(fleet.vehicles()[i]));
         }
         ++row;
         for (SideArrays& table : tables) {
           table.add(flown.scene, fleet, step, time_ns);
         }
       },
       [&](std::uint64_t /*done*/, std::int64_t /*time_ns*/) { attention.pay(); }});
  return unresolved.warning(flown.scene, flown.plan, words());
}

/// A dictionary: "step_s", "scheme", "warning", "step", "time_s", and "motions": a dictionary each, in the order of
/// `chosen`, with the side tables that it has rows in.
py::dict propagate(const ReadScene& whole, const std::vector<std::size_t>& chosen,
                   std::optional<double> duration_s, std::optional<double> every_s,
                   const std::optional<std::string>& scheme, std::optional<double> step_s,
                   const std::vector<AddedTorque>& added, std::size_t threads,
                   const py::function& available_bytes) {
  const scene::Scene scene = part_of(whole.scene, chosen, added);
  propagation::Request request{whole_nanoseconds("duration_s", duration_s),
                               whole_nanoseconds("step_s", step_s),
                               whole_nanoseconds("every_s", every_s), scheme};
  if (!request.every_ns) {
    request.every_ns = request.step_ns.value_or(scene.simulation.step_ns);
  }
  const propagation::Plan plan = propagation::make_plan(scene, request, words());
  runtime::Fleet fleet = fleet_of(scene, plan, threads);
  std::vector<SideArrays> tables;
  double bytes_an_instant = TimeArrays::kBytesARow +
                            MotionArrays::kBytesARow * static_cast<double>(scene.spacecraft.size());
  for (const propagation::SideTable& table : propagation::side_tables()) {
    if (table.first(scene.spacecraft) != nullptr) {
      bytes_an_instant += tables.emplace_back(table, scene, fleet).bytes_an_instant();
    }
  }
  require_room(plan, scene.spacecraft.size(), bytes_an_instant, available_bytes);
  const auto rows = static_cast<py::ssize_t>(propagation::rows_of(plan));
  for (SideArrays& table : tables) {
    table.allocate(rows);
  }
  TimeArrays times(rows);
  std::vector<MotionArrays> motions;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    motions.emplace_back(rows);
  }
  py::dict run;
  run["warning"] = fly_into({scene, plan, fleet}, motions, times, tables);
  run["scheme"] = plan.scheme;
  run["step_s"] = seconds<double>(plan.step_ns);
  times.close();
  run["step"] = times.step;
  run["time_s"] = times.time_s;
  py::list all;
  for (const MotionArrays& motion : motions) {
    all.append(motion.dictionary());
  }
  for (const SideArrays& table : tables) {
    table.put_into(all);
  }
  run["motions"] = all;
  return run;
}

/// Largest errors of the scheme against the truth, at up to ten instants.
py::dict accuracy(const ReadScene& read, std::optional<double> duration_s,
                  const std::optional<std::string>& scheme, std::optional<double> step_s) {
  const scene::Scene& scene = read.scene;
  const propagation::Request request{
      whole_nanoseconds("duration_s", duration_s), whole_nanoseconds("step_s", step_s), {}, scheme};
  const propagation::Plan plan = propagation::make_plan(scene, request, words());
  const auto horizon_ns = static_cast<std::int64_t>(plan.steps) * plan.step_ns;
  const std::vector<std::int64_t> instants = trade::instants_of(horizon_ns);
  if (instants.front() % plan.step_ns != 0) {
    throw std::invalid_argument(fmt::format(
        "duration_s={} is looked at every {}, which is not whole steps of {}; try duration_s={}",
        report::seconds_text(horizon_ns), scene::format_duration(instants.front()),
        scene::format_duration(plan.step_ns), report::seconds_text(10 * horizon_ns)));
  }
  trade::Truth truth;
  trade::Errors errors;
  {
    const py::gil_scoped_release without_gil;
    constexpr double kGoalRad = 1e-14;
    Attention attention;
    const trade::Progress progress = [&](double) {
      attention.pay();
      return true;
    };
    truth = trade::find_truth(scene.spacecraft, instants, kGoalRad, progress);
    errors = trade::find_errors(scene.spacecraft, plan.scheme, scene.simulation.limits,
                                plan.step_ns, truth, progress);
  }
  py::dict found;
  found["scheme"] = plan.scheme;
  found["step_s"] = seconds<double>(plan.step_ns);
  found["duration_s"] = seconds<double>(horizon_ns);
  found["attitude_error_rad"] = errors.attitude_rad;
  found["momentum_error_relative"] = errors.momentum_relative;
  found["energy_error_relative"] = errors.energy_relative;
  found["resolved"] = errors.resolved;
  found["truth"] = truth.how;
  found["truth_uncertainty_rad"] = truth.uncertainty_rad;
  return found;
}

py::dict described(const scene::Spacecraft& craft) {
  runtime::Fleet fleet({craft}, scheme_names().front(), StepLimits{});
  const runtime::TelemetryRecord start = runtime::sample(fleet.vehicles().front());
  py::list torques, wheels, actuators;
  for (const Torque<double>& torque : craft.torques) {
    torques.append(std::visit([](const auto& model) { return model.kName; }, torque));
  }
  for (const scene::NamedWheel& wheel : craft.wheels) {
    wheels.append(wheel.name);
  }
  for (const scene::Actuator& actuator : craft.actuators) {
    actuators.append(actuator.name);
  }
  py::array_t<double> inertia({3, 3});
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      inertia.mutable_at(i, k) = craft.inertia_body_kg_m2(i, k);
    }
  }
  py::dict all;
  all["name"] = craft.name;
  all["inertia_body_kg_m2"] = inertia;
  all["q_IB"] = array_of(start.q_IB);
  all["angular_velocity_body_rad_s"] = array_of(start.omega_B_rad_s);
  all["momentum_inertial_n_m_s"] = array_of(start.H_I_n_m_s);
  all["rotational_energy_j"] = start.rotational_energy_j;
  all["torques"] = py::tuple(torques);
  all["wheels"] = py::tuple(wheels);
  all["actuators"] = py::tuple(actuators);
  return all;
}

std::vector<std::string> names_of(const ReadScene& read) {
  std::vector<std::string> names;
  for (const scene::Spacecraft& craft : read.scene.spacecraft) {
    names.push_back(craft.name);
  }
  return names;
}

}  // namespace

void bind_scene(py::module_& module) {
  const py::object error =
      py::register_exception<scene::SceneError>(module, "SceneError", PyExc_ValueError);
  error.attr("__module__") = "adstar";
  error.doc() =
      "Every complaint about a scene, a line each: `file:line:column: key: got X, expected Y; try "
      "Z`.";
  py::class_<AddedTorque>(module, "AddedTorque")
      .def(py::init([](std::size_t spacecraft, const Doubles& time_s, const Doubles& torque_n_m,
                       const std::string& frame, const std::string& interpolation,
                       const std::string& after_end) {
             return ::new AddedTorque{
                 {}, spacecraft, table_of(time_s, torque_n_m, frame, interpolation, after_end)};
           }),
           py::arg("spacecraft"), py::arg("time_s"), py::arg("torque_n_m"), py::arg("frame"),
           py::arg("interpolation"), py::arg("after_end"));
  py::class_<ReadScene>(module, "Scene")
      .def_static("load", load, py::arg("file"))
      .def_static("parse", parse, py::arg("text"), py::arg("file"))
      .def_property_readonly("text", [](const ReadScene& read) { return read.text; })
      .def_property_readonly(
          "step_s",
          [](const ReadScene& read) { return seconds<double>(read.scene.simulation.step_ns); })
      .def_property_readonly("duration_s",
                             [](const ReadScene& read) {
                               const auto& ns = read.scene.simulation.duration_ns;
                               return ns ? std::optional(seconds<double>(*ns)) : std::nullopt;
                             })
      .def_property_readonly("scheme",
                             [](const ReadScene& read) { return read.scene.simulation.scheme; })
      .def_property_readonly("names", names_of)
      .def("index_of", index_of, py::arg("spacecraft"))
      .def(
          "described",
          [](const ReadScene& read, std::size_t i) {
            return described(read.scene.spacecraft.at(i));
          },
          py::arg("index"))
      .def("propagate", propagate, py::arg("spacecraft"), py::arg("duration_s"), py::arg("every_s"),
           py::arg("scheme"), py::arg("step_s"), py::arg("torques"), py::arg("threads"),
           py::arg("available_bytes"))
      .def("accuracy", accuracy, py::arg("duration_s"), py::arg("scheme"), py::arg("step_s"));
}

}  // namespace adstar::python
