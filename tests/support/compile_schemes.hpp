#pragma once
// Makes one half of compiled_schemes.hpp: included by the two translation units that do, and by nothing else.

#include <utility>

#include "tests/support/compiled_schemes.hpp"

namespace adstar::test {

template <class Scheme>
constexpr CompiledScheme compile_scheme() {
  using Body = BodyOf<Scheme, double>;
  CompiledScheme entry;
  entry.free = [](const void* body, State<double>& state, double h) {
    Scheme::step(*static_cast<const Body*>(body), state, h, NoTorque{});
  };
  entry.body = [](const void* body, State<double>& state, double h, const TorqueFunction& torque) {
    Scheme::step(*static_cast<const Body*>(body), state, h, body_torque(std::ref(torque)));
  };
  entry.rateless_body = [](const void* body, State<double>& state, double h,
                           const TorqueFunction& torque) {
    Scheme::step(*static_cast<const Body*>(body), state, h, rateless_body_torque(std::ref(torque)));
  };
  entry.mixed = [](const void* body, State<double>& state, double h, const TorqueFunction& torque) {
    Scheme::step(*static_cast<const Body*>(body), state, h, mixed_torque(std::ref(torque)));
  };
  entry.advance = [](const void* body, State<double>& state,
                     std::span<const Torque<double>> torques, std::int64_t t_ns, std::int64_t h_ns,
                     const StepLimits& limits) {
    return advance<Scheme, double>(*static_cast<const Body*>(body), state, torques, t_ns, h_ns,
                                   limits);
  };
  return entry;
}

/// Those whose place is even (0) or odd (1); the others stay empty.
template <std::size_t Parity>
constexpr std::array<CompiledScheme, kSchemes> compile_half() {
  std::array<CompiledScheme, kSchemes> half;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto put = [&]<std::size_t Place>(std::integral_constant<std::size_t, Place>) {
      if constexpr (Place % 2 == Parity) {
        half[Place] = compile_scheme<std::tuple_element_t<Place, Schemes>>();
      }
    };
    (put(std::integral_constant<std::size_t, I>{}), ...);
  }
  (std::make_index_sequence<kSchemes>{});
  return half;
}

}  // namespace adstar::test
