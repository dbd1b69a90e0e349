// The transcript of a run of a scene under an event-driven detector. It is recorded once and then played to
// the detector repeatedly: answers of probes and velocity changes are read off, so that neither the motion
// nor the response counts.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct Transcript {
  struct Kick {
    std::uint32_t body;
    Vec3 velocity;
  };

  WorldDefinition world;
  double end_time;
  std::vector<BodyDefinition> bodies;  ///< in the order in which they are added
  std::vector<State> answers;          ///< answers of all probes, in order
  std::vector<Kick> kicks;
  std::vector<std::uint32_t> kicks_after;  ///< by event: number of velocity changes after it
  SceneResult result;
  /// Probes without those at the start.
  std::uint64_t probes = 0;

  double body_time() const { return result.body_time; }
  /// Returns the number of contacts of bodies and walls, and of alarms.
  std::uint64_t contacts() const;
};

/// Records a run. Throws ProgramError.
Transcript write_down(const Scene& scene, const DetectorMaker& make);

/// CPU time in seconds.
struct Playing {
  double building;   ///< until all bodies are in and the clock stands at the start
  double detecting;  ///< from there to the end
};

/// Plays a transcript. Throws ProgramError if the detector does not repeat its run.
Playing play(const Transcript& transcript, const DetectorMaker& make);

}  // namespace kinesphere::program
