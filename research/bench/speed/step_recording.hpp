// The recording of a scene moved in fixed steps. Detectors are timed on recorded frames, so that the motion
// does not count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinesphere/event.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/speed/step_kernel.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct StepRecording {
  double step;               ///< time
  SphereTest test;           ///< the test by which answered contacts were found
  std::vector<float> radii;  ///< by body; bodies are numbered along strips of space, as in a tuned program
  std::vector<std::vector<float>> x, y, z;  ///< by step, by body; the first is the start
  std::uint64_t contacts = 0;               ///< contacts of bodies and walls that were approaching
  std::optional<Box> box{};

  std::size_t steps() const { return x.size() - 1; }
  Frame frame(std::size_t step_number) const {
    return {x[step_number].data(), y[step_number].data(), z[step_number].data()};
  }
  double body_time() const { return step * static_cast<double>(steps()) * static_cast<double>(radii.size()); }
};

/// Called for each pair that touches in a step, with numbers of bodies as in the scene. For a wall, `second`
/// equals `first`.
using TouchObserver =
    std::function<void(std::size_t step_number, std::uint32_t first, std::uint32_t second, Wall wall)>;

/// Records a scene. Contacts of approaching bodies are answered at the step as the scene says. Frames are
/// kept only without an observer. Throws ProgramError.
StepRecording record_steps(const Scene& scene, double step, std::size_t steps, SphereTest test,
                           const TouchObserver& observer = {});

/// Counts the contacts in a scene in which all bodies pass through each other. A pair that touches in one
/// step and not in the step before is a contact.
ContactCounts contacts_at_steps(const Scene& scene, double step, std::size_t steps, SphereTest test);

}  // namespace kinesphere::program
