#include "processor/overlaps.hpp"

#include <algorithm>
#include <tuple>

#include "processor/bodies_in.hpp"

namespace kinesphere {
namespace {

/// Returns true if the two overlap wherever they are in their bounds.
bool certainly_overlap(const Bodies& bodies, double now, const CollisionShape& a, const CollisionShape& b) {
  return gap_at(bodies, now, a, b).upper < -bodies.definition().contact_tolerance;
}

}  // namespace

std::optional<Wall> Overlaps::of_wall(const CollisionShape& shape, const Filter& filter) const {
  if (!bodies_.walls() || !meets_walls(bodies_.definition(), filter)) return std::nullopt;
  for (const Wall wall : walls)
    if (stands(*bodies_.walls(), wall) && gap_to_wall(shape, half_space(*bodies_.walls(), wall), now_).upper <
                                              -bodies_.definition().contact_tolerance)
      return wall;
  return std::nullopt;
}

std::optional<BodyId> Overlaps::of_body(BodyId id, const CollisionShape& shape,
                                        const BodyDefinition& definition) const {
  std::optional<BodyId> found;
  const Box box = box_now(bodies_, shape, now_);
  for (const std::uint32_t other : registered_in(box, state_)) {
    const Body& body = bodies_[other];
    const CollisionShape partner = collision_shape_of(bodies_, other);
    const bool certain =
        other != id.index && !(shape.is_static && body.is_static()) &&
        body.has_parts() == (partner.rigid != nullptr) && certainly_overlap(bodies_, now_, shape, partner) &&
        bodies_.filters.may_touch(id, definition, bodies_.id_of(other), bodies_.definition_of(other));
    if (certain && (!found || other < found->index)) found = bodies_.id_of(other);
  }
  return found;
}

/// Returns the new bodies that may touch anything as balls at rest, numbered by their places, in all images
/// that reach into the primary box. Two that overlap beyond a border do so in two of these images: on each
/// axis, one of them reaches over the border.
std::vector<Stretch> Overlaps::balls_of(std::span<const BodyDefinition> added) const {
  std::vector<Stretch> balls;
  balls.reserve(added.size());
  for (std::uint32_t number = 0; number < added.size(); ++number) {
    if (!added[number].solid) continue;
    const Bound bound = bound_now(added[number], now_);
    const Vec3 centre = bound.centre_at(now_), half{bound.radius, bound.radius, bound.radius};
    bodies_.space().for_each_image(
        {centre - half, centre + half}, 0.0, now_, [&](const Box&, const Vec3& shift) {
          balls.push_back({.number = number, .middle = centre + shift, .radius = bound.radius});
        });
  }
  return balls;
}

std::optional<std::pair<std::size_t, std::size_t>> Overlaps::first_among(
    std::span<const BodyDefinition> added) const {
  StretchGrid grid;
  grid.fill(balls_of(added));
  std::optional<std::pair<std::size_t, std::size_t>> least;
  const auto look_at = [&](std::uint32_t a, std::uint32_t b) {
    const auto [first, second] = std::minmax({a, b});
    if (first == second) return;
    if (least && std::tie(least->second, least->first) <= std::tie(second, first)) return;
    if (certainly_overlap(bodies_, now_, {bound_now(added[first], now_)}, {bound_now(added[second], now_)}) &&
        bodies_.filters.may_touch(bodies_.table().next_id(first), added[first],
                                  bodies_.table().next_id(second), added[second]))
      least = {first, second};
  };
  for (std::uint32_t slot = 0; slot < grid.slots(); ++slot) {
    const std::uint32_t number = grid.number_at(slot);
    // Of a crowd, most bodies come after its first pair, and are not searched for.
    if (least && number > least->second) continue;
    for (const std::uint32_t other : grid.search_behind(slot)) look_at(number, grid.number_at(other));
  }
  return least;
}

}  // namespace kinesphere
