// Worlds with bodies that motions of JavaScript move, one or several.
#include "kinesphere/body_map.hpp"

#include <algorithm>
#include <optional>

#include "kinesphere/motion/frame_motion.hpp"
#include "module.hpp"

namespace kinesphere::browser {
namespace {

std::vector<Motion*> motions_of(std::span<const MotionHandle* const> handles) {
  std::vector<Motion*> motions;
  for (const MotionHandle* const handle : handles) motions.push_back(handle->motion.get());
  return motions;
}

void keep(BodyMapHandle* handle, const std::shared_ptr<Motion>& motion) {
  if (std::find(handle->motions.begin(), handle->motions.end(), motion) == handle->motions.end())
    handle->motions.push_back(motion);
}

/// Calls add(world) for a motion that knows the body at the time of the world, and keeps the motion alive.
template <class Add>
ks_status add_by(BodyMapHandle* handle, ks_world world, const MotionHandle* moving, std::uint32_t number,
                 ks_body_id* id, const Add& add) {
  return c::changing("BodyMap", world, [&](c::WorldObject& object) {
    require_known(*moving->motion, number, object.world().time());
    *id = c::c_id(add(object.world()).value());
    keep(handle, moving->motion);
  });
}

/// Calls change(world), which returns a result.
template <class Change>
ks_status change_by(ks_world world, const Change& change) {
  return c::changing("BodyMap", world, [&](c::WorldObject& object) { change(object.world()).value(); });
}

}  // namespace

KINESPHERE_EXPORT(map_create) BodyMapHandle* map_create() {
  return new BodyMapHandle{std::make_unique<BodyMap>(), {}};
}
KINESPHERE_EXPORT(map_free) void map_free(BodyMapHandle* handle) { delete handle; }

KINESPHERE_EXPORT(map_add)
ks_status map_add(BodyMapHandle* handle, ks_world world, const MotionHandle* moving, std::uint32_t number,
                  const ks_body_definition* like, ks_body_id* id) {
  return add_by(handle, world, moving, number, id, [&](World& to) {
    return handle->map->add(to, *moving->motion, number, c::body_of("add", *like));
  });
}
KINESPHERE_EXPORT(map_add_moving_shape)
ks_status map_add_moving_shape(BodyMapHandle* handle, ks_world world, const MotionHandle* moving,
                               std::uint32_t number, const ks_shape* shape, const ks_body_definition* like,
                               ks_body_id* id) {
  return add_by(handle, world, moving, number, id, [&](World& to) {
    return handle->map->add_moving_shape(to, *moving->motion, number,
                                         {c::body_of("add", *like), c::shape_of("add", *shape)});
  });
}
KINESPHERE_EXPORT(map_add_rigid_body)
ks_status map_add_rigid_body(BodyMapHandle* handle, ks_world world, const MotionHandle* moving,
                             std::uint32_t number, const ks_body_definition* like,
                             const ks_rigid_definition* rigid, ks_body_id* id) {
  return add_by(handle, world, moving, number, id, [&](World& to) {
    return handle->map->add_rigid_body(to, *moving->motion, number, c::rigid_of("add", *like, *rigid));
  });
}
/// Adds all bodies of the motion or, on an error, none, and writes their ids. `radii` has one for each of
/// `count` numbers.
KINESPHERE_EXPORT(map_add_all)
ks_status map_add_all(BodyMapHandle* handle, ks_world world, const MotionHandle* moving, std::size_t count,
                      const double* radii, const ks_body_definition* like, ks_body_id* ids,
                      std::size_t* added) {
  return c::changing("BodyMap", world, [&](c::WorldObject& object) {
    Motion& motion = *moving->motion;
    for (std::uint32_t number = 0; number < motion.size(); ++number)
      if (motion.contains(number)) require_known(motion, number, object.world().time());
    const auto found =
        handle->map->add_all(object.world(), motion, std::span(radii, count), c::body_of("add_all", *like))
            .value();
    *added = found.size();
    std::copy_n(c::c_ids(found), found.size(), ids);
    keep(handle, moving->motion);
  });
}

KINESPHERE_EXPORT(map_set_velocity)
ks_status map_set_velocity(BodyMapHandle* handle, ks_world world, const BodyId* body, const Vec3* velocity) {
  return change_by(world, [&](World& of) { return handle->map->set_velocity(of, *body, *velocity); });
}
KINESPHERE_EXPORT(map_teleport)
ks_status map_teleport(BodyMapHandle* handle, ks_world world, const BodyId* body, const State* state) {
  return change_by(world, [&](World& of) { return handle->map->teleport(of, *body, *state); });
}
KINESPHERE_EXPORT(map_remove)
ks_status map_remove(BodyMapHandle* handle, ks_world world, const BodyId* body) {
  return change_by(world, [&](World& of) { return handle->map->remove(of, *body); });
}
/// As frames_push().
KINESPHERE_EXPORT(map_push)
ks_status map_push(const BodyMapHandle* handle, ks_world world, const MotionHandle* moving, std::size_t count,
                   const Vec3* positions, const double* time, std::size_t rotation_count,
                   const Quaternion* rotations) {
  return change_by(world, [&](World& of) {
    auto* const frames = dynamic_cast<FrameMotion*>(moving->motion.get());
    if (frames == nullptr) {
      detail::bad_result({ErrorCode::unsupported, "frames", no_body, "push: frames must be a FrameMotion"});
    }
    return handle->map->push(of, *frames, std::span(positions, count), std::span(rotations, rotation_count),
                             time != nullptr ? std::optional<double>(*time) : std::nullopt);
  });
}

/// As a ks_rotation_probe.
KINESPHERE_EXPORT(map_rotations)
ks_status map_rotations(const BodyMapHandle* handle, double time, std::size_t count, const BodyId* bodies,
                        Rotation* rotations) {
  return c::guarded([&] {
    for (std::size_t k = 0; k < count; ++k) {
      const auto found = handle->map->find(bodies[k]);
      if (found) require_known(*found->motion, found->number, time);
      rotations[k] = handle->map->rotation(bodies[k], time);
    }
  });
}
/// Returns the place of the body's motion among those that were added, in order, and writes the body's number
/// there; -1 if the map does not know it.
KINESPHERE_EXPORT(map_find)
std::int32_t map_find(const BodyMapHandle* handle, const BodyId* body, std::uint32_t* number) {
  const auto found = handle->map->find(*body);
  if (!found) return -1;
  *number = found->number;
  const auto moves_it = [&](const std::shared_ptr<Motion>& motion) { return motion.get() == found->motion; };
  const auto at = std::find_if(handle->motions.begin(), handle->motions.end(), moves_it);
  return static_cast<std::int32_t>(at - handle->motions.begin());
}
/// States of the bodies, NaN for one that the map does not know, at a time or at the nearest one.
KINESPHERE_EXPORT(map_states)
void map_states(const BodyMapHandle* handle, double time, std::size_t count, const BodyId* bodies,
                State* states) {
  for (std::size_t k = 0; k < count; ++k) {
    const auto found = handle->map->find(bodies[k]);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    states[k] =
        found ? nearest_state(*found->motion, found->number, time) : State{{nan, nan, nan}, {nan, nan, nan}};
  }
}
/// Makes a map of the same bodies, in which the motion to[k] stands for from[k].
KINESPHERE_EXPORT(map_with_motions)
ks_status map_with_motions(const BodyMapHandle* handle, std::size_t count, const MotionHandle* const* from,
                           const MotionHandle* const* to, BodyMapHandle** made) {
  return c::guarded([&] {
    const std::span handles(to, count);
    auto map = handle->map->with_motions(motions_of({from, count}), motions_of(handles)).value();
    *made = new BodyMapHandle{std::move(map), {}};
    for (const MotionHandle* const moving : handles) (*made)->motions.push_back(moving->motion);
  });
}

}  // namespace kinesphere::browser
