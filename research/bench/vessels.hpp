// Reports of vessels along a coast, drawn at random: harbours full of moored vessels, ferries, coasters, a
// few aircraft. Their speeds and accelerations lie further apart than 1:10,000.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct VesselParameters {
  std::uint32_t vessels = 2708;
  double seconds = 3600.0;  ///< every vessel is seen from time 0 on, until then at least
  std::uint64_t seed = 1;
};

/// One track for each vessel, in metres and seconds, from the earth's centre: its samples are rounded to
/// centimetres. About 25.5 samples each in an hour: every three minutes of those who lie still, about every
/// minute of the others, some lost.
std::vector<Track> vessel_tracks(const VesselParameters& parameters);

/// Whoever comes closer than `distance` to another is in contact with it.
Scene make_vessels(const VesselParameters& parameters, double distance);

struct VesselOptions {
  std::string file;
  VesselParameters parameters;
};

/// `kinesphere bench vessels`: writes the tracks as a table for `kinesphere tracks`. `options` must live
/// until the command line has been parsed.
CLI::App* add_bench_vessels_command(CLI::App& bench, VesselOptions& options);
/// Lines of id, time, x, y and z by time, under a header. Returns the exit code. Throws ProgramError.
int bench_vessels(const VesselOptions& options);

}  // namespace kinesphere::program
