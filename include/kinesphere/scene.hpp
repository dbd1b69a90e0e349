// Scenes: bodies, their motion and what they do on contact. One set of scenes serves the program, the tests
// and the benchmarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinesphere/detector.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

enum class Response {
  pass_through,  ///< nobody reacts: the contacts are a fixed truth
  bounce,        ///< bodies bounce off each other and the walls, mass ~ radius^3
};

struct SceneBody {
  double radius = 1.0;
  double appears = 0.0;                                       ///< when it is added
  double vanishes = std::numeric_limits<double>::infinity();  ///< when it is removed
};

/// A velocity that a body is given at some time, whatever happens: the motion's set_velocity() is called with
/// it, and the detector told.
struct SceneTurn {
  double time = 0.0;
  std::uint32_t body = 0;
  Vec3 velocity;
};

struct Scene {
  std::string name;
  WorldDefinition world;
  std::vector<SceneBody> bodies;  ///< by their number in the motion
  std::unique_ptr<const Motion> motion;
  std::vector<SceneTurn> turns;  ///< in any order; those of bodies that are not there then are passed over
  Response response = Response::pass_through;
  double restitution = 1.0;
  double resting_speed = 0.0;  ///< positive: bodies settle() with it instead of just bounce()
  double end_time = 1.0;
};

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
  Counters counters;
  double simulated_time = 0.0;
  double body_time = 0.0;          ///< sum over bodies of the time they were there
  std::uint64_t contact_hash = 0;  ///< of all events, in order; see EventHash
  std::optional<Memory> memory{};  ///< of the detector at the end, if it knows
};

/// Runs a scene under a detector that `make` creates: adds and removes bodies when their time comes, answers
/// contacts as the scene's response says. Errors: not_finite, time_backwards or out_of_range for times that
/// cannot be, for more bodies than the motion has and for turns of none; unsupported where bodies are to
/// bounce whose motion cannot be changed; those of the detector.
Result<SimulationResult> simulate(const Scene& scene, const DetectorMaker& make,
                                  const SimulationObserver& observer = {});

/// What simulate() gave when its detector was recorded (SimulationObserver::at_start and at_end), from the
/// recording alone. Errors: as Replay::open() and Replay::advance(), which is where it stops.
Result<SimulationResult> replay(std::span<const std::byte> recording);

/// A hash of events that any change of a bit in time, kind, ids or wall changes (64-bit FNV-1a).
class EventHash {
 public:
  void add(const Event& event);
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word);
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The parameters of the paper's experiments; scene files and the built-in scenes are made of these.
struct SceneParameters {
  std::string name = "custom";
  enum class MotionKind { random_forces, velocity_field, ballistic } motion = MotionKind::random_forces;
  std::uint32_t bodies = 1000;
  double radius_min = 0.1, radius_max = 10.0;
  double speed_min = 4.3301270189221932, speed_max = 43.301270189221931;  ///< 2.5 sqrt 3, 25 sqrt 3
  double limit_min = 10.0, limit_max = 20.0;                              ///< acceleration
  Vec3 gravity{};                                                         ///< planned acceleration
  Box box{{0, 0, 0}, {200, 200, 200}};
  /// In [0, 1). When positive, the box is made larger or smaller, in proportion and from its lower corner,
  /// until the bodies fill this part of it. Up to about 0.55 there is room for spheres of one size.
  double packing = 0.0;
  bool walls = true;
  /// Space repeats with the box on all three axes; there are no walls then, and the velocities at the start
  /// are changed by as much as makes the total momentum zero.
  bool periodic = false;
  double redraw_interval = 0.2;  ///< how long a random force lasts
  Response response = Response::bounce;
  double restitution = 1.0;
  /// Scene::resting_speed. When positive and too small for the contact tolerance, it is raised to
  /// least_resting_speed().
  double resting_speed = 0.0;
  double contact_tolerance = 1e-6;
  double zeno_interval = 0.0;  ///< WorldDefinition::zeno_interval
  double seconds = 15.0;
  std::uint64_t seed = 1;
};

/// Places the bodies without overlap and makes the scene. Errors: out_of_range naming the parameter, also
/// when so many bodies do not fit into the box.
Result<Scene> make_scene(const SceneParameters& parameters);

/// The built-in scenes, by name.
const std::vector<SceneParameters>& built_in_scenes();

}  // namespace kinesphere
