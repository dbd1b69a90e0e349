// Adding, changing and removing bodies.
#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "motions.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

constexpr std::uint64_t all_categories = std::numeric_limits<std::uint64_t>::max();

/// What add() and add_motion() are told of bodies beside their motion: a value for all, or one of each.
struct Traits {
  const py::object& radii;
  const py::object& categories;
  const py::object& masks;
  const py::object& group;
  const py::object& solid;
  const py::object& sensor_classes;
  const py::object& user_data;
  const py::object& masses;
  const std::optional<std::string>& contacts;

  void apply(std::string_view call, std::vector<BodyDefinition>& bodies) const;
};

void Traits::apply(std::string_view call, std::vector<BodyDefinition>& bodies) const {
  const std::size_t count = bodies.size();
  const auto set = [&](const auto& values, auto assign) {
    for (std::size_t k = 0; k < count; ++k) assign(bodies[k], values[k]);
  };
  set(each_of(radii, {call, "radii"}, count),
      [](BodyDefinition& body, double radius) { body.radius = radius; });
  set(each_whole_of(categories, {call, "categories"}, count),
      [](BodyDefinition& body, std::uint64_t category) { body.filter.category = category; });
  set(each_whole_of(masks, {call, "masks"}, count),
      [](BodyDefinition& body, std::uint64_t mask) { body.filter.mask = mask; });
  const std::int32_t common_group = group_of(group, {call, "group"});
  const bool is_solid = solid.cast<bool>();
  std::optional<ContactEvents> wanted;
  if (contacts) wanted = contact_events_of(*contacts, {call, "contacts"});
  for (BodyDefinition& body : bodies) {
    body.filter.group = common_group;
    body.solid = is_solid;
    body.contacts = wanted;
  }
  set(each_whole_of(sensor_classes, {call, "sensor_classes"}, count),
      [&](BodyDefinition& body, std::uint64_t sensor_class) {
        body.sensor_class = sensor_class_of(sensor_class, {call, "sensor_classes"});
      });
  set(each_whole_of(user_data, {call, "user_data"}, count),
      [](BodyDefinition& body, std::uint64_t data) { body.user_data = data; });
  set(each_of(masses, {call, "masses"}, count), [](BodyDefinition& body, double mass) { body.mass = mass; });
}

/// Errors such as "add: body 3: ..." name the number in the given arrays.
std::vector<BodyDefinition> definitions_of(WorldHandle& handle, const py::object& positions,
                                           const py::object& velocities,
                                           const py::object& acceleration_limits,
                                           const py::object& planned_accelerations,
                                           const py::object& position_errors,
                                           const py::object& velocity_errors, const Traits& traits) {
  const std::string_view call = "add";
  const std::vector<State> states = states_of(positions, velocities, call, handle.is_plane());
  const std::size_t count = states.size();
  std::vector<BodyDefinition> bodies(count);
  const auto set = [&](const auto& values, auto assign) {
    for (std::size_t k = 0; k < count; ++k) assign(bodies[k], values[k]);
  };
  set(states, [](BodyDefinition& body, const State& state) {
    body.position = state.position;
    body.velocity = state.velocity;
  });
  set(each_of(acceleration_limits, {call, "acceleration_limits"}, count),
      [](BodyDefinition& body, double limit) { body.acceleration_limit = limit; });
  if (!planned_accelerations.is_none()) {
    const Argument argument{call, "planned_accelerations"};
    const Numbers numbers(planned_accelerations, argument);
    const bool is_one = numbers.dimensions() == 1 && numbers.length(0) > 0;
    const auto plan_of = [](BodyDefinition& body, const Vec3& plan) { body.planned_acceleration = plan; };
    if (is_one)
      set(std::vector<Vec3>(count, vector_of(planned_accelerations, argument, handle.is_plane())), plan_of);
    else
      set(vectors_of(planned_accelerations, argument, handle.is_plane(), count), plan_of);
  }
  set(each_of(position_errors, {call, "position_errors"}, count),
      [](BodyDefinition& body, double error) { body.position_error = error; });
  set(each_of(velocity_errors, {call, "velocity_errors"}, count),
      [](BodyDefinition& body, double error) { body.velocity_error = error; });
  traits.apply(call, bodies);
  return bodies;
}

/// Returns true for one vector, which stands for a single body.
bool is_vector(const py::object& given) {
  const Numbers numbers(given, {"add", "positions"});
  return numbers.dimensions() == 1 && numbers.length(0) > 0;
}

py::object one_row(const py::object& vector) {
  if (vector.is_none()) return py::none();
  return numpy("asarray")(vector).attr("reshape")(1, -1);
}

/// Adds all bodies, or on an error none. An error has the name of the call, and the number in the given
/// arrays.
std::vector<BodyId> add_all(WorldHandle& handle, const std::vector<BodyDefinition>& bodies,
                            const std::string& call) {
  const Result<std::vector<BodyId>> ids =
      without_gil(handle, [&] { return handle.change([&](auto& to) { return to.add_all(bodies); }); });
  if (ids) return *ids;
  Error error = ids.error();
  constexpr std::string_view inner = "add_all: bodies[";
  const std::size_t end = error.message.find(']');
  if (error.message.starts_with(inner) && end != std::string::npos)
    error.message = call + ": body " + error.message.substr(inner.size(), end - inner.size()) +
                    error.message.substr(end + 1);
  throw BadResult(error);
}

/// Ends a call that added one body.
py::object object_of_added(WorldHandle& handle, const Result<BodyId>& added) {
  const BodyId id = added.value();
  end_call(handle);
  return object_of(id);
}

py::object add_bodies(WorldHandle& handle, const py::object& positions, const py::object& velocities,
                      const py::object& radii, const py::object& acceleration_limits,
                      const py::object& planned_accelerations, const py::object& position_errors,
                      const py::object& velocity_errors, const py::object& categories,
                      const py::object& masks, const py::object& group, const py::object& solid,
                      const py::object& sensor_classes, const py::object& user_data, const py::object& mass,
                      const std::optional<std::string>& contacts) {
  const auto turn = handle.take("add");
  const bool single = is_vector(positions);
  const auto bodies =
      definitions_of(handle, single ? one_row(positions) : py::reinterpret_borrow<py::object>(positions),
                     single ? one_row(velocities) : py::reinterpret_borrow<py::object>(velocities),
                     acceleration_limits, planned_accelerations, position_errors, velocity_errors,
                     {radii, categories, masks, group, solid, sensor_classes, user_data, mass, contacts});
  if (single) return object_of_added(handle, handle.change([&](auto& to) { return to.add(bodies.front()); }));
  return array_of(add_all(handle, bodies, "add"));
}

/// Adds all bodies of a motion; their ids must equal their numbers.
py::object add_motion(WorldHandle& handle, MotionHandle& moved, const py::object& radii,
                      const py::object& categories, const py::object& masks, const py::object& group,
                      const py::object& solid, const py::object& sensor_classes, const py::object& user_data,
                      const py::object& masses, const std::optional<std::string>& contacts) {
  const auto turn = handle.take("add_motion");
  handle.require_moved_by_others("add_motion");
  const auto turn_of_motion = moved.in_use.take_alone("add_motion", "motion");
  const Motion& motion = *moved.motion;
  const Argument argument{"add_motion", "motion"};
  std::vector<BodyDefinition> bodies;
  for (std::uint32_t number = 0; number < motion.size(); ++number) {
    if (!motion.contains(number))
      refuse(argument, "must have all its bodies", "has lost number " + std::to_string(number));
    bodies.push_back(motion.definition(number, handle.world.time()));
  }
  const Traits traits{radii, categories, masks, group, solid, sensor_classes, user_data, masses, contacts};
  traits.apply("add_motion", bodies);
  if (handle.world.size() > 0)
    refuse(argument, "must be added to a world without bodies, so that its numbers are ids",
           "there are " + std::to_string(handle.world.size()) + " (a BodyMap has no such need)");
  const std::vector<BodyId> ids = add_all(handle, bodies, "add_motion");
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k].index == k) continue;
    require(handle.world.remove(ids));
    refuse(argument, "must be added to a world that never had bodies, so that its numbers are ids",
           "some have been removed (a BodyMap has no such need)");
  }
  return array_of(ids);
}

/// Returns a call that adds a body that never moves, whose shape is shape_of_given(given, call), of one or
/// several arguments.
template <class... Given, class ShapeOf>
auto adding_static(const char* call, ShapeOf shape_of_given) {
  return [=](WorldHandle& handle, const Given&... given, std::uint64_t category, std::uint64_t mask,
             const py::object& group, bool solid, std::uint64_t sensor_class, std::uint64_t user_data) {
    const auto turn = handle.take(call);
    return object_of_added(handle, handle.world.add_static(
                                       {.shape = shape_of_given(given...),
                                        .filter = {category, mask, group_of(group, {call, "group"})},
                                        .solid = solid,
                                        .sensor_class = sensor_class_of(sensor_class, {call, "sensor_class"}),
                                        .user_data = user_data}));
  };
}
const auto add_static = adding_static<py::object>("add_static", [](const py::object& shape) {
  return shape_of(shape, {"add_static", "shape"});
});
const auto add_mesh = adding_static<py::object, py::object>(
    "add_mesh", [](const py::object& vertices, const py::object& corners) {
      return Shape(mesh_of(vertices, corners, "add_mesh"));
    });

py::object add_moving_shape(WorldHandle& handle, const py::object& shape, const py::object& position,
                            const py::object& velocity, double acceleration_limit,
                            const py::object& planned_acceleration, double position_error,
                            double velocity_error, std::uint64_t category, std::uint64_t mask,
                            const py::object& group, bool solid, std::uint64_t sensor_class,
                            std::uint64_t user_data, double mass) {
  const std::string_view call = "add_moving_shape";
  const auto turn = handle.take(call);
  const auto vector = [&](const py::object& given, const char* name) {
    return given.is_none() ? Vec3{} : vector_of(given, {call, name}, handle.is_plane());
  };
  const MovingShape moving{{.acceleration_limit = acceleration_limit,
                            .planned_acceleration = vector(planned_acceleration, "planned_acceleration"),
                            .position_error = position_error,
                            .velocity_error = velocity_error,
                            .position = vector(position, "position"),
                            .velocity = vector(velocity, "velocity"),
                            .filter = {category, mask, group_of(group, {call, "group"})},
                            .solid = solid,
                            .sensor_class = sensor_class_of(sensor_class, {call, "sensor_class"}),
                            .user_data = user_data,
                            .mass = mass},
                           shape_of(shape, {call, "shape"})};
  return object_of_added(handle, handle.change([&](auto& to) { return to.add_moving_shape(moving); }));
}

py::object add_zone(WorldHandle& handle, const py::object& shape, std::uint64_t user_data) {
  const auto turn = handle.take("add_zone");
  return object_of_added(handle, handle.world.add_zone(shape_of(shape, {"add_zone", "shape"}), user_data));
}

void remove(WorldHandle& handle, const py::object& bodies) {
  const auto turn = handle.take("remove");
  const Ids named = ids_of(bodies, {"remove", "bodies"});
  require(handle.change([&](auto& of) { return of.remove(named.ids); }));
  end_call(handle);
}

/// Changes one body, or many in order.
template <class Change>
void change_each(WorldHandle& handle, const py::object& bodies, const char* call, const Change& change) {
  const auto turn = handle.take(call);
  const Ids named = ids_of(bodies, {call, "bodies"});
  for (std::size_t k = 0; k < named.ids.size(); ++k) require(change(named.ids[k], k));
  end_call(handle);
}

/// For changes that games leave to their worlds.
World& world_of(World& world) { return world; }
World& world_of(GameWorld& game) { return game.world(); }

/// Binds a call that changes bodies of a world or a game, each in the same way.
template <class Change>
auto changing(const char* call, Change change) {
  return [call, change](WorldHandle& handle, const py::object& bodies) {
    change_each(handle, bodies, call, [&](BodyId body, std::size_t) {
      return handle.change([&](auto& of) { return change(of, body); });
    });
  };
}

/// Returns vectors for bodies: one vector for one id, one in a row for an array of ids.
std::vector<Vec3> vectors_for(WorldHandle& handle, const py::object& bodies, const py::object& vectors,
                              const Argument& argument) {
  const Ids named = ids_of(bodies, {argument.call, "bodies"});
  if (named.is_single) return {vector_of(vectors, argument, handle.is_plane())};
  return vectors_of(vectors, argument, handle.is_plane(), named.ids.size());
}

void set_velocity(WorldHandle& handle, const py::object& bodies, const py::object& velocities) {
  const auto turn = handle.take("set_velocity");
  const Ids named = ids_of(bodies, {"set_velocity", "bodies"});
  const std::vector<Vec3> each = vectors_for(handle, bodies, velocities, {"set_velocity", "velocities"});
  require(handle.change([&](auto& of) {
    return named.is_single ? of.set_velocity(named.ids.front(), each.front())
                           : of.set_velocities(named.ids, each);
  }));
  end_call(handle);
}

/// Reads the states of teleport() and enable().
template <class Change>
void put(WorldHandle& handle, const py::object& bodies, const py::object& positions,
         const py::object& velocities, const char* call, const Change& change) {
  const std::vector<Vec3> places = vectors_for(handle, bodies, positions, {call, "positions"});
  std::vector<Vec3> speeds(places.size());
  if (!velocities.is_none()) speeds = vectors_for(handle, bodies, velocities, {call, "velocities"});
  change_each(handle, bodies, call, [&](BodyId body, std::size_t k) {
    return handle.change([&](auto& of) { return change(of, body, State{places[k], speeds[k]}); });
  });
}

/// Binds a call that changes a part of some bodies to numbers, which read() reads: each_of or each_whole_of.
template <auto part, class Read>
auto changing_to(const char* call, const char* name, Read read) {
  return [=](WorldHandle& handle, const py::object& bodies, const py::object& given) {
    const auto each = read(given, {call, name}, ids_of(bodies, {call, "bodies"}).ids.size());
    BodyChange change;
    change_each(handle, bodies, call, [&](BodyId body, std::size_t k) {
      change.*part = each[k];
      return handle.world.change(body, change);
    });
  };
}

void set_shape(WorldHandle& handle, const py::object& body, const py::object& shape) {
  const auto turn = handle.take("set_shape");
  require(
      handle.world.set_shape(id_of(body, {"set_shape", "body"}), shape_of(shape, {"set_shape", "shape"})));
  end_call(handle);
}

void set_motion_limits(WorldHandle& handle, const py::object& bodies, double acceleration_limit,
                       const py::object& plan, double position_error, double velocity_error) {
  handle.require_moved_by_others("set_motion_limits");
  const MotionLimits limits{acceleration_limit,
                            vector_of(plan, {"set_motion_limits", "planned_acceleration"}, handle.is_plane()),
                            position_error, velocity_error};
  change_each(handle, bodies, "set_motion_limits",
              [&](BodyId body, std::size_t) { return handle.world.change(body, {.motion_limits = limits}); });
}

void set_filter(WorldHandle& handle, const py::object& bodies, std::uint64_t category, std::uint64_t mask,
                const py::object& group) {
  const Filter filter{category, mask, group_of(group, {"set_filter", "group"})};
  change_each(handle, bodies, "set_filter",
              [&](BodyId body, std::size_t) { return handle.world.change(body, {.filter = filter}); });
}

void set_pair_filter(WorldHandle& handle, const py::object& function) {
  const auto turn = handle.take("set_pair_filter");
  require_function(function, {"set_pair_filter", "function"}, "must be a function of (first, second)");
  const auto trouble = trouble_of(function);
  require(handle.world.set_pair_filter(pair_filter_of(function, trouble)));
  handle.filter_trouble = trouble;
  end_call(handle);
}

void set_sensor(WorldHandle& handle, std::uint64_t sensor_class, const py::object& distances,
                std::uint64_t mask) {
  const auto turn = handle.take("set_sensor");
  const Argument argument{"set_sensor", "distances"};
  const Numbers numbers(distances, argument);
  if (numbers.dimensions() > 1) refuse(argument, "must have shape (n,)", "has shape " + numbers.shape());
  Sensor sensor{.mask = mask};
  sensor.distances = each_of(distances, argument, numbers.dimensions() == 0 ? 1 : numbers.length(0));
  require(handle.world.set_sensor(sensor_class_of(sensor_class, {"set_sensor", "sensor_class"}), sensor));
  end_call(handle);
}

}  // namespace

void bind_bodies(WorldClass& world) {
  world
      .def("add", add_bodies, py::arg("positions"), py::arg("velocities") = py::none(),
           py::arg("radii") = 1.0, py::arg("acceleration_limits") = 0.0, py::kw_only(),
           py::arg("planned_accelerations") = py::none(), py::arg("position_errors") = 0.0,
           py::arg("velocity_errors") = 0.0, py::arg("categories") = 1, py::arg("masks") = all_categories,
           py::arg("group") = 0, py::arg("solid") = true, py::arg("sensor_classes") = 0,
           py::arg("user_data") = 0, py::arg("masses") = 1.0, py::arg("contacts") = py::none(),
           R"(Adds bodies at the current time, all of them or, where something is wrong, none.

positions (length): shape (n, 3), or (n, 2) in a world of two dimensions; shape (3,) or (2,) for one body.
velocities (length / time): the same shape; zero without.

What follows is one number for all, or one of each body, shape (n,):
radii (length, >= 0).
acceleration_limits (length / time^2, >= 0): the largest deviation from the planned acceleration.
planned_accelerations (length / time^2): shape (n, 3), or one vector for all.
position_errors (length) and velocity_errors (length / time): how far reports may be off.
categories, masks (64 bits each), and one group (32 bits): which others they may touch; see set_filter().
solid: False for what touches nobody and only senses and is sensed.
sensor_classes (0 to 254).
user_data (64 bits): kept for you.
masses (>= 0, or infinite): every event of the body has it, and bounce(), settle() and Bouncing() use it.

contacts: which contact events these bodies ask for, if not those of the world; see World(). Two bodies report
what either asks for.

Returns the ids: an array of int64, shape (n,), or a BodyId for a single body. Raises InvalidValue that
names the argument and the body. Cost: O(1) each, and a search when the world goes on.)")
      .def("add_motion", add_motion, py::arg("motion"), py::arg("radii") = 1.0, py::kw_only(),
           py::arg("categories") = 1, py::arg("masks") = all_categories, py::arg("group") = 0,
           py::arg("solid") = true, py::arg("sensor_classes") = 0, py::arg("user_data") = 0,
           py::arg("masses") = 1.0, py::arg("contacts") = py::none(),
           R"(Adds all bodies of a motion to a world that never had any: their numbers are their ids.

radii and the others are those of add(): one number, or one of each body. Returns the ids, 0 to n - 1. States
and promises are the motion's at world.time.)")
      .def("add_static", add_static, py::arg("shape"), py::kw_only(), py::arg("category") = 1,
           py::arg("mask") = all_categories, py::arg("group") = 0, py::arg("solid") = true,
           py::arg("sensor_class") = 0, py::arg("user_data") = 0,
           R"(Adds a body that never moves: a Ball, Box, HalfSpace, Triangle or Mesh. Returns its BodyId.

It may reach out of the box of the world; it is never probed. Where space repeats it has to be a Ball.)")
      .def(
          "add_moving_shape", add_moving_shape, py::arg("shape"), py::arg("position"),
          py::arg("velocity") = py::none(), py::arg("acceleration_limit") = 0.0, py::kw_only(),
          py::arg("planned_acceleration") = py::none(), py::arg("position_error") = 0.0,
          py::arg("velocity_error") = 0.0, py::arg("category") = 1, py::arg("mask") = all_categories,
          py::arg("group") = 0, py::arg("solid") = true, py::arg("sensor_class") = 0,
          py::arg("user_data") = 0, py::arg("mass") = 1.0,
          R"(Adds a body that carries a Box, a Triangle or a Mesh, relative to its position: a lift, a door, a piston.

It moves like a body of add(), without turning, and is probed. It meets all bodies, static ones and other moving
shapes too, but no walls of the world. A mass of inf makes a body that no contact turns. Returns its BodyId.)")
      .def("add_zone", add_zone, py::arg("shape"), py::arg("user_data") = 0,
           R"(Adds a zone: it touches nobody and tells who comes in and goes.

Its events are sensor_enter and sensor_leave at distance 0. Zones are of the sensor class zone_class.)")
      .def("add_mesh", add_mesh, py::arg("vertices"), py::arg("corners"), py::kw_only(),
           py::arg("category") = 1, py::arg("mask") = all_categories, py::arg("group") = 0,
           py::arg("solid") = true, py::arg("sensor_class") = 0, py::arg("user_data") = 0,
           R"(Adds a surface of triangles as one body that never moves: add_static(Mesh(vertices, corners)).

vertices: shape (n, 3). corners: shape (m, 3), numbers of vertices, a row for each triangle. Returns the BodyId.
What slides over the edges meets one surface. Events name the triangle: second_part, or first_part if the mesh
is their first body. Cost: O(m log m) once; a ball beside it costs about log m.)")
      .def(
          "reserve",
          [](WorldHandle& handle, std::size_t bodies) {
            const auto turn = handle.take("reserve");
            require(handle.world.reserve(bodies));
          },
          py::arg("bodies"), "Makes room for this many bodies in all, before many are added one by one.")
      .def("remove", remove, py::arg("bodies"),
           R"(Removes a body, or all bodies of an array, or on an error none.

Their contacts end: the end events come next. Ids of removed bodies are stale for ever.)")
      .def("set_velocity", set_velocity, py::arg("bodies"), py::arg("velocities"),
           R"(Tells the world that these velocities (length / time) hold from the current time on.

One id and shape (3,), or n ids and shape (n, 3), all of them or on an error none. The probe has to answer
accordingly.

On an error of a call below that takes several bodies, those before the one that it names have been
changed.)")
      .def(
          "teleport",
          [](WorldHandle& handle, const py::object& bodies, const py::object& positions,
             const py::object& velocities) {
            put(handle, bodies, positions, velocities, "teleport",
                [](auto& of, BodyId body, const State& state) { return of.teleport(body, state); });
          },
          py::arg("bodies"), py::arg("positions"), py::arg("velocities") = py::none(),
          "These bodies are in other states from now on; shapes as in set_velocity().")
      .def("set_radius", changing_to<&BodyChange::radius>("set_radius", "radii", each_of), py::arg("bodies"),
           py::arg("radii"), "The radii (length, >= 0) of these bodies from now on.")
      .def("set_shape", set_shape, py::arg("body"), py::arg("shape"),
           R"(Gives a static body or a zone another shape from now on: it grows, shrinks or moves.

Only true changes are told: who stays inside a zone neither leaves nor enters.)")
      .def("set_radius_rate", changing_to<&BodyChange::radius_rate>("set_radius_rate", "rates", each_of),
           py::arg("bodies"), py::arg("rates"),
           R"(Lets the radii of balls change at these rates (length / time) from now on.

A rate below 0 is that of a ball that shrinks; it stays a point once it is one. Events have the speed at which the
surfaces approach, and body() has the present radius. Such a ball cannot sleep.)")
      .def("set_mass", changing_to<&BodyChange::mass>("set_mass", "masses", each_of), py::arg("bodies"),
           py::arg("masses"), "The masses (>= 0) that events have from now on; see add().")
      .def("set_motion_limits", set_motion_limits, py::arg("bodies"), py::arg("acceleration_limit"),
           py::kw_only(), py::arg("planned_acceleration") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("position_error") = 0.0, py::arg("velocity_error") = 0.0,
           "From now on these bodies move within these limits; see add().")
      .def("disable", changing("disable", [](auto& of, BodyId body) { return of.disable(body); }),
           py::arg("bodies"), "Disabled bodies touch nobody and are not probed. They keep their ids.")
      .def(
          "enable",
          [](WorldHandle& handle, const py::object& bodies, const py::object& positions,
             const py::object& velocities) {
            put(handle, bodies, positions, velocities, "enable",
                [](auto& of, BodyId body, const State& state) { return of.enable(body, state); });
          },
          py::arg("bodies"), py::arg("positions"), py::arg("velocities") = py::none(),
          "These bodies are back, in these states.")
      .def("sleep", changing("sleep", [](auto& of, BodyId body) { return of.sleep(body); }),
           py::arg("bodies"),
           "These bodies stay exactly where they are until they are woken, and cost nothing meanwhile.")
      .def("wake", changing("wake", [](auto& of, BodyId body) { return world_of(of).wake(body); }),
           py::arg("bodies"), "Wakes these bodies, and all resting ones in touch with them.")
      .def("set_filter", set_filter, py::arg("bodies"), py::kw_only(), py::arg("category") = 1,
           py::arg("mask") = all_categories, py::arg("group") = 0,
           R"(Two bodies touch if the category of each has a bit in the mask of the other; of the same
non-zero group, if it is positive.

A body without a filter of its own, as a floor, has the category 1: a mask without that bit lets its body fall
through the floor.)")
      .def("set_pair_filter", set_pair_filter, py::arg("function"),
           R"(A function of two ids that says whether these bodies may touch, or None.

It must be symmetric, and its answers must not change but before refresh_filter(). What it raises comes out of
the call of the world that asked it, and counts as True.)")
      .def(
          "refresh_filter",
          changing("refresh_filter", [](auto& of, BodyId body) { return world_of(of).refresh_filter(body); }),
          py::arg("bodies"),
          "Tells the world that the pair filter's answers about these bodies have changed.")
      .def(
          "set_solid",
          [](WorldHandle& handle, const py::object& bodies, bool solid) {
            change_each(handle, bodies, "set_solid", [&](BodyId body, std::size_t) {
              return handle.world.change(body, {.solid = solid});
            });
          },
          py::arg("bodies"), py::arg("solid"),
          "Whether these bodies touch others from now on, or only sense and are sensed, as zones do.")
      .def("set_sensor", set_sensor, py::arg("sensor_class"), py::arg("distances"),
           py::arg("mask") = all_categories,
           R"(From now on all bodies of this class sense others at these distances (length, each >= 0).

distances: shape (k,), or a number. Each crossing is told by sensor_enter and sensor_leave. The mask says which
categories are sensed. Cost: O(n).)")
      .def(
          "set_sensor_class",
          [](WorldHandle& handle, const py::object& bodies, std::uint64_t sensor_class) {
            const SensorClass given = sensor_class_of(sensor_class, {"set_sensor_class", "sensor_class"});
            change_each(handle, bodies, "set_sensor_class", [&](BodyId body, std::size_t) {
              return handle.world.change(body, {.sensor_class = given});
            });
          },
          py::arg("bodies"), py::arg("sensor_class"),
          "These bodies have the sensor of this class from now on; see set_sensor().")
      .def(
          "set_pair_state",
          [](WorldHandle& handle, const py::object& first, const py::object& second, std::int32_t state) {
            const auto turn = handle.take("set_pair_state");
            require(handle.world.set_pair_state(id_of(first, {"set_pair_state", "first"}),
                                                id_of(second, {"set_pair_state", "second"}), state));
            end_call(handle);
          },
          py::arg("first"), py::arg("second"), py::arg("state"),
          R"(Gives two bodies a state, a number of yours that their events have (Event.pair_state), as for a bond.

It stays until it is set to 0 or one of the two is removed.)")
      .def(
          "pair_state",
          [](WorldHandle& handle, const py::object& first, const py::object& second) {
            const auto turn = handle.take("pair_state");
            return handle.world
                .pair_state(id_of(first, {"pair_state", "first"}), id_of(second, {"pair_state", "second"}))
                .value();
          },
          py::arg("first"), py::arg("second"), "The state of two bodies; 0 if it was never set.")
      .def(
          "turn_back",
          [](WorldHandle& handle, const Event& crossing) {
            const auto turn = handle.take("turn_back");
            require(handle.world.turn_back(crossing));
            end_call(handle);
          },
          py::arg("crossing"),
          R"(At a sensor_enter or sensor_leave: your velocities have turned the two back, so they have not crossed.

They stay on their side of the sensor distance; the event comes again if they do cross it.)")
      .def(
          "schedule",
          [](WorldHandle& handle, double time, std::uint64_t user_data, double period) {
            const auto turn = handle.take("schedule");
            require(handle.world.schedule({.time = time, .user_data = user_data, .period = period}));
            end_call(handle);
          },
          py::arg("time"), py::arg("user_data") = 0, py::arg("period") = 0.0,
          R"(Schedules an event of kind timer at this time, after all others of it: first_user_data is user_data.

With a period (time, > 0) it comes again after each.)")
      .def(
          "unschedule",
          [](WorldHandle& handle, std::uint64_t user_data) {
            const auto turn = handle.take("unschedule");
            const std::size_t removed = handle.world.unschedule(user_data).value();
            end_call(handle);
            return removed;
          },
          py::arg("user_data"), "Removes all timers with these data. Returns how many there were.")
      .def("set_user_data", changing_to<&BodyChange::user_data>("set_user_data", "data", each_whole_of),
           py::arg("bodies"), py::arg("data"),
           "Stores one whole number for all, or one of each body, shape (n,): events have it.");
}

}  // namespace kinesphere::python
