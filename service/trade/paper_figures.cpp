#include "service/trade/paper_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "service/plot/plot.hpp"
#include "service/report/numbers.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::trade {
namespace {

scene::Spacecraft paper_body() {
  scene::Spacecraft craft;
  craft.name = "paper";
  craft.inertia_body_kg_m2 = Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal();
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  craft.initial = make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  return craft;
}

PaperSample sample(const std::vector<runtime::Fleet>& fleets, const Vec3<double>& H_0,
                   double time_s) {
  const runtime::Vehicle& vehicle = fleets.front().vehicles().front();
  const Eigen::Matrix3d R = rotation_matrix(vehicle.state.q_IB);
  const Eigen::Vector3d unit = (R * R.transpose()).diagonal();
  PaperSample s;
  s.time_s = time_s;
  s.omega_B = vehicle.body.angular_velocity(body_momentum(vehicle.state));
  s.orthogonality = {unit[0] - 1, unit[1] - 1, unit[2] - 1};
  s.determinant = R.determinant() - 1;
  for (std::size_t i = 0; i < fleets.size(); ++i) {
    s.drift[i] = fleets[i].vehicles().front().state.H_I.value() - H_0;
  }
  return s;
}

struct Column {
  std::string name;
  std::function<double(const PaperSample&)> value;
};

constexpr double Vec3<double>::*kAxes[] = {&Vec3<double>::x, &Vec3<double>::y, &Vec3<double>::z};
constexpr const char* kAxisNames[] = {"x", "y", "z"};

std::vector<Column> axes(const std::string& before, const std::string& after,
                         const std::function<const Vec3<double>&(const PaperSample&)>& vector) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    columns.push_back({before + kAxisNames[i] + after,
                       [vector, i](const PaperSample& s) { return vector(s).*kAxes[i]; }});
  }
  return columns;
}

std::string csv(const std::vector<Column>& columns, const std::vector<PaperSample>& samples) {
  std::string text = "time_s";
  for (const Column& column : columns) {
    text += "," + column.name;
  }
  text += "\n";
  for (const PaperSample& s : samples) {
    report::append_number(text, s.time_s);
    for (const Column& column : columns) {
      text += ",";
      report::append_number(text, column.value(s));
    }
    text += "\n";
  }
  return text;
}

/// Some hundred points are enough for the eye.
plot::Series series(const std::string& name, const Column& column,
                    const std::vector<PaperSample>& samples, bool magnitude) {
  const std::size_t every = std::max<std::size_t>(1, samples.size() / 500);
  plot::Series line{name, {}, false};
  for (std::size_t i = 0; i < samples.size(); i += every) {
    const double value = column.value(samples[i]);
    line.points.push_back({samples[i].time_s, magnitude ? std::fabs(value) : value});
  }
  return line;
}

const plot::Axis kTime{"time [s]", plot::Scale::linear};

Figure angular_velocity(const std::vector<PaperSample>& samples, const std::string& title) {
  const auto columns = axes(
      "omega_body_", "_rad_s", [](const PaperSample& s) -> const auto& { return s.omega_B; });
  plot::Panel panel{"", kTime, {"omega_B [rad/s]", plot::Scale::linear}, {}, 0};
  for (const Column& column : columns) {
    panel.series.push_back(series(column.name, column, samples, false));
  }
  return {"figure_1", csv(columns, samples), plot::svg("Body angular velocity" + title, {panel})};
}

Figure rotation_group(const std::vector<PaperSample>& samples, const std::string& title) {
  auto columns = axes(
      "r_rt_", "_minus_1", [](const PaperSample& s) -> const auto& { return s.orthogonality; });
  columns.push_back({"det_r_minus_1", [](const PaperSample& s) { return s.determinant; }});
  plot::Panel diagonal{"diagonal of R Rᵀ, less 1", kTime, {"", plot::Scale::linear}, {}, 0};
  plot::Panel determinant{"det R, less 1", kTime, {"", plot::Scale::linear}, {}, 0};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    (i < 3 ? diagonal : determinant)
        .series.push_back(series(columns[i].name, columns[i], samples, false));
  }
  return {"figure_2", csv(columns, samples),
          plot::svg("R_IB stays a rotation: coadjoint_rk4" + title, {diagonal, determinant})};
}

Figure momentum_drift(const std::vector<PaperSample>& samples, const std::string& title) {
  constexpr double kFloor = 1e-18;
  std::vector<Column> columns;
  std::vector<plot::Panel> panels;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    panels.push_back({fmt::format("{} component (none at all is drawn at 1e-18)", kAxisNames[axis]),
                      kTime,
                      {"|H_I - H_I(0)| [N m s]", plot::Scale::log},
                      {},
                      kFloor});
  }
  for (std::size_t scheme = 0; scheme < kPaperSchemes.size(); ++scheme) {
    const auto own = axes(
        fmt::format("{}_momentum_drift_inertial_", kPaperSchemes[scheme]),
        "_n_m_s", [scheme](const PaperSample& s) -> const auto& { return s.drift[scheme]; });
    for (std::size_t axis = 0; axis < 3; ++axis) {
      panels[axis].series.push_back(series(kPaperSchemes[scheme], own[axis], samples, true));
      columns.push_back(own[axis]);
    }
  }
  return {"figure_3", csv(columns, samples), plot::svg("Drift of the momentum" + title, panels)};
}

}  // namespace

std::vector<PaperSample> paper_run(std::int64_t step_ns, std::int64_t duration_ns) {
  const std::vector<scene::Spacecraft> crafts{paper_body()};
  std::vector<runtime::Fleet> fleets;
  for (const char* scheme : kPaperSchemes) {
    fleets.emplace_back(crafts, scheme, StepLimits{});
  }
  const Vec3<double> H_0 = crafts.front().initial.H_I.value();
  std::vector<PaperSample> samples{sample(fleets, H_0, 0)};
  for (std::int64_t t_ns = 0; t_ns < duration_ns; t_ns += step_ns) {
    for (runtime::Fleet& fleet : fleets) {
      fleet.step(t_ns, step_ns);
    }
    samples.push_back(sample(fleets, H_0, seconds<double>(t_ns + step_ns)));
  }
  return samples;
}

std::vector<Figure> paper_figures(const std::vector<PaperSample>& samples, std::int64_t step_ns) {
  const std::string title = ", free body of the paper, h = " + scene::format_duration(step_ns);
  return {angular_velocity(samples, title), rotation_group(samples, title),
          momentum_drift(samples, title)};
}

}  // namespace adstar::trade
