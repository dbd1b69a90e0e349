// Bodies on straight paths in a periodic box, and their true contacts over all images.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/playground.hpp"

namespace kinesphere {

/// The form of positions in reports.
enum class Reports { unwrapped, wrapped, any_image };

struct PeriodicCrowd {
  std::size_t bodies = 0;
  double least_radius = 0.0;
  double largest_radius = 0.0;
  double speed = 1.0;
};

struct PeriodicKind {
  std::string name;
  Box box{};
  Axes periodic{true, true, true};
  int dimensions = 3;
  PeriodicCrowd crowd{};
  double duration = 5.0;
  Reports reports = Reports::unwrapped;
  /// Radius of the first body; 0 leaves it random.
  double first_radius = 0.0;
  std::uint64_t seed = 1;
};

inline std::ostream& operator<<(std::ostream& out, const PeriodicKind& kind) { return out << kind.name; }

/// A time span in which the true gap is below zero.
struct Overlap {
  double begin;
  double end;
  double depth;  ///< the largest
};

class PeriodicWorld : public Playground {
 public:
  static constexpr double eps = 1e-6;

  explicit PeriodicWorld(const PeriodicKind& its_kind, const WorldDefinition& more = {})
      : Playground(definition_of(its_kind, more)), kind(its_kind), random(its_kind.seed) {
    for (int axis = 0; axis < 3; ++axis)
      if (kind.periodic[axis]) period[axis] = kind.box.upper[axis] - kind.box.lower[axis];
    distort = [this](BodyId, double, State& state) { state.position = reported(state.position); };
    const PeriodicCrowd& crowd = kind.crowd;
    for (std::size_t k = 0; k < crowd.bodies; ++k) {
      double radius = crowd.least_radius + (crowd.largest_radius - crowd.least_radius) * random.uniform();
      if (k == 0 && kind.first_radius > 0.0) radius = kind.first_radius;
      const Vec3 velocity = crowd.speed * flat(random.point_in_ball());
      // The limit is larger than the true acceleration, so that the body has to be probed again and again.
      const double limit = random.uniform() < 0.3 ? 0.0 : 0.3 * crowd.speed * random.uniform();
      ids.push_back(
          add({.radius = radius, .acceleration_limit = limit, .position = any_point(), .velocity = velocity},
              Vec3{}));
    }
  }

  static WorldDefinition definition_of(const PeriodicKind& kind, WorldDefinition definition) {
    definition.box = kind.box;
    definition.periodic = kind.periodic;
    definition.dimensions = kind.dimensions;
    definition.contact_tolerance = eps;
    return definition;
  }

  Vec3 flat(Vec3 v) const {
    if (kind.dimensions == 2) v.z = 0.0;
    return v;
  }
  Vec3 any_point() {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = kind.box.lower[axis] + (kind.box.upper[axis] - kind.box.lower[axis]) * random.uniform();
    return flat(point);
  }

  /// Returns a position in the form of the reports.
  Vec3 reported(Vec3 position) {
    for (int axis = 0; axis < 3; ++axis) {
      if (period[axis] == 0.0 || kind.reports == Reports::unwrapped) continue;
      position[axis] -= std::floor((position[axis] - kind.box.lower[axis]) / period[axis]) * period[axis];
      if (kind.reports == Reports::any_image)
        position[axis] += (std::floor(7.0 * random.uniform()) - 3.0) * period[axis];
    }
    return position;
  }

  /// Returns the way from one point to the nearest image of another.
  Vec3 shortest(Vec3 way) const {
    for (int axis = 0; axis < 3; ++axis)
      if (period[axis] > 0.0) way[axis] -= std::round(way[axis] / period[axis]) * period[axis];
    return way;
  }

  /// Returns the gap of the true surfaces, in the nearest image.
  double true_gap(BodyId a, BodyId b, double t) const {
    return norm(shortest(state(a, t).position - state(b, t).position)) - radius(a) - radius(b);
  }

  /// Returns the overlaps from now until a time, for straight paths, by brute force over all images that come
  /// near.
  std::vector<Overlap> overlaps(BodyId a, BodyId b, double until) const {
    const double now = world.time();
    const Vec3 offset = state(a, now).position - state(b, now).position;
    const Vec3 velocity = state(a, now).velocity - state(b, now).velocity;
    const double reach = radius(a) + radius(b);
    std::array<int, 3> first{}, last{};
    for (int axis = 0; axis < 3; ++axis) {
      if (period[axis] == 0.0) continue;
      const double there = offset[axis] + velocity[axis] * (until - now);
      const auto k = static_cast<std::size_t>(axis);
      first[k] = static_cast<int>(std::floor((std::min(offset[axis], there) - reach) / period[axis]));
      last[k] = static_cast<int>(std::ceil((std::max(offset[axis], there) + reach) / period[axis]));
    }
    std::vector<Overlap> found;
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int z = first[2]; z <= last[2]; ++z) {
          const Vec3 p = offset - Vec3{x * period.x, y * period.y, z * period.z};
          const double v2 = norm_squared(velocity);
          const double nearest = std::max(0.0, -dot(p, velocity) / v2);
          const double least = norm(p + velocity * nearest);
          if (least >= reach) continue;
          const double middle = -dot(p, velocity) / v2;
          const double half =
              std::sqrt(std::max(0.0, middle * middle - (norm_squared(p) - reach * reach) / v2));
          if (middle + half < 0.0) continue;
          const Overlap overlap{now + std::max(0.0, middle - half), now + middle + half, reach - least};
          if (overlap.begin <= until) found.push_back(overlap);
        }
    std::sort(found.begin(), found.end(),
              [](const Overlap& s, const Overlap& t) { return s.begin < t.begin; });
    return found;
  }

  /// Returns the position that the world keeps, on the path since the body was placed.
  Vec3 path_position(BodyId id) const {
    const BodyView view = world.body(id).value();
    Vec3 position = view.definition.position;
    for (int axis = 0; axis < 3; ++axis)
      position[axis] += static_cast<double>(view.image[static_cast<std::size_t>(axis)]) * period[axis];
    return position;
  }

  void check_image(BodyId id) const {
    const BodyView view = world.body(id).value();
    const Vec3 path = state(id, view.bound.time).position;
    EXPECT_NEAR(norm(path_position(id) - path), 0.0, 1e-9 * (1.0 + norm(path)))
        << id << " at " << world.time();
    for (int axis = 0; axis < 3; ++axis) {
      if (period[axis] == 0.0) continue;
      EXPECT_GE(view.definition.position[axis], kind.box.lower[axis]);
      EXPECT_LT(view.definition.position[axis], kind.box.upper[axis]);
    }
    EXPECT_EQ(view.definition.position, view.bound.position);
  }

  /// Expects that an event is consistent and true.
  void check_event(const Event& event) const {
    if (event.second == no_body) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (period[axis] == 0.0) continue;
      EXPECT_GE(event.first_state.position[axis], kind.box.lower[axis]) << event;
      EXPECT_LT(event.first_state.position[axis], kind.box.upper[axis]) << event;
    }
    const Vec3 way = event.second_state.position - event.first_state.position;
    EXPECT_NEAR(norm(way) - radius(event.first) - radius(event.second), event.gap, 1e-9) << event;
    EXPECT_NEAR(dot(event.normal, way), norm(way), 1e-9) << event;
    const double middle = radius(event.first) + 0.5 * event.gap;
    EXPECT_NEAR(norm(event.first_state.position + event.normal * middle - event.point), 0.0, 1e-9) << event;
    for (const auto& [id, told_state] :
         {std::pair(event.first, event.first_state), std::pair(event.second, event.second_state)})
      EXPECT_NEAR(norm(shortest(told_state.position - state(id, event.time).position)), 0.0, 1e-9) << event;
  }

  PeriodicKind kind;
  Random random;
  Vec3 period{};
  std::vector<BodyId> ids;
};

}  // namespace kinesphere
