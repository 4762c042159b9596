#pragma once
// The steps of every scheme in double, compiled once for all test programs: each would take minutes over
// its own copy.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <tuple>
#include <type_traits>

#include "adstar/propagator.hpp"

namespace adstar::test {

using TorqueFunction = std::function<TorqueSample<double>(const Stage<double>&)>;

/// `body` points to the scheme's own Body<double>.
struct CompiledScheme {
  void (*free)(const void* body, State<double>& state, double h) = nullptr;
  void (*body)(const void* body, State<double>& state, double h,
               const TorqueFunction& torque) = nullptr;
  void (*rateless_body)(const void* body, State<double>& state, double h,
                        const TorqueFunction& torque) = nullptr;
  void (*mixed)(const void* body, State<double>& state, double h,
                const TorqueFunction& torque) = nullptr;
  StepReport (*advance)(const void* body, State<double>& state,
                        std::span<const Torque<double>> torques, std::int64_t t_ns,
                        std::int64_t h_ns, const StepLimits& limits) = nullptr;
};

inline constexpr std::size_t kSchemes = std::tuple_size_v<Schemes>;
/// By the place in Schemes; half of them each, so that two compilers share the work.
extern const std::array<CompiledScheme, kSchemes> kEvenSchemes, kOddSchemes;

template <class Scheme>
constexpr std::size_t place_of() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return ((std::is_same_v<Scheme, std::tuple_element_t<I, Schemes>> ? I : 0) + ...);
  }
  (std::make_index_sequence<kSchemes>{});
}

/// Stands in for a scheme of the list.
template <class Scheme>
struct Compiled {
  using Body = BodyOf<Scheme, double>;

  static const CompiledScheme& entry() {
    constexpr std::size_t kPlace = place_of<Scheme>();
    return (kPlace % 2 == 0 ? kEvenSchemes : kOddSchemes)[kPlace];
  }

  static void step(const Body& body, State<double>& state, double h, const NoTorque&) {
    entry().free(&body, state, h);
  }
  template <class Function, bool Inertial, bool OfRate>
  static void step(const Body& body, State<double>& state, double h,
                   const StageTorque<Function, Inertial, OfRate>& torque) {
    const auto form = Inertial ? entry().mixed : OfRate ? entry().body : entry().rateless_body;
    form(&body, state, h, std::ref(torque.function));
  }
  static StepReport advance(const Body& body, State<double>& state,
                            std::span<const Torque<double>> torques, std::int64_t t_ns,
                            std::int64_t h_ns, const StepLimits& limits = {}) {
    return entry().advance(&body, state, torques, t_ns, h_ns, limits);
  }
};

}  // namespace adstar::test
