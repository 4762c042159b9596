#pragma once
// Two registers of doubles to one of floats and back: lane by lane as narrow.hpp says.

#include <immintrin.h>

#include "adstar/batch/lanes.hpp"
#include "adstar/narrow.hpp"

namespace adstar {

template <class Arch>
struct Narrower<Lanes<double, Arch>> {
  using type = Lanes<float, Arch>;
  using Wide = Lanes<double, Arch>;
  static constexpr int kParts = 2;

  [[gnu::always_inline]] static type narrow(const Wide& low, const Wide& high) {
    if constexpr (type::kWidth == 4) {
      return Floats(_mm_movelh_ps(_mm_cvtpd_ps(low.values), _mm_cvtpd_ps(high.values)));
    } else if constexpr (type::kWidth == 8) {
      return Floats(_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(low.values)),
                                         _mm256_cvtpd_ps(high.values), 1));
    } else {
      static_assert(type::kWidth == 16);
      const __m512d half = _mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(low.values)));
      const __m256d other = _mm256_castps_pd(_mm512_cvtpd_ps(high.values));
      return Floats(_mm512_castpd_ps(_mm512_insertf64x4(half, other, 1)));
    }
  }

  /// Part 0 the lower lanes, part 1 the upper.
  template <int kPart>
  [[gnu::always_inline]] static Wide widen(const type& x) {
    if constexpr (type::kWidth == 4) {
      const __m128 v = x.values;
      return Doubles(_mm_cvtps_pd(kPart == 0 ? v : _mm_movehl_ps(v, v)));
    } else if constexpr (type::kWidth == 8) {
      const __m256 v = x.values;
      return Doubles(
          _mm256_cvtps_pd(kPart == 0 ? _mm256_castps256_ps128(v) : _mm256_extractf128_ps(v, 1)));
    } else {
      const __m512 v = x.values;
      const __m256 upper = _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(v), 1));
      return Doubles(_mm512_cvtps_pd(kPart == 0 ? _mm512_castps512_ps256(v) : upper));
    }
  }

 private:
  using Floats = xsimd::batch<float, Arch>;
  using Doubles = xsimd::batch<double, Arch>;
};

}  // namespace adstar
