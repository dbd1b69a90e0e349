// Runs a scene under a detector.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "input/input_check.hpp"
#include "kinesphere/event_hash.hpp"
#include "number/infinity.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/run/scene_answer.hpp"
#include "simulation/scene/scene.hpp"
#include "simulation/scene/scene_check.hpp"

namespace kinesphere {
namespace {

class SceneRun {
 public:
  SceneRun(const Scene& scene, Motion& motion, Detector& detector, const SceneObserver& observer,
           Workers* workers)
      : scene_(scene), motion_(motion), detector_(detector), observer_(observer), workers_(workers) {
    for (std::uint32_t number = 0; number < scene.bodies.size(); ++number) {
      const SceneBody& body = scene.bodies[number];
      if (body.appears > scene.end_time || body.vanishes <= scene.world.start_time) continue;
      changes_.push_back({std::max(body.appears, scene.world.start_time), Change::appears, number, nullptr});
      if (body.vanishes <= scene.end_time)
        changes_.push_back({body.vanishes, Change::vanishes, number, nullptr});
      result_.body_time +=
          std::min(body.vanishes, scene.end_time) - std::max(body.appears, scene.world.start_time);
    }
    for (const SceneTurn& turn : scene.turns) {
      const SceneBody& body = scene.bodies[turn.body];
      if (std::max(body.appears, scene.world.start_time) < turn.time && turn.time < body.vanishes &&
          turn.time < scene.end_time)
        changes_.push_back({turn.time, Change::turns, turn.body, &turn});
    }
    // At one time, bodies that vanish make room before others appear.
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
      return std::tie(a.time, b.kind, a.body) < std::tie(b.time, a.kind, b.body);
    });
  }

  Result<SceneResult> run() {
    const double start = scene_.world.start_time;
    std::uint64_t frame = 0;
    double last_frame = -infinity;
    std::size_t change = 0;
    for (;;) {
      const double frame_time = observer_.frame_interval < infinity
                                    ? start + static_cast<double>(frame) * observer_.frame_interval
                                    : infinity;
      const double change_time = change < changes_.size() ? changes_[change].time : infinity;
      const double stop = std::min({frame_time, change_time, scene_.end_time});
      if (auto advanced = advance_to(stop); !advanced) return advanced.error();
      for (; change < changes_.size() && changes_[change].time <= stop; ++change) {
        if (auto applied = apply(changes_[change]); !applied) return applied.error();
      }
      if (frame_time <= stop) {
        if (auto advanced = advance_to(stop); !advanced) return advanced.error();
        show(stop);
        last_frame = stop;
        ++frame;
      }
      if (stop >= scene_.end_time) break;
    }
    // Contacts of bodies that vanish at the very end still report their end.
    if (auto advanced = advance_to(scene_.end_time); !advanced) return advanced.error();
    if (last_frame != scene_.end_time) show(scene_.end_time);
    result_.counters = detector_.counters();
    result_.memory = detector_.memory();
    result_.simulated_time = scene_.end_time - start;
    result_.contact_hash = hash_.value();
    return result_;
  }

 private:
  struct Change {
    enum Kind { appears, vanishes, turns };
    double time;
    Kind kind;
    std::uint32_t body;
    const SceneTurn* turn;  ///< the turn, if the kind is `turns`
  };

  Result<void> advance_to(double time) {
    if (workers_) return run_to(time);
    for (;;) {
      if (observer_.between_events) observer_.between_events(detector_);
      auto event = detector_.advance(time);
      if (!event) return event.error();
      if (!*event) return {};
      report(**event);
      const Response answered = scene_answer(scene_, **event);
      const Event& at = **event;
      auto changed = set_velocity(at.first, at.time, answered.first_velocity);
      if (changed) changed = set_velocity(at.second, at.time, answered.second_velocity);
      if (!changed) return changed;
    }
  }

  Result<void> run_to(double time) try {
    if (observer_.between_events) observer_.between_events(detector_);
    return detector_.run(
        time, motion_, [this](const Event& event) { return scene_answer(scene_, event); },
        [this](const Event& event) {
          report(event);
          if (observer_.between_events) observer_.between_events(detector_);
        },
        *workers_);
  } catch (const BadResult& thrown) {
    return named(thrown.error());
  }

  void report(const Event& event) {
    hash_.add(event);
    if (observer_.on_event) observer_.on_event(event);
  }

  void show(double time) {
    if (observer_.on_frame) observer_.on_frame(detector_, motion_, time);
  }

  Result<void> apply(const Change& change) {
    if (change.kind == Change::vanishes) return detector_.remove(change.body);
    if (change.kind == Change::turns) {
      if (auto turned = motion_.set_velocity(change.body, change.time, change.turn->velocity); !turned)
        return turned;
      return detector_.set_velocity(change.body, change.turn->velocity);
    }
    BodyDefinition definition = motion_.definition(change.body, change.time);
    definition.radius = scene_.bodies[change.body].radius;
    return detector_.add(change.body, definition);
  }

  Result<void> set_velocity(BodyId body, double time, const std::optional<Vec3>& velocity) {
    if (!velocity) return {};
    if (auto turned = motion_.set_velocity(body.index, time, *velocity); !turned)
      return named(turned.error());
    return detector_.set_velocity(body.index, *velocity);
  }

  /// Returns an error of a motion in the terms of the scene.
  static Error named(const Error& error) {
    if (error.code != ErrorCode::unsupported) return error;
    return {ErrorCode::unsupported, "response", error.body,
            "simulate: response bounce needs a motion that can be kicked, and this one cannot"};
  }

  const Scene& scene_;
  Motion& motion_;
  Detector& detector_;
  const SceneObserver& observer_;
  Workers* workers_;
  std::vector<Change> changes_;
  EventHash hash_;
  SceneResult result_;
};

}  // namespace

Result<SceneResult> run_scene(const Scene& scene, const DetectorMaker& make, const SceneObserver& observer,
                              Workers* workers) {
  if (auto valid = check_times(scene, "simulate"); !valid) return valid.error();
  if (auto valid = InputCheck("simulate")
                       .require(observer.frame_interval > 0.0, ErrorCode::out_of_range, {"frame_interval"},
                                "must be larger than 0", observer.frame_interval)
                       .result();
      !valid) {
    return valid.error();
  }
  const std::unique_ptr<Motion> motion = scene.motion->clone();
  auto detector = make(scene.world, *motion);
  if (!detector) return detector.error();
  if (observer.at_start) {
    if (auto started = observer.at_start(**detector); !started) return started.error();
  }
  auto result = SceneRun(scene, *motion, **detector, observer, workers).run();
  if (result && observer.at_end) {
    if (auto ended = observer.at_end(**detector); !ended) return ended.error();
  }
  return result;
}

}  // namespace kinesphere
