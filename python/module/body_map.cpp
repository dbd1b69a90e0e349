// Worlds with bodies that one motion moves, or several.
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "motions.hpp"
#include "rigid_bodies.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

using MapClass = py::class_<BodyMapHandle, std::shared_ptr<BodyMapHandle>>;

constexpr const char* map_name = "body map";

void keep(BodyMapHandle& map, const py::object& motion) {
  const auto same = [&](const py::object& kept) { return kept.is(motion); };
  if (std::none_of(map.motions.begin(), map.motions.end(), same)) map.motions.push_back(motion);
}

/// Returns the place of a motion in map.motions.
std::size_t place_of(const BodyMapHandle& map, const Motion* motion) {
  const auto is_it = [&](const py::object& kept) {
    return kept.cast<MotionHandle&>().motion.get() == motion;
  };
  return static_cast<std::size_t>(std::find_if(map.motions.begin(), map.motions.end(), is_it) -
                                  map.motions.begin());
}

BodyDefinition like(double radius, std::uint64_t category, std::uint64_t mask, std::int32_t group, bool solid,
                    SensorClass sensor_class, std::uint64_t user_data) {
  return {.radius = radius,
          .filter = {category, mask, group},
          .solid = solid,
          .sensor_class = sensor_class,
          .user_data = user_data};
}

/// Completes a definition for a ball.
BodyDefinition with_mass(BodyDefinition body, double mass, const std::optional<std::string>& contacts,
                         std::string_view call) {
  body.mass = mass;
  if (contacts) body.contacts = contact_events_of(*contacts, {call, "contacts"});
  return body;
}

/// Adds what add(motion) adds to the map and the world, and returns its id or ids.
template <class Add>
auto added(BodyMapHandle& map, WorldHandle& world, const py::object& moving, const char* call,
           const Add& add) {
  auto& motion = moving.cast<MotionHandle&>();
  const auto turn = map.in_use.take_alone(call, map_name);
  const auto turn_of_motion = motion.take(call);
  const auto turn_of_world = world.take(call);
  const auto ids = add(*motion.motion).value();
  keep(map, moving);
  end_call(world);
  return ids;
}

py::object add_moved(BodyMapHandle& map, WorldHandle& world, const py::object& moving, std::uint32_t number,
                     double radius, std::uint64_t category, std::uint64_t mask, std::int32_t group,
                     bool solid, SensorClass sensor_class, std::uint64_t user_data, double mass,
                     const std::optional<std::string>& contacts) {
  return object_of(added(map, world, moving, "add", [&](Motion& motion) {
    const BodyDefinition body =
        with_mass(like(radius, category, mask, group, solid, sensor_class, user_data), mass, contacts, "add");
    return map.map->add(world.world, motion, number, body);
  }));
}

py::object add_moved_shape(BodyMapHandle& map, WorldHandle& world, const py::object& moving,
                           std::uint32_t number, const py::object& shape, std::uint64_t category,
                           std::uint64_t mask, std::int32_t group, bool solid, SensorClass sensor_class,
                           std::uint64_t user_data, double mass) {
  return object_of(added(map, world, moving, "add_moving_shape", [&](Motion& motion) {
    MovingShape carried{like(0.0, category, mask, group, solid, sensor_class, user_data),
                        shape_of(shape, {"add_moving_shape", "shape"})};
    carried.body.mass = mass;
    return map.map->add_moving_shape(world.world, motion, number, carried);
  }));
}

py::object add_moved_rigid_body(BodyMapHandle& map, WorldHandle& world, const py::object& moving,
                                std::uint32_t number, const py::object& parts, const py::object& orientation,
                                const py::object& angular_velocity, double angular_acceleration_limit,
                                double largest_angular_speed, const py::object& inertia,
                                std::uint64_t category, std::uint64_t mask, std::int32_t group, bool solid,
                                SensorClass sensor_class, std::uint64_t user_data, double mass) {
  return object_of(added(map, world, moving, "add_rigid_body", [&](Motion& motion) {
    BodyDefinition body = like(0.0, category, mask, group, solid, sensor_class, user_data);
    body.mass = mass;
    const RigidArguments rigid{
        parts, orientation, angular_velocity, angular_acceleration_limit, largest_angular_speed, inertia};
    return map.map->add_rigid_body(world.world, motion, number, rigid.read(body));
  }));
}

py::object add_all_moved(BodyMapHandle& map, WorldHandle& world, const py::object& moving,
                         const py::object& radii, std::uint64_t category, std::uint64_t mask,
                         std::int32_t group, bool solid, SensorClass sensor_class, std::uint64_t user_data,
                         double mass, const std::optional<std::string>& contacts) {
  return array_of(added(map, world, moving, "add_all", [&](Motion& motion) {
    std::size_t count = 0;
    for (std::uint32_t number = 0; number < motion.size(); ++number) count += motion.contains(number) ? 1 : 0;
    const std::vector<double> each = each_of(radii, {"add_all", "radii"}, count);
    const BodyDefinition body = with_mass(like(1.0, category, mask, group, solid, sensor_class, user_data),
                                          mass, contacts, "add_all");
    return map.map->add_all(world.world, motion, each, body);
  }));
}

/// Returns a map of the same bodies for copies of its motions. copy.deepcopy() copies each motion once, also
/// where the copied object refers to it elsewhere.
std::shared_ptr<BodyMapHandle> deep_copy(BodyMapHandle& map, const py::dict& memo) {
  const auto turn = map.in_use.take_alone("copy", map_name);
  const py::object copied = py::module_::import("copy").attr("deepcopy");
  auto copy = std::make_shared<BodyMapHandle>();
  std::vector<Motion*> from, to;
  for (const py::object& motion : map.motions) {
    copy->motions.push_back(copied(motion, memo));
    from.push_back(motion.cast<MotionHandle&>().motion.get());
    to.push_back(copy->motions.back().cast<MotionHandle&>().motion.get());
  }
  copy->map = map.map->with_motions(from, to).value();
  return copy;
}

/// Returns a call that makes the map again, of motions that are pickled with it and bodies by their numbers.
py::tuple reduced_map(BodyMapHandle& map) {
  const auto turn = map.in_use.take_alone("pickle", map_name);
  py::list bodies;
  for (const BodyId body : map.map->bodies()) {
    const MovedBody moved = *map.map->find(body);
    bodies.append(py::make_tuple(number_of(body), place_of(map, moved.motion), moved.number));
  }
  return py::make_tuple(package_attribute("kinesphere.pickles", "restored_map"),
                        py::make_tuple(py::cast(map.motions), bodies));
}
void connect(BodyMapHandle& map, const py::object& body, const py::object& moving, std::uint32_t number) {
  auto& motion = moving.cast<MotionHandle&>();
  const auto turn = map.in_use.take_alone("pickle", map_name);
  const auto turn_of_motion = motion.take("pickle");
  require(map.map->connect(id_of(body, {"BodyMap", "body"}), *motion.motion, number));
  keep(map, moving);
}

/// Changes a body in its motion and in the world.
template <class Change>
void change(BodyMapHandle& map, WorldHandle& world, const char* call, const Change& made) {
  const auto turn = map.in_use.take_alone(call, map_name);
  const auto turn_of_world = world.take(call);
  require(made(*map.map, world.world));
  end_call(world);
}

}  // namespace

void bind_body_map(py::module_& module) {
  constexpr std::uint64_t all_categories = ~std::uint64_t{0};
  MapClass(
      module, "BodyMap",
      R"(Which body of a world is which body of which motion, where several move them or bodies come and go.

It serves wherever a probe or a motion is asked for. It keeps its motions alive. One map may serve clones of
a world. copy.deepcopy() of an object that holds the world, the map and the motions copies all of them
together, for rollback.)")
      .def(py::init([] { return std::make_shared<BodyMapHandle>(); }))
      .def("add", add_moved, py::arg("world"), py::arg("motion"), py::arg("number"), py::arg("radius") = 1.0,
           py::kw_only(), py::arg("category") = 1, py::arg("mask") = all_categories, py::arg("group") = 0,
           py::arg("solid") = true, py::arg("sensor_class") = 0, py::arg("user_data") = 0,
           py::arg("mass") = 1.0, py::arg("contacts") = py::none(),
           "Adds a body of a motion to the world, with the motion's state and promise at world.time. Returns "
           "its BodyId.")
      .def("add_all", add_all_moved, py::arg("world"), py::arg("motion"), py::arg("radii") = 1.0,
           py::kw_only(), py::arg("category") = 1, py::arg("mask") = all_categories, py::arg("group") = 0,
           py::arg("solid") = true, py::arg("sensor_class") = 0, py::arg("user_data") = 0,
           py::arg("mass") = 1.0, py::arg("contacts") = py::none(),
           "All bodies of the motion, in the order of their numbers; radii is one number, or one of each. "
           "Returns ids, shape (n,).")
      .def("add_moving_shape", add_moved_shape, py::arg("world"), py::arg("motion"), py::arg("number"),
           py::arg("shape"), py::kw_only(), py::arg("category") = 1, py::arg("mask") = all_categories,
           py::arg("group") = 0, py::arg("solid") = true, py::arg("sensor_class") = 0,
           py::arg("user_data") = 0, py::arg("mass") = 1.0,
           "Adds a body of a motion that carries a shape: see World.add_moving_shape(). Returns its BodyId.")
      .def("add_rigid_body", add_moved_rigid_body, py::arg("world"), py::arg("motion"), py::arg("number"),
           py::arg("parts"), py::kw_only(), py::arg("orientation") = py::make_tuple(1.0, 0.0, 0.0, 0.0),
           py::arg("angular_velocity") = py::none(), py::arg("angular_acceleration_limit") = 0.0,
           py::arg("largest_angular_speed") = std::numeric_limits<double>::infinity(),
           py::arg("inertia") = py::make_tuple(0.0, 0.0, 0.0), py::arg("category") = 1,
           py::arg("mask") = all_categories, py::arg("group") = 0, py::arg("solid") = true,
           py::arg("sensor_class") = 0, py::arg("user_data") = 0, py::arg("mass") = 1.0,
           "Adds a body of a motion as the position of a rigid body: see World.add_rigid_body(). Returns its "
           "BodyId.")
      .def(
          "set_velocity",
          [](BodyMapHandle& map, WorldHandle& world, const py::object& body, const py::object& velocity) {
            const BodyId id = id_of(body, {"set_velocity", "body"});
            const Vec3 given = vector_of(velocity, {"set_velocity", "velocity"}, world.is_plane());
            change(map, world, "set_velocity",
                   [&](BodyMap& known, World& of) { return known.set_velocity(of, id, given); });
          },
          py::arg("world"), py::arg("body"), py::arg("velocity"),
          "In the motion and in the world, at world.time.")
      .def(
          "teleport",
          [](BodyMapHandle& map, WorldHandle& world, const py::object& body, const py::object& position,
             const py::object& velocity) {
            const BodyId id = id_of(body, {"teleport", "body"});
            const State state{vector_of(position, {"teleport", "position"}, world.is_plane()),
                              vector_of(velocity, {"teleport", "velocity"}, world.is_plane())};
            change(map, world, "teleport",
                   [&](BodyMap& known, World& of) { return known.teleport(of, id, state); });
          },
          py::arg("world"), py::arg("body"), py::arg("position"), py::arg("velocity"),
          "Puts a body elsewhere, in its motion, too: World.teleport().")
      .def(
          "remove",
          [](BodyMapHandle& map, WorldHandle& world, const py::object& body) {
            const BodyId id = id_of(body, {"remove", "body"});
            change(map, world, "remove", [&](BodyMap& known, World& of) { return known.remove(of, id); });
          },
          py::arg("world"), py::arg("body"),
          "Removes a body from the world, and from its motion if that can remove bodies.")
      .def(
          "push",
          [](BodyMapHandle& map, WorldHandle& world, HandleOf<FrameMotion>& frames,
             const py::object& positions, std::optional<double> time, const py::object& rotations) {
            const std::vector<Vec3> each = vectors_of(positions, {"push", "positions"}, true);
            std::vector<Quaternion> turns;
            if (!rotations.is_none()) turns = quaternions_of(rotations, {"push", "rotations"});
            const auto turn_of_frames = frames.in_use.take_alone("push", "frames");
            change(map, world, "push", [&](BodyMap& known, World& of) {
              return known.push(of, frames.get(), each, turns, time);
            });
          },
          py::arg("world"), py::arg("frames"), py::arg("positions"), py::arg("time") = py::none(),
          py::kw_only(), py::arg("rotations") = py::none(),
          R"(The next frame of a FrameMotion: the position of every body, shape (n, 3) or (n, 2), at a time.

Without a time it comes frames.interval after the latest one: give it where frames differ in length. rotations
are quaternions (w, x, y, z) of shape (n, 4), if the motion was made with them. The world learns all new
velocities, so that no contact is missed; world.time must be frames.latest_time.)")
      .def(
          "rotations",
          [](const BodyMapHandle& map, const py::object& bodies, double t) {
            std::vector<Rotation> rotations;
            for (const BodyId id : ids_of(bodies, {"rotations", "ids"}).ids)
              rotations.push_back(map.map->rotation(id, t));
            return arrays_of(rotations);
          },
          py::arg("ids"), py::arg("t"),
          R"(Orientations, shape (n, 4), and angular velocities, shape (n, 3), that motions give at a time.

It is a function for World.set_rotation_probe(), where rigid bodies have an angular acceleration limit.)")
      .def(
          "find",
          [](const BodyMapHandle& map, const py::object& body) -> py::object {
            const auto found = map.map->find(id_of(body, {"find", "body"}));
            if (!found) return py::none();
            return py::make_tuple(map.motions[place_of(map, found->motion)], found->number);
          },
          py::arg("body"), "The motion and the number there of a body; None for one that is not known.")
      .def("__deepcopy__", deep_copy)
      .def("__reduce__", reduced_map)
      .def("_connect", connect)
      .def("__repr__", [](const BodyMapHandle& map) {
        py::list motions;
        for (const py::object& motion : map.motions) motions.append(motion);
        return py::str("<BodyMap of {}>").format(motions);
      });
}

}  // namespace kinesphere::python
