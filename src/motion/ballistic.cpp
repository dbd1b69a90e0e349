// Bodies that fly freely under a common gravity.
#include "kinesphere/motion/ballistic.hpp"

#include "input/input_check.hpp"

namespace kinesphere {

Result<Ballistic> Ballistic::create(const BallisticDefinition& definition) {
  const auto check = InputCheck("Ballistic::create")
                         .start(definition.start, definition.start_time)
                         .finite({"gravity"}, definition.gravity);
  if (check.error()) return *check.error();
  return Ballistic(definition);
}

Ballistic::Ballistic(const BallisticDefinition& definition)
    : PiecewiseAcceleration(definition.start, definition.start_time), gravity_(definition.gravity) {}

BodyDefinition Ballistic::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, 0.0, gravity_);
}

std::unique_ptr<Motion> Ballistic::clone() const { return std::make_unique<Ballistic>(*this); }

}  // namespace kinesphere
