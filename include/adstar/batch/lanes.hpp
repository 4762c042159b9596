#pragma once
// The same number of several bodies side by side: one xsimd register that a kernel takes for its
// scalar. Optional: needs xsimd, and a translation unit compiled for `Arch`.
//
// Every operation is the IEEE 754 one in each lane, so a lane has the bits that the scalar kernel
// has, on every instruction set, as long as nothing is contracted (-ffp-contract=off).
// Every name that is instantiated here carries `Arch`: code of one instruction set cannot be merged
// by the linker into that of another (service/decisions/0008).

#include <concepts>
#include <cstddef>

#include <xsimd/xsimd.hpp>

#include "adstar/scalar.hpp"

namespace adstar {

template <class Number, class Arch>
struct LaneMask {
  xsimd::batch_bool<Number, Arch> bits;

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return {a.bits & b.bits}; }
};

template <class Number, class Arch>
struct Lanes {
  using Mask = LaneMask<Number, Arch>;
  static constexpr std::size_t kWidth = xsimd::batch<Number, Arch>::size;

  xsimd::batch<Number, Arch> values;

  [[gnu::always_inline]] Lanes() : values(Number(0)) {}
  [[gnu::always_inline]] Lanes(const xsimd::batch<Number, Arch>& v) : values(v) {}
  /// The same in every lane; implicit, as a kernel's constants are.
  template <class N>
  requires std::floating_point<N> || std::integral<N>
  [[gnu::always_inline]] Lanes(N number) : values(static_cast<Number>(number)) {}

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return a.values + b.values;
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return a.values - b.values;
  }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return a.values * b.values;
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return a.values / b.values;
  }
  /// Of the register, not xsimd's: that is 0 - a on some instruction sets, which makes +0 of +0.
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) {
    return xsimd::batch<Number, Arch>(-a.values.data);
  }
  [[gnu::always_inline]] friend Mask operator<=(const Lanes& a, const Lanes& b) {
    return {a.values <= b.values};
  }
  [[gnu::always_inline]] friend Mask operator<(const Lanes& a, const Lanes& b) {
    return {a.values < b.values};
  }
  [[gnu::always_inline]] friend Mask operator>(const Lanes& a, const Lanes& b) {
    return {a.values > b.values};
  }
};

template <class Number, class Arch>
struct NumberIn<Lanes<Number, Arch>> {
  using type = Number;
};

template <class Number, class Arch>
[[gnu::always_inline]] inline bool all(const LaneMask<Number, Arch>& mask) {
  return xsimd::all(mask.bits);
}
template <class Number, class Arch>
[[gnu::always_inline]] inline bool any(const LaneMask<Number, Arch>& mask) {
  return xsimd::any(mask.bits);
}
/// In each lane `yes` where the mask is set, `no` elsewhere.
template <class Number, class Arch>
[[gnu::always_inline]] inline Lanes<Number, Arch> select(const LaneMask<Number, Arch>& mask,
                                                         const Lanes<Number, Arch>& yes,
                                                         const Lanes<Number, Arch>& no) {
  return xsimd::select(mask.bits, yes.values, no.values);
}

}  // namespace adstar
