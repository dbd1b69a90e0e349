// BodyMap: assigns each body of a world its motion and its number there.
#include "kinesphere/body_map.hpp"

#include <algorithm>
#include <string>

#include "input/input_check.hpp"
#include "motion/checks.hpp"

namespace kinesphere {
namespace {

Error unknown(std::string_view call, BodyId body) {
  return {ErrorCode::unknown_body, "body", body,
          "BodyMap::" + std::string(call) + ": body: " + text_of(body) +
              " of the world was not added through this map, or has been removed from it, or the map has" +
              " served another world since"};
}

/// Returns `like` with the state and the motion limits of a body of the motion at `time`.
Result<BodyDefinition> definition_of(std::string_view call, const Motion& motion, std::uint32_t number,
                                     double time, BodyDefinition like) {
  if (const auto error = wrong_body("BodyMap::" + std::string(call), motion, number)) return *error;
  const BodyDefinition moved = motion.definition(number, time);
  like = with_motion_limits(like, motion_limits_of(moved));
  like.position = moved.position;
  like.velocity = moved.velocity;
  return like;
}

}  // namespace

void BodyMap::note(BodyId body, Motion& motion, std::uint32_t number) {
  if (body.index >= entries_.size()) entries_.resize(std::size_t{body.index} + 1);
  entries_[body.index] = {&motion, number, body.generation, body.world};
}

Result<void> BodyMap::connect(BodyId body, Motion& motion, std::uint32_t number) {
  if (const auto error = wrong_body("BodyMap::connect", motion, number)) return *error;
  if (body == no_body) return unknown("connect", body);
  note(body, motion, number);
  return {};
}

std::vector<BodyId> BodyMap::bodies() const {
  std::vector<BodyId> bodies;
  for (std::uint32_t index = 0; index < entries_.size(); ++index)
    if (const Entry& known = entries_[index]; known.motion != nullptr)
      bodies.push_back({index, known.generation, known.world});
  return bodies;
}

Result<BodyId> BodyMap::add(World& world, Motion& motion, std::uint32_t number, const BodyDefinition& like) {
  const auto definition = definition_of("add", motion, number, world.time(), like);
  if (!definition) return definition.error();
  auto id = world.add(*definition);
  if (id) note(*id, motion, number);
  return id;
}

Result<BodyId> BodyMap::add_moving_shape(World& world, Motion& motion, std::uint32_t number,
                                         MovingShape like) {
  const auto definition = definition_of("add_moving_shape", motion, number, world.time(), like.body);
  if (!definition) return definition.error();
  like.body = *definition;
  auto id = world.add_moving_shape(like);
  if (id) note(*id, motion, number);
  return id;
}

Result<BodyId> BodyMap::add_rigid_body(World& world, Motion& motion, std::uint32_t number, RigidBody like) {
  const auto definition = definition_of("add_rigid_body", motion, number, world.time(), like.body);
  if (!definition) return definition.error();
  like.body = *definition;
  if (const auto rotation = motion.rotation(number, world.time())) {
    like.rotation = *rotation;
    InputCheck check("BodyMap::add_rigid_body");
    check.require(like.inertia == Vec3{}, ErrorCode::unsupported, {"inertia"},
                  "must be 0 for a body that its motion turns", like.inertia);
    if (check.error()) return *check.error();
  }
  auto id = world.add_rigid_body(like);
  if (id) note(*id, motion, number);
  return id;
}

Result<std::vector<BodyId>> BodyMap::add_all(World& world, Motion& motion, const BodyDefinition& like) {
  return add_with_radii(world, motion, std::vector<double>(motion.size(), like.radius), like);
}

Result<std::vector<BodyId>> BodyMap::add_with_radii(World& world, Motion& motion,
                                                    std::span<const double> radii,
                                                    const BodyDefinition& like) {
  InputCheck check("BodyMap::add_all");
  check.require(radii.size() == motion.size(), ErrorCode::out_of_range, {"radii"},
                "must have one entry per body,", motion.size(), radii.size());
  if (check.error()) return *check.error();
  std::vector<BodyDefinition> definitions;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = 0; number < motion.size(); ++number) {
    if (!motion.contains(number)) continue;
    auto definition = definition_of("add", motion, number, world.time(), like);
    if (!definition) return definition.error();
    definition->radius = radii[number];
    definitions.push_back(*definition);
    numbers.push_back(number);
  }
  auto ids = world.add_all(definitions);
  if (!ids) return ids;
  for (std::size_t k = 0; k < numbers.size(); ++k) note((*ids)[k], motion, numbers[k]);
  return ids;
}

Result<void> BodyMap::set_velocity(World& world, BodyId body, const Vec3& velocity) {
  const Entry* const found = entry(body);
  if (found == nullptr) return unknown("set_velocity", body);
  if (auto valid = world.check_set_velocity(body, velocity); !valid) return valid;
  if (auto turned = found->motion->set_velocity(found->number, world.time(), velocity); !turned)
    return turned;
  return world.set_velocity(body, velocity);
}

Result<void> BodyMap::teleport(World& world, BodyId body, const State& state) {
  const Entry* const found = entry(body);
  if (found == nullptr) return unknown("teleport", body);
  if (auto valid = world.check_teleport(body, state); !valid) return valid;
  if (auto moved = found->motion->teleport(found->number, world.time(), state); !moved) return moved;
  return world.teleport(body, state);
}

Result<void> BodyMap::remove(World& world, BodyId body) {
  const Entry* const found = entry(body);
  if (found == nullptr) return unknown("remove", body);
  if (const auto error = wrong_body("remove", *found->motion, found->number)) return *error;
  if (world.contains(body)) {
    if (auto removed = world.remove(body); !removed) return removed;
  }
  auto removed = found->motion->remove(found->number);
  if (!removed && removed.error().code != ErrorCode::unsupported) return removed;
  entries_[body.index] = {};
  return {};
}

Result<void> BodyMap::remove_gone(World& world, const Event& event, const ResponseFn& respond) {
  const auto has_gone = [&](BodyId body) { return entry(body) != nullptr && !world.contains(body); };
  if (!has_gone(event.first) && !has_gone(event.second)) return {};
  // A later event that has been responded to already may have removed the body, which then stays until the
  // sink receives that event.
  const Response response = respond(event);
  const auto remove_if = [&](BodyId body, BodyAction action) {
    return action == BodyAction::remove && has_gone(body) ? remove(world, body) : Result<void>();
  };
  auto removed = remove_if(event.first, response.first_action);
  return removed ? remove_if(event.second, response.second_action) : removed;
}

Result<void> BodyMap::push(World& world, FrameMotion& frames, std::span<const Vec3> positions,
                           std::optional<double> time) const {
  return push(world, frames, positions, {}, time);
}

Result<void> BodyMap::push(World& world, FrameMotion& frames, std::span<const Vec3> positions,
                           std::span<const Quaternion> rotations, std::optional<double> time) const {
  std::vector<BodyId> ids(frames.size(), no_body);
  for (std::uint32_t index = 0; index < entries_.size(); ++index) {
    const Entry& known = entries_[index];
    if (known.motion == &frames) ids[known.number] = {index, known.generation, known.world};
  }
  return frames.push("BodyMap::push", world, ids, {positions, rotations, time});
}

Result<std::unique_ptr<BodyMap>> BodyMap::with_motions(std::span<Motion* const> from,
                                                       std::span<Motion* const> to) const {
  InputCheck check("BodyMap::with_motions");
  check.require(from.size() == to.size(), ErrorCode::out_of_range, {"to"},
                "must have as many motions as from,", from.size(), to.size());
  if (check.error()) return *check.error();
  auto map = std::make_unique<BodyMap>();
  map->entries_ = entries_;
  std::size_t k = 0;
  for (Entry& moved : map->entries_) {
    if (moved.motion == nullptr) continue;
    // Bodies of one motion mostly follow each other, so the motion of the last one is tried first.
    if (k == from.size() || from[k] != moved.motion)
      k = static_cast<std::size_t>(std::find(from.begin(), from.end(), moved.motion) - from.begin());
    if (k == from.size()) {
      const auto index = static_cast<std::uint32_t>(&moved - map->entries_.data());
      return Error{ErrorCode::out_of_range,
                   "from",
                   {index, moved.generation},
                   "BodyMap::with_motions: from must have every motion of this map, but lacks that of " +
                       text_of(BodyId{index, moved.generation})};
    }
    moved.motion = to[k];
  }
  return map;
}

std::optional<MovedBody> BodyMap::find(BodyId body) const {
  const Entry* const found = entry(body);
  if (found == nullptr) return std::nullopt;
  return MovedBody{found->motion, found->number};
}

const BodyMap::Entry& BodyMap::known(std::string_view call, BodyId body) const {
  const Entry* const found = entry(body);
  if (found == nullptr) [[unlikely]]
    detail::bad_result(unknown(call, body));
  return *found;
}

State BodyMap::state(BodyId body, double time) const {
  const Entry& moved = known("state", body);
  return moved.motion->state(moved.number, time);
}

Rotation BodyMap::rotation(BodyId body, double time) const {
  const Entry& moved = known("rotation", body);
  const auto rotation = moved.motion->rotation(moved.number, time);
  if (!rotation) [[unlikely]]
    detail::bad_result({ErrorCode::unsupported, "body", body,
                        "BodyMap::rotation: the motion of " + text_of(body) +
                            " must know how its bodies turn: a FrameMotion that was created with rotations"});
  return *rotation;
}

void BodyMap::MapSource::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  bodies_.probe()(ids, time, states);
}

MotionOrigin BodyMap::MapSource::origin(BodyId body) const {
  const Entry& moved = bodies_.known("origin", body);
  return moved.motion->origin(moved.number);
}

void BodyMap::MapSource::set_origin(BodyId body, const MotionOrigin& origin) {
  const Entry& moved = bodies_.known("set_origin", body);
  moved.motion->set_origin(moved.number, origin).value();
}

}  // namespace kinesphere
