// Approaches by a cylinder against dense samples, with candidates from the engine's spheres.
#include "simulation/tracks/cylinder_approaches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinesphere/random.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::cylinder_approaches_test {
namespace {

/// Returns the approaches of spheres around the cylinder, in stretched space.
std::vector<Approach> enclosing(std::vector<Track> tracks, const CylinderLimits& limits,
                                Interpolation interpolation) {
  const CylinderEnclosure enclosure = enclosure_of(limits);
  for (Track& track : tracks)
    for (TrackSample& sample : track) sample.position.z *= enclosure.stretch;
  auto scene = scene_of_tracks(tracks, 1.001 * enclosure.distance, interpolation);
  scene->world.contact_tolerance = 1e-6;
  scene->world.contacts = ContactEvents::begin_and_end;
  std::vector<Event> events;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  EXPECT_TRUE(run_scene(*scene, make_world_detector, observer));
  return approaches_in(*scene, events);
}

TEST(CylinderApproaches, EnclosuresAreClose) {
  for (const double ratio : {0.01, 0.3, 0.7, 1.0, 1.5, 30.4, 1000.0}) {
    const CylinderEnclosure enclosure = enclosure_of({ratio, 1.0, 1e-6});
    EXPECT_LE(enclosure.distance, 1.7321 * ratio);
    EXPECT_GE(enclosure.distance, std::hypot(ratio, enclosure.stretch) * (1 - 1e-15));
  }
}

TEST(CylinderApproaches, AreThoseOfDenseSamples) {
  constexpr std::uint64_t seed = 4201;
  Random random(seed);
  constexpr int bodies = 12, steps = 8000;
  constexpr double duration = 10.0;
  std::size_t found = 0;
  for (const double vertical : {0.1, 0.5, 4.0}) {
    for (const Interpolation interpolation : {Interpolation::spline, Interpolation::linear}) {
      const CylinderLimits limits{.horizontal = 1.0, .vertical = vertical, .tolerance = 1e-6};
      std::vector<Track> tracks(bodies);
      for (Track& track : tracks)
        for (int k = 0; k <= 10; ++k)
          track.push_back({k * duration / 10,
                           {random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4 * vertical)}});
      const auto scene = scene_of_tracks(tracks, 1.0, interpolation);
      const Motion& motion = *scene->motion;
      const auto candidates = enclosing(tracks, limits, interpolation);
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Approach>> all;
      for (const Approach& approach : approaches_within(limits, motion, candidates)) {
        EXPECT_LE(approach.begin, approach.end);
        all[std::minmax(approach.first, approach.second)].push_back(approach);
        ++found;
      }
      std::vector<Trajectory> curves;
      for (std::uint32_t body = 0; body < bodies; ++body)
        curves.push_back(motion.trajectory(body, 0.0, duration));
      // A sample inside lies in an approach, and one in an approach is not outside by more than the
      // tolerance.
      const auto at = [&](std::uint32_t body, double time) {
        const Trajectory& curve = curves[body];
        const auto after = std::upper_bound(curve.begin(), curve.end(), time,
                                            [](double t, const Segment& piece) { return t < piece.begin; });
        return (after - 1)->state_at(time).position;
      };
      for (int k = 0; k <= steps; ++k) {
        const double time = duration * k / steps;
        for (std::uint32_t a = 0; a < bodies; ++a)
          for (std::uint32_t b = a + 1; b < bodies; ++b) {
            const Vec3 way = at(b, time) - at(a, time);
            const double level = std::hypot(way.x, way.y) - limits.horizontal;
            const double upright = (std::abs(way.z) - vertical) / vertical;
            const auto& known = all[{a, b}];
            const bool holds = std::any_of(known.begin(), known.end(), [time](const Approach& approach) {
              return approach.begin <= time && time <= approach.end;
            });
            const double outside = std::max(level, upright);
            if (holds ? outside > 1.001e-6 : outside < -1e-12)
              FAIL() << a << " and " << b << " at " << time << ": " << outside << ", seed " << seed;
          }
      }
    }
  }
  EXPECT_GT(found, 500u);
}

}  // namespace
}  // namespace kinesphere::cylinder_approaches_test
