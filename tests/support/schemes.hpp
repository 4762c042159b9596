#pragma once
// adstar::Schemes as a list of test types: a scheme that joins the list joins the suite.

#include <tuple>
#include <type_traits>
#include <utility>

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

/// The schemes that know torques.
template <class... Scheme>
auto forced_among(std::tuple<Scheme...>) -> decltype(std::tuple_cat(
    std::declval<
        std::conditional_t<Scheme::kClaims.free_only, std::tuple<>, std::tuple<Scheme>>>()...));
using ForcedSchemeTypes = AsTestTypes<decltype(forced_among(std::declval<Schemes>()))>::type;

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
