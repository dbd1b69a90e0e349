// Advances a world event by event, or by itself.
#include <memory>
#include <optional>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "mover.hpp"
#include "moving.hpp"
#include "simulation/run/scene_answer.hpp"
#include "threads.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

bool has_any(const MotionHandle& moved) {
  const Motion& motion = *moved.motion;
  for (std::uint32_t number = 0; number < motion.size(); ++number)
    if (motion.contains(number)) return true;
  return false;
}

/// Refuses a motion with bodies for a world in which none ever moved: its bodies were not added.
void require_added(WorldHandle& handle, const py::object& motion, std::string_view call) {
  const auto turn = handle.take(call);
  const Counters& counters = handle.world.counters();
  if (counters.starts > 0 || counters.restarts > 0) return;
  const bool has_bodies =
      (py::isinstance<MotionHandle>(motion) && has_any(motion.cast<MotionHandle&>())) ||
      (py::isinstance<MoverHandle>(motion) && !motion.cast<MoverHandle&>().departures.empty());
  if (!has_bodies) return;
  for (const BodyId body : handle.world.bodies())
    if (!handle.world.body(body).value().is_static) return;
  refuse({call, "motion"}, "must move bodies that have been added to the world (World.add_motion)",
         "there are none");
}

void warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

void note_promise(WorldHandle& handle, const Event& event) {
  if (event.kind == EventKind::bound_violation && !handle.warned_of_promises && !handle.broken)
    handle.broken = event;
}

/// Warns once of a world of a broken promise: what comes of it is easily overlooked. A warning may be an
/// exception, so it comes where no event is lost.
void warn_of_promise(WorldHandle& handle, std::string_view call) {
  if (!handle.broken) return;
  const Event event = *std::exchange(handle.broken, std::nullopt);
  handle.warned_of_promises = true;
  warn(std::string(call) + ": body " + to_string(event.first) + " broke its promise (bound_violation at " +
       py::str(py::float_(event.time)).cast<std::string>() +
       "), so contacts may have been missed before: its acceleration_limit or planned_acceleration is not "
       "that "
       "of its motion, its velocity is not that of its positions, or the world was not told of a change" +
       (event.acceleration_limit > 0.0
            ? "; its acceleration_limit is " +
                  py::str(py::float_(event.acceleration_limit)).cast<std::string>() + " from now on"
            : std::string()));
}

/// Counts idle calls, which could not advance and found no event, and warns of a caller that gives the length
/// of a step in place of its end: nothing would ever happen.
void warn_of_duration(WorldHandle& handle, bool is_idle, double until, std::string_view call) {
  constexpr int many = 16;
  handle.idle_calls = is_idle ? handle.idle_calls + 1 : 0;
  if (handle.idle_calls != many) return;
  warn(std::string(call) + ": until is a time, not a duration: " + std::to_string(many) +
       " calls in a row ended where the world stood, at " + py::str(py::float_(until)).cast<std::string>() +
       "; world.time + dt goes on by dt");
}

/// Calls advance() once; returns its Event, or nothing. Precondition: the GIL is held.
std::optional<Event> advanced(WorldHandle& handle, double until, Asked& asked) {
  const auto turn = handle.take("advance");
  asked.interruptions().at_each_look([&] { handle.reached = handle.world.time(); });
  warn_of_promise(handle, "advance");
  const double before = handle.world.time();
  const std::optional<Event> event =
      without_gil(handle, [&] { return handle.world.advance(until, asked.probe()); }).value();
  if (event) note_promise(handle, *event);
  warn_of_duration(handle, !event && until == before, until, "advance");
  return event;
}

py::object advance(WorldHandle& handle, double until, const py::object& probe) {
  handle.require_moved_by_others("advance");
  require_added(handle, probe, "advance");
  Asked asked(probe, "advance", handle.is_plane());
  const std::optional<Event> event = advanced(handle, until, asked);
  return event ? py::cast(*event) : py::none();
}

/// Iterates over the events of a world up to a time.
class EventIterator {
 public:
  EventIterator(std::shared_ptr<WorldHandle> handle, double until, py::object probe)
      : handle_(std::move(handle)), until_(until), probe_(std::move(probe)) {}

  double until() const { return until_; }

  Event next() {
    handle_->require_moved_by_others("events");
    require_added(*handle_, probe_, "events");
    // Between two events the caller may change the motion.
    Asked asked(probe_, "events", handle_->is_plane());
    const std::optional<Event> event = advanced(*handle_, until_, asked);
    if (!event) throw py::stop_iteration();
    return *event;
  }

 private:
  std::shared_ptr<WorldHandle> handle_;
  double until_;
  py::object probe_;
};

/// Responds to the events of a run.
class Responding {
 public:
  Responding(const py::object& given, const WorldHandle& handle, bool may_stop, Interruptions& interruptions)
      : interruptions_(interruptions),
        may_stop_(may_stop),
        plane_(handle.is_plane()),
        given_(py::reinterpret_borrow<py::object>(given)) {
    if (given.is_none()) return;
    ready_ = ReadyResponse::of(given, "run");
    if (py::isinstance<SceneHandle>(given)) {
      scene_ = &given.cast<const SceneHandle&>();
    } else if (!ready_ && (PyCallable_Check(given.ptr()) == 0 || PyType_Check(given.ptr()) != 0)) {
      refuse_type({"run", "respond"},
                  "must be a Bouncing, a Roughness, a StepPotential, a dict of these, a Scene or a function "
                  "of an event",
                  given);
    }
  }
  explicit operator bool() const { return !given_.is_none(); }
  bool hops() const { return ready_ && ready_->any(&Bouncing::hops); }
  bool settles() const { return ready_ && ready_->any(&Bouncing::settles); }

  /// Needs no GIL.
  Response operator()(const Event& event) const {
    if (ready_) return (*ready_)(event);
    if (scene_ != nullptr) {
      check_known(event.first);
      check_known(event.second);
      return scene_answer(*scene_, event);
    }
    return interruptions_.call([&] {
      const Response response = answer_of(given_(event), plane_);
      if (response.stop && !may_stop_)
        throw py::type_error("run: respond: 'stop' needs at_stop, a function that is called there");
      return response;
    });
  }

 private:
  void check_known(BodyId body) const {
    if (body == no_body || body.index < scene_->bodies.size()) return;
    throw BadResult({ErrorCode::unknown_body, "respond", body,
                     "run: respond must know all bodies, but the scene has no body " + to_string(body)});
  }

  Interruptions& interruptions_;
  bool may_stop_;
  bool plane_;
  py::object given_;
  std::optional<ReadyResponse> ready_;
  const Scene* scene_ = nullptr;
};

/// Warns once of a world nearly all of whose contacts were repeated, of bodies that hop upon each other.
void warn_of_hops(WorldHandle& handle) {
  constexpr std::uint64_t many = 10'000;
  const Counters& counters = handle.world.counters();
  const std::uint64_t contacts =
      counters.count(EventKind::contact_begin) + counters.count(EventKind::wall_begin);
  const std::uint64_t repeated = counters.repeated_contacts;
  if (handle.warned_of_hops || repeated < many || 10 * repeated < 9 * contacts) return;
  handle.warned_of_hops = true;
  const std::string text =
      "run: " + std::to_string(repeated) + " of " + std::to_string(contacts) +
      " contacts followed another one at once, as those of bodies that lie upon each other, "
      "and took no energy: Bouncing(restitution=..., resting_speed=...) lets stacks settle";
  warn(text);
}

/// Warns once of contacts without room, in which bodies lose their energy.
void warn_of_jams(WorldHandle& handle) {
  const std::uint64_t jammed = handle.world.counters().jammed_contacts;
  if (handle.warned_of_jams || jammed == 0) return;
  handle.warned_of_jams = true;
  warn("run: " + std::to_string(jammed) +
       " contacts were jammed: their bodies had no room beyond the contact_tolerance, and parted without "
       "speed, whatever the restitution: a contact_tolerance below the gaps keeps their energy");
}

/// Tells a function, or the bar of the package for True, which time a run has reached.
class Progress {
 public:
  Progress(const py::object& given, double start, double until) {
    if (given.is_none() || given.is(py::bool_(false))) return;
    if (given.is(py::bool_(true))) {
      tell_ = bar_ = package_attribute("kinesphere.progress", "Bar")(start, until);
    } else {
      require_function(given, {"run", "progress"}, "must be a bool or a function of a time");
      tell_ = given;
    }
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (!bar_) return;
    const py::error_scope raised;
    try {
      bar_.attr("close")();
    } catch (py::error_already_set&) {
      PyErr_Clear();
    }
  }
  /// Precondition: the GIL is held.
  void operator()(double time) const {
    if (tell_) tell_(time);
  }

 private:
  py::object tell_;
  py::object bar_;
};

py::object run(WorldHandle& handle, double until, const py::object& motion, const py::object& respond,
               const py::object& sink, const py::object& at_stop, const py::object& threads,
               const py::object& progress, const py::object& events) {
  const auto turn = handle.take("run");
  handle.undelivered.choose(events);
  handle.require_moved_by_others("run");
  require_added(handle, motion, "run");
  Asked asked(motion, "run", handle.is_plane());
  require_function(at_stop, {"run", "at_stop"}, "must be a function of an event");
  const Responding responding(respond, handle, !at_stop.is_none(), asked.interruptions());
  if (responding && asked.mover() == nullptr) {
    throw py::type_error(
        "run: motion must be a Motion, a BodyMap or a MotionSource where there is a respond, as bodies are "
        "given velocities, but is a function; loop over world.events() instead");
  }
  Threads shared(threads);
  const Progress tell(progress, handle.world.time(), until);
  asked.interruptions().at_each_look([&] { tell(handle.reached = handle.world.time()); });
  const auto answer = [&](const Event& event) { return responding(event); };
  const double before = handle.world.time();
  bool has_event = false;
  const auto receive = [&](const Event& event) {
    has_event = true;
    note_promise(handle, event);
    if (responding && asked.map() != nullptr) require(asked.map()->remove_gone(handle.world, event, answer));
    if (sink.is_none()) {
      handle.undelivered.add(record_of(event));
      asked.interruptions().look();
    } else {
      asked.interruptions().call([&] { sink(event); });
    }
    // Inside the sink the world may be changed at a stop alone.
    if (!at_stop.is_none() && handle.world.reserve(0)) asked.call_at_stop([&] { at_stop(event); });
  };
  const Result<void> done = without_gil(handle, [&] {
    if (!responding) return handle.world.run(until, asked.probe(), receive, shared.workers());
    return handle.world.run(until, *asked.mover(), answer, receive, shared.workers());
  });
  require(done);
  tell(handle.world.time());
  if (responding.hops()) warn_of_hops(handle);
  if (responding && !responding.settles()) warn_of_jams(handle);
  warn_of_promise(handle, "run");
  warn_of_duration(handle, !has_event && until == before, until, "run");
  return handle.undelivered.take();
}

}  // namespace

void bind_going_on(py::module_& module, WorldClass& world) {
  py::class_<EventIterator>(module, "EventIterator",
                            "The events of a world up to a time, one by one; see World.events().")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &EventIterator::next)
      .def("__repr__", [](const EventIterator& events) {
        return py::str("<EventIterator until {}>").format(events.until());
      });
  py::class_<Workers>(
      module, "Workers",
      R"(Threads that runs and worlds may use, for those who run often: threads in all, 1 to 256.

They work for one run at a time.)")
      .def(py::init([](int threads) { return Workers::create(threads).value(); }), py::arg("threads"))
      .def_property_readonly("count", &Workers::count)
      .def("__repr__",
           [](const Workers& workers) { return "Workers(" + std::to_string(workers.count()) + ")"; });

  world
      .def("advance", advance, py::arg("until"), py::arg("probe"),
           R"(Goes on to the next event, at most to time `until`: the Event, or None at `until`.

What the probe answers is checked: an answer of another shape, or with a NaN, raises InvalidValue that names
argument and body, is dropped, and the call may be repeated. The same holds when the probe raises.)")
      .def(
          "events",
          [](std::shared_ptr<WorldHandle> handle, double until, py::object probe) {
            return EventIterator(std::move(handle), until, std::move(probe));
          },
          py::arg("until"), py::arg("probe"),
          R"(Goes through all events up to time `until`: for event in world.events(60.0, probe).

In the loop bodies may be changed, added and removed. When it has run to its end, world.time == until; when
it is left early, the world stands at the last event. Each step is an advance().)")
      .def(
          "use_threads",
          [](WorldHandle& handle, const py::object& threads) {
            const auto turn = handle.take("use_threads");
            auto shared = std::make_unique<Threads>(threads);
            require(handle.world.use_workers(shared->workers()));
            handle.threads = std::move(shared);
          },
          py::arg("threads"),
          R"(From now on, so many threads, or Workers, share what a call does for thousands of bodies at one time.

That is so where all velocities change, and where many bodies arrive. 1, as at first: the calling thread alone. They
call no function of yours, and the outcome is the same, bit for bit. Clones and restored worlds begin with 1.)")
      .def("run", run, py::arg("until"), py::arg("motion"), py::arg("respond") = py::none(), py::kw_only(),
           py::arg("sink") = py::none(), py::arg("at_stop") = py::none(), py::arg("threads") = 1,
           py::arg("progress") = py::none(), py::arg("events") = "all",
           R"(Goes on to time `until` by itself and returns all Events, in order.

motion: a Motion or BodyMap, and then no Python is called for states; a MotionSource; without respond any
probe.
respond: what gives bodies new velocities at an event: a Bouncing, a Roughness, a StepPotential; a dict of these for
the states of pairs, as {0: well, 1: bond} (set_pair_state()); a Scene; or a function of the Event that returns None
or (first velocity or None, second velocity or None); for a rigid body a tuple (velocity or None, angular velocity or
None), as bounce_rigid() makes it, may take the place of its velocity; for any body so may 'remove', 'disable' or
'sleep', which do to it what the methods of the world do. (first, second, 'stop') stops the world at this event. It
must depend on the event alone, and may not call the world. Removed bodies leave a BodyMap and its motions, too.
sink: a function that is told each Event, in order; then no Events are returned.
events: "all", "none", or names of columns of Event, such as ("time", "first", "second"): then a structured array of
these alone is returned, 24 bytes an event in place of 384. The Events of an interrupted run come first in what the next
one returns, which has to ask for the same.
at_stop: a function that is told each Event at which the world stops, after the sink. It may change the world, the
motion and the map as a loop over events() may: add bodies, teleport them. It may not advance the world.
threads: how many share the asking of many probes at once, or Workers; the outcome is the same.
progress: a function that is told the time that the run has reached, at most 20 times a second and at the end; or
True for a bar by tqdm, in notebooks too. It may not change the world.

The GIL is released while the engine works, and Ctrl-C interrupts it. When something is raised the world
stands at a stop and can go on with another run; the Events that were told before come first in what that
one returns.)");
}

}  // namespace kinesphere::python
