// The probe floor: how few probes a detector could do with that knew everything but the one body it asks.
//
// For body i, with everyone else's true motion known, there is a longest time that it may go unprobed: until
// the bound that has grown since its last report first reaches deeper than the contact tolerance into a true
// sphere or a wall. Probing as late as that each time (greedily), and at its contacts, is the least number of
// probes of that body. A real method knows less about the others, so it needs at least as many; how many
// times as many is what it pays for not knowing.
//
// While two bodies touch, nothing is asked about that pair but when its contact ends, and the probe at that
// end is counted. Reports that bodies are added with are not.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/run/flight.hpp"

namespace kinesphere {

struct ProbeFloor {
  std::vector<std::uint64_t> probes;  ///< by body

  std::uint64_t total() const;
};

/// Of a flight through this scene. Errors: unsupported for bodies that come or go on the way, for reports
/// with errors, and for paths with jerk. Cost: some microseconds for each probe.
Result<ProbeFloor> probe_floor(const Scene& scene, const Flight& flight);

}  // namespace kinesphere
