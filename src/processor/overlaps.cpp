#include "processor/overlaps.hpp"

#include <algorithm>
#include <tuple>

#include "broadphase/neighbour_search.hpp"
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
  for (const std::uint32_t other : registered_in(box, state_, now_)) {
    const Body& body = bodies_[other];
    const CollisionShape partner = collision_shape_of(bodies_, other);
    const bool certain =
        other != id.index && !(shape.is_static && body.is_static()) &&
        body.is_rigid == (partner.rigid != nullptr) && certainly_overlap(bodies_, now_, shape, partner) &&
        bodies_.filters.may_touch(id, definition, bodies_.id_of(other), bodies_.definition_of(other));
    if (certain && (!found || other < found->index)) found = bodies_.id_of(other);
  }
  return found;
}

std::optional<std::pair<std::size_t, std::size_t>> Overlaps::first_among(
    std::span<const BodyDefinition> added) const {
  const auto ball_of = [&](std::uint32_t number) {
    const Bound bound = bound_now(added[number], now_);
    const Vec3 centre = bodies_.space().wrapped(bound.centre_at(now_)).position;
    const Bound ball{.time = now_, .position = centre, .radius = bound.radius};
    return InflatedBound{BoundAt(ball, now_), bodies_.definition().contact_tolerance};
  };
  BroadPhase windows(bodies_.space());
  std::vector<BroadPhase::Starter> starters;
  starters.reserve(added.size());
  for (std::uint32_t number = 0; number < added.size(); ++number)
    starters.push_back(
        {number, SizeClasses::size_class_of(ball_of(number), Window::endless()), Window::endless()});
  PoolLease alone;
  windows.start(starters, now_, ball_of, alone);
  std::optional<std::pair<std::size_t, std::size_t>> least;
  NeighbourSearch search;
  for (const auto& [a, b] : search.near_started(windows, 0, windows.started_slots(), now_, ball_of)) {
    const auto [first, second] = std::minmax({a, b});
    if (least && std::tie(least->second, least->first) <= std::tie(second, first)) continue;
    if (certainly_overlap(bodies_, now_, {bound_now(added[first], now_)}, {bound_now(added[second], now_)}) &&
        bodies_.filters.may_touch(bodies_.table().next_id(first), added[first],
                                  bodies_.table().next_id(second), added[second]))
      least = {first, second};
  }
  return least;
}

}  // namespace kinesphere
