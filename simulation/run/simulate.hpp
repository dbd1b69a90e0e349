// Running a scene under a detector.
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

/// What simulate() hands out while it runs. Each may be empty.
struct SimulationObserver {
  /// Called for every event, in order.
  std::function<void(const Event&)> on_event;
  /// Called at start_time + k * frame_interval, and at the end.
  std::function<void(const Detector&, const Motion&, double time)> on_frame;
  double frame_interval = std::numeric_limits<double>::infinity();
  /// Called with the detector before every advance (tests audit here).
  std::function<void(const Detector&)> between_events;
  /// Called before anything is done with the detector, and when all is done; an error ends the simulation.
  std::function<Result<void>(Detector&)> at_start;
  std::function<Result<void>(Detector&)> at_end;
};

struct SimulationResult {
  DetectorCounters counters;
  double simulated_time = 0.0;
  double body_time = 0.0;          ///< sum over bodies of the time they were there
  std::uint64_t contact_hash = 0;  ///< of all events; see EventHash
  std::optional<Memory> memory{};  ///< of the detector at the end, if it knows
};

/// Runs a scene under a detector that `make` creates: adds and removes bodies when their time comes, answers
/// contacts as the scene's response says. With workers the detector goes on by itself between those times
/// (Detector::run), and between_events is called before that and at each event, when it cannot be audited;
/// without, by one advance() for each event. Both give the same result. Errors: not_finite, time_backwards or
/// out_of_range for times that cannot be, for more bodies than the motion has and for turns of none;
/// unsupported where bodies are to bounce whose motion cannot be changed; those of the detector.
Result<SimulationResult> simulate(const Scene& scene, const DetectorMaker& make,
                                  const SimulationObserver& observer = {}, Workers* workers = nullptr);

}  // namespace kinesphere
