#pragma once
// What a kernel asks of its scalar: whether T is one number, or the same number of several bodies
// side by side (batch/lanes.hpp).
//
// A kernel is written once for both. What it decides by an `if`, it decides for lanes one by one:
// computes both sides and selects, so that each lane gets the bits of a scalar on its own.

#include <concepts>

namespace adstar {

/// The number in each lane; T itself when T is one number. Lanes specialise it.
template <class T>
struct NumberIn {
  using type = T;
};

template <class T>
concept ManyLanes = !std::same_as<typename NumberIn<T>::type, T>;

/// double, or lanes of double.
template <class T>
concept Binary64 = std::same_as < typename NumberIn<T>::type,
double > ;

}  // namespace adstar
