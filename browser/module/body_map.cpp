// Worlds with bodies that one motion moves, or several.
#include "body_map.hpp"

#include <algorithm>
#include <optional>

#include "body.hpp"
#include "exchange.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "rigid_bodies.hpp"

namespace kinesphere::browser {
namespace {

void keep(BodyMapHandle& handle, const std::shared_ptr<Motion>& motion) {
  if (std::find(handle.motions.begin(), handle.motions.end(), motion) == handle.motions.end())
    handle.motions.push_back(motion);
}

std::vector<Motion*> motions_of(std::span<const MotionHandle* const> handles) {
  std::vector<Motion*> motions;
  for (const MotionHandle* const handle : handles) motions.push_back(handle->motion.get());
  return motions;
}

}  // namespace

KINESPHERE_EXPORT(map_create) BodyMapHandle* map_create() {
  return new BodyMapHandle{std::make_unique<BodyMap>(), {}};
}
KINESPHERE_EXPORT(map_free) void map_free(BodyMapHandle* handle) { delete handle; }

/// `like` are the numbers of a body, of which state and limits are ignored. Returns the body's id.
KINESPHERE_EXPORT(map_add)
double map_add(BodyMapHandle* handle, World* world, const MotionHandle* moving, double number,
               const double* like) {
  if (auto reason = why_unknown(*moving->motion, number, world->time())) return fail(*reason), no_id;
  const auto id =
      handle->map->add(*world, *moving->motion, static_cast<std::uint32_t>(number), body_at(like));
  if (!is_good(id)) return no_id;
  keep(*handle, moving->motion);
  return number_of(*id);
}

/// Adds a body that carries a shape. Returns its id.
KINESPHERE_EXPORT(map_add_moving_shape)
double map_add_moving_shape(BodyMapHandle* handle, World* world, const MotionHandle* moving, double number,
                            int kind, const double* shape, const double* like) {
  if (auto reason = why_unknown(*moving->motion, number, world->time())) return fail(*reason), no_id;
  const auto made = shape_at(kind, shape);
  if (!is_good(made)) return no_id;
  const auto id = handle->map->add_moving_shape(*world, *moving->motion, static_cast<std::uint32_t>(number),
                                                {body_at(like), *made});
  if (!is_good(id)) return no_id;
  keep(*handle, moving->motion);
  return number_of(*id);
}

/// Adds a body as the position of a rigid one. Returns its id.
KINESPHERE_EXPORT(map_add_rigid_body)
double map_add_rigid_body(BodyMapHandle* handle, World* world, const MotionHandle* moving, double number,
                          const double* like, const double* rigid, std::size_t count, const double* parts) {
  if (auto reason = why_unknown(*moving->motion, number, world->time())) return fail(*reason), no_id;
  const auto id = handle->map->add_rigid_body(*world, *moving->motion, static_cast<std::uint32_t>(number),
                                              rigid_body_at({like, rigid, count, parts}));
  if (!is_good(id)) return no_id;
  keep(*handle, moving->motion);
  return number_of(*id);
}

/// Adds all bodies of the motion or, on an error, none. `radii` has one for each of `count` numbers.
KINESPHERE_EXPORT(map_add_all)
bool map_add_all(BodyMapHandle* handle, World* world, const MotionHandle* moving, std::size_t count,
                 const double* radii, const double* like) {
  Motion& motion = *moving->motion;
  for (std::uint32_t number = 0; number < motion.size(); ++number)
    if (motion.contains(number))
      if (auto reason = why_unknown(motion, number, world->time())) return fail(*reason);
  const auto ids = handle->map->add_all(*world, motion, std::span(radii, count), body_at(like));
  if (!is_good(ids)) return false;
  keep(*handle, moving->motion);
  answer_ids(*ids);
  return true;
}

KINESPHERE_EXPORT(map_set_velocity)
bool map_set_velocity(BodyMapHandle* handle, World* world, double body, const double* velocity) {
  return is_good(handle->map->set_velocity(*world, body_of(body), vector_at(velocity)));
}
KINESPHERE_EXPORT(map_teleport)
bool map_teleport(BodyMapHandle* handle, World* world, double body, const double* state) {
  return is_good(handle->map->teleport(*world, body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(map_remove) bool map_remove(BodyMapHandle* handle, World* world, double body) {
  return is_good(handle->map->remove(*world, body_of(body)));
}
KINESPHERE_EXPORT(map_push)
bool map_push(const BodyMapHandle* handle, World* world, const MotionHandle* moving, std::size_t count,
              const double* positions, const double* time, std::size_t rotation_count,
              const double* rotations) {
  auto* const frames = dynamic_cast<FrameMotion*>(moving->motion.get());
  if (frames == nullptr)
    return fail({ErrorCode::unsupported, "frames", no_body, "push: frames must be a FrameMotion"});
  std::vector<Vec3> next;
  for (std::size_t k = 0; k < count; ++k) next.push_back(vector_at(positions + 3 * k));
  const auto at = time != nullptr ? std::optional<double>(*time) : std::nullopt;
  return is_good(handle->map->push(*world, *frames, next, quaternions_at(rotations, rotation_count), at));
}

/// Answers seven numbers for each body: its orientation and angular velocity.
KINESPHERE_EXPORT(map_rotations)
bool map_rotations(const BodyMapHandle* handle, double time, std::size_t count, const double* bodies) {
  answer().clear();
  for (std::size_t k = 0; k < count; ++k) {
    const BodyId body = body_of(bodies[k]);
    const auto found = handle->map->find(body);
    if (!found)
      return fail({ErrorCode::unknown_body, "body", body, "rotations: body must be one that this map knows"});
    if (auto reason = why_unknown(*found->motion, found->number, time)) return fail(*reason);
    const auto rotation = found->motion->rotation(found->number, time);
    if (!rotation)
      return fail({ErrorCode::unsupported, "body", body,
                   "rotations: the motion of a body must know how it turns: a FrameMotion with rotations"});
    const auto& [w, x, y, z] = rotation->orientation;
    const Vec3& spin = rotation->angular_velocity;
    answer().insert(answer().end(), {w, x, y, z, spin.x, spin.y, spin.z});
  }
  return true;
}

/// Answers the place of the body's motion among those that were added, in order, and the body's number
/// there; nothing if the map does not know it.
KINESPHERE_EXPORT(map_find) void map_find(const BodyMapHandle* handle, double body) {
  answer().clear();
  const auto found = handle->map->find(body_of(body));
  if (!found) return;
  const auto moves_it = [&](const std::shared_ptr<Motion>& motion) { return motion.get() == found->motion; };
  const auto at = std::find_if(handle->motions.begin(), handle->motions.end(), moves_it);
  answer() = {static_cast<double>(at - handle->motions.begin()), static_cast<double>(found->number)};
}

/// Answers six numbers for each body, NaN for one that the map does not know. At a time without a state the
/// nearest one is used.
KINESPHERE_EXPORT(map_states)
void map_states(const BodyMapHandle* handle, double time, std::size_t count, const double* bodies) {
  answer().resize(6 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto found = handle->map->find(body_of(bodies[k]));
    put_nearest_state(found ? found->motion : nullptr, found ? found->number : 0, time,
                      answer().data() + 6 * k);
  }
}

/// Returns a map of the same bodies, in which the motion to[k] stands for from[k].
KINESPHERE_EXPORT(map_with_motions)
BodyMapHandle* map_with_motions(const BodyMapHandle* handle, std::size_t count,
                                const MotionHandle* const* from, const MotionHandle* const* to) {
  const std::span handles(to, count);
  auto map = handle->map->with_motions(motions_of({from, count}), motions_of(handles));
  if (!is_good(map)) return nullptr;
  auto* const made = new BodyMapHandle{std::move(*map), {}};
  for (const MotionHandle* const moving : handles) made->motions.push_back(moving->motion);
  return made;
}

}  // namespace kinesphere::browser
