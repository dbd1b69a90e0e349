// Who answers events while the world goes on by itself (World::run).
#pragma once

#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// May be used by several threads at the same time, for different bodies.
class ResponseHandler {
 public:
  virtual ~ResponseHandler() = default;

  /// What the event does to its bodies. Errors: an answer that is none.
  virtual Result<Response> respond(const Event& event) = 0;
  /// Makes the bodies move on from the event as the answer says. Errors: a state that is none. After an error
  /// or an exception no body has departed.
  virtual Result<void> apply(const Event& event, const Response& answer) = 0;
  virtual MotionOrigin origin(BodyId body) = 0;
  /// Takes turns back.
  virtual void set_origin(BodyId body, const MotionOrigin& origin) = 0;
};

/// Tells the mover of all new velocities, or of none: where it throws, and where a state that it gives is
/// refused as a report of a probe is (check_report), which is the error returned.
Result<void> turn(MotionSource& source, const WorldDefinition& world, const Event& event,
                  const Response& answer);

}  // namespace kinesphere
