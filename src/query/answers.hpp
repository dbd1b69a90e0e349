// Certified answers about the future, from stored certificates and present bounds.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "kinesphere/certificates.hpp"
#include "space/stretch_grid.hpp"

namespace kinesphere {

/// Earliest possible begin of a contact, or approach to a distance: it cannot happen before `time`.
struct ContactBoundary {
  double time = std::numeric_limits<double>::infinity();
  std::uint32_t body = 0;
  std::optional<std::uint32_t> partner{};
  Wall wall = Wall::none;
  /// Contact has begun or the distance is certainly reached; `time` is the present time.
  bool touching = false;

  bool exists() const { return partner || wall != Wall::none; }
};

/// Answers from the present state of the engine. Invalidated by any change of the engine.
class World::Engine::Answers {
 public:
  explicit Answers(const Engine& engine);

  ContactBoundary of_pair(std::uint32_t a, std::uint32_t b) const;
  ContactBoundary of_body(std::uint32_t number) const;
  ContactBoundary of_world() const;
  DistanceLimits distance(std::uint32_t a, std::uint32_t b, double time) const;
  /// Earliest time at which the surfaces of the two bodies may be within `distance` (length). Ignores
  /// filters.
  ContactBoundary approach_of_pair(std::uint32_t a, std::uint32_t b, double distance) const;
  /// Earliest time at which a wall, or another body that passes the filters, may be within `distance`
  /// (length) of the body.
  ContactBoundary approach_of_body(std::uint32_t number, double distance) const;

  /// Returns the bodies whose reports limit an answer: fresh ones give a later time.
  static std::vector<std::uint32_t> concerned(const ContactBoundary& boundary);

 private:
  const Body& body(std::uint32_t number) const { return engine_.bodies()[number]; }
  Bound present(std::uint32_t number) const;
  Bound guarded(std::uint32_t number) const;
  CollisionShape shape_of(std::uint32_t number, const Bound& bound) const;
  bool is_shape_at_rest(std::uint32_t number) const;
  double meeting(const CollisionShape& extent_of_a, const CollisionShape& extent_of_b) const;
  bool is_certified(std::uint32_t a, std::uint32_t b) const;
  double recorded(std::uint32_t a, std::uint32_t b) const;
  double recorded_of_walls(std::uint32_t number) const;
  void consider_touching(std::uint32_t number, ContactBoundary& first) const;
  void consider_walls(std::uint32_t number, ContactBoundary& first) const;
  void consider(std::uint32_t a, std::uint32_t b, ContactBoundary& first) const;
  void consider_approach(std::uint32_t a, std::uint32_t b, double distance, ContactBoundary& first) const;
  void consider_approach_to_walls(std::uint32_t number, double distance, ContactBoundary& first) const;
  void consider_due(std::uint32_t number, ContactBoundary& first) const;
  Stretch way_of(std::uint32_t number, double horizon) const;
  void consider_all_within(const std::vector<std::uint32_t>& numbers, ContactBoundary& first) const;

  const Engine& engine_;
  double now_;
  /// Pairs without a valid certificate: an event of the present time is pending, or has been delivered since
  /// the last recheck. A pair of a body with itself stands for its walls.
  std::set<std::pair<std::uint32_t, std::uint32_t>> open_;
};

}  // namespace kinesphere
