#pragma once
// One step of linked bodies under the torques that act on each, with motors that somebody commands: split where one
// of them has an edge, as propagator.hpp does it for a body alone.
//
// Beside the torques that are named, the gravity of a point mass pulls harder on what is nearer: about the common centre
// of mass, in free fall, a body at x feels
//   F = m μ/r³ (3 (x·u) u - x),   u to the spacecraft, r its distance
// (Hill 1878; terms of x²/r² left out), the tide, which stretches a tether. With the gravity gradient on each body
// (torques/gravity_gradient.hpp) that is the gravity gradient of the whole.
//
// Air and sunlight push as well as turn. What they do to the whole's way is the orbit's, which is given: a body feels
// its own push less its mass's share of all, F_i - m_i/M Σ F, and the common centre of mass stays in the origin.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "adstar/integrators/all.hpp"
#include "adstar/multibody/advance.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/segment.hpp"
#include "adstar/torques/commanded.hpp"

namespace adstar::multibody {

/// Whether linked bodies are stepped by a scheme of that name: the coadjoint family in double.
template <class Scheme>
concept LinksBodies = std::is_base_of_v<Coadjoint<typename Scheme::Nodes>, Scheme>;

inline bool links_bodies(std::string_view scheme) {
  bool links = false;
  with_scheme(scheme, [&](auto s) { links = LinksBodies<decltype(s)>; });
  return links;
}

/// The motor of one free coordinate: a torque [N m], or a force [N], in x of what is commanded; `standing` else.
template <class T>
struct CoordinateMotor {
  std::size_t joint = 0, coordinate = 0;
  T standing{};
  Commanded<T> window{};

  T at(std::int64_t t_ns) const {
    const TorqueInterval<T>* const interval =
        in_force(std::span<const TorqueInterval<T>>(window.window.data(), window.intervals), t_ns);
    return interval == nullptr ? standing : interval->torque_n_m.x;
  }
};

/// Whose gravity stretches linked bodies.
template <class T>
struct Tide {
  using Scalar = T;
  using Around = OrbitPosition<T>;
  Orbit<T> orbit;
  Around around_at(const T& t_s) const { return position_at(orbit, t_s); }
  bool is_around_too(const Tide& other) const { return this == &other; }
};

/// Everything that one spacecraft of linked bodies flies with; all memory is made here.
template <class T>
struct LinkedFlight {
  explicit LinkedFlight(Assembly<T> of)
      : assembly(std::move(of)),
        work(assembly),
        state(make_state(assembly)),
        motor_torques(assembly.joints().size()),
        first_torque(assembly.bodies().size() + 1),
        segments(assembly.bodies().size()) {}

  Assembly<T> assembly;
  Workspace<T> work;
  AssemblyState<T> state;
  std::vector<CoordinateMotor<T>> motors;
  std::vector<std::array<T, 3>> motor_torques;  ///< by joint, in force over the segment
  std::vector<std::size_t> first_torque;        ///< of each body among the torques, and their end
  std::vector<adstar::detail::Segment<T>> segments;
  std::optional<Tide<T>> tide;  ///< none: no tide
};

/// Sets motor_torques to what is in force at t_ns.
template <class T>
void set_motors(LinkedFlight<T>& flight, std::int64_t t_ns) noexcept {
  for (std::array<T, 3>& each : flight.motor_torques) {
    each = {};
  }
  for (const CoordinateMotor<T>& motor : flight.motors) {
    flight.motor_torques[motor.joint][motor.coordinate] = motor.at(t_ns);
  }
}

template <class T>
std::span<const Torque<T>> torques_of(const LinkedFlight<T>& flight, std::span<const Torque<T>> all,
                                      std::size_t body) {
  const std::size_t first = flight.first_torque[body];
  return all.subspan(first, flight.first_torque[body + 1] - first);
}

/// A model that pushes as well as turns.
template <class Model>
concept Pushes = requires(const Model& model, const Quat<typename Model::Scalar>& q_IB) {
  model.force_I(typename Model::Around{}, q_IB);
};

template <class T>
bool pushes(const Torque<T>& torque) {
  return std::visit([]<class Model>(const Model&) { return Pushes<Model>; }, torque);
}

/// A model of which a part is the same for all bodies of a spacecraft.
template <class Model>
concept Surrounds = requires(const Model& model, const Quat<typename Model::Scalar>& q_IB) {
  model.torque_B(typename Model::Around{}, q_IB);
};

/// What is around a spacecraft at a stage, worked out once for all of its bodies.
template <class Model>
class Around {
 public:
  const typename Model::Around& at(const Model& model, const typename Model::Scalar& t_s) {
    if (of_ == nullptr || t_s != t_s_ || !model.is_around_too(*of_)) {
      of_ = &model;
      t_s_ = t_s;
      around_ = model.around_at(t_s);
    }
    return around_;
  }

 private:
  const Model* of_ = nullptr;
  typename Model::Scalar t_s_{};
  typename Model::Around around_{};
};

/// What acts on the bodies over a segment that began at t_s.
template <class T>
struct FlightLoad {
  const LinkedFlight<T>& flight;
  std::span<const Torque<T>> torques;
  T t_s{};
  bool pushed = std::any_of(torques.begin(), torques.end(), pushes<T>);
  mutable std::tuple<Around<Aerodynamic<T>>, Around<SolarPressure<T>>, Around<GravityGradient<T>>>
      surroundings{};
  mutable Around<Tide<T>> tide{};

  bool keeps_centre() const { return pushed; }

  BodyLoad<T> operator()(const LoadStage<T>& stage) const {
    const auto& segment = flight.segments[stage.body];
    const std::span<const Torque<T>> own = torques_of(flight, torques, stage.body);
    const TorqueSample<T> tau = adstar::detail::torque_at(segment, own, t_s, stage.time_s);
    const BodyMotion<T>& motion = stage.motion;
    const T now_s = t_s + stage.time_s;
    BodyLoad<T> load{tau.body, tau.inertial, {}, {}};
    if (segment.oriented) {
      add_oriented(load, own, now_s, motion.q_IB);
    }
    if (segment.damped) {
      load.torque_B = load.torque_B + adstar::detail::damping_torque(
                                          segment, rotate_inverse(motion.q_IB, motion.omega_I));
    }
    if (flight.tide) {
      const OrbitPosition<T>& place = tide.at(*flight.tide, now_s);
      const T& r = place.distance_m;
      const T strength =
          flight.assembly.bodies()[stage.body].mass * (gravity_of(flight.tide->orbit) / r / r / r);
      const Vec3<T>& u = place.direction_I;
      load.force_I = load.force_I + strength * (T(3) * dot(motion.x_I, u) * u - motion.x_I);
    }
    return load;
  }

  /// The fastest rate at which a body of its own loses omega_B to it [1/s].
  T decay() const {
    using std::max;
    T fastest{};
    for (std::size_t i = 0; i < flight.segments.size(); ++i) {
      const Vec3<T>& damping = flight.segments[i].damping;
      fastest = max(fastest, max(max(damping.x, damping.y), damping.z) *
                                 flight.assembly.bodies()[i].rigid.inverse_moments()[0]);
    }
    return fastest;
  }

 private:
  void add_oriented(BodyLoad<T>& load, std::span<const Torque<T>> own, const T& now_s,
                    const Quat<T>& q_IB) const {
    for (const Torque<T>& torque : own) {
      std::visit(
          [&]<class Model>(const Model& model) {
            if constexpr (Surrounds<Model>) {
              const typename Model::Around& around =
                  std::get<Around<Model>>(surroundings).at(model, now_s);
              load.torque_B = load.torque_B + model.torque_B(around, q_IB);
              if constexpr (Pushes<Model>) {
                load.force_I = load.force_I + model.force_I(around, q_IB);
              }
            } else if constexpr (requires { model.at(now_s, q_IB); }) {
              load.torque_B = load.torque_B + model.at(now_s, q_IB);
            }
          },
          torque);
    }
  }
};

/// Advances the flight from t_ns to t_ns + h_ns [ns] under `torques`, body by body as first_torque has them. Never
/// throws, never allocates. `edges`: at most so many segments; past it `edges_left` is set and the rest of the step
/// takes what is in force at its beginning.
template <class Tableau, class T>
AssemblyReport<T> advance(LinkedFlight<T>& flight, std::span<const Torque<T>> torques,
                          std::int64_t t_ns, std::int64_t h_ns, const AssemblyLimits& limits,
                          std::int64_t edges, bool& edges_left) noexcept {
  AssemblyReport<T> all;
  edges_left = false;
  const std::int64_t end_ns = t_ns + h_ns;
  for (std::int64_t segments = 0; t_ns < end_ns; ++segments) {
    std::int64_t next_ns = adstar::detail::next_edge_after(torques, t_ns);
    for (const CoordinateMotor<T>& motor : flight.motors) {
      next_ns = std::min(next_ns, motor.window.next_edge_after(t_ns));
    }
    edges_left = edges_left || (next_ns < end_ns && segments >= edges);
    next_ns = next_ns < end_ns && segments < edges ? next_ns : end_ns;
    set_motors(flight, t_ns);
    bool loaded = flight.tide.has_value();
    for (std::size_t i = 0; i < flight.segments.size(); ++i) {
      const std::span<const Torque<T>> own = torques_of(flight, torques, i);
      flight.segments[i] = adstar::detail::make_segment(own, t_ns);
      loaded = loaded || !own.empty();
    }
    const std::array<T, 3>* const motors =
        flight.motors.empty() ? nullptr : flight.motor_torques.data();
    const T t_s = seconds<T>(t_ns);
    const FlightLoad<T> load{flight, torques, t_s};
    const AssemblyReport<T> part =
        loaded ? advance<Tableau>(flight.assembly, flight.work, flight.state, next_ns - t_ns,
                                  motors, load, limits)
               : advance<Tableau>(flight.assembly, flight.work, flight.state, next_ns - t_ns,
                                  motors, NoLoad{}, limits);
    all.parts += part.parts;
    all.unresolved_angle = all.unresolved_angle || part.unresolved_angle;
    all.unresolved_gap = all.unresolved_gap || part.unresolved_gap;
    all.unresolved_stiffness = all.unresolved_stiffness || part.unresolved_stiffness;
    all.at_dead_point = all.at_dead_point || part.at_dead_point;
    all.out_of_balance = all.out_of_balance || part.out_of_balance;
    all.lost = all.lost || part.lost;
    all.gap = std::max(all.gap, part.gap);
    all.gap_rate = std::max(all.gap_rate, part.gap_rate);
    t_ns = next_ns;
  }
  return all;
}

}  // namespace adstar::multibody
