#pragma once
// Cholesky factors of small symmetric matrices, with the order of every sum fixed (service/decisions/0002).
//
// Row-major with a leading dimension of their own; only the lower triangle is read and written. The diagonal
// of a factor holds 1/L_ii: a solve then divides nowhere.

#include <cmath>

namespace adstar::multibody {

/// A = L Lᵀ in place. A pivot at or below `least` (by row; null: zero) is of a row that depends on those
/// before: it is taken out (its 1/L_ii = 0, so that its unknown is 0). Returns how many were.
template <class T>
int factor_cholesky(T* A, int n, int ld, const T* least = nullptr) {
  using std::sqrt;
  int dropped = 0;
  for (int i = 0; i < n; ++i) {
    T* const row = A + i * ld;
    for (int j = 0; j < i; ++j) {
      const T* const other = A + j * ld;
      T sum = row[j];
      for (int k = 0; k < j; ++k) {
        sum = sum - row[k] * other[k];
      }
      row[j] = sum * other[j];
    }
    T pivot = row[i];
    for (int k = 0; k < i; ++k) {
      pivot = pivot - row[k] * row[k];
    }
    if (pivot > (least == nullptr ? T(0) : least[i])) {
      row[i] = T(1) / sqrt(pivot);
    } else {
      row[i] = T(0);
      ++dropped;
    }
  }
  return dropped;
}

/// The same of N × N with leading dimension 6, where nothing is to be taken out: loops of known length.
template <int N, class T>
void factor_cholesky_of(T* A) {
  using std::sqrt;
  for (int i = 0; i < N; ++i) {
    T* const row = A + 6 * i;
    T pivot = row[i];
    for (int j = 0; j < i; ++j) {
      const T* const other = A + 6 * j;
      T sum = row[j];
      for (int k = 0; k < j; ++k) {
        sum = sum - row[k] * other[k];
      }
      row[j] = sum * other[j];
      pivot = pivot - row[j] * row[j];
    }
    row[i] = T(1) / sqrt(pivot);
  }
}

/// x := L⁻¹ x
template <class T>
void solve_lower(const T* L, int n, int ld, T* x) {
  for (int i = 0; i < n; ++i) {
    const T* const row = L + i * ld;
    T sum = x[i];
    for (int k = 0; k < i; ++k) {
      sum = sum - row[k] * x[k];
    }
    x[i] = sum * row[i];
  }
}

/// x := L⁻ᵀ x
template <class T>
void solve_upper(const T* L, int n, int ld, T* x) {
  for (int i = n - 1; i >= 0; --i) {
    T sum = x[i];
    for (int k = i + 1; k < n; ++k) {
      sum = sum - L[k * ld + i] * x[k];
    }
    x[i] = sum * L[i * ld + i];
  }
}

}  // namespace adstar::multibody
