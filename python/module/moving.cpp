#include "moving.hpp"

#include <cmath>
#include <limits>

#include "errors.hpp"
#include "exchange.hpp"
#include "mover.hpp"

namespace kinesphere::python {
namespace {

/// A motion source that lets Ctrl-C through.
template <class Moving>
class Interruptible final : public MotionSource {
 public:
  Interruptible(Moving moving, Interruptions& interruptions)
      : moving_(std::move(moving)), interruptions_(interruptions) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    interruptions_.look();
    moving_.states(ids, time, states);
  }
  MotionOrigin origin(BodyId body) const override { return moving_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& departure) override {
    moving_.set_origin(body, departure);
  }

 private:
  Moving moving_;
  Interruptions& interruptions_;
};

/// Returns true for (velocity, angular velocity), false for a velocity, which has numbers.
bool has_spin(py::handle given) {
  if (PyTuple_Check(given.ptr()) == 0 || PyTuple_GET_SIZE(given.ptr()) != 2) return false;
  const auto is_number = [&](Py_ssize_t k) {
    const py::handle item = PyTuple_GET_ITEM(given.ptr(), k);
    return !item.is_none() && !py::hasattr(item, "__len__");
  };
  return !is_number(0) && !is_number(1);
}

template <class Moving>
std::unique_ptr<MotionSource> interruptible(Moving moving, Interruptions& interruptions) {
  return std::make_unique<Interruptible<Moving>>(std::move(moving), interruptions);
}

}  // namespace

Asked::Asked(const py::object& given, std::string_view call, bool plane)
    : call_(call), plane_(plane), given_(py::reinterpret_borrow<py::object>(given)) {
  if (given.is_none()) {
    refuse({call, "probe"}, "must be a motion or a function of (ids, t)", "is None", ErrorCode::null_probe);
  } else if (py::isinstance<MotionHandle>(given)) {
    mover_ = interruptible(SingleMotionSource(*given.cast<MotionHandle&>().motion), interruptions_);
  } else if (py::isinstance<BodyMapHandle>(given)) {
    map_ = given.cast<BodyMapHandle&>().map.get();
    mover_ = interruptible(map_->source(), interruptions_);
  } else if (py::isinstance<MoverHandle>(given)) {
    mover_ = std::make_unique<FunctionMover>(given.cast<MoverHandle&>(), interruptions_, call_, plane_);
  } else if (PyCallable_Check(given.ptr()) == 0 || PyType_Check(given.ptr()) != 0) {
    refuse_type({call_, "probe"}, "must be a motion or a function of (ids, t)", given);
  }
  take_turns();
}

void Asked::take_turns() {
  const auto take = [this](InUse& in_use, std::string_view what) {
    turns_.push_back(in_use.take_alone(call_, what));
  };
  if (py::isinstance<MotionHandle>(given_)) {
    take(given_.cast<MotionHandle&>().in_use, "motion");
  } else if (py::isinstance<BodyMapHandle>(given_)) {
    auto& handle = given_.cast<BodyMapHandle&>();
    take(handle.in_use, "body map");
    for (const py::object& motion : handle.motions) take(motion.cast<MotionHandle&>().in_use, "motion");
  } else if (py::isinstance<MoverHandle>(given_)) {
    take(given_.cast<MoverHandle&>().in_use, "mover");
  }
}

Probe Asked::probe() {
  return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    if (mover_)
      mover_->states(ids, time, states);
    else
      ask(ids, time, states);
  };
}

void Asked::ask(std::span<const BodyId> ids, double time, std::span<State> states) {
  interruptions_.look(1);
  interruptions_.call([&] { read_states(given_(array_of(ids), time), states, call_, plane_); });
}

Response answer_of_rough(const Event& event, const Roughness& rough) {
  const bool is_begin = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  return is_begin ? response_of(event, bounce(event, rough)) : Response{};
}

namespace {

std::string shown(double number) { return py::repr(py::float_(number)).cast<std::string>(); }

}  // namespace

void require_bounce(std::string_view call, double restitution, double resting_speed) {
  if (!(restitution >= 0.0 && restitution <= 1.0))
    refuse({call, "restitution"}, "must lie in [0, 1]", "is " + shown(restitution));
  if (!(resting_speed >= 0.0 && std::isfinite(resting_speed)))
    refuse({call, "resting_speed"}, "must be finite and >= 0", "is " + shown(resting_speed));
}

Bouncing::Bouncing(const py::object& masses, double restitution, double resting_speed)
    : restitution_(restitution), resting_speed_(resting_speed) {
  const std::string_view call = "Bouncing";
  if (!masses.is_none()) {
    const Numbers numbers(masses, {call, "masses"});
    // Equal masses change nothing, so one number is a restitution without its name.
    if (numbers.dimensions() == 0)
      refuse({call, "masses"},
             "must have one number for each body (a restitution needs its name, as restitution=0.5)",
             "is " + py::repr(masses).cast<std::string>());
    if (numbers.dimensions() > 1)
      refuse({call, "masses"}, "must have shape (n,)", "has shape " + numbers.shape());
    masses_ =
        std::make_shared<const std::vector<double>>(each_of(masses, {call, "masses"}, numbers.length(0)));
    for (const double mass : *masses_)
      if (!(mass > 0.0)) refuse({call, "masses"}, "must be > 0", "is " + shown(mass));
  }
  require_bounce(call, restitution, resting_speed);
}

py::tuple Bouncing::arguments() const {
  const py::object masses = masses_ ? py::object(array_of(*masses_)) : py::none();
  return py::make_tuple(masses, restitution_, resting_speed_);
}

Response Bouncing::answer(const Event& event) const {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (!begins || event.approach_speed <= 0.0) return {};
  const double first = event.first_can_move() ? mass(event.first, event.first_mass) : 1.0;
  const double second = event.second_can_move() ? mass(event.second, event.second_mass) : 1.0;
  return response_of(event, resting_speed_ > 0.0 ? settle(event, first, second, restitution_, resting_speed_)
                                                 : bounce(event, first, second, restitution_));
}

double Bouncing::mass(BodyId body, double own) const {
  if (!masses_) return own;
  if (body.index < masses_->size()) return (*masses_)[body.index];
  throw BadResult({ErrorCode::out_of_range, "masses", body,
                   "run: respond: masses must have one number for each body, but has " +
                       std::to_string(masses_->size()) + ", and none for body " + to_string(body)});
}

namespace {

/// Returns nothing for what is no state of a pair.
std::optional<std::int32_t> state_of(py::handle given) {
  if (PyIndex_Check(given.ptr()) == 0) return std::nullopt;
  try {
    return py::reinterpret_borrow<py::object>(given).cast<std::int32_t>();
  } catch (const py::cast_error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<ReadyResponse::One> ReadyResponse::one_of(py::handle given) {
  if (py::isinstance<Bouncing>(given)) return given.cast<const Bouncing&>();
  if (py::isinstance<Roughness>(given)) return given.cast<const Roughness&>();
  if (py::isinstance<StepPotential>(given)) return given.cast<const StepPotential&>();
  return std::nullopt;
}

std::optional<ReadyResponse> ReadyResponse::of(const py::object& given, std::string_view call) {
  ReadyResponse ready;
  ready.for_all_ = one_of(given);
  if (ready.for_all_) return ready;
  if (PyDict_Check(given.ptr()) == 0) return std::nullopt;
  const std::string name = std::string(call) + ": respond: ";
  for (const auto& [key, response] : given.cast<py::dict>()) {
    const auto state = state_of(key);
    if (!state)
      throw py::type_error(name + "keys must be states of pairs, whole numbers of 32 bits, but one is " +
                           py::repr(key).cast<std::string>());
    const auto one = one_of(response);
    if (!one)
      throw py::type_error(name + "values must be a Bouncing, a Roughness or a StepPotential, but one is " +
                           py::repr(response).cast<std::string>());
    ready.by_state_.emplace(*state, *one);
  }
  return ready;
}

Response ReadyResponse::operator()(const Event& event) const {
  const One* one = for_all_ ? &*for_all_ : nullptr;
  if (one == nullptr) {
    const auto found = by_state_.find(event.pair_state);
    if (found == by_state_.end()) return {};
    one = &found->second;
  }
  if (const auto* const bouncing = std::get_if<Bouncing>(one)) return bouncing->answer(event);
  if (const auto* const rough = std::get_if<Roughness>(one)) return answer_of_rough(event, *rough);
  return std::get<StepPotential>(*one).respond(event);
}

bool ReadyResponse::any(bool (Bouncing::*holds)() const) const {
  const auto does = [holds](const One& one) {
    const auto* const bouncing = std::get_if<Bouncing>(&one);
    return bouncing != nullptr && (bouncing->*holds)();
  };
  return (for_all_ && does(*for_all_)) ||
         std::any_of(by_state_.begin(), by_state_.end(), [&](const auto& each) { return does(each.second); });
}

namespace {

/// Converts the name of an action that a response has in place of the velocity of a body.
BodyAction action_of(py::handle given, const char* body) {
  const auto name = given.cast<std::string>();
  for (const BodyAction action : {BodyAction::remove, BodyAction::disable, BodyAction::sleep})
    if (name == name_of(action)) return action;
  refuse({"run: respond", body}, "must be a velocity, None, 'remove', 'disable' or 'sleep'",
         "is " + py::repr(given).cast<std::string>());
}

}  // namespace

Response answer_of(const py::object& returned, bool plane) {
  if (returned.is_none()) return {};
  const bool is_sequence = PyTuple_Check(returned.ptr()) != 0 || PyList_Check(returned.ptr()) != 0;
  const Py_ssize_t size = is_sequence ? PySequence_Fast_GET_SIZE(returned.ptr()) : 0;
  Response response;
  response.stop = size == 3 && py::str("stop").equal(py::handle(PySequence_Fast_ITEMS(returned.ptr())[2]));
  if (size != 2 && !response.stop)
    refuse({"run", "respond"},
           "must return None, (first velocity, second velocity) or (first velocity, second velocity, 'stop')",
           "returned " + py::repr(returned).cast<std::string>());
  const auto set = [&](py::handle given, const char* name, bool in_plane, std::optional<Vec3>& value) {
    if (!given.is_none()) value = vector_of(given, {"run: respond", name}, in_plane);
  };
  const auto set_body = [&](Py_ssize_t k, const char* name, std::optional<Vec3>& velocity,
                            const char* spin_name, std::optional<Vec3>& spin, BodyAction& action) {
    const py::handle given = PySequence_Fast_ITEMS(returned.ptr())[k];
    if (PyUnicode_Check(given.ptr()) != 0) {
      action = action_of(given, name);
      return;
    }
    if (!has_spin(given)) return set(given, name, plane, velocity);
    set(PyTuple_GET_ITEM(given.ptr(), 0), name, plane, velocity);
    set(PyTuple_GET_ITEM(given.ptr(), 1), spin_name, false, spin);
  };
  set_body(0, "first_velocity", response.first_velocity, "first_angular_velocity",
           response.first_angular_velocity, response.first_action);
  set_body(1, "second_velocity", response.second_velocity, "second_angular_velocity",
           response.second_angular_velocity, response.second_action);
  return response;
}

void bind_moving(py::module_& module) {
  py::class_<Bouncing>(
      module, "Bouncing",
      R"(A ready-made response for World.run(): bodies bounce off each other, walls and static bodies.

masses (> 0) is an array with one at the index of each body; without, the bodies have the masses of add(). Static bodies count as infinitely heavy. restitution lies in [0, 1]. With a
resting_speed (length / time) bodies come to rest as settle() has them.)")
      .def(py::init<const py::object&, double, double>(), py::arg("masses") = py::none(),
           py::arg("restitution") = 1.0, py::arg("resting_speed") = 0.0)
      .def("__repr__",
           [](const Bouncing& bouncing) {
             const py::tuple given = bouncing.arguments();
             const bool is_array = py::hasattr(given[0], "shape");
             return py::str("Bouncing(masses={}, restitution={}, resting_speed={})")
                 .format(is_array ? py::str("<{} numbers>").format(py::len(given[0])) : py::str(given[0]),
                         given[1], given[2]);
           })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(self.get_type(), self.cast<const Bouncing&>().arguments());
      });
  py::class_<Roughness>(
      module, "Roughness",
      R"(A ready-made response for World.run(): rough balls that turn each other, by Walton's model.

The balls are rigid bodies of one Ball around their position (World.add_rigid_body). restitution (0 to 1): along
the normal; tangential_restitution (-1 to 1): of a contact that sticks, -1 is smooth and 1 loses no energy;
friction (>= 0): the coefficient beyond which it slides; inertia (> 0): the moment of inertia in units of mass and
squared radius, 0.4 for solid spheres, 0.5 for discs. For one contact: bounce_rigid(contact, Roughness(...)).)")
      .def(py::init([](double restitution, double tangential_restitution, double friction, double inertia) {
             const auto require_that = [](bool holds, const char* name, const char* expectation,
                                          double given) {
               if (!holds) refuse({"Roughness", name}, expectation, "is " + shown(given));
             };
             require_bounce("Roughness", restitution);
             require_that(std::abs(tangential_restitution) <= 1.0, "tangential_restitution",
                          "must lie in [-1, 1]", tangential_restitution);
             require_that(friction >= 0.0, "friction", "must be >= 0", friction);
             require_that(inertia > 0.0 && std::isfinite(inertia), "inertia", "must be finite and > 0",
                          inertia);
             return Roughness{restitution, tangential_restitution, friction, inertia};
           }),
           py::arg("restitution") = 1.0, py::arg("tangential_restitution") = 1.0,
           py::arg("friction") = std::numeric_limits<double>::infinity(), py::arg("inertia") = 0.4)
      .def_readonly("restitution", &Roughness::restitution)
      .def_readonly("tangential_restitution", &Roughness::tangential_restitution)
      .def_readonly("friction", &Roughness::friction)
      .def_readonly("inertia", &Roughness::inertia)
      .def("__repr__", repr_of_parts("restitution", "tangential_restitution", "friction", "inertia"))
      .def("__reduce__", made_of_parts("restitution", "tangential_restitution", "friction", "inertia"));
  py::class_<StepPotential>(
      module, "StepPotential",
      R"(A ready-made response for World.run(): pairs whose potential energy changes in steps with their gap.

distances (length, ascending): gaps between surfaces at which it changes; energies: those of pairs nearer than
each distance, but not than the one before; outside: beyond the last one, infinite for a bond. Give bodies the
sensor of the distances: world.set_sensor(0, potential.distances). Pairs gain or lose what their energy changes
by, or are turned back where they have too little. Contacts bounce with the restitution.)")
      .def(py::init([](const WorldHandle& handle, const py::object& distances, const py::object& energies,
                       double outside, double restitution) {
             const auto all = [](const py::object& given, const Argument& argument) {
               const Numbers numbers(given, argument);
               return each_of(given, argument, numbers.dimensions() == 0 ? 1 : numbers.length(0));
             };
             return StepPotential::create({.distances = all(distances, {"StepPotential", "distances"}),
                                           .energies = all(energies, {"StepPotential", "energies"}),
                                           .outside = outside,
                                           .restitution = restitution},
                                          handle.world.definition())
                 .value();
           }),
           py::arg("world"), py::arg("distances"), py::arg("energies"), py::kw_only(),
           py::arg("outside") = 0.0, py::arg("restitution") = 1.0)
      .def_property_readonly("distances", [](const StepPotential& of) { return of.definition().distances; })
      .def_property_readonly("energies", [](const StepPotential& of) { return of.definition().energies; })
      .def("energy", &StepPotential::energy, py::arg("gap"),
           "The potential energy of a pair with this gap (length).");
}

}  // namespace kinesphere::python
