#pragma once
// a, b and c of a tableau as numbers of the scalar at hand, for steps that loop over their stages.

#include <array>
#include <cstddef>

namespace adstar::detail {

template <class Nodes, class T>
struct StageWeights {
  static constexpr std::size_t kStages = Nodes::kStages;
  std::array<std::array<T, kStages>, kStages> a{};
  std::array<T, kStages> b{}, c{};

  constexpr StageWeights() {
    for (std::size_t i = 0; i < kStages; ++i) {
      for (std::size_t j = 0; j < kStages; ++j) {
        a[i][j] = Nodes::a[i][j].template as<T>();
      }
      b[i] = Nodes::b[i].template as<T>();
      c[i] = Nodes::c[i].template as<T>();
    }
  }
};

template <class Nodes, class T>
inline const StageWeights<Nodes, T> kStageWeights{};

}  // namespace adstar::detail
