#include "service/trade/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "adstar/integrators/all.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::trade {
namespace {

using V = Vec3<double>;

constexpr std::int64_t kStepNs = 1'000'000'000;  // the momentum is scaled, not the step

struct Shape {
  const char* name;
  V moments_kg_m2;
};

constexpr Shape kShapes[] = {{"paper's body", {0.9144, 1.098, 1.66}},
                             {"needle 1e-6", {1e-6, 1, 1}},
                             {"bent needle", {1e-4, 1, 1.00005}},
                             {"near-sphere", {1, 1 + 1e-12, 1 + 2e-12}},
                             {"disc", {0.8, 1.2, 2}},
                             {"chipsat", {0.9144e-9, 1.098e-9, 1.66e-9}},
                             {"station", {0.9144e9, 1.098e9, 1.66e9}}};

struct Start {
  std::string name;
  V direction;  ///< of Pi_B
};

/// Pi_B at which 2E = Pi²/J_2: between turning about the lightest and about the heaviest axis.
V separatrix(const V& moments, double aside) {
  const double x = std::sqrt(std::max(0.0, (1 / moments.y - 1 / moments.z)));
  const double z = std::sqrt(std::max(0.0, (1 / moments.x - 1 / moments.y)));
  const double size = std::hypot(x, z);
  return size > 0 ? V{x / size + aside, 0.1, z / size} : V{1, 0.1, 1};
}

std::vector<Start> starts_of(const Shape& shape) {
  std::vector<Start> starts = {{"about the lightest axis", {1, 1e-3, 1e-3}},
                               {"about the middle axis", {1e-3, 1, 1e-3}},
                               {"about the heaviest axis", {1e-3, 1e-3, 1}},
                               {"on the separatrix", separatrix(shape.moments_kg_m2, 0)},
                               {"beside the separatrix", separatrix(shape.moments_kg_m2, 1e-9)}};
  std::mt19937_64 random(42);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 4; ++i) {
    starts.push_back({"at random", {normal(random), normal(random), normal(random)}});
  }
  return starts;
}

enum class Load { none, weak, strong, blow };
constexpr const char* kLoads[] = {"free", "weak torque", "strong torque", "blow of a millisecond"};

/// Torques in body axes whose impulse within the step is a part of the momentum.
std::vector<Torque<double>> torques_of(Load load, double momentum) {
  const V direction{0.5, -0.7, 0.5};
  switch (load) {
    case Load::none:
      return {};
    case Load::weak:
      return {Constant<double>{Frame::body, (1e-3 * momentum) * direction}};
    case Load::strong:
      return {Constant<double>{Frame::body, momentum * direction}};
    case Load::blow:
      break;
  }
  return {Table<double>{Frame::body,
                        Interpolation::hold,
                        AfterEnd::zero,
                        {300'000'000, 301'000'000},
                        {(100 * momentum) * direction, V{}}}};
}

/// A spacecraft whose free turn within the step is at most `turn_rad`.
scene::Spacecraft spacecraft_of(const Shape& shape, const V& direction, Load load,
                                double turn_rad) {
  scene::Spacecraft craft;
  craft.name = shape.name;
  craft.inertia_body_kg_m2 = to_eigen(shape.moments_kg_m2).asDiagonal();
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const double speed = std::sqrt(angular_speed_bound_squared(body, direction, 0.0));
  const V H_I = (turn_rad / speed) * direction;
  craft.initial = make_state(Quat<double>{}, H_I);
  craft.torques = torques_of(load, norm(H_I));
  return craft;
}

struct Case {
  std::string name;
  scene::Spacecraft craft;
  Quat<Wide> truth;
};

std::vector<Case> cases_at(double turn_rad, const Progress& progress, double done, double share) {
  constexpr double kGoalRad = 1e-12;
  constexpr double kMostForcedRad = 5, kThinnest = 1e-5;  // beyond, the truth takes minutes
  std::vector<Case> cases;
  double shapes = 0;
  for (const Shape& shape : kShapes) {
    const double here = done + share * shapes++ / static_cast<double>(std::size(kShapes));
    const bool forced =
        turn_rad <= kMostForcedRad && shape.moments_kg_m2.x > kThinnest * shape.moments_kg_m2.z;
    for (const Start& start : starts_of(shape)) {
      for (const Load load : {Load::none, Load::weak, Load::strong, Load::blow}) {
        if (load != Load::none && !forced) {
          continue;
        }
        scene::Spacecraft craft = spacecraft_of(shape, start.direction, load, turn_rad);
        const Truth truth =
            find_truth({craft}, {kStepNs}, kGoalRad, [&](double) { return progress(here); });
        cases.push_back({std::string(shape.name) + ", " + start.name + ", " +
                             kLoads[static_cast<std::size_t>(load)],
                         std::move(craft), truth.spacecraft[0][0].q_IB});
      }
    }
  }
  return cases;
}

void add(MapCell& cell, const Case& the_case) {
  runtime::Fleet fleet({the_case.craft}, cell.scheme, StepLimits{});
  const bool reported = fleet.step(0, kStepNs) > 0;
  const Quat<double>& q = fleet.vehicles().front().state.q_IB;
  const auto error = static_cast<double>(
      angle_between(the_case.truth, normalised(Quat<Wide>{q.w, q.x, q.y, q.z})));
  const Standing standing = judge(error, cell.turn_rad, reported);
  ++cell.counts[static_cast<std::size_t>(standing)];
  if (!reported && !(error <= cell.worst_rad)) {
    cell.worst_rad = error;
    cell.worst_case = the_case.name;
  }
}

}  // namespace

Standing judge(double error_rad, double turn_rad, bool reported) {
  constexpr double kRoundOff = 1e-14, kAccurate = 1e-3, kBounded = 0.1;
  if (reported) {
    return Standing::reported;
  }
  if (error_rad <= kRoundOff * (1 + turn_rad)) {
    return Standing::exact;
  }
  if (error_rad <= kAccurate * turn_rad) {
    return Standing::accurate;
  }
  return error_rad <= kBounded ? Standing::bounded : Standing::wrong;  // NaN is wrong
}

Standing MapCell::worst() const {
  for (const Standing standing : {Standing::wrong, Standing::bounded, Standing::accurate}) {
    if (counts[static_cast<std::size_t>(standing)] > 0) {
      return standing;
    }
  }
  return reported() > 0 && reported() == starts() ? Standing::reported : Standing::exact;
}

int MapCell::starts() const { return std::accumulate(counts.begin(), counts.end(), 0); }

std::vector<double> default_turns() {
  return {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1, 2, 5, 10, 20};
}

StabilityMap map_stability(const std::vector<std::string>& schemes,
                           const std::vector<double>& turns_rad, const Progress& progress) {
  StabilityMap map{turns_rad, schemes, {}};
  for (const std::string& scheme : schemes) {
    for (const double turn_rad : turns_rad) {
      map.cells.push_back({scheme, turn_rad, {}, 0, {}});
    }
  }
  const double share = 1.0 / static_cast<double>(turns_rad.size());
  for (std::size_t column = 0; column < turns_rad.size(); ++column) {
    const double done = share * static_cast<double>(column);
    for (const Case& the_case : cases_at(turns_rad[column], progress, done, share)) {
      for (std::size_t row = 0; row < schemes.size(); ++row) {
        if (the_case.craft.torques.empty() || !claims_of(schemes[row]).free_only) {
          add(map.cells[row * turns_rad.size() + column], the_case);
        }
      }
    }
  }
  return map;
}

}  // namespace adstar::trade
