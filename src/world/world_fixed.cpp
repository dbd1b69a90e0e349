// The surroundings of a world: checks of the calls about fixed bodies.
#include "input/input_check.hpp"
#include "world/changing.hpp"
#include "world/engine.hpp"
#include "world/fixed.hpp"
#include "world/validation.hpp"

namespace kinesphere {

Result<void> World::check_moving(BodyId body, std::string_view call) const {
  auto valid = check_call(body, call);
  if (!valid || !engine_->table()[body.index].is_fixed()) return valid;
  return Error{ErrorCode::fixed_body, "body", body,
               std::string(call) + ": body must be one that can move, but " + text_of(body) + " is fixed"};
}

/// For a call that needs the body to be enabled, too.
Result<void> World::check_mobile(BodyId body, std::string_view call) const {
  auto valid = check_moving(body, call);
  return !valid || engine_->table()[body.index].enabled ? valid : check_enabled(body, true, call);
}

/// Whether there is room for a fixed body, where overlaps are not allowed.
Result<void> World::check_fixed_room(const FixedDefinition& fixed, BodyId id, std::string_view call) const {
  if (definition().allow_overlap) return {};
  const Bound bound = engine_->bound_now(body_of(fixed));
  const auto other = engine_->certain_overlap(id, Engine::extent_of(bound, fixed.shape), body_of(fixed));
  return other ? Result<void>(overlap_error(call, *other, text_of(*other), "shape")) : Result<void>();
}

Result<FixedDefinition> World::check_new_fixed(const FixedDefinition& fixed, BodyId id,
                                               std::string_view call) const {
  auto valid = check_shape(fixed.shape, definition(), call);
  if (valid) valid = check_reach(body_of(fixed), no_body, "shape", call);
  if (!valid) return valid.error();
  FixedDefinition kept = fixed;
  kept.shape = engine_->as_kept(fixed.shape);
  if (auto room = check_fixed_room(kept, id, call); !room) return room.error();
  return kept;
}

Result<BodyId> World::add_fixed(const FixedDefinition& body) {
  if (auto idle = check_idle(engine_->activity(), "add_fixed"); !idle) return idle.error();
  const auto kept = check_new_fixed(body, engine_->next_id(), "add_fixed");
  if (!kept) return kept.error();
  return changing(step::AddFixed{*kept}).add_fixed(*kept);
}

Result<std::vector<BodyId>> World::add_fixed_all(std::span<const FixedDefinition> bodies) {
  if (auto idle = check_idle(engine_->activity(), "add_fixed_all"); !idle) return idle.error();
  std::vector<FixedDefinition> kept;
  kept.reserve(bodies.size());
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "add_fixed_all: bodies[" + std::to_string(number) + "]";
    auto valid = check_new_fixed(bodies[number], engine_->next_id(number), call);
    if (!valid) return valid.error();
    kept.push_back(*valid);
  }
  std::vector<BodyId> ids;
  ids.reserve(kept.size());
  for (const FixedDefinition& body : kept) ids.push_back(changing(step::AddFixed{body}).add_fixed(body));
  return ids;
}

Result<Shape> World::shape_of(BodyId body) const {
  if (auto valid = check_alive(body, "shape_of"); !valid) return valid.error();
  if (engine_->table()[body.index].is_fixed()) return engine_->shape(body.index);
  const Body& moving = engine_->table()[body.index];
  return Shape(Ball{moving.bound.position, moving.radius});
}

}  // namespace kinesphere
