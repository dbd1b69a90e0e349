// What one rank has of the world: the engine's tables with its own bodies and copies of others nearby.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/roster.hpp"
#include "engine/island.hpp"
#include "engine/tables.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

struct LocalWorld {
  LocalWorld(const WorldDefinition& definition, int rank);
  LocalWorld(const LocalWorld&) = delete;
  LocalWorld& operator=(const LocalWorld&) = delete;

  double time() const { return everybody.time(); }
  Bodies& bodies() { return tables.bodies; }
  const Bodies& bodies() const { return tables.bodies; }
  std::uint32_t name_of(std::uint32_t number) const { return bodies().table().name_of(number); }
  /// Of a registered body: around its capsule.
  Box box_of(std::uint32_t number) const { return tables.windows.box_of(number, time()); }
  /// Around the way of a kicked body until its window ends.
  Box box_of(const BodyKick& kick) const;
  /// Where the body is; where space repeats, its image in the primary box.
  Vec3 centre_of(const Body& body) const {
    return bodies().space().wrapped(body.bound.centre_at(time())).position;
  }

  /// How many own bodies are in windows, and in windows that end.
  std::size_t own_registered() const;
  std::size_t own_moving() const;
  /// Own bodies that are registered and may come into one of the boxes before their windows end, in ascending
  /// order.
  std::vector<std::uint32_t> own_bodies_in(std::span<const Box> boxes) const;

  Tables tables;
  Island everybody;  ///< all bodies that the rank knows, on their way through time
  Roster roster;
};

}  // namespace kinesphere
