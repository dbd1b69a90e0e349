// Reports of vessels along a coast, drawn at random: harbours full of moored vessels, ferries, coasters, a
// few aircraft. Speeds and accelerations differ by more than 1:10,000.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct VesselParameters {
  std::uint32_t vessels = 2708;
  double seconds = 3600.0;  ///< vessels report from time 0 at least until then
  std::uint64_t seed = 1;
};

/// Returns one track for each vessel, in metres and seconds, from the earth's centre, rounded to centimetres.
/// A track has about 25.5 samples in an hour: every three minutes while a vessel lies still, about every
/// minute while it moves, with some lost.
std::vector<Track> vessel_tracks(const VesselParameters& parameters);

/// Makes a scene in which vessels closer than `distance` (length) to each other are in contact.
Scene make_vessels(const VesselParameters& parameters, double distance);

}  // namespace kinesphere::program
