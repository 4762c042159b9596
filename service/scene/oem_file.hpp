#pragma once
// An orbit from a CCSDS Orbit Ephemeris Message in KVN (CCSDS 502.0-B-3, Orbit Data Messages, 2023, section 5), one segment
// or several that follow each other, of an object about the Earth on the axes of EME2000, GCRF or ICRF.

#include <filesystem>
#include <memory>
#include <optional>

#include "adstar/orbit/ephemeris.hpp"
#include "service/scene/keys.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::scene {

/// `value` names the file, beside the scene `scene_file`; t = 0 is `epoch`. Complaints carry the place in the file.
std::optional<std::shared_ptr<const Ephemeris<double>>> read_oem_file(
    const Value& value, const std::filesystem::path& scene_file, const TaiDate& epoch,
    double gravity_m3_s2);

}  // namespace adstar::scene
