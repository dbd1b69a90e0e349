// Overlaps that the caller is about to make: bodies that certainly overlap by more than the tolerance now,
// wherever in their bounds they are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "engine/body_bounds.hpp"

namespace kinesphere {

class Overlaps {
 public:
  Overlaps(const Bodies& bodies, const BroadPhase& windows, double now)
      : bodies_(bodies), windows_(windows), now_(now) {}

  /// The first other body that certainly overlaps body `id` with this extent and definition, and may touch
  /// it. Cost: a search.
  std::optional<BodyId> of_body(BodyId id, const CollisionShape& extent,
                                const BodyDefinition& definition) const;
  std::optional<Wall> of_wall(const Bound& bound) const;
  /// The first of new bodies that certainly overlaps one before it, and may touch it: as the second of a
  /// pair, beside the first that it overlaps. Cost: a search for each.
  std::optional<std::pair<std::size_t, std::size_t>> first_among(std::span<const BodyDefinition> added) const;

 private:
  const Bodies& bodies_;
  const BroadPhase& windows_;
  double now_;
};

}  // namespace kinesphere
