// RankSource and RankResponder connect a rank's bodies to the caller's motion and responses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bodies/bodies.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/run.hpp"
#include "processor/responses.hpp"

namespace kinesphere {

/// Motion source for the bodies of a part of the world, backed by the rank's motion.
class RankSource final : public MotionSource {
 public:
  /// `in_motion`: number in the motion, by number.
  RankSource(Motion& motion, const std::vector<std::uint32_t>& in_motion)
      : motion_(motion), in_motion_(in_motion) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override;
  void set_origin(BodyId body, const MotionOrigin& origin) override;

 private:
  Motion& motion_;
  const std::vector<std::uint32_t>& in_motion_;
};

/// Calls `respond` and validates the response. Errors: unknown_body for a velocity of a body that is not part
/// of the event; those of check_velocity() and check_spin(); unsupported for an action or a stop.
class RankResponder {
 public:
  RankResponder(const ResponseFn& respond, MotionSource& source, const Bodies& bodies)
      : respond_(respond), source_(source), bodies_(bodies) {}

  Result<Response> respond(const Event& event) const;
  Result<void> apply(const Event& event, const Response& answer) const {
    return apply_response(source_, bodies_.definition(), event, answer);
  }

 private:
  Result<void> check(const Event& event, const Response& answer) const;

  const ResponseFn& respond_;
  MotionSource& source_;
  const Bodies& bodies_;
};

}  // namespace kinesphere
