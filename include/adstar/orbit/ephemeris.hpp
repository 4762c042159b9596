#pragma once
// An orbit given as a table: positions and velocities at epochs, joined by a polynomial through the epochs nearest to t.
//
// Hermite of odd degree d: through positions and velocities of (d + 1)/2 epochs; Lagrange of degree d: through d + 1
// positions, the velocity through d + 1 velocities (CCSDS 502.0-B-3, Orbit Data Messages, 2023, names both for its OEM). Both in
// Newton's form over divided differences (Hildebrand, Introduction to Numerical Analysis, 2nd ed., sections 2.5 and 8.2),
// in the time since the interval's beginning. Where the epochs change, the polynomial does: a jump of the size of its error.
//
// Outside the table's span (span_s) the spacecraft stands where the table begins or ends, with the velocity of there: it
// is nobody's orbit any more, and whoever runs past it should say so.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "adstar/orbit/kepler.hpp"

namespace adstar {

enum class EphemerisMethod : std::uint8_t { hermite, lagrange };

/// A row: where and how fast at t [s] of simulation time; about the centre of attraction, in I.
template <class T>
struct EphemerisRow {
  T t_s{};
  Vec3<T> r_I;  ///< [m]
  Vec3<T> v_I;  ///< [m/s]
};

/// Made by make_ephemeris(), then constant.
template <class T>
struct Ephemeris {
  /// The highest degree that is taken.
  static constexpr int kMostDegree = 15;

  std::vector<EphemerisRow<T>> rows;  ///< epochs strictly rising
  EphemerisMethod method = EphemerisMethod::hermite;
  int degree = 7;
  T gravity_m3_s2 = T(kEarthGravity_m3_s2);
  T least_distance_m{}, greatest_speed_m_s{};  ///< over the span, some margin taken

  /// Epochs that one polynomial goes through.
  std::size_t nodes() const {
    return static_cast<std::size_t>(method == EphemerisMethod::hermite ? (degree + 1) / 2
                                                                       : degree + 1);
  }
};

/// What is wrong with a table, in words that end a sentence; null when nothing is.
template <class T>
const char* defect_of(const Ephemeris<T>& table) {
  if (table.degree < 1 || table.degree > Ephemeris<T>::kMostDegree) {
    return "the degree is not from 1 to 15";
  }
  if (table.method == EphemerisMethod::hermite && table.degree % 2 == 0) {
    return "a Hermite polynomial has an odd degree";
  }
  if (table.rows.size() < std::max<std::size_t>(2, table.nodes())) {
    return "it has fewer epochs than its polynomial needs";
  }
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    if (!(table.rows[i - 1].t_s < table.rows[i].t_s)) {
      return "its epochs do not rise";
    }
  }
  for (const EphemerisRow<T>& row : table.rows) {
    if (!(squared_norm(row.r_I) > T(0)) || !(squared_norm(row.v_I) >= T(0))) {
      return "a row is not a motion off the centre";
    }
  }
  return nullptr;
}

/// First and last epoch [s].
template <class T>
std::pair<T, T> span_s(const Ephemeris<T>& table) {
  return {table.rows.front().t_s, table.rows.back().t_s};
}

namespace detail {

inline constexpr std::size_t kEphemerisNodes = 16;

/// Newton's form: value = c_0 + (x - x_0)(c_1 + (x - x_1)(c_2 + ...)). A node that stands twice brings its slope.
template <class T>
struct NewtonForm {
  std::array<T, kEphemerisNodes> x{};
  std::array<Vec3<T>, kEphemerisNodes> c{};
  std::size_t count = 0;

  /// `c` holds the values at the nodes; `slope[i]` is asked only where x[i] == x[i - 1].
  template <class Slope>
  void divide(const Slope& slope) {
    for (std::size_t order = 1; order < count; ++order) {
      for (std::size_t i = count - 1; i >= order; --i) {
        const T gap = x[i] - x[i - order];
        c[i] = gap == T(0) ? slope(i) : (T(1) / gap) * (c[i] - c[i - 1]);
      }
    }
  }
  Vec3<T> value(const T& at) const {
    Vec3<T> sum = c[count - 1];
    for (std::size_t i = count - 1; i-- > 0;) {
      sum = c[i] + (at - x[i]) * sum;
    }
    return sum;
  }
  Vec3<T> derivative(const T& at) const {
    Vec3<T> sum = c[count - 1], rate{};
    for (std::size_t i = count - 1; i-- > 0;) {
      rate = sum + (at - x[i]) * rate;
      sum = c[i] + (at - x[i]) * sum;
    }
    return rate;
  }
};

/// Index of the first of the nodes about t, as many before it as after where the table lets it.
template <class T>
std::size_t first_node(const Ephemeris<T>& table, const T& t_s) {
  const auto& rows = table.rows;
  const auto next =
      std::upper_bound(rows.begin(), rows.end(), t_s,
                       [](const T& time, const EphemerisRow<T>& row) { return time < row.t_s; });
  const auto after = static_cast<std::size_t>(next - rows.begin());
  const std::size_t half = table.nodes() / 2, most = rows.size() - table.nodes();
  return after < half ? 0 : std::min(after - half, most);
}

template <class T>
NewtonForm<T> hermite_form(const Ephemeris<T>& table, std::size_t first) {
  NewtonForm<T> form;
  form.count = 2 * table.nodes();
  const EphemerisRow<T>* const rows = table.rows.data() + first;
  for (std::size_t i = 0; i < form.count; ++i) {
    form.x[i] = rows[i / 2].t_s - rows[0].t_s;
    form.c[i] = rows[i / 2].r_I;
  }
  form.divide([rows](std::size_t i) { return rows[i / 2].v_I; });
  return form;
}

template <class T>
NewtonForm<T> lagrange_form(const Ephemeris<T>& table, std::size_t first,
                            Vec3<T> EphemerisRow<T>::*member) {
  NewtonForm<T> form;
  form.count = table.nodes();
  const EphemerisRow<T>* const rows = table.rows.data() + first;
  for (std::size_t i = 0; i < form.count; ++i) {
    form.x[i] = rows[i].t_s - rows[0].t_s;
    form.c[i] = rows[i].*member;
  }
  form.divide([](std::size_t) { return Vec3<T>{}; });
  return form;
}

}  // namespace detail

template <class T>
OrbitMotion<T> motion_at(const Ephemeris<T>& table, const T& t_s) {
  const EphemerisRow<T>&begin = table.rows.front(), &end = table.rows.back();
  if (!(t_s > begin.t_s)) {
    return {begin.r_I, begin.v_I};
  }
  if (t_s >= end.t_s) {
    return {end.r_I, end.v_I};
  }
  const std::size_t first = detail::first_node(table, t_s);
  const T x = t_s - table.rows[first].t_s;
  if (table.method == EphemerisMethod::hermite) {
    const auto form = detail::hermite_form(table, first);
    return {form.value(x), form.derivative(x)};
  }
  return {detail::lagrange_form(table, first, &EphemerisRow<T>::r_I).value(x),
          detail::lagrange_form(table, first, &EphemerisRow<T>::v_I).value(x)};
}

template <class T>
OrbitPosition<T> position_at(const Ephemeris<T>& table, const T& t_s) {
  Vec3<T> r_I;
  const EphemerisRow<T>&begin = table.rows.front(), &end = table.rows.back();
  if (!(t_s > begin.t_s) || t_s >= end.t_s) {
    r_I = t_s >= end.t_s ? end.r_I : begin.r_I;
  } else {
    const std::size_t first = detail::first_node(table, t_s);
    const auto form = table.method == EphemerisMethod::hermite
                          ? detail::hermite_form(table, first)
                          : detail::lagrange_form(table, first, &EphemerisRow<T>::r_I);
    r_I = form.value(t_s - table.rows[first].t_s);
  }
  const T distance = norm(r_I);
  return {(T(1) / distance) * r_I, distance};
}

/// Through every other row alone: how far the polynomial misses those between [m], at most. With all of them it errs
/// by some 2^(degree + 1) less. Nothing where the rows are too few to tell.
template <class T>
std::optional<T> left_out_error(const Ephemeris<T>& table) {
  Ephemeris<T> half = table;
  half.rows.clear();
  for (std::size_t i = 0; i < table.rows.size(); i += 2) {
    half.rows.push_back(table.rows[i]);
  }
  if (half.rows.size() <= half.nodes()) {
    return std::nullopt;
  }
  T most{};
  for (std::size_t i = 1; i + 1 < table.rows.size(); i += 2) {
    most = std::max(most, T(norm(motion_at(half, table.rows[i].t_s).r_I - table.rows[i].r_I)));
  }
  return most;
}

/// A table without a defect, ready to be shared. Sampled eight times between epochs: what the distance may fall by
/// between samples δ apart is at most δ²/8 of its acceleration, taken as twice μ/r², or twice what the samples'
/// own second differences come to.
template <class T>
std::shared_ptr<const Ephemeris<T>> make_ephemeris(Ephemeris<T> table) {
  constexpr int kSamples = 8;
  T least = norm(table.rows.front().r_I), fastest = norm(table.rows.front().v_I), widest{};
  T strongest{};
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const T begin = table.rows[i - 1].t_s, gap = (table.rows[i].t_s - begin) / T(kSamples);
    widest = std::max(widest, gap);
    Vec3<T> before{}, last = table.rows[i - 1].r_I;
    for (int k = 1; k <= kSamples; ++k) {
      const OrbitMotion<T> motion = motion_at(table, T(begin + T(k) * gap));
      const T distance = norm(motion.r_I);
      least = std::min(least, distance);
      fastest = std::max(fastest, T(norm(motion.v_I)));
      if (k > 1) {
        const Vec3<T> r2 = (T(1) / (gap * gap)) * ((motion.r_I - last) - (last - before));
        strongest = std::max(strongest, T(norm(r2)));
      }
      before = last;
      last = motion.r_I;
    }
  }
  const T acceleration = T(2) * std::max(strongest, T(table.gravity_m3_s2 / least / least));
  const T fall = widest * widest / T(8) * acceleration;
  table.least_distance_m = std::max(T(0.5) * least, T(least - fall));
  table.greatest_speed_m_s = fastest + T(0.5) * widest * acceleration;
  return std::make_shared<const Ephemeris<T>>(std::move(table));
}

}  // namespace adstar
