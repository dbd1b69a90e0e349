// Runs a scene under a detector.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "kinesphere/event.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Callbacks of run_scene(). Each may be empty.
struct SceneObserver {
  /// Called for each event, in order.
  std::function<void(const Event&)> on_event;
  /// Called at start_time + k * frame_interval, and at the end.
  std::function<void(const Detector&, const Motion&, double time)> on_frame;
  double frame_interval = std::numeric_limits<double>::infinity();
  /// Called with the detector before each advance (tests audit here).
  std::function<void(const Detector&)> between_events;
  /// Called before the detector is used, and after the end of the scene. An error ends the run.
  std::function<Result<void>(Detector&)> at_start;
  std::function<Result<void>(Detector&)> at_end;
};

/// Result of run_scene().
struct SceneResult {
  DetectorCounters counters;
  double simulated_time = 0.0;
  double body_time = 0.0;          ///< sum over bodies of the time they were there
  std::uint64_t contact_hash = 0;  ///< event hash of all events; see EventHash
  std::optional<Memory> memory{};  ///< memory of the detector at the end, if it keeps count
};

/// Runs a scene under a detector that `make` creates: adds, turns and removes bodies at their times, and
/// answers contacts as the scene's response says. Without workers it calls advance() for each event. With
/// workers the detector runs by itself between the changes of the scene (Detector::run); between_events is
/// then called before each run and at each event, where the detector cannot be audited. Results do not depend
/// on the workers. Errors: not_finite, time_backwards or out_of_range for impossible times, for more bodies
/// than the motion has and for turns of a body that does not exist; unsupported if bodies are to bounce and
/// their motion cannot be changed; those of the detector.
Result<SceneResult> run_scene(const Scene& scene, const DetectorMaker& make,
                              const SceneObserver& observer = {}, Workers* workers = nullptr);

}  // namespace kinesphere
