// Worlds that find contacts by windows, as they do once several threads have run them.
#pragma once

#include <span>

#include "kinesphere/run.hpp"
#include "kinesphere/world.hpp"
#include "support/eager_workers.hpp"

namespace kinesphere {

/// Makes a world go on in windows. Its bodies have been added at the present time. Events of this time are
/// not lost: the run stops before it answers the first one.
inline void use_windows(World& world) {
  struct Stop {};
  struct Nobody final : MotionSource {
    void states(std::span<const BodyId>, double, std::span<State>) override {}
    MotionOrigin origin(BodyId) const override { return {}; }
    void set_origin(BodyId, const MotionOrigin&) override {}
  };
  Workers two = eager_workers(2).value();
  Nobody nobody;
  const auto respond = [](const Event&) -> Response { throw Stop(); };
  try {
    world
        .run(
            world.time(), nobody, respond, [](const Event&) {}, &two)
        .value();
  } catch (const Stop&) {
  }
}

}  // namespace kinesphere
