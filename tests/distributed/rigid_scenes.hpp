// Scenes of rigid bodies that fly freely and bounce: capsules, clusters of balls, hulls, and all of these
// among balls.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "distributed/one_world.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere {

enum class RigidKind { capsules, clusters, hulls, mixed };

struct RigidSceneParameters {
  RigidKind kind = RigidKind::mixed;
  std::uint64_t seed = 1;
  int side = 5;          ///< of the lattice on which bodies start, in bodies
  int length = side;     ///< of the lattice along x
  double spacing = 2.2;  ///< of the lattice; the balls around bodies have radii of at most 1
  double largest_spin = 3.0;
  double acceleration_limit = 0.0;
  double speed = 3.0;
  double seconds = 2.0;
  bool is_periodic = false;
  bool has_walls = true;
  /// Bodies with larger x at the start are balls.
  double rigid_below = 1e9;
};

/// Returns parts whose points are within 1 of the origin.
inline std::vector<RigidPart> parts_of(RigidKind kind, Random& random) {
  switch (kind) {
    case RigidKind::capsules: {
      const Vec3 end = 0.7 * random.unit_vector();
      return {RigidPart{-1.0 * end, end, random.uniform(0.1, 0.3)}};
    }
    case RigidKind::clusters: {
      std::vector<RigidPart> parts;
      for (auto left = 2 + random.bits() % 6; left > 0; --left) {
        const Vec3 place = 0.65 * random.point_in_ball();
        parts.push_back({place, place, random.uniform(0.15, 0.35)});
      }
      return parts;
    }
    case RigidKind::hulls: {
      const Vec3 corner{random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)};
      if (random.bits() % 2 == 0) return {box_part({-1.0 * corner, corner}, 0.05)};
      std::vector<Vec3> points;
      for (int k = 0; k < 7; ++k) points.push_back(0.9 * random.point_in_ball());
      return {hull_part(points, 0.05)};
    }
    case RigidKind::mixed:
      return parts_of(static_cast<RigidKind>(random.bits() % 3), random);
  }
  return {};
}

inline Setting rigid_setting(const RigidSceneParameters& parameters) {
  const int side = parameters.side;
  const int length = parameters.length;
  const int count = length * side * side;
  Random random(parameters.seed);
  RandomForcesDefinition forces{.interval = 0.25, .seed = parameters.seed};
  Setting setting;
  Scene& scene = setting.scene;
  const double width = parameters.spacing * side;
  if (parameters.has_walls || parameters.is_periodic)
    scene.world.box = Box{{-0.5, -0.5, -0.5}, {parameters.spacing * length + 0.5, width + 0.5, width + 0.5}};
  if (parameters.is_periodic) scene.world.periodic = {true, true, true};
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
    // Numbers unrelated to places.
    const int place = 47 * static_cast<int>(k) % count;
    const Vec3 cell{place % length + 0.5, place / length % side + 0.5, place / (length * side) + 0.5};
    forces.start.push_back({parameters.spacing * cell, parameters.speed * random.point_in_ball()});
    forces.acceleration_limits.push_back(parameters.acceleration_limit);
    scene.bodies.push_back({.radius = random.uniform(0.4, 0.8)});
    const bool is_ball = (parameters.kind == RigidKind::mixed && random.bits() % 4 == 0) ||
                         parameters.spacing * cell.x > parameters.rigid_below;
    if (is_ball) continue;
    const Vec3 inertia{random.uniform(0.02, 0.2), random.uniform(0.02, 0.2), random.uniform(0.02, 0.2)};
    setting.rigid[k] = {.parts = parts_of(parameters.kind, random),
                        .rotation = {rotation_by(3.0 * random.point_in_ball()),
                                     parameters.largest_spin * random.point_in_ball()},
                        .inertia = inertia};
  }
  scene.motion = RandomForces::create(forces).value().clone();
  scene.response = SceneResponse::bounce;
  scene.end_time = parameters.seconds;
  return setting;
}

/// Every fourth body becomes a plate or a triangle of about this size.
inline void add_shapes(Setting& setting, double size) {
  for (std::uint32_t k = 0; k < setting.scene.bodies.size(); k += 4) {
    setting.rigid.erase(k);
    if (k % 8 == 0)
      setting.shapes[k] = Box{{-size, -0.5 * size, -0.1}, {size, 0.5 * size, 0.1}};
    else
      setting.shapes[k] = Triangle{{-size, 0, 0}, {size, 0, 0.3}, {0.2, 0.5 * size, 0}};
  }
}

}  // namespace kinesphere
