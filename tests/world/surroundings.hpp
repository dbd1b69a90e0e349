// A world with static bodies, for tests: distances by brute force, bounces, and a probe that must not be
// called for them.
#pragma once

#include <map>

#include "support/exact_shapes.hpp"
#include "support/playground.hpp"

namespace kinesphere {

/// Returns the distance from any shape, by the slow twin.
inline double distance(const Shape& shape, const Vec3& from) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>)
          return norm(from - solid.centre) - solid.radius;
        else
          return static_cast<double>(exact::distance(solid, exact::wide(from)));
      },
      shape);
}

/// A playground with a probe that fails the test if it is called for a static body.
class Surroundings : public Playground {
 public:
  explicit Surroundings(const WorldDefinition& definition = {}) : Playground(definition) {
    distort = [this](BodyId id, double, State&) {
      EXPECT_FALSE(fixed.contains(id)) << "the probe was asked about fixed " << id;
    };
  }

  BodyId place(const Shape& shape, const Filter& filter = {}) {
    const BodyId id = world.add_static({.shape = shape, .filter = filter}).value();
    // Fills the static body's index, as Playground::state requires.
    if (!fixed.contains(id)) fixed.emplace(id, shape);
    return id;
  }

  std::vector<BodyId> place_all(const std::vector<StaticDefinition>& bodies) {
    const auto ids = world.add_static_all(bodies).value();
    for (std::size_t k = 0; k < ids.size(); ++k) fixed.emplace(ids[k], bodies[k].shape);
    return ids;
  }

  /// Returns the gap, or for distant bodies a lower limit, which is cheaper.
  double gap_to(BodyId ball, BodyId shape) const {
    if (const auto* triangle = std::get_if<Triangle>(&fixed.at(shape))) {
      const double size = std::max(norm(triangle->b - triangle->a), norm(triangle->c - triangle->a));
      const double least = norm(state(ball).position - triangle->a) - size - radius(ball);
      if (least > 0.1) return least;
    }
    return distance(fixed.at(shape), state(ball).position) - radius(ball);
  }

  /// Throws the ball of a contact with a static body back without loss.
  void bounce(const Event& event) {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
    const Vec3 change = event.normal * event.approach_speed;
    const bool first_moves = !fixed.contains(event.first);
    const bool second_moves = event.second != no_body && !fixed.contains(event.second);
    const double part = first_moves && second_moves ? 1.0 : 2.0;
    if (first_moves) set_velocity(event.first, state(event.first).velocity - part * change);
    if (second_moves) set_velocity(event.second, state(event.second).velocity + part * change);
  }

  std::map<BodyId, Shape> fixed;
};

}  // namespace kinesphere
