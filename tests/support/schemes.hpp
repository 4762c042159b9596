#pragma once
// adstar::Schemes as a list of test types: a scheme that joins the list joins the suite.

#include <tuple>

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

}  // namespace adstar::test
