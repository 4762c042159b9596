#pragma once
// The schemes there are. To add one: its header beside this file and one line here; scenes, the
// command line, the conformance suite and the benchmarks iterate this list.

#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "adstar/integrators/coadjoint.hpp"
#include "adstar/integrators/coadjoint_float.hpp"
#include "adstar/integrators/free_exact.hpp"
#include "adstar/integrators/guard.hpp"
#include "adstar/integrators/lie_newmark.hpp"
#include "adstar/integrators/moser_veselov.hpp"
#include "adstar/integrators/quaternion.hpp"
#include "adstar/integrators/rkmk4.hpp"
#include "adstar/integrators/splitting.hpp"

namespace adstar {

using Schemes =
    std::tuple<CoadjointRk4, CoadjointMidpoint2, CoadjointDopri5, CoadjointVerner6,
               CoadjointFehlberg8, CoadjointDop853, CoadjointRk4Float, CoadjointMidpoint2Float,
               QuaternionRk4, ProjectedRk4, ProjectedDopri5, ProjectedVerner6, ProjectedFehlberg8,
               ProjectedDop853, Rkmk4, LieNewmark, FreeExact, MoserVeselov2, MoserVeselov4,
               MoserVeselov6, MoserVeselov8, MoserVeselov10, MoserVeselov16, SplittingStrang,
               SplittingBlanesMoan4, SplittingMcLachlan84, SplittingMcLachlan102>;

inline std::vector<std::string_view> scheme_names() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<std::string_view>{std::tuple_element_t<I, Schemes>::kName...};
  }
  (std::make_index_sequence<std::tuple_size_v<Schemes>>{});
}

/// Calls `action(scheme)` with the scheme of that name; false when there is none.
template <class Action>
bool with_scheme(std::string_view name, Action&& action) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto attempt = [&](auto scheme) {
      if (name != decltype(scheme)::kName) {
        return false;
      }
      action(scheme);
      return true;
    };
    return (attempt(std::tuple_element_t<I, Schemes>{}) || ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Schemes>>{});
}

/// Claims of the scheme of that name; none claimed when there is none.
inline Claims claims_of(std::string_view name) {
  Claims claims;
  with_scheme(name, [&](auto scheme) { claims = decltype(scheme)::kClaims; });
  return claims;
}

/// The limits as they hold for the scheme of that name.
inline StepLimits limits_for(std::string_view name, StepLimits limits) {
  with_scheme(name, [&](auto scheme) { limits = limits_for<decltype(scheme)>(limits); });
  return limits;
}

}  // namespace adstar
