// Overlaps that the caller is about to make.
#include <algorithm>
#include <tuple>

#include "engine/engine.hpp"
#include "engine/fixed.hpp"

namespace kinesphere {
namespace {

/// Wherever in their bounds the two are.
bool certainly_overlap(const Bodies& bodies, double now, const Extent& a, const Extent& b) {
  return gap_at(bodies, now, a, b).upper < -bodies.definition().contact_tolerance;
}

}  // namespace

Bound World::Engine::bound_now(const BodyDefinition& body) const {
  return bound_of(body, {body.position, body.velocity}, time());
}

Bound World::Engine::bound_with(BodyId id, const BodyDefinition& changed) const {
  const Body& body = bodies()[id.index];
  if (body.fresh(time())) return bound_of(changed, {body.bound.position, body.bound.velocity}, time());
  // The old promise held until now, and the next report comes before time moves on.
  Bound bound = body.bound;
  bound.radius = changed.radius + (bound.radius - body.radius);
  return bound;
}

std::optional<Wall> World::Engine::certain_overlap_of_wall(const Bound& bound) const {
  if (!bodies().walls()) return std::nullopt;
  for (const Wall wall : walls)
    if (stands(*bodies().walls(), wall) &&
        gap_limits(bound, half_space(*bodies().walls(), wall), time()).upper <
            -definition().contact_tolerance)
      return wall;
  return std::nullopt;
}

std::optional<BodyId> World::Engine::certain_overlap(BodyId id, const Extent& extent,
                                                     const BodyDefinition& definition) const {
  std::optional<BodyId> found;
  const Box box = box_now(bodies(), extent, time());
  NeighbourSearch search;
  for (const std::uint32_t other : search.in_box(windows(), box, time())) {
    const Body& body = bodies()[other];
    const bool certain =
        other != id.index && !(extent.fixed && body.is_fixed()) &&
        certainly_overlap(bodies(), time(), extent, extent_of(bodies(), other)) &&
        bodies().filters.may_touch(id, definition, bodies().id_of(other), bodies().definition_of(other));
    if (certain && (!found || other < found->index)) found = bodies().id_of(other);
  }
  return found;
}

std::optional<std::pair<std::size_t, std::size_t>> World::Engine::first_overlap(
    std::span<const BodyDefinition> added) const {
  const auto ball_of = [&](std::uint32_t number) {
    const Bound bound = bound_now(added[number]);
    const Vec3 centre = bodies().space().wrapped(bound.centre_at(time())).position;
    const Bound ball{.time = time(), .position = centre, .radius = bound.radius};
    return RoomyBound{MovedBound(ball, time()), definition().contact_tolerance};
  };
  Windows windows(bodies().space());
  std::vector<Windows::Starter> starters;
  starters.reserve(added.size());
  for (std::uint32_t number = 0; number < added.size(); ++number)
    starters.push_back({number, SizeLevels::level_of(ball_of(number), Window::endless()), Window::endless()});
  Shift alone;
  windows.start(starters, time(), ball_of, alone);
  std::optional<std::pair<std::size_t, std::size_t>> least;
  NeighbourSearch search;
  for (const auto& [a, b] : search.near_started(windows, 0, windows.started(), time(), ball_of)) {
    const auto [first, second] = std::minmax({a, b});
    if (least && std::tie(least->second, least->first) <= std::tie(second, first)) continue;
    if (certainly_overlap(bodies(), time(), {bound_now(added[first])}, {bound_now(added[second])}) &&
        bodies().filters.may_touch(bodies().table().next_id(first), added[first],
                                   bodies().table().next_id(second), added[second]))
      least = {first, second};
  }
  return least;
}

}  // namespace kinesphere
