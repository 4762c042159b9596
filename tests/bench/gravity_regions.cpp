// Where a satellite keeps its place in the orbital frame under the gradient of gravity: a sweep over its shape, drawn.
//   gravity_regions_bench [FILE.svg]
//
// k_1 = (J_2 - J_3)/J_1, k_3 = (J_2 - J_1)/J_3, of roll, pitch and yaw 1, 2 and 3: every body is a point of the square
// between -1 and 1. Each starts a microradian off in all three angles and flies for some 15 orbits; one that is still
// within 0.2 mrad is called stable. Beside it what is known of the linear motion (Hughes, Spacecraft Attitude
// Dynamics, 1986, section 9.2): pitch needs k_1 > k_3, roll and yaw k_1 k_3 > 0, b = 1 + 3 k_1 + k_1 k_3 > 0 and
// b² > 16 k_1 k_3. Both positive is Lagrange's region, both negative that of DeBra and Delp (1961).

#include <cmath>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>

#include "adstar/orbit/orbital_frame.hpp"
#include "adstar/propagator.hpp"
#include "service/plot/grid.hpp"

namespace {

using namespace adstar;
using V = Vec3<double>;

constexpr double kRadius = 7e6;
constexpr int kCells = 20;

// Off the diagonal k_1 = k_3 and off zero, where the motion is on the edge.
double value_of_k_1(int i) { return -0.95 + 0.1 * i; }
double value_of_k_3(int i) { return -0.92 + 0.1 * i; }

enum Region { kUnstable, kLagrange, kDeBraDelp };

Region known(double k_1, double k_3) {
  const double b = 1 + 3 * k_1 + k_1 * k_3, c = k_1 * k_3;
  const bool stable = k_1 > k_3 && c > 0 && b > 0 && b * b > 16 * c;
  return !stable ? kUnstable : k_1 > 0 ? kLagrange : kDeBraDelp;
}

bool stays(double k_1, double k_3) {
  const double J_1 = 100, J_3 = J_1 * (1 - k_1) / (1 - k_3), J_2 = J_1 + k_3 * J_3;
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(J_1, J_2, J_3).asDiagonal()));
  const Orbit<double> orbit = make_orbit<double>({kRadius, 0, 0.7, 0.3, 0.2, 0.1});
  GravityGradient<double> gravity;
  gravity.orbit = orbit;
  gravity.act_on(body);
  const std::vector<Torque<double>> torques{gravity};
  const OrbitalFrame<double> frame = orbital_frame(motion_at(orbit, 0.0));
  const Quat<double> off = Rotation<double>(V{1e-6, 1e-6, 1e-6}).quaternion();
  const Quat<double> q_IB = frame.q_IO * off;
  State<double> state =
      make_state(q_IB, rotate(normalised(q_IB), body.momentum(rotate_inverse(off, frame.omega_O))));
  constexpr std::int64_t kStep_ns = 60'000'000'000;
  for (std::int64_t n = 0; n < 1500; ++n) {
    advance<CoadjointDop853, double>(body, state, torques, n * kStep_ns, kStep_ns);
    const double t = 60.0 * static_cast<double>(n + 1);
    const Quat<double> q_IO = orbital_frame(motion_at(orbit, t)).q_IO;
    if (norm(rotation_vector(q_IO, state.q_IB)) > 2e-4) {
      return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  plot::Grid grid;
  grid.title = "Gravity gradient: which shapes keep their place in the orbital frame";
  grid.x_label = "k_1 = (J_pitch - J_yaw)/J_roll; upwards k_3 = (J_pitch - J_roll)/J_yaw";
  grid.kinds = {{"unstable, as known", "#d9d9d9", "#000"},
                {"stays: Lagrange's region", "#0072b2", "#fff"},
                {"stays: region of DeBra and Delp", "#009e73", "#fff"},
                {"otherwise than the linear motion says", "#d55e00", "#fff"}};
  int otherwise = 0, stable = 0;
  for (int i = 0; i < kCells; ++i) {
    grid.columns.push_back(fmt::format("{:.2f}", value_of_k_1(i)));
    grid.rows.push_back(fmt::format("k_3 = {:.2f}", value_of_k_3(kCells - 1 - i)));
  }
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const double k_1 = value_of_k_1(column), k_3 = value_of_k_3(kCells - 1 - row);
      const Region region = known(k_1, k_3);
      const bool stayed = stays(k_1, k_3);
      const bool as_known = stayed == (region != kUnstable);
      stable += stayed ? 1 : 0;
      otherwise += as_known ? 0 : 1;
      grid.cells.push_back({as_known ? static_cast<std::size_t>(region) : 3U, ""});
      if (!as_known) {
        std::printf("k_1 %.2f k_3 %.2f: %s\n", k_1, k_3,
                    stayed ? "stays, though unstable in the long run" : "leaves");
      }
    }
  }
  std::printf("%d of %d shapes stay; %d otherwise than the linear motion says\n", stable,
              kCells * kCells, otherwise);
  if (argc > 1) {
    std::ofstream(argv[1]) << plot::svg({grid});
  }
  return 0;
}
