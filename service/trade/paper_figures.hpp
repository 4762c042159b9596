#pragma once
// Figures 1 to 3 of Terze, Müller and Zlatar: a free body (its values are those of Krysl and Endres
// 2005) by the paper's scheme and by the two that it is compared with.
//
// The paper gives neither step nor duration nor numbers; what the figures claim is the shape of
// things: R stays orthogonal with determinant 1, and the momentum drifts less than with RKMK4 and
// Lie-Newmark.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "adstar/vec3.hpp"

namespace adstar::trade {

struct PaperSample {
  double time_s = 0;
  Vec3<double> omega_B;               ///< [rad/s], coadjoint_rk4
  Vec3<double> orthogonality;         ///< diag(R Rᵀ) - 1
  double determinant = 0;             ///< det R - 1
  std::array<Vec3<double>, 3> drift;  ///< H_I - H_I(0) [N m s], by kPaperSchemes
};

inline constexpr std::array<const char*, 3> kPaperSchemes = {"coadjoint_rk4", "rkmk4",
                                                             "lie_newmark"};

/// Samples at t = 0 and after every step.
std::vector<PaperSample> paper_run(std::int64_t step_ns, std::int64_t duration_ns);

struct Figure {
  std::string name;  ///< "figure_1"
  std::string csv, svg;
};
std::vector<Figure> paper_figures(const std::vector<PaperSample>& samples, std::int64_t step_ns);

}  // namespace adstar::trade
