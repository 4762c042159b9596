#pragma once
// Coils that somebody commands, in the Earth's field:
//   tau_B = m_B × B_B,   m_B = Σ m_i a_i
// with the dipole m_i of coil i [A m²] about its axis a_i: what is commanded, cut at the coil's limit and rounded to its step,
// followed at once or with a lag, lag · m_i' = target_i - m_i (Wertz, Spacecraft Attitude Determination and
// Control, 1978, section 17.2.4; the lag is that of a coil's current, L/R). Nothing is commanded: the target is zero.
//
// Commands stand in a window as in torques/commanded.hpp. Between edges the lag is an exponential in closed form. Its past is
// the state `settled`, plain numbers to be saved: carry_to(t) before the window is written anew for the step at t. The bits do not
// depend on how often it is called, for the state moves only to instants at which the target changes.
//
// Without a lag the dipole jumps half a microsecond after an edge, and the microsecond is a segment of its own: a stage that
// falls on the edge is then on the side that its step is on, and the order is kept (kSwitch_ns; an impulse off by less than that
// of a microsecond). With a lag it is the exponential that a step would be too coarse for: kAfterTurn cuts it into segments that
// grow as it dies away: what the dipole's impulse is off by is 5e-5 of one lag's length of the full change by Simpson's rule, as
// schemes of fourth order have it, and 1.2e-2 by the midpoint's. Left out: the coils' own field in each other, heat, the field
// that induces in them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "adstar/attitude.hpp"
#include "adstar/earth/magnetic_field.hpp"
#include "adstar/exponential.hpp"
#include "adstar/torques/commanded.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct DipoleInterval {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< exclusive
  Vec3<T> dipole_A_m2;      ///< one component a coil
};

/// What does not change in a run; three coils at most, an unused one has the limit 0.
template <class T>
struct Coils {
  std::array<Vec3<T>, 3> axes_B{Vec3<T>{T(1), T(0), T(0)}, Vec3<T>{T(0), T(1), T(0)},
                                Vec3<T>{T(0), T(0), T(1)}};  ///< unit
  Vec3<T> limit_A_m2;                                        ///< 0 or above
  Vec3<T> step_A_m2;                                         ///< of the quantisation; 0: none
  T lag_s{};                                                 ///< 0: none
  FieldOnOrbit<T> field;
};

template <class T>
struct Magnetorquer {
  static constexpr const char* kName = "magnetorquer";
  static constexpr Frame frame = Frame::body;
  static constexpr std::size_t kWindow = Commanded<T>::kWindow;
  /// How long a dipole without a lag takes to change, from the edge on.
  static constexpr std::int64_t kSwitch_ns = 1000;

  /// The lag's past: from `since_ns` to `until_ns` the coils went from `dipole` towards `towards`. Components by coil.
  struct Settled {
    std::int64_t since_ns = 0, until_ns = 0;
    Vec3<T> dipole_A_m2, towards_A_m2;
    friend bool operator==(const Settled&, const Settled&) = default;
  };

  std::shared_ptr<const Coils<T>> coils;            ///< not null
  std::array<DipoleInterval<T>, kWindow> window{};  ///< ascending, disjoint
  std::size_t intervals = 0;
  Settled settled;

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const {
    const Vec3<T> B_B = rotate_inverse(normalised(q_IB), coils->field.field_I(t_s));
    return cross(dipole_B(t_s), B_B);
  }

  /// [A m²], in B.
  Vec3<T> dipole_B(const T& t_s) const {
    const Vec3<T> m = dipole_of_coils(t_s);
    return m.x * coils->axes_B[0] + (m.y * coils->axes_B[1] + m.z * coils->axes_B[2]);
  }

  /// [A m²], a component a coil; before settled.until_ns as at it.
  Vec3<T> dipole_of_coils(const T& t_s) const {
    using std::floor;
    if (!(coils->lag_s > T(0))) {
      const T late_ns = t_s * T(1'000'000'000) - T(kSwitch_ns / 2);
      return target_at(static_cast<std::int64_t>(floor(late_ns)));
    }
    const Settled now =
        turned([&t_s](std::int64_t edge_ns) { return !(t_s < seconds<T>(edge_ns)); });
    const T until_s = seconds<T>(now.until_ns);
    return followed(now, (t_s > until_s ? t_s : until_s) - seconds<T>(now.since_ns));
  }

  /// What the coils are to reach at t [A m²], a component a coil.
  Vec3<T> target_at(std::int64_t t_ns) const {
    const DipoleInterval<T>* const interval = in_force(all(), t_ns);
    return interval == nullptr ? Vec3<T>{} : possible(interval->dipole_A_m2);
  }

  /// Cut and rounded to the nearest step within the limit.
  Vec3<T> possible(const Vec3<T>& asked) const {
    const Vec3<T>&limit = coils->limit_A_m2, &step = coils->step_A_m2;
    return {possible(asked.x, limit.x, step.x), possible(asked.y, limit.y, step.y),
            possible(asked.z, limit.z, step.z)};
  }

  /// Moves the past forward to t_ns, across the edges of the window as it stands. Backwards: nothing happens.
  void carry_to(std::int64_t t_ns) {
    if (t_ns <= settled.until_ns) {
      return;
    }
    settled = turned([t_ns](std::int64_t edge_ns) { return edge_ns < t_ns; });
    settled.until_ns = t_ns;
  }

  /// The coils' limits, or where they began beyond them.
  T bound() const {
    using std::abs;
    using std::max;
    const Vec3<T>&limit = coils->limit_A_m2, &m = settled.dipole_A_m2;
    const T most =
        max(limit.x, T(abs(m.x))) + max(limit.y, T(abs(m.y))) + max(limit.z, T(abs(m.z)));
    return most * coils->field.bound();
  }

  std::int64_t next_edge_after(std::int64_t t_ns) const {
    const std::int64_t edge_ns = adstar::next_edge_after(all(), t_ns);
    if (coils->lag_s > T(0)) {
      return std::min(edge_ns, next_cut_after(t_ns));
    }
    constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min() + kSwitch_ns;
    const std::int64_t late_ns =
        adstar::next_edge_after(all(), std::max(t_ns, kFirst) - kSwitch_ns);
    return late_ns == kNever ? edge_ns : std::min(edge_ns, late_ns + kSwitch_ns);
  }

 private:
  /// Lags after a turn at which a segment ends; by the last of them 1e-13 of the change is left.
  static constexpr std::array<double, 15> kAfterTurn{0.5, 1, 1.5, 2,  2.5, 3,  4, 5,
                                                     6,   8, 10,  13, 17,  22, 30};

  std::int64_t next_cut_after(std::int64_t t_ns) const {
    const Settled now = turned([t_ns](std::int64_t edge_ns) { return edge_ns <= t_ns; });
    if (now.dipole_A_m2 == now.towards_A_m2) {
      return kNever;
    }
    for (const double lags : kAfterTurn) {
      const T after_ns = T(lags) * coils->lag_s * T(1'000'000'000);
      constexpr std::int64_t kFar = kNever / 2;
      if (!(after_ns < T(kFar)) || now.since_ns > kFar) {
        return kNever;
      }
      const std::int64_t cut_ns = now.since_ns + static_cast<std::int64_t>(after_ns);
      if (cut_ns > t_ns) {
        return cut_ns;
      }
    }
    return kNever;
  }

  /// The past, carried across those edges of the window that `is_past` says yes to.
  template <class IsPast>
  Settled turned(const IsPast& is_past) const {
    Settled now = settled;
    turn_to(now, target_at(now.until_ns), now.until_ns);
    for (;;) {
      const std::int64_t edge_ns = adstar::next_edge_after(all(), now.until_ns);
      if (edge_ns == kNever || !is_past(edge_ns)) {
        return now;
      }
      turn_to(now, target_at(edge_ns), edge_ns);
    }
  }

  std::span<const DipoleInterval<T>> all() const { return {window.data(), intervals}; }

  static T possible(const T& asked, const T& limit, const T& step) {
    using std::floor;
    const bool negative = asked < T(0);
    T size = negative ? -asked : asked;
    size = size < limit ? size : limit;
    if (step > T(0)) {
      const T nearest = floor(T(size / step + T(0.5))), most = floor(T(limit / step));
      size = step * (nearest < most ? nearest : most);
    }
    return negative ? -size : size;
  }

  /// The dipole `since` seconds after now.since_ns: target + (m - target) e^(-since/lag).
  Vec3<T> followed(const Settled& now, const T& since) const {
    const T left = exponential(T(-(since / coils->lag_s)));
    return now.towards_A_m2 + left * (now.dipole_A_m2 - now.towards_A_m2);
  }

  /// From t_ns on towards `target`; nothing happens where that is where it goes.
  void turn_to(Settled& now, const Vec3<T>& target, std::int64_t t_ns) const {
    now.until_ns = t_ns;
    if (target == now.towards_A_m2) {
      return;
    }
    if (coils->lag_s > T(0)) {
      now.dipole_A_m2 = followed(now, seconds<T>(t_ns - now.since_ns));
    }
    now.towards_A_m2 = target;
    now.since_ns = t_ns;
  }
};

}  // namespace adstar
