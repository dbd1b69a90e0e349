// Watches a pile of ballistic spheres from outside: exact least gaps of all neighbours between bounces, and
// how the heap comes to rest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::scene_tests {

/// The heap at one time.
struct PileFrame {
  double time;
  double kinetic_energy;  ///< per mass
  double mean_height;     ///< height of the centre of mass
};

/// Takes the events and frames of run_scene(). Paths between events are parabolas with a common acceleration,
/// so two bodies move on straight lines relative to each other, and a downward parabola is nearest to the
/// floor at an end: the least gaps are exact.
class PileWatch {
 public:
  explicit PileWatch(const Scene& scene)
      : scene_(scene), since_(scene.bodies.size(), scene.world.start_time), near_(scene.bodies.size()) {}

  DetectorMaker watching(const DetectorMaker& make) {
    return [this, make](const WorldDefinition& world, const Motion& motion) {
      motion_ = &motion;
      return make(world, motion);
    };
  }

  SceneObserver observer(double frame_interval) {
    SceneObserver observer;
    observer.frame_interval = frame_interval;
    observer.on_event = [this](const Event& event) {
      if (event.kind == EventKind::zeno_guard) ++guards_;
      finish(event.first.index, event.time);
      if (event.second != no_body) finish(event.second.index, event.time);
    };
    observer.on_frame = [this, frame_interval](const Detector&, const Motion&, double time) {
      for (std::uint32_t body = 0; body < since_.size(); ++body) finish(body, time);
      frames_.push_back(frame(time));
      find_neighbours(time, frame_interval);
    };
    return observer;
  }

  const std::vector<PileFrame>& frames() const { return frames_; }
  /// Returns the least gap of all pairs, and of bodies with walls, at any time. Unit: length.
  double least_gap() const { return least_gap_; }
  std::uint64_t guards() const { return guards_; }

 private:
  State state(std::uint32_t body, double time) const { return motion_->state(body, time); }

  /// Examines the body's path up to now, from its last event or that of the neighbour.
  void finish(std::uint32_t body, double now) {
    const State self = state(body, now);
    for (const std::uint32_t other : near_[body]) {
      const State its = state(other, now);
      const Vec3 apart = its.position - self.position;
      const Vec3 velocity = its.velocity - self.velocity;
      const double ago = dot(apart, velocity) / std::max(norm_squared(velocity), 1e-300);
      const double back = std::clamp(ago, 0.0, now - std::max(since_[body], since_[other]));
      note(norm(apart - velocity * back) - scene_.bodies[body].radius - scene_.bodies[other].radius);
    }
    const Vec3 below = self.position - scene_.world.box->lower;
    const Vec3 above = scene_.world.box->upper - self.position;
    note(std::min({below.x, below.y, below.z, above.x, above.y, above.z}) - scene_.bodies[body].radius);
    since_[body] = now;
  }

  void note(double gap) { least_gap_ = std::min(least_gap_, gap); }

  double mass(std::uint32_t body) const {
    const double radius = scene_.bodies[body].radius;
    return radius * radius * radius;
  }

  PileFrame frame(double time) const {
    double masses = 0.0, energy = 0.0, height = 0.0;
    for (std::uint32_t body = 0; body < since_.size(); ++body) {
      const State now = state(body, time);
      masses += mass(body);
      energy += 0.5 * mass(body) * norm_squared(now.velocity);
      height += mass(body) * now.position.z;
    }
    return {time, energy / masses, height / masses};
  }

  /// Finds all pairs that can touch within the next interval, in which bodies gain speed only by falling.
  void find_neighbours(double time, double interval) {
    double fastest = 0.0;
    std::vector<Vec3> at;
    for (std::uint32_t body = 0; body < since_.size(); ++body) {
      const State now = state(body, time);
      fastest = std::max(fastest, norm(now.velocity));
      at.push_back(now.position);
      near_[body].clear();
    }
    const double reach = 2.0 * interval * (2.0 * fastest + 10.0 * interval);
    for (std::uint32_t a = 0; a < since_.size(); ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        const double near = scene_.bodies[a].radius + scene_.bodies[b].radius + reach;
        if (norm_squared(at[a] - at[b]) > near * near) continue;
        near_[a].push_back(b);
        near_[b].push_back(a);
      }
    }
  }

  const Scene& scene_;
  const Motion* motion_ = nullptr;
  std::vector<double> since_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<PileFrame> frames_;
  double least_gap_ = std::numeric_limits<double>::infinity();
  std::uint64_t guards_ = 0;
};

}  // namespace kinesphere::scene_tests
