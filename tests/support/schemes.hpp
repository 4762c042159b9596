#pragma once
// adstar::Schemes as a list of test types: a scheme that joins the list joins the suite.

#include <tuple>
#include <type_traits>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"

namespace adstar::test {

template <class Tuple>
struct AsTestTypes;
template <class... Scheme>
struct AsTestTypes<std::tuple<Scheme...>> {
  using type = testing::Types<Scheme...>;
};
using SchemeTypes = AsTestTypes<Schemes>::type;

/// Those that know a torque.
template <class... Scheme>
auto forced(std::tuple<Scheme...>) {
  return std::tuple_cat(
      std::conditional_t<Scheme::kClaims.free_only, std::tuple<>, std::tuple<Scheme>>{}...);
}
using ForcedSchemeTypes = AsTestTypes<decltype(forced(Schemes{}))>::type;

/// Order on a free body: a splitting leaves it to its free scheme.
template <class Scheme>
constexpr int free_order() {
  if constexpr (requires { Scheme::kFreeOrder; }) {
    return Scheme::kFreeOrder;
  } else {
    return Scheme::kOrder;
  }
}

}  // namespace adstar::test
