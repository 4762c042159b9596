#pragma once
// Four numbers of each of several structs, to and from four lanes-wide registers: a transpose in
// registers, so that structs may lie anywhere and stay structs.

#include <cstddef>
#include <immintrin.h>

#include "adstar/batch/lanes.hpp"

namespace adstar::batch {

template <class L>
struct Rows {
  L column[4];
};

/// column[j] lane i := from[i][j].
template <class Arch>
[[gnu::always_inline]] inline Rows<Lanes<double, Arch>> load_rows(const double* const* from) {
  using L = Lanes<double, Arch>;
  using B = xsimd::batch<double, Arch>;
  if constexpr (L::kWidth == 2) {
    const __m128d a = _mm_loadu_pd(from[0]), b = _mm_loadu_pd(from[1]);
    const __m128d c = _mm_loadu_pd(from[0] + 2), d = _mm_loadu_pd(from[1] + 2);
    return {B(_mm_unpacklo_pd(a, b)), B(_mm_unpackhi_pd(a, b)), B(_mm_unpacklo_pd(c, d)),
            B(_mm_unpackhi_pd(c, d))};
  } else if constexpr (L::kWidth == 4) {
    const __m256d a = _mm256_loadu_pd(from[0]), b = _mm256_loadu_pd(from[1]);
    const __m256d c = _mm256_loadu_pd(from[2]), d = _mm256_loadu_pd(from[3]);
    const __m256d ab02 = _mm256_unpacklo_pd(a, b), ab13 = _mm256_unpackhi_pd(a, b);
    const __m256d cd02 = _mm256_unpacklo_pd(c, d), cd13 = _mm256_unpackhi_pd(c, d);
    return {
        B(_mm256_permute2f128_pd(ab02, cd02, 0x20)), B(_mm256_permute2f128_pd(ab13, cd13, 0x20)),
        B(_mm256_permute2f128_pd(ab02, cd02, 0x31)), B(_mm256_permute2f128_pd(ab13, cd13, 0x31))};
  } else {
    static_assert(L::kWidth == 8);
    // Lanes 0 to 3 in the lower half, 4 to 7 in the upper, as two transposes of four.
    __m512d row[4];
    for (std::size_t i = 0; i < 4; ++i) {
      row[i] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(from[i])),
                                  _mm256_loadu_pd(from[i + 4]), 1);
    }
    const __m512d ab02 = _mm512_unpacklo_pd(row[0], row[1]);
    const __m512d ab13 = _mm512_unpackhi_pd(row[0], row[1]);
    const __m512d cd02 = _mm512_unpacklo_pd(row[2], row[3]);
    const __m512d cd13 = _mm512_unpackhi_pd(row[2], row[3]);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {B(_mm512_permutex2var_pd(ab02, first, cd02)),
            B(_mm512_permutex2var_pd(ab13, first, cd13)),
            B(_mm512_permutex2var_pd(ab02, second, cd02)),
            B(_mm512_permutex2var_pd(ab13, second, cd13))};
  }
}

/// to[i][j] := column[j] lane i, for the lanes of `which` (bit i: lane i).
template <class Arch>
[[gnu::always_inline]] inline void store_rows(const Rows<Lanes<double, Arch>>& rows,
                                              double* const* to, unsigned which) {
  using L = Lanes<double, Arch>;
  const auto& [c0, c1, c2, c3] = rows.column;
  const auto wanted = [which](std::size_t lane) { return (which >> lane & 1U) != 0; };
  if constexpr (L::kWidth == 2) {
    const auto put = [&](std::size_t lane, __m128d low, __m128d high) {
      if (wanted(lane)) {
        _mm_storeu_pd(to[lane], low);
        _mm_storeu_pd(to[lane] + 2, high);
      }
    };
    put(0, _mm_unpacklo_pd(c0.values, c1.values), _mm_unpacklo_pd(c2.values, c3.values));
    put(1, _mm_unpackhi_pd(c0.values, c1.values), _mm_unpackhi_pd(c2.values, c3.values));
  } else if constexpr (L::kWidth == 4) {
    const __m256d ab02 = _mm256_unpacklo_pd(c0.values, c1.values);
    const __m256d ab13 = _mm256_unpackhi_pd(c0.values, c1.values);
    const __m256d cd02 = _mm256_unpacklo_pd(c2.values, c3.values);
    const __m256d cd13 = _mm256_unpackhi_pd(c2.values, c3.values);
    const auto put = [&](std::size_t lane, __m256d row) {
      if (wanted(lane)) {
        _mm256_storeu_pd(to[lane], row);
      }
    };
    put(0, _mm256_permute2f128_pd(ab02, cd02, 0x20));
    put(1, _mm256_permute2f128_pd(ab13, cd13, 0x20));
    put(2, _mm256_permute2f128_pd(ab02, cd02, 0x31));
    put(3, _mm256_permute2f128_pd(ab13, cd13, 0x31));
  } else {
    static_assert(L::kWidth == 8);
    const __m512d ab02 = _mm512_unpacklo_pd(c0.values, c1.values);
    const __m512d ab13 = _mm512_unpackhi_pd(c0.values, c1.values);
    const __m512d cd02 = _mm512_unpacklo_pd(c2.values, c3.values);
    const __m512d cd13 = _mm512_unpackhi_pd(c2.values, c3.values);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const __m512d row[4] = {
        _mm512_permutex2var_pd(ab02, first, cd02), _mm512_permutex2var_pd(ab13, first, cd13),
        _mm512_permutex2var_pd(ab02, second, cd02), _mm512_permutex2var_pd(ab13, second, cd13)};
    for (std::size_t i = 0; i < 4; ++i) {
      if (wanted(i)) {
        _mm256_storeu_pd(to[i], _mm512_castpd512_pd256(row[i]));
      }
      if (wanted(i + 4)) {
        _mm256_storeu_pd(to[i + 4], _mm512_extractf64x4_pd(row[i], 1));
      }
    }
  }
}

}  // namespace adstar::batch
