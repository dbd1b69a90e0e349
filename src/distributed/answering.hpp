// How the bodies that a rank knows move on, and what happens to them in an event: by the motion and the
// answers of the caller.
#pragma once

#include <cstdint>
#include <span>

#include "distributed/roster.hpp"
#include "engine/answerer.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Moves own bodies and copies by the rank's motion.
class RankMover final : public Mover {
 public:
  RankMover(Motion& motion, const Roster& roster) : motion_(motion), roster_(roster) {}

  bool contains(std::uint32_t number_in_motion) const { return motion_.contains(number_in_motion); }
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  Departure departure(BodyId body) const override;
  void depart(BodyId body, const Departure& departure) override;

 private:
  Motion& motion_;
  const Roster& roster_;
};

/// Asks `respond`, and refuses answers that are none.
class RankAnswerer final : public Answerer {
 public:
  RankAnswerer(const Respond& respond, Mover& mover, const WorldDefinition& definition)
      : respond_(respond), mover_(mover), definition_(definition) {}

  Result<Answer> answer(const Event& event) override;
  Result<void> turn(const Event& event, const Answer& answer) override {
    return kinesphere::turn(mover_, definition_, event, answer);
  }
  Departure departure(BodyId body) override { return mover_.departure(body); }
  void depart(BodyId body, const Departure& departure) override { mover_.depart(body, departure); }

 private:
  const Respond& respond_;
  Mover& mover_;
  const WorldDefinition& definition_;
};

}  // namespace kinesphere
