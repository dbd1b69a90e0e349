// WorldState is the state of a world but for its clock and the events of the present.
#pragma once

#include "bodies/body_bounds.hpp"
#include "contact/contact_graph.hpp"
#include "core/core.hpp"
#include "processor/spot_checks.hpp"
#include "processor/timers.hpp"

namespace kinesphere {

struct WorldState {
  explicit WorldState(const WorldDefinition& definition)
      : bodies(definition), contacts(definition), core(definition) {}

  Bodies bodies;
  ContactGraph contacts;
  SpotChecks spot_checks;
  Timers timers;
  core::Core core;  ///< finds what is due
};

}  // namespace kinesphere
