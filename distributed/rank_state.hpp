// RankState holds the engine state of one rank: its own bodies and ghosts of bodies nearby.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/body_directory.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"
#include "processor/event_processor.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

struct RankState {
  RankState(const WorldDefinition& definition, int rank);
  RankState(const RankState&) = delete;
  RankState& operator=(const RankState&) = delete;

  double time() const { return main.time(); }
  Bodies& bodies() { return state.bodies; }
  const Bodies& bodies() const { return state.bodies; }
  std::uint32_t name_of(std::uint32_t number) const { return bodies().table().name_of(number); }
  /// Box around the body's swept sphere. Precondition: the body is registered in the broad phase.
  Box box_of(std::uint32_t number) const { return state.broad_phase.box_of(number, time()); }
  /// Box around the swept sphere of an updated body until its window ends; if the window never ends, the box
  /// at the time of the update.
  Box box_of(const SweptSphereUpdate& update) const;
  /// Position of the body now; in periodic space, its image in the primary box.
  Vec3 centre_of(const Body& body) const {
    return bodies().space().wrapped(body.bound.centre_at(time())).position;
  }

  /// Number of own bodies that have a window, and of those whose window end is finite. Cost: O(ghosts).
  std::size_t own_registered() const;
  std::size_t own_moving() const;
  /// Returns the numbers of the own bodies, in ascending order. Cost: O(numbers).
  std::vector<std::uint32_t> own_bodies() const;
  /// Returns, in ascending order, the registered own bodies that may enter one of the boxes before their
  /// windows end.
  std::vector<std::uint32_t> own_bodies_in(std::span<const Box> boxes) const;

  WorldState state;
  EventProcessor main;  ///< processes events of all bodies that the rank holds
  BodyDirectory directory;
};

}  // namespace kinesphere
