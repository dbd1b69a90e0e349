// Overlaps finds overlaps that a change by the caller would cause: two bodies that overlap by more than the
// contact tolerance now, wherever they are in their bounds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bodies/body_bounds.hpp"
#include "processor/world_state.hpp"
#include "space/stretch_grid.hpp"

namespace kinesphere {

class Overlaps {
 public:
  Overlaps(const WorldState& state, double now) : state_(state), bodies_(state.bodies), now_(now) {}

  /// Returns the first other body, in the order of id indices, that certainly overlaps body `id` with this
  /// shape and definition and may touch it. Cost: one search.
  std::optional<BodyId> of_body(BodyId id, const CollisionShape& shape,
                                const BodyDefinition& definition) const;
  /// Returns the first wall that a body with this shape and filter certainly overlaps and may touch.
  std::optional<Wall> of_wall(const CollisionShape& shape, const Filter& filter) const;
  /// Returns the first new body that certainly overlaps an earlier new body and may touch it. The result is a
  /// pair of indices: the first body that it overlaps, then the body itself. Cost: O(n), and one step for
  /// each pair of solid bodies that touch before the pair is found.
  std::optional<std::pair<std::size_t, std::size_t>> first_among(std::span<const BodyDefinition> added) const;

 private:
  std::vector<Stretch> balls_of(std::span<const BodyDefinition> added) const;

  const WorldState& state_;
  const Bodies& bodies_;
  double now_;
};

}  // namespace kinesphere
