// The run of a scene under an event-driven detector, written down once and then played to it again and again:
// what its probes answered and how bodies were kicked are read off, so that neither the motion nor the
// response count.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/simulate.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct Transcript {
  struct Kick {
    std::uint32_t body;
    Vec3 velocity;
  };

  WorldDefinition world;
  double end_time;
  std::vector<BodyDefinition> bodies;  ///< as they are added
  std::vector<State> answers;          ///< of all probes, in order
  std::vector<Kick> kicks;
  std::vector<std::uint32_t> kicks_after;  ///< how many follow each event
  SimulationResult result;
  /// Without those at the start.
  std::uint64_t probes = 0;

  double body_time() const { return result.body_time; }
  /// Of bodies and walls, and alarms.
  std::uint64_t contacts() const;
};

/// Throws ProgramError.
Transcript write_down(const Scene& scene, const DetectorMaker& make);

/// CPU time in seconds.
struct Playing {
  double building;   ///< until all bodies are in and the clock stands at the start
  double detecting;  ///< from there to the end
};

/// Throws ProgramError when the detector does not do again what it did.
Playing play(const Transcript& transcript, const DetectorMaker& make);

}  // namespace kinesphere::program
