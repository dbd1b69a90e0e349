// What one rank has of the world: the engine's tables with its own bodies and copies of others nearby.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/body_directory.hpp"
#include "engine/event_processor.hpp"
#include "engine/world_state.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

struct RankState {
  RankState(const WorldDefinition& definition, int rank);
  RankState(const RankState&) = delete;
  RankState& operator=(const RankState&) = delete;

  double time() const { return main.time(); }
  Bodies& bodies() { return state.bodies; }
  const Bodies& bodies() const { return state.bodies; }
  std::uint32_t name_of(std::uint32_t number) const { return bodies().table().name_of(number); }
  /// Of a registered body: around its capsule.
  Box box_of(std::uint32_t number) const { return state.broad_phase.box_of(number, time()); }
  /// Around the way of a kicked body until its window ends.
  Box box_of(const SweptSphereUpdate& update) const;
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

  WorldState state;
  EventProcessor main;  ///< all bodies that the rank knows, on their way through time
  BodyDirectory directory;
};

}  // namespace kinesphere
