#include "service/scene/earth_keys.hpp"

#include <array>

#include "service/scene/complaints.hpp"

namespace adstar::scene {

std::optional<Earth> read_earth(Keys& root, const Simulation& simulation) {
  const Value named = root.optional("earth");
  Keys keys =
      named ? Keys(named, "[earth] on a line of its own") : Keys("earth", root.complaints());
  const Value ut1 = keys.optional("ut1_minus_utc_s");
  const double ut1_minus_utc =
      read_number(ut1, NumberRange{-1.0, 1.0}, {"seconds from -1 to 1, see IERS Bulletin A", "0.0"})
          .value_or(0);
  constexpr std::array<std::string_view, 2> kFields{"igrf", "dipole"};
  const bool dipole = read_choice(keys.optional("magnetic_field"), kFields).value_or(0) == 1;
  const Value degree_value = keys.optional("magnetic_degree");
  const auto degree = read_integer(degree_value, {1, HarmonicField<double>::kMostDegree},
                                   {"an integer from 1 to 13", "13"});
  if (dipole && degree_value) {
    degree_value.refuse("no magnetic_degree beside magnetic_field = \"dipole\"", "removing it");
  }
  keys.refuse_unknown();
  const auto epoch = simulation.epoch ? tai_date_of_epoch(*simulation.epoch) : std::nullopt;
  if (!epoch) {
    if (named && !simulation.epoch) {
      root.complaints().add(keys.place(), "simulation.epoch_utc", "nothing",
                            "the date that [earth] is turned to at t = 0",
                            "epoch_utc = 2026-01-01T00:00:00Z in [simulation]");
    }
    return std::nullopt;
  }
  Earth earth;
  earth.epoch = *epoch;
  earth.rotation = earth_rotation(*epoch, ut1_minus_utc);
  earth.year = julian_year(*epoch);
  earth.days_since_j2000 = days_since_j2000(*epoch);
  const FieldCoefficients<double> coefficients = igrf_coefficients(earth.year);
  earth.field.rotation = earth.rotation;
  earth.field.dipole = dipole_of(coefficients);
  if (!dipole) {
    earth.field.harmonics = std::make_shared<const HarmonicField<double>>(
        coefficients, static_cast<int>(degree.value_or(HarmonicField<double>::kMostDegree)));
  }
  return earth;
}

}  // namespace adstar::scene
