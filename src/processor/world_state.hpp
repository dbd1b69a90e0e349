// WorldState is the part of a world that all event processors share.
#pragma once

#include <optional>

#include "bodies/body_bounds.hpp"
#include "broadphase/broad_phase.hpp"
#include "broadphase/window_policy.hpp"
#include "contact/contact_graph.hpp"
#include "core/core.hpp"
#include "processor/spot_checks.hpp"

namespace kinesphere {

struct WorldState {
  explicit WorldState(const WorldDefinition& definition)
      : bodies(definition),
        contacts(definition),
        broad_phase(bodies.space()),
        window_policy(longest_way(bodies.definition()), definition.dimensions) {}

  Bodies bodies;
  ContactGraph contacts;
  BroadPhase broad_phase;
  WindowPolicy window_policy;
  SpotChecks spot_checks;
  /// Finds what is due, in place of windows and certificates, which are not used as long as there is one.
  std::optional<core::Core> core;
};

}  // namespace kinesphere
