// Who answers events while the world goes on by itself (World::run).
#pragma once

#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere {

/// May be used by several threads at the same time, for different bodies.
class Answerer {
 public:
  virtual ~Answerer() = default;

  /// What the event does to its bodies. Errors: an answer that is none.
  virtual Result<Answer> answer(const Event& event) = 0;
  /// The bodies move on from the event as the answer says. When it throws, none of them does.
  virtual void turn(const Event& event, const Answer& answer) = 0;
  virtual Departure departure(BodyId body) = 0;
  /// Takes turns back.
  virtual void depart(BodyId body, const Departure& departure) = 0;
};

/// Tells the mover of all new velocities or, if it throws, of none.
void turn(Mover& mover, const Event& event, const Answer& answer);

}  // namespace kinesphere
