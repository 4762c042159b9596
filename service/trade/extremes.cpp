#include "service/trade/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include <fmt/format.h>

#include "adstar/integrators/motion_bounds.hpp"

namespace adstar::trade {
namespace {

using V = Vec3<double>;

struct Shape {
  const char* name;
  V moments_kg_m2;
};

// The step is a second: the momentum is scaled, not the step.
constexpr Shape kPaper = {"paper's body", {0.9144, 1.098, 1.66}};
constexpr Shape kNeedle = {"needle 1e-6", {1e-6, 1, 1}};
constexpr Shape kBentNeedle = {"bent needle", {1e-4, 1, 1.00005}};
constexpr Shape kRod = {"rod", {0.066, 0.85, 0.894}};
constexpr Shape kNearSphere = {"near-sphere", {1, 1 + 1e-12, 1 + 2e-12}};
constexpr Shape kDisc = {"disc", {0.8, 1.2, 2}};
constexpr Shape kChipsat = {"chipsat", {0.9144e-9, 1.098e-9, 1.66e-9}};
constexpr Shape kStation = {"station", {0.9144e9, 1.098e9, 1.66e9}};
constexpr Shape kHeaviest = {"1e250 kg m^2", {0.9144e250, 1.098e250, 1.66e250}};
constexpr Shape kLightest = {"1e-250 kg m^2", {0.9144e-250, 1.098e-250, 1.66e-250}};

struct Start {
  std::string name;
  V direction;  ///< of Pi_B
};

/// Pi_B at which 2E = Pi²/J_2: between turning about the lightest and about the heaviest axis.
V separatrix(const V& moments, double aside) {
  const double x = std::sqrt(std::max(0.0, (1 / moments.y - 1 / moments.z) * moments.y));
  const double z = std::sqrt(std::max(0.0, (1 / moments.x - 1 / moments.y) * moments.y));
  const double size = std::hypot(x, z);
  return size > 0 ? V{x / size + aside, 0.1, z / size} : V{1, 0.1, 1};
}

std::vector<Start> starts_of(const Shape& shape, int at_random) {
  std::vector<Start> starts = {{"about the lightest axis", {1, 1e-3, 1e-3}},
                               {"about the middle axis", {1e-3, 1, 1e-3}},
                               {"about the heaviest axis", {1e-3, 1e-3, 1}},
                               {"on the separatrix", separatrix(shape.moments_kg_m2, 0)},
                               {"beside the separatrix", separatrix(shape.moments_kg_m2, 1e-9)}};
  std::mt19937_64 random(42);
  std::normal_distribution<double> normal;
  for (int i = 0; i < at_random; ++i) {
    starts.push_back({"at random", {normal(random), normal(random), normal(random)}});
  }
  return starts;
}

RigidBody<double> body_of(const Shape& shape) {
  return RigidBody<double>(Eigen::Matrix3d(to_eigen(shape.moments_kg_m2).asDiagonal()));
}

Extreme extreme(const Shape& shape, const V& H_I, std::vector<Torque<double>> torques,
                double turn_rad, std::string name) {
  scene::Spacecraft craft;
  craft.name = shape.name;
  craft.inertia_body_kg_m2 = to_eigen(shape.moments_kg_m2).asDiagonal();
  craft.initial = make_state(Quat<double>{}, H_I);
  craft.torques = std::move(torques);
  return {fmt::format("{}, {}", shape.name, name), std::move(craft), turn_rad};
}

/// The momentum in that direction whose free turn within the step is at most `turn_rad`.
V momentum(const Shape& shape, const V& direction, double turn_rad) {
  // As one of the body's own size: of 1e250 kg m² and a unit of momentum, no rate could be written.
  const V along = shape.moments_kg_m2.z * direction;
  const double speed = std::sqrt(angular_speed_bound_squared(body_of(shape), along, 0.0));
  return (turn_rad / speed) * along;
}

double largest(const V& v) {
  return std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

/// |v|, of any size.
double size_of(const V& v) {
  const double unit = largest(v);
  return unit > 0 ? unit * norm((1 / unit) * v) : 0;
}

struct Load {
  const char* name;
  std::vector<Torque<double>> torques;
};

/// Torques in body axes whose impulse within the step is a part of the momentum.
std::vector<Load> loads_of(double momentum) {
  const V direction{0.5, -0.7, 0.5};
  return {{"free", {}},
          {"weak torque", {Constant<double>{Frame::body, (1e-3 * momentum) * direction}}},
          {"strong torque", {Constant<double>{Frame::body, momentum * direction}}},
          {"blow of a millisecond",
           {Table<double>{Frame::body,
                          Interpolation::hold,
                          AfterEnd::zero,
                          {300'000'000, 301'000'000},
                          {(100 * momentum) * direction, V{}}}}}};
}

/// A bound of the turn of a body that a torque may speed up.
double turn_under(const Shape& shape, const V& H_I, double impulse) {
  return std::sqrt(angular_speed_bound_squared(body_of(shape), H_I, impulse));
}

std::string short_name(double x) { return fmt::format("{:.4g}", x); }

Extremes momenta(const std::string& name, double size) {
  Extremes column{name, {}};
  for (const V& direction : {V{1, 0, 0}, V{0, 1, 0}, V{1, 0.5, 0.1}}) {
    const V H_I = size * direction;
    column.starts.push_back(extreme(kPaper, H_I, {}, turn_under(kPaper, H_I, 0), name + " N m s"));
  }
  return column;
}

/// Damping whose rate times the step is h c/J on every axis, on bodies that turn and are pushed.
Extremes damped(double decay, Detail detail) {
  Extremes column{fmt::format("hc/J {}", short_name(decay)), {}};
  for (const Shape& shape : {kPaper, kRod, kDisc, kNeedle, kChipsat}) {
    for (const Start& start : starts_of(shape, detail == Detail::full ? 2 : 1)) {
      for (const double turn_rad : {0.0, 0.1, 5.0, 20.0}) {
        const V H_I = momentum(shape, start.direction, turn_rad);
        const V& J = shape.moments_kg_m2;
        const Damping<double> even{decay * J}, one_axis{{0, 0, decay * J.z}};
        const V push = momentum(shape, {0.1, 0.3, -0.2}, 1);
        column.starts.push_back(extreme(shape, H_I, {even}, turn_rad, start.name + ", damped"));
        column.starts.push_back(extreme(shape, H_I, {one_axis, Constant<double>{Frame::body, push}},
                                        turn_under(shape, H_I, size_of(push)),
                                        start.name + ", damped about one axis and pushed"));
      }
    }
  }
  return column;
}

Extremes edges(int knots) {
  Extremes column{fmt::format("{} edges", knots), {}};
  Table<double> table{Frame::inertial, Interpolation::hold, AfterEnd::zero, {}, {}};
  for (int i = 0; i < knots; ++i) {
    table.time_ns.push_back((i + 1) * (kExtremeStepNs / (knots + 1)));
    table.torque_n_m.push_back({i % 2 == 0 ? 1.0 : -1.0, 0, 0.3});
  }
  for (const Start& start : starts_of(kPaper, 1)) {
    column.starts.push_back(extreme(kPaper, momentum(kPaper, start.direction, 1), {table}, 1,
                                    start.name + ", a torque of many edges"));
  }
  return column;
}

}  // namespace

Extremity extremes_by_turn(const std::vector<double>& turns_rad, Detail detail) {
  Extremity all{
      "One step of every scheme, the worst of all starts: by its turn", "|omega| h [rad]", {}};
  for (const double turn_rad : turns_rad) {
    Extremes column{short_name(turn_rad), {}};
    for (const Shape& shape : {kPaper, kNeedle, kBentNeedle, kRod, kNearSphere, kDisc, kChipsat,
                               kStation, kHeaviest, kLightest}) {
      for (const Start& start : starts_of(shape, detail == Detail::full ? 4 : 1)) {
        const V H_I = momentum(shape, start.direction, turn_rad);
        for (const Load& load : loads_of(size_of(H_I))) {
          column.starts.push_back(
              extreme(shape, H_I, load.torques, turn_rad, start.name + ", " + load.name));
        }
      }
    }
    all.columns.push_back(std::move(column));
  }
  return all;
}

Extremity extremes_by_torque(const std::vector<double>& torques_n_m, Detail detail) {
  Extremity all{"The same by a constant torque, in a step of one second", "torque [N m]", {}};
  for (const double size : torques_n_m) {
    Extremes column{fmt::format("{:.0e}", size), {}};
    for (const Shape& shape : {kPaper, kNeedle, kRod, kDisc, kChipsat, kStation}) {
      for (const Start& start : starts_of(shape, detail == Detail::full ? 2 : 0)) {
        for (const double turn_rad : {0.0, 0.01, 1.0, 5.0}) {
          const V H_I = momentum(shape, start.direction, turn_rad);
          for (const Frame frame : {Frame::body, Frame::inertial}) {
            column.starts.push_back(
                extreme(shape, H_I, {Constant<double>{frame, size * V{0.48, -0.6, 0.64}}},
                        turn_under(shape, H_I, size),
                        fmt::format("{}, {} rad, torque in {}", start.name, turn_rad,
                                    frame == Frame::body ? "B" : "I")));
          }
        }
      }
    }
    all.columns.push_back(std::move(column));
  }
  return all;
}

Extremity peculiar_extremes(Detail detail) {
  Extremity all{"The same by momentum [N m s], by damping, by torque edges",
                "of the paper's body; damping of rods, discs, needles and chipsats too",
                {}};
  for (const double size : {0.0, 5e-324, 1e-310, 1e-160, 1e150, 1e154, 1e300}) {
    all.columns.push_back(momenta(size == 0 ? "at rest" : fmt::format("{:.0e}", size), size));
  }
  for (const double decay : {1e-3, 0.03, 0.3, 1.0, 3.0, 30.0, 1e3, 1e6}) {
    all.columns.push_back(damped(decay, detail));
  }
  for (const int knots : {20, 200}) {
    all.columns.push_back(edges(knots));
  }
  return all;
}

std::vector<double> default_turns() {
  return {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1, 2, 5, 10, 20};
}

std::vector<double> default_torques() {
  std::vector<double> torques;
  for (int decade = -12; decade <= 6; ++decade) {
    torques.push_back(std::pow(10.0, decade));
  }
  return torques;
}

std::vector<Extremity> all_extremes(Detail detail) {
  return {extremes_by_turn(default_turns(), detail), extremes_by_torque(default_torques(), detail),
          peculiar_extremes(detail)};
}

}  // namespace adstar::trade
