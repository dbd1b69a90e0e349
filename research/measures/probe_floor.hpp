// The probe floor: the number of probes of a detector that knows everything but the one body it probes.
//
// If the true motion of all other bodies is known, there is a longest time that body i may go unprobed: until
// its bound, grown since the last report, first reaches deeper than the contact tolerance into a true sphere
// or a wall. Probing as late as that each time (greedily), and at contacts, takes the least number of probes
// of that body. A real method knows less about the others and needs at least as many; the ratio is what it
// pays for not knowing.
//
// While two bodies touch, the pair is probed at the end of its contact only, and that probe is counted.
// Reports with which bodies are added are not counted.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/run/flight.hpp"

namespace kinesphere {

struct ProbeFloor {
  std::vector<std::uint64_t> probes;  ///< by body

  std::uint64_t total() const;
};

/// Computes the floor for a flight through the scene. Cost: some microseconds for each probe. Precondition:
/// all bodies are there from the start to the end, reports have no errors, and paths no jerk.
ProbeFloor probe_floor(const Scene& scene, const Flight& flight);

}  // namespace kinesphere
