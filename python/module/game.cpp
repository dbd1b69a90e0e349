// Games: worlds that move their own bodies.
#include <memory>
#include <string>
#include <vector>

#include "errors.hpp"
#include "exchange.hpp"
#include "moving.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

/// A game, and what answers its events.
struct GameHandle : WorldHandle {
  GameHandle(GameWorld made, const py::object& given) : WorldHandle(std::move(made)) { answer_by(given); }

  py::object respond;
  Interruptions* interruptions = nullptr;  ///< of the call that advances

  /// Answers events by the object that respond is to be.
  void answer_by(const py::object& given) {
    require(game().set_response(response(given)));
    respond = given;
  }

  /// Lets Ctrl-C through, and the exceptions of a function.
  GameResponse response(const py::object& given) {
    if (given.is_none()) return [this](const Event&) { return interruptions->look(), Response{}; };
    if (const auto ready = ReadyResponse::of(given, "GameWorld"))
      return [this, ready](const Event& event) { return interruptions->look(), (*ready)(event); };
    if (PyCallable_Check(given.ptr()) == 0 || PyType_Check(given.ptr()) != 0)
      refuse_type(
          {"GameWorld", "respond"},
          "must be a Bouncing, a Roughness, a StepPotential, a dict of these or a function of an event",
          given);
    return [this](const Event& event) {
      return interruptions->call([&] { return answer_of(respond(event), is_plane()); });
    };
  }

  /// Calls go(game), which lets time pass.
  template <class Go>
  auto advancing(const char* call, const Go& go) {
    const auto turn = take(call);
    Interruptions own;
    const auto outer = std::exchange(interruptions, &own);
    try {
      auto done = without_gil(*this, [&] { return go(game()); }).value();
      interruptions = outer;
      return done;
    } catch (...) {
      interruptions = outer;
      throw;
    }
  }
};

using GameClass = py::class_<GameHandle, WorldHandle, std::shared_ptr<GameHandle>>;

std::shared_ptr<GameHandle> create_game(const py::object& gravity, const py::object& respond,
                                        const py::kwargs& world) {
  const py::object made = py::type::of<WorldHandle>()(**world);
  const WorldDefinition& definition = made.cast<const WorldHandle&>().world.definition();
  const Vec3 all = vector_of(gravity, {"GameWorld", "gravity"}, definition.dimensions == 2);
  return std::make_shared<GameHandle>(GameWorld::create({.world = definition, .gravity = all}).value(),
                                      respond);
}

std::shared_ptr<GameHandle> clone_game(GameHandle& handle) {
  const auto turn = handle.take("clone");
  auto copy = std::make_shared<GameHandle>(without_gil(handle, [&] { return handle.game().clone(); }).value(),
                                           handle.respond);
  copy->filter_trouble = handle.filter_trouble;
  copy->has_rotation_probe = handle.has_rotation_probe;
  return copy;
}

std::shared_ptr<GameHandle> restored_game(const py::object& snapshot, const py::object& respond,
                                          const py::object& pair_filter) {
  const std::vector<std::byte> bytes = bytes_from(snapshot, {"restore", "snapshot"});
  const auto trouble = trouble_of(pair_filter);
  auto handle = std::make_shared<GameHandle>(
      GameWorld::restore(bytes, {}, pair_filter_of(pair_filter, trouble)).value(), respond);
  handle->filter_trouble = trouble;
  end_call(*handle);
  return handle;
}

py::object step_game(GameHandle& handle, double dt) {
  return handle.advancing("step", [&](GameWorld& game) -> Result<py::object> {
    const auto happened = game.step(dt);
    if (!happened) return happened.error();
    std::vector<EventRecord> records;
    for (const Event& event : *happened) records.push_back(record_of(event));
    const py::gil_scoped_acquire gil;
    return table_of(records);
  });
}

py::object advance_game(GameHandle& handle, double until) {
  const auto next = handle.advancing("advance", [&](GameWorld& game) { return game.advance(until); });
  return next ? py::cast(*next) : py::none();
}

py::object events_of_game(const py::object& self, double until) {
  const py::cpp_function next([self, until] { return advance_game(self.cast<GameHandle&>(), until); });
  return py::module_::import("builtins").attr("iter")(next, py::none());
}

/// An array of shape (n, 3), which stays as it is when the game goes on, and cannot be taken for a way to
/// move bodies.
py::object array_of_all(std::span<const Vec3> vectors) {
  py::object array = array_of(vectors);
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace

void bind_game(py::module_& module, WorldClass& /*world*/) {
  // Between steps alone, or at an event.
  const auto looking = [](const char* call, auto look) {
    return [call, look](GameHandle& handle) {
      const auto turn = handle.take(call);
      return look(handle.game());
    };
  };
  GameClass(module, "GameWorld",
            R"(A world that moves its own bodies, so that a game keeps nothing of them but ids.

Between events each body flies freely, by the gravity of the game and its planned acceleration, so steps of any
length miss nothing. add(), remove(), set_velocity(), teleport(), queries and all else are those of World;
motions, probes, run() and set_motion_limits() are not, and raise StateError.

    game = GameWorld(gravity=(0, 0, -9.81), respond=Bouncing(restitution=0.8), box=((0, 0, 0), (10, 10, 10)))
    ball = game.add((5, 5, 5), radii=0.2)
    events = game.step(1 / 60)  # each frame
    draw(game.positions)
)")
      .def(py::init(&create_game), py::arg("gravity") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("respond") = py::none(),
           R"(gravity (length / time^2): shape (3,), or (2,) in two dimensions; acts on all bodies.
respond: what gives bodies new velocities at an event: a Bouncing, a Roughness, a StepPotential, a dict of these or a
function, as for World.run(), which may depend on the event alone and may not call the game. None: bodies pass through
each other.
All other arguments are those of World, by name.)")
      .def("step", &step_game, py::arg("dt"),
           R"(Goes on by dt > 0, answers all events, and returns them as Events, in order.

When respond raises, the game stands at that event, and the next step goes on from there, with the events of this
one.)")
      .def(
          "advance", &advance_game, py::arg("until"),
          R"(Goes on to the next event, at most to time `until`, and answers it: the Event, or None at `until`.

The game stands at the event then, and may be changed.)")
      .def("events", &events_of_game, py::arg("until"),
           "Goes through all events up to time `until` by advance(): for event in game.events(game.time + "
           "dt).")
      .def_property_readonly("ids",
                             looking("ids", [](const GameWorld& game) { return array_of(game.ids()); }),
                             R"(The bodies that can move, disabled ones too: an array of int64, shape (n,).

The last body takes the place of a removed one. These three arrays are copies, which stay as they are.)")
      .def_property_readonly(
          "positions",
          looking("positions", [](const GameWorld& game) { return array_of_all(game.positions()); }),
          "Where they are, in the order of ids: shape (n, 3), a copy that cannot be changed; teleport() "
          "moves "
          "bodies. On periodic axes positions lie in the box.")
      .def_property_readonly(
          "velocities",
          looking("velocities", [](const GameWorld& game) { return array_of_all(game.velocities()); }),
          "Their velocities, in the order of ids: shape (n, 3), a copy that cannot be changed; "
          "set_velocities() gives them others.")
      .def(
          "index_of",
          [](GameHandle& handle, const py::object& body) {
            const auto turn = handle.take("index_of");
            const BodyId id = id_of(body, {"index_of", "body"});
            (void)handle.game().state(id);
            return *handle.game().index_of(id);
          },
          py::arg("body"),
          "The place of a body in these arrays. Raises BodyError for one that is not in them.")
      .def(
          "set_velocities",
          [](GameHandle& handle, const py::object& velocities) {
            const auto turn = handle.take("set_velocities");
            require(handle.game().set_velocities(
                vectors_of(velocities, {"set_velocities", "velocities"}, handle.is_plane())));
            end_call(handle);
          },
          py::arg("velocities"),
          R"(The velocities of all bodies from now on, in the order of ids, shape (n, 3); on an error of none.

A body that has its velocity already goes on undisturbed.)")
      .def(
          "set_acceleration",
          [](GameHandle& handle, const py::object& body, const py::object& acceleration) {
            const auto turn = handle.take("set_acceleration");
            require(handle.game().set_acceleration(
                id_of(body, {"set_acceleration", "body"}),
                vector_of(acceleration, {"set_acceleration", "acceleration"}, handle.is_plane())));
            end_call(handle);
          },
          py::arg("body"), py::arg("acceleration"),
          "The acceleration of a body beside the gravity (length / time^2): engines, wind.")
      .def_property_readonly(
          "gravity", looking("gravity", [](const GameWorld& game) { return array_of(game.gravity()); }),
          "Acceleration of all bodies (length / time^2), beside that of each.")
      .def(
          "set_gravity",
          [](GameHandle& handle, const py::object& gravity) {
            const auto turn = handle.take("set_gravity");
            require(
                handle.game().set_gravity(vector_of(gravity, {"set_gravity", "gravity"}, handle.is_plane())));
            end_call(handle);
          },
          py::arg("gravity"), "Sets the gravity of the game; wakes all that sleep.")
      .def_property(
          "respond", [](GameHandle& handle) { return handle.respond; },
          [](GameHandle& handle, const py::object& given) {
            const auto turn = handle.take("respond");
            handle.answer_by(given);
          },
          "What answers the events of the game; see GameWorld().")
      .def("clone", &clone_game, "A game of its own that goes on as this one does, to the bit. Cost: O(n).")
      .def("__copy__", &clone_game)
      .def("__deepcopy__", [](GameHandle& handle, const py::object&) { return clone_game(handle); })
      .def_static("restore", &restored_game, py::arg("snapshot"), py::arg("respond") = py::none(),
                  py::arg("pair_filter") = py::none(),
                  "The game that save() wrote. Raises InvalidValue (bad_snapshot) for bytes that are none.")
      .def("__reduce__",
           [](const py::object& self) {
             auto& handle = self.cast<GameHandle&>();
             if (handle.filter_trouble || handle.has_rotation_probe)
               throw py::type_error(
                   "pickle: a game with a pair filter or a rotation probe cannot be pickled, as these are "
                   "code; use save() and GameWorld.restore()");
             return py::make_tuple(package_attribute("kinesphere.recordings", "restored_game"),
                                   py::make_tuple(save(handle), handle.respond));
           })
      .def("__repr__", looking("repr", [](const GameWorld& game) {
             return py::str("<GameWorld of {} bodies at {}>").format(game.ids().size(), game.time());
           }));
}

}  // namespace kinesphere::python
