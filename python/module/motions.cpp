#include "motions.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/motion/velocity_field.hpp"
#include "rigid_bodies.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Motions have no dimension: arrays with two columns lie in the plane z = 0.
constexpr bool any_dimension = true;

template <class Definition>
Definition with_limits(std::string_view call, const py::object& positions, const py::object& velocities,
                       const py::object& limits, double start_time) {
  Definition definition;
  definition.start = states_of(positions, velocities, call, any_dimension);
  definition.acceleration_limits = each_of(limits, {call, "acceleration_limits"}, definition.start.size());
  definition.start_time = start_time;
  return definition;
}

std::uint32_t number_in_motion(long long number) {
  // An id without a body in the motion stays so.
  const bool is_number = number >= 0 && number < std::numeric_limits<std::uint32_t>::max();
  return is_number ? static_cast<std::uint32_t>(number) : std::numeric_limits<std::uint32_t>::max();
}

/// Returns the named numbers, or those of all present bodies.
std::vector<std::uint32_t> numbers_of(const Motion& motion, const py::object& named, std::string_view call) {
  std::vector<std::uint32_t> numbers;
  if (!named.is_none()) {
    for (const BodyId id : ids_of(named, {call, "numbers"}).ids)
      numbers.push_back(id.generation == 0 ? id.index : no_body.index);
    return numbers;
  }
  for (std::uint32_t number = 0; number < motion.size(); ++number)
    if (motion.contains(number)) numbers.push_back(number);
  return numbers;
}

py::tuple states_at(MotionHandle& handle, const py::object& named, double time, std::string_view call) {
  const auto turn = handle.take(call);
  const std::vector<std::uint32_t> numbers = numbers_of(*handle.motion, named, call);
  std::vector<State> states(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) states[k] = handle.motion->state(numbers[k], time);
  return arrays_of(states);
}

/// Returns false for motions such as recorded tracks, of which nothing can be changed.
bool can_be_undone(const Motion& motion, std::uint32_t number) {
  try {
    motion.origin(number);
    return true;
  } catch (const BadResult&) {
    return false;
  }
}

/// Changes one body, or many: all of them or, where one is refused, none.
template <class Change>
void change_bodies(MotionHandle& handle, const Ids& named, const Change& change) {
  Motion& motion = *handle.motion;
  std::vector<std::pair<std::uint32_t, MotionOrigin>> before;
  for (std::size_t k = 0; k < named.ids.size(); ++k) {
    const BodyId id = named.ids[k];
    const std::uint32_t number = id.generation == 0 ? id.index : no_body.index;
    if (!named.is_single && motion.contains(number) && can_be_undone(motion, number))
      before.emplace_back(number, motion.origin(number));
    const Result<void> done = change(motion, number, k);
    if (done) continue;
    // Undoing the refused change too does nothing.
    for (auto undone = before.rbegin(); undone != before.rend(); ++undone)
      require(motion.set_origin(undone->first, undone->second));
    require(done);
  }
}

/// Returns one vector for one number, one in a row for an array of numbers.
std::vector<Vec3> vectors_for(const Ids& named, const py::object& vectors, const Argument& argument) {
  if (named.is_single) return {vector_of(vectors, argument, any_dimension)};
  return vectors_of(vectors, argument, any_dimension, named.ids.size());
}

void set_velocities(MotionHandle& handle, const py::object& numbers, double t, const py::object& velocities) {
  const auto turn = handle.take("set_velocity");
  const Ids named = ids_of(numbers, {"set_velocity", "numbers"});
  const std::vector<Vec3> each = vectors_for(named, velocities, {"set_velocity", "velocities"});
  change_bodies(handle, named, [&](Motion& motion, std::uint32_t number, std::size_t k) {
    return motion.set_velocity(number, t, each[k]);
  });
}

void teleport_bodies(MotionHandle& handle, const py::object& numbers, double t, const py::object& positions,
                     const py::object& velocities) {
  const auto turn = handle.take("teleport");
  const Ids named = ids_of(numbers, {"teleport", "numbers"});
  const std::vector<Vec3> places = vectors_for(named, positions, {"teleport", "positions"});
  const std::vector<Vec3> speeds = vectors_for(named, velocities, {"teleport", "velocities"});
  change_bodies(handle, named, [&](Motion& motion, std::uint32_t number, std::size_t k) {
    return motion.teleport(number, t, {places[k], speeds[k]});
  });
}

/// Returns the arguments of World.add().
py::dict definitions_at(MotionHandle& handle, double time, const py::object& named) {
  const auto turn = handle.take("definitions");
  const std::vector<std::uint32_t> numbers = numbers_of(*handle.motion, named, "definitions");
  std::vector<State> states;
  std::vector<double> limits, position_errors, velocity_errors;
  std::vector<Vec3> plans;
  for (const std::uint32_t number : numbers) {
    const BodyDefinition body = handle.motion->definition(number, time);
    states.push_back({body.position, body.velocity});
    limits.push_back(body.acceleration_limit);
    position_errors.push_back(body.position_error);
    velocity_errors.push_back(body.velocity_error);
    plans.push_back(body.planned_acceleration);
  }
  const py::tuple arrays = arrays_of(states);
  py::dict definitions;
  definitions["positions"] = arrays[0];
  definitions["velocities"] = arrays[1];
  definitions["acceleration_limits"] = array_of(limits);
  definitions["planned_accelerations"] = array_of(plans);
  definitions["position_errors"] = array_of(position_errors);
  definitions["velocity_errors"] = array_of(velocity_errors);
  return definitions;
}

// What the constructor of a motion needs beside the start of its bodies, for pickle.
constexpr std::array<std::pair<const char*, Outside>, 3> outsides{
    {{"go-on", Outside::go_on}, {"stay", Outside::stay}, {"vanish", Outside::vanish}}};

const char* name_of(Outside outside) {
  return std::find_if(outsides.begin(), outsides.end(),
                      [&](const auto& each) { return each.second == outside; })
      ->first;
}

Outside outside_of(const std::string& name) {
  for (const auto& [each, outside] : outsides)
    if (name == each) return outside;
  refuse({"RecordedTracks", "outside"}, "must be 'go-on', 'stay' or 'vanish'", "'" + name + "'");
}

py::dict common_arguments(const Ballistic& motion) {
  py::dict arguments;
  arguments["gravity"] = py::tuple(array_of(motion.gravity()).attr("tolist")());
  return arguments;
}
py::dict common_arguments(const RandomForces& motion) {
  py::dict arguments;
  arguments["interval"] = motion.interval();
  arguments["seed"] = motion.seed();
  return arguments;
}
py::dict common_arguments(const VelocityField& motion) {
  const auto* const field = motion.field().target<Circulation>();
  if (field == nullptr) throw py::type_error("pickle: the field of the VelocityField must be a Circulation");
  py::dict arguments;
  arguments["field"] = *field;
  arguments["interval"] = motion.interval();
  arguments["response_time"] = motion.response_time();
  return arguments;
}
py::dict common_arguments(const SteeredMotion&) { return {}; }
py::dict common_arguments(const RecordedTracks& motion) {
  py::dict arguments;
  arguments["outside"] = name_of(motion.outside());
  return arguments;
}
py::dict common_arguments(const FrameMotion& motion) {
  py::dict arguments;
  arguments["interval"] = motion.interval();
  arguments["position_error"] = motion.position_error();
  arguments["start_time"] = motion.start_time();
  if (motion.has_rotations()) arguments["rotations"] = array_of(std::span<const Quaternion>());
  return arguments;
}

/// Tries each of these kinds.
template <class Kind, class... Others>
py::dict common_arguments_of(const Motion& motion) {
  if (const auto* const kind = dynamic_cast<const Kind*>(&motion)) return common_arguments(*kind);
  if constexpr (sizeof...(Others) > 0) return common_arguments_of<Others...>(motion);
  throw py::type_error("pickle: motion must be one of the library");
}

/// Tries each of these kinds.
template <class Kind, class... Others>
py::object object_of_kind(std::unique_ptr<Motion> motion) {
  if (dynamic_cast<Kind*>(motion.get()) != nullptr)
    return py::cast(std::make_shared<HandleOf<Kind>>(std::move(motion)));
  if constexpr (sizeof...(Others) > 0) return object_of_kind<Others...>(std::move(motion));
  return py::cast(std::make_shared<MotionHandle>(std::move(motion)));
}

py::object copy_of(MotionHandle& handle) {
  const auto turn = handle.take("copy");
  return object_of(handle.motion->clone());
}

void bind_motion(py::module_& module) {
  py::class_<MotionHandle, std::shared_ptr<MotionHandle>>(module, "Motion", R"(How bodies really move.

Bodies are named by their numbers 0, 1, 2, ..., which are their ids in a world to which they were added in
this order. A motion serves wherever a probe is asked for, and then no Python is called for states. It is
itself the probe motion(ids, t) -> (positions, velocities), to be called by a probe of your own. copy.copy()
makes one that goes its own way.)")
      .def("__len__", [](const MotionHandle& handle) { return handle.motion->size(); })
      .def("__contains__", [](const MotionHandle& handle,
                              long long number) { return handle.motion->contains(number_in_motion(number)); })
      .def(
          "__call__",
          [](MotionHandle& handle, const py::object& ids, double t) {
            return states_at(handle, ids, t, "motion");
          },
          py::arg("ids"), py::arg("t"),
          "Positions and velocities of these bodies at time t: two arrays of shape (n, 3).")
      .def(
          "states",
          [](MotionHandle& handle, double t, const py::object& numbers) {
            return states_at(handle, numbers, t, "states");
          },
          py::arg("t"), py::arg("numbers") = py::none(),
          R"(Positions and velocities of these bodies, or of all, at time t: two arrays of shape (n, 3).

t must not lie before the last change of a body (time_backwards).)")
      .def("definitions", definitions_at, py::arg("t"), py::arg("numbers") = py::none(),
           R"(What a world has to know of these bodies, or of all: their promises and their states at time t.

The arguments of World.add(): world.add(**motion.definitions(0.0), radii=0.5).)")
      .def("set_velocity", set_velocities, py::arg("numbers"), py::arg("t"), py::arg("velocities"),
           R"(Gives bodies new velocities at time t: one number and shape (3,), or n numbers and shape (n, 3).

On an error none has been changed. The world that watches the bodies has to be told too:
World.set_velocity().)")
      .def(
          "teleport", teleport_bodies, py::arg("numbers"), py::arg("t"), py::arg("positions"),
          py::arg("velocities"),
          "Puts bodies into other states at time t; shapes and errors as in set_velocity(). The world has to "
          "be told too: World.teleport().")
      .def(
          "remove",
          [](MotionHandle& handle, long long number) {
            const auto turn = handle.take("remove");
            require(handle.motion->remove(number_in_motion(number)));
          },
          py::arg("number"), "The next body that is added takes its number.")
      .def(
          "origin",
          [](MotionHandle& handle, long long number) {
            const auto turn = handle.take("origin");
            const MotionOrigin from = handle.motion->origin(number_in_motion(number));
            return py::make_tuple(from.time, array_of(from.state.position), array_of(from.state.velocity));
          },
          py::arg("number"), "The last change of a body, or its start: time, position and velocity.")
      .def(
          "write_body",
          [](MotionHandle& handle, long long number) {
            const auto turn = handle.take("write_body");
            std::vector<std::byte> bytes;
            require(handle.motion->write_body(number_in_motion(number), bytes));
            return bytes_of(bytes);
          },
          py::arg("number"),
          "What the motion knows of this body alone, for read_body() of a motion that was made with the same "
          "arguments.")
      .def(
          "read_body",
          [](MotionHandle& handle, const py::object& written) {
            const auto turn = handle.take("read_body");
            const std::vector<std::byte> bytes = bytes_from(written, {"read_body", "bytes"});
            std::span<const std::byte> rest = bytes;
            return handle.motion->read_body(rest).value();
          },
          py::arg("bytes"), "Adds the body that write_body() wrote, and returns its number here.")
      .def("__repr__",
           [](const py::object& self) {
             return py::str("<{} of {} bodies>").format(self.get_type().attr("__name__"), py::len(self));
           })
      .def("__copy__", copy_of)
      .def("__deepcopy__", [](MotionHandle& handle, const py::object&) { return copy_of(handle); })
      .def("_common_arguments",
           [](MotionHandle& handle) {
             const auto turn = handle.take("pickle");
             return common_arguments_of<Ballistic, RandomForces, VelocityField, SteeredMotion, RecordedTracks,
                                        FrameMotion>(*handle.motion);
           })
      .def("__reduce__", [](const py::object& self) {
        return package_attribute("kinesphere.pickles", "reduced_motion")(self);
      });
}

/// Binds a kind of motion, which has the calls of Motion.
template <class Kind>
py::class_<HandleOf<Kind>, MotionHandle, std::shared_ptr<HandleOf<Kind>>> bind_kind(
    py::module_& module, const char* name, const char* documentation) {
  using Handle = HandleOf<Kind>;
  return py::class_<Handle, MotionHandle, std::shared_ptr<Handle>>(module, name, documentation);
}

template <class Class, class Limit = py::arg>
void bind_add_with_limit(Class& kind, const Limit& limit = Limit("acceleration_limit")) {
  using Handle = typename Class::type;
  kind.def(
      "add",
      [](Handle& handle, double t, const py::object& position, const py::object& velocity,
         double acceleration_limit) {
        const auto turn = handle.take("add");
        return handle.get()
            .add(t,
                 {vector_of(position, {"add", "position"}, any_dimension),
                  vector_of(velocity, {"add", "velocity"}, any_dimension)},
                 acceleration_limit)
            .value();
      },
      py::arg("t"), py::arg("position"), py::arg("velocity"), limit,
      "Adds a body that moves on from there at time t, and returns its number.");
}

void bind_ready_made(py::module_& module) {
  bind_kind<Ballistic>(module, "Ballistic",
                       R"(Bodies that fly freely under a common gravity (length / time^2).

positions and velocities have shape (n, 3) or (n, 2); without velocities all are at rest.)")
      .def(py::init([](const py::object& positions, const py::object& velocities, const py::object& gravity,
                       double start_time) {
             const std::string_view call = "Ballistic";
             return std::make_shared<HandleOf<Ballistic>>(
                 Ballistic::create({.start = states_of(positions, velocities, call, any_dimension),
                                    .gravity = vector_of(gravity, {call, "gravity"}, any_dimension),
                                    .start_time = start_time}));
           }),
           py::arg("positions"), py::arg("velocities") = py::none(), py::kw_only(),
           py::arg("gravity") = py::make_tuple(0.0, 0.0, 0.0), py::arg("start_time") = 0.0)
      .def(
          "add",
          [](HandleOf<Ballistic>& handle, double t, const py::object& position, const py::object& velocity) {
            const auto turn = handle.take("add");
            return handle.get()
                .add(t, {vector_of(position, {"add", "position"}, any_dimension),
                         vector_of(velocity, {"add", "velocity"}, any_dimension)})
                .value();
          },
          py::arg("t"), py::arg("position"), py::arg("velocity"),
          "Adds a body that flies on from there at time t, and returns its number.");

  auto random_forces = bind_kind<RandomForces>(
      module, "RandomForces",
      R"(Bodies pushed around by random forces that change at the multiples of `interval` (time).

Each acceleration is drawn uniformly from the ball of radius acceleration_limits (length / time^2): one
number, or one of each body. The draw depends on seed, body and interval alone.)");
  random_forces.def(
      py::init([](const py::object& positions, const py::object& velocities, const py::object& limits,
                  double interval, std::uint64_t seed, double start_time) {
        auto definition =
            with_limits<RandomForcesDefinition>("RandomForces", positions, velocities, limits, start_time);
        definition.interval = interval;
        definition.seed = seed;
        return std::make_shared<HandleOf<RandomForces>>(RandomForces::create(std::move(definition)));
      }),
      py::arg("positions"), py::arg("velocities") = py::none(), py::arg("acceleration_limits") = 1.0,
      py::kw_only(), py::arg("interval") = 0.2, py::arg("seed") = 1, py::arg("start_time") = 0.0);
  bind_add_with_limit(random_forces);

  auto steered = bind_kind<SteeredMotion>(
      module, "SteeredMotion",
      R"(Bodies steered by hand: each keeps its acceleration, at first zero, until it is steered again.)");
  steered
      .def(py::init([](const py::object& positions, const py::object& velocities, const py::object& limits,
                       double start_time) {
             return std::make_shared<HandleOf<SteeredMotion>>(
                 SteeredMotion::create(with_limits<SteeredMotionDefinition>("SteeredMotion", positions,
                                                                            velocities, limits, start_time)));
           }),
           py::arg("positions"), py::arg("velocities") = py::none(), py::arg("acceleration_limits") = 1.0,
           py::kw_only(), py::arg("start_time") = 0.0)
      .def(
          "steer",
          [](HandleOf<SteeredMotion>& handle, long long number, double t, const py::object& acceleration) {
            const auto turn = handle.take("steer");
            require(handle.get().steer(number_in_motion(number), t,
                                       vector_of(acceleration, {"steer", "acceleration"}, any_dimension)));
          },
          py::arg("number"), py::arg("t"), py::arg("acceleration"),
          "Sets the acceleration of a body from t on, no longer than its limit. The world need not hear of "
          "it.");
  bind_add_with_limit(steered);

  py::class_<Circulation>(
      module, "Circulation",
      R"(The velocity field of the paper: up along the centre line of a box, down its sides.)")
      .def(py::init([](const Box& box, double speed) {
             return Circulation{box, speed};
           }),
           py::arg("box"), py::arg("speed"))
      .def_readonly("box", &Circulation::box)
      .def_readonly("speed", &Circulation::speed)
      .def("__repr__", repr_of_parts("box", "speed"))
      .def("__reduce__", made_of_parts("box", "speed"))
      .def(
          "__call__",
          [](const Circulation& field, const py::object& position) {
            return array_of(field(vector_of(position, {"Circulation", "position"}, false)));
          },
          py::arg("position"));
  auto velocity_field = bind_kind<VelocityField>(
      module, "VelocityField",
      R"(Bodies that follow a velocity field as well as their acceleration limits let them.

At the multiples of `interval` (time) each looks at the field; it would reach its velocity in response_time
(time).)");
  velocity_field.def(
      py::init([](const Circulation& field, const py::object& positions, const py::object& velocities,
                  const py::object& limits, double interval, double response_time, double start_time) {
        auto definition =
            with_limits<VelocityFieldDefinition>("VelocityField", positions, velocities, limits, start_time);
        definition.field = field;
        definition.interval = interval;
        definition.response_time = response_time;
        return std::make_shared<HandleOf<VelocityField>>(VelocityField::create(std::move(definition)));
      }),
      py::arg("field"), py::arg("positions"), py::arg("velocities") = py::none(),
      py::arg("acceleration_limits") = 1.0, py::kw_only(), py::arg("interval") = 0.1,
      py::arg("response_time") = 0.5, py::arg("start_time") = 0.0);
  bind_add_with_limit(velocity_field);
}

std::vector<Track> tracks_of(const py::object& given) {
  std::vector<Track> tracks;
  for (const py::handle item : py::reinterpret_borrow<py::iterable>(given)) {
    const py::sequence pair = py::reinterpret_borrow<py::sequence>(item);
    if (py::len(pair) != 2)
      refuse({"RecordedTracks", "tracks"}, "must be pairs (times, positions)",
             "one has " + std::to_string(py::len(pair)) + " things");
    const std::vector<Vec3> positions = vectors_of(pair[1], {"RecordedTracks", "positions"}, any_dimension);
    const std::vector<double> times = each_of(pair[0], {"RecordedTracks", "times"}, positions.size());
    Track& track = tracks.emplace_back();
    for (std::size_t k = 0; k < times.size(); ++k) track.push_back({times[k], positions[k]});
  }
  return tracks;
}

std::vector<Quaternion> pushed_rotations(const py::object& rotations) {
  if (rotations.is_none()) return {};
  return quaternions_of(rotations, {"push", "rotations"});
}

void bind_recorded(py::module_& module) {
  bind_kind<RecordedTracks>(
      module, "RecordedTracks",
      R"(Bodies that go along the natural cubic splines through samples of their positions.

tracks has a pair (times, positions) for each body: times of shape (k,), rising, k >= 2; positions of shape
(k, 3) or (k, 2). The promise of each is the largest acceleration of its curve. Bodies can be removed, but not
be changed.

outside: before its first and after its last sample a body goes straight on ("go-on"), stays at that sample
("stay": its curve begins and ends at rest, which bends its first and last steps), or is not there ("vanish": add
it to a world no earlier and remove it no later than span(body) says, because asking for another time is an
error).)")
      .def(py::init([](const py::iterable& tracks, const std::string& outside) {
             return std::make_shared<HandleOf<RecordedTracks>>(
                 RecordedTracks::create(tracks_of(tracks), outside_of(outside)));
           }),
           py::arg("tracks"), py::kw_only(), py::arg("outside") = "go-on")
      .def(
          "span",
          [](HandleOf<RecordedTracks>& handle, std::uint32_t body) {
            const auto turn = handle.take("span");
            const auto& motion = static_cast<const RecordedTracks&>(*handle.motion);
            return std::pair(motion.first_time(body), motion.last_time(body));
          },
          py::arg("body"), "The times of the body's first and last sample.");

  auto frames = bind_kind<FrameMotion>(
      module, "FrameMotion",
      R"(Bodies of a program that moves them in steps: straight lines between its last two frames.

push(world, positions, time) takes each frame with its time. Frames without a time follow each other after
interval: give the time where frames differ in length.

Velocities are news at every frame: push() informs the world of them, and nothing is promised between frames
but straight motion. acceleration_limits (length / time^2, gravity included) changes that, with one number, or
one of each body. The world need not be informed of a body that keeps its limit, as long as no frame is longer
than interval; after longer frames it is informed where the limit needs it. A limit suits bodies that turn
little, far from others; where velocities jump it costs 10 to 30 times as much. position_error (length) is how
far positions may be off. States can be asked for from previous_time to latest_time. Entries of removed bodies
must be NaN, as in latest().

rotations, quaternions (w, x, y, z) of shape (n, 4), make frames of rigid bodies that turn: each push() then
takes the rotations, too. Between frames a body turns with constant angular velocity, by the shorter way.
BodyMap.add_rigid_body() adds one, whose inertia must be 0, as the frames turn it.)");
  frames
      .def(py::init([](const py::object& positions, const py::object& velocities, const py::object& limits,
                       double interval, double position_error, double start_time,
                       const py::object& rotations) {
             const std::string_view call = "FrameMotion";
             FrameMotionDefinition definition;
             definition.start = vectors_of(positions, {call, "positions"}, any_dimension);
             const std::size_t count = definition.start.size();
             if (!velocities.is_none())
               definition.velocities = vectors_of(velocities, {call, "velocities"}, any_dimension, count);
             definition.acceleration_limits = each_of(limits, {call, "acceleration_limits"}, count);
             definition.interval = interval;
             definition.position_error = position_error;
             definition.start_time = start_time;
             if (!rotations.is_none()) definition.rotations = quaternions_of(rotations, {call, "rotations"});
             return std::make_shared<HandleOf<FrameMotion>>(FrameMotion::create(std::move(definition)));
           }),
           py::arg("positions"), py::arg("velocities") = py::none(),
           py::arg("acceleration_limits") = no_limit, py::kw_only(), py::arg("interval") = 1.0 / 60.0,
           py::arg("position_error") = 0.0, py::arg("start_time") = 0.0, py::arg("rotations") = py::none())
      .def(
          "push",
          [](HandleOf<FrameMotion>& handle, WorldHandle& world, const py::object& positions,
             std::optional<double> time, const py::object& rotations) {
            const std::vector<Vec3> next = vectors_of(positions, {"push", "positions"}, any_dimension);
            const std::vector<Quaternion> turns = pushed_rotations(rotations);
            const auto turn = handle.in_use.take_alone("push", "frames");
            const auto turn_of_world = world.take("push");
            require(handle.get().push(world.world, next, turns, time));
            end_call(world);
          },
          py::arg("world"), py::arg("positions"), py::arg("time") = py::none(), py::kw_only(),
          py::arg("rotations") = py::none(),
          R"(The next frame: the position of every body, shape (n, 3) or (n, 2), at a time after latest_time.

Without a time it comes interval after the latest one. rotations, shape (n, 4), if the motion was made with
them. The world, in which ids are the numbers here, learns all new velocities, so that no contact is missed;
world.time must be latest_time. For other worlds: BodyMap.push().)")
      .def(
          "push",
          [](HandleOf<FrameMotion>& handle, const py::object& positions, std::optional<double> time,
             const py::object& rotations) {
            const std::vector<Quaternion> turns = pushed_rotations(rotations);
            const auto turn = handle.in_use.take_alone("push", "frames");
            require(
                handle.get().push(vectors_of(positions, {"push", "positions"}, any_dimension), turns, time));
          },
          py::arg("positions"), py::arg("time") = py::none(), py::kw_only(),
          py::arg("rotations") = py::none(),
          "The next frame, if no world has to know of a new velocity: all bodies have limits and keep them.")
      .def(
          "latest_rotations",
          [](const HandleOf<FrameMotion>& handle) -> py::object {
            const FrameMotion& motion = handle.get();
            return motion.has_rotations() ? array_of(motion.latest_rotations()) : py::object(py::none());
          },
          "How the bodies are turned at latest_time: shape (n, 4); None for a motion without rotations.")
      .def_property_readonly(
          "has_equal_frames",
          [](const HandleOf<FrameMotion>& handle) { return handle.get().has_equal_frames(); },
          "True while each frame has come interval after the one before, with or without a time of its own.")
      .def(
          "latest", [](const HandleOf<FrameMotion>& handle) { return array_of(handle.get().latest()); },
          "Where the bodies are at latest_time, changes included: shape (n, 3), NaN for removed ones.")
      .def_property_readonly("previous_time",
                             [](const HandleOf<FrameMotion>& handle) { return handle.get().previous_time(); })
      .def_property_readonly("latest_time",
                             [](const HandleOf<FrameMotion>& handle) { return handle.get().latest_time(); })
      .def_property_readonly(
          "latest_frame", [](const HandleOf<FrameMotion>& handle) { return handle.get().latest_frame(); },
          "How many frames have been pushed.")
      .def("__reduce__",
           [](const py::object& self) {
             return package_attribute("kinesphere.pickles", "reduced_frames")(self);
           })
      .def_property_readonly(
          "violation_count",
          [](const HandleOf<FrameMotion>& handle) { return handle.get().violation_count(); })
      .def(
          "violations",
          [](const HandleOf<FrameMotion>& handle) {
            py::list violations;
            for (const FrameViolation& found : handle.get().violations())
              violations.append(
                  py::make_tuple(found.body, found.excess, found.acceleration, array_of(found.velocity)));
            return violations;
          },
          R"(Bodies that violated their limits in the latest frame: tuples of number, excess (length), the
acceleration limit that would have allowed it, and velocity. The world has been informed of them.)");
  frames.def(
      "add",
      [](HandleOf<FrameMotion>& handle, double t, const py::object& position, const py::object& velocity,
         double acceleration_limit, const py::object& orientation) {
        const auto turn = handle.take("add");
        return handle.get()
            .add(t,
                 {vector_of(position, {"add", "position"}, any_dimension),
                  vector_of(velocity, {"add", "velocity"}, any_dimension)},
                 acceleration_limit, quaternion_of(orientation, {"add", "orientation"}))
            .value();
      },
      py::arg("t"), py::arg("position"), py::arg("velocity"), py::arg("acceleration_limit") = no_limit,
      py::arg("orientation") = py::make_tuple(1.0, 0.0, 0.0, 0.0),
      "Adds a body that moves on from there at time t, and returns its number.");
}

}  // namespace

py::object object_of(std::unique_ptr<Motion> motion) {
  return object_of_kind<RandomForces, VelocityField, Ballistic, SteeredMotion, RecordedTracks, FrameMotion>(
      std::move(motion));
}

void bind_motions(py::module_& module) {
  bind_motion(module);
  bind_ready_made(module);
  bind_recorded(module);
}

}  // namespace kinesphere::python
