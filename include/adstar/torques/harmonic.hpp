#pragma once
// amplitude · sin(angular_frequency · t + phase), per axis; t is simulation time.

#include <cstddef>

#include "adstar/sine.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct Harmonic {
  static constexpr const char* kName = "harmonic";
  Frame frame = Frame::body;
  Vec3<T> amplitude_n_m;
  Vec3<T> angular_frequency_rad_s;
  Vec3<T> phase_rad;

  Vec3<T> at(const T& t_s) const {
    return {axis(amplitude_n_m.x, angular_frequency_rad_s.x, phase_rad.x, t_s),
            axis(amplitude_n_m.y, angular_frequency_rad_s.y, phase_rad.y, t_s),
            axis(amplitude_n_m.z, angular_frequency_rad_s.z, phase_rad.z, t_s)};
  }

  /// at() of N instants together: the same bits sooner.
  template <std::size_t N>
  void add_at(const T (&t_s)[N], VectorRows<T, N>& sum) const {
    add_axis(amplitude_n_m.x, angular_frequency_rad_s.x, phase_rad.x, t_s, sum.x);
    add_axis(amplitude_n_m.y, angular_frequency_rad_s.y, phase_rad.y, t_s, sum.y);
    add_axis(amplitude_n_m.z, angular_frequency_rad_s.z, phase_rad.z, t_s, sum.z);
  }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }
  T bound() const { return norm(amplitude_n_m); }

 private:
  static T axis(const T& amplitude, const T& rate, const T& phase, const T& t_s) {
    return amplitude == T(0) ? T(0) : amplitude * sine(rate * t_s + phase);
  }

  template <std::size_t N>
  static void add_axis(const T& amplitude, const T& rate, const T& phase, const T (&t_s)[N],
                       T (&sum)[N]) {
    if (amplitude == T(0)) {
      return;
    }
    T sines[N];
    for (std::size_t i = 0; i < N; ++i) {
      sines[i] = rate * t_s[i] + phase;
    }
    replace_by_sines(sines);
    for (std::size_t i = 0; i < N; ++i) {
      sum[i] = sum[i] + amplitude * sines[i];
    }
  }
};

}  // namespace adstar
