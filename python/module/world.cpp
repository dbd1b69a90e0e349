#include "world.hpp"

#include <cmath>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "shapes.hpp"

namespace kinesphere::python {
namespace {

std::string text_of(const Axes& axes) {
  return std::string(axes.x ? "x" : "") + (axes.y ? "y" : "") + (axes.z ? "z" : "");
}

const char* name_of(ContactEvents contacts) {
  return contacts == ContactEvents::all ? "all" : wants_ends(contacts) ? "begin_and_end" : "impacts";
}

std::optional<Filter> wall_filter_of(const py::object& given) {
  constexpr Argument argument{"World", "wall_filter"};
  if (given.is_none()) return std::nullopt;
  const auto wrong = [&] {
    return py::type_error(
        "World: wall_filter must be a dict of whole numbers, such as {\"category\": 2}, but is " +
        py::repr(given).cast<std::string>());
  };
  if (!py::isinstance<py::dict>(given)) throw wrong();
  Filter filter;
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(given)) try {
      const auto name = key.cast<std::string>();
      if (name == "category")
        filter.category = value.cast<std::uint64_t>();
      else if (name == "mask")
        filter.mask = value.cast<std::uint64_t>();
      else if (name == "group")
        filter.group = group_of(value, argument);
      else
        refuse(argument, "must have no other keys than category, mask and group", "has " + name);
    } catch (const py::cast_error&) {
      throw wrong();
    }
  return filter;
}

py::dict dict_of(const Filter& filter) {
  return py::dict(py::arg("category") = filter.category, py::arg("mask") = filter.mask,
                  py::arg("group") = filter.group);
}

std::shared_ptr<WorldHandle> create_world(const py::object& box, const py::object& periodic,
                                          const py::object& wall_filter, int dimensions,
                                          double contact_tolerance, const py::object& separation_distance,
                                          const std::string& contacts, bool allow_overlap,
                                          double zeno_interval, double start_time, bool spread_window_starts,
                                          bool adopt_observed_limits) {
  WorldDefinition definition;
  definition.box = box_of(box, {"World", "box"}, dimensions == 2);
  definition.periodic = axes_of(periodic, {"World", "periodic"}, dimensions == 2);
  definition.wall_filter = wall_filter_of(wall_filter);
  definition.dimensions = dimensions;
  definition.contact_tolerance = contact_tolerance;
  if (!separation_distance.is_none()) {
    definition.separation_distance = separation_distance.cast<double>();
    // NaN stands for the default in the library.
    if (std::isnan(definition.separation_distance))
      refuse({"World", "separation_distance"}, "must be a number", "is nan", ErrorCode::not_finite);
  }
  definition.contacts = contact_events_of(contacts, {"World", "contacts"});
  definition.allow_overlap = allow_overlap;
  definition.zeno_interval = zeno_interval;
  definition.start_time = start_time;
  definition.spread_window_starts = spread_window_starts;
  definition.adopt_observed_limits = adopt_observed_limits;
  return std::make_shared<WorldHandle>(World::create(definition).value());
}

std::shared_ptr<WorldHandle> clone(WorldHandle& handle) {
  const auto turn = handle.take("clone");
  auto copy =
      std::make_shared<WorldHandle>(without_gil(handle, [&] { return handle.world.clone(); }).value());
  copy->filter_trouble = handle.filter_trouble;
  copy->has_rotation_probe = handle.has_rotation_probe;
  copy->undelivered = handle.undelivered;
  return copy;
}

py::bytes save(WorldHandle& handle) {
  const auto turn = handle.take("save");
  return bytes_of(without_gil(handle, [&] { return handle.world.save(); }).value());
}

py::tuple pickled(const py::object& self) {
  auto& handle = self.cast<WorldHandle&>();
  if (handle.filter_trouble)
    throw py::type_error(
        "pickle: a world with a pair filter cannot be pickled, as the filter is code; use save() and "
        "World.restore(snapshot, pair_filter)");
  if (handle.has_rotation_probe)
    throw py::type_error(
        "pickle: a world with a rotation probe cannot be pickled, as the probe is code; use save(), "
        "World.restore(snapshot) and set_rotation_probe()");
  if (!handle.undelivered.empty())
    throw_state_error(
        "run_in_progress", "world",
        "pickle: world must have delivered its events, but a run was interrupted; run it on first");
  return py::make_tuple(package_attribute("kinesphere.recordings", "restored"), py::make_tuple(save(handle)));
}

}  // namespace

Axes axes_of(const py::object& given, const Argument& argument, bool plane) {
  const auto found = [&] { return "is " + py::repr(given).cast<std::string>(); };
  if (py::isinstance<py::bool_>(given)) {
    const bool all = given.cast<bool>();
    return {all, all, all && !plane};
  }
  if (!py::isinstance<py::str>(given))
    throw py::type_error(std::string(argument.call) + ": " + std::string(argument.name) +
                         " must be a bool or a text such as \"xy\", but " + found());
  const auto text = given.cast<std::string>();
  if (text.find_first_not_of("xyz") != std::string::npos)
    refuse(argument, "must be a text of the letters x, y and z", "is \"" + text + "\"");
  const auto has = [&](char axis) { return text.find(axis) != std::string::npos; };
  if (plane && has('z')) refuse(argument, "must be of x and y in two dimensions, such as \"xy\"", found());
  return {has('x'), has('y'), has('z')};
}

py::dict arguments_of(const WorldDefinition& definition) {
  py::dict arguments;
  arguments["box"] = definition.box ? py::cast(*definition.box) : py::none();
  arguments["periodic"] = text_of(definition.periodic);
  arguments["wall_filter"] =
      definition.wall_filter ? py::object(dict_of(*definition.wall_filter)) : py::none();
  arguments["dimensions"] = definition.dimensions;
  arguments["contact_tolerance"] = definition.contact_tolerance;
  arguments["separation_distance"] = std::isnan(definition.separation_distance)
                                         ? py::none()
                                         : py::object(py::float_(definition.separation_distance));
  arguments["contacts"] = name_of(definition.contacts);
  arguments["allow_overlap"] = definition.allow_overlap;
  arguments["zeno_interval"] = definition.zeno_interval;
  arguments["start_time"] = definition.start_time;
  arguments["spread_window_starts"] = definition.spread_window_starts;
  arguments["adopt_observed_limits"] = definition.adopt_observed_limits;
  return arguments;
}

std::shared_ptr<py::object> kept_by_engine(const py::object& function) {
  return {new py::object(function), [](py::object* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

PairFilter pair_filter_of(const py::object& function, const std::shared_ptr<FilterTrouble>& trouble) {
  if (function.is_none()) return {};
  return [shared = kept_by_engine(function), trouble](BodyId first, BodyId second) {
    const py::gil_scoped_acquire gil;
    if (trouble->thrown) return true;
    try {
      return (*shared)(object_of(first), object_of(second)).cast<bool>();
    } catch (...) {
      trouble->thrown = std::current_exception();
      return true;
    }
  };
}

std::shared_ptr<WorldHandle> restored(const py::object& snapshot, const py::object& pair_filter) {
  const std::vector<std::byte> bytes = bytes_from(snapshot, {"restore", "snapshot"});
  std::shared_ptr<FilterTrouble> trouble;
  if (!pair_filter.is_none()) trouble = std::make_shared<FilterTrouble>();
  auto handle =
      std::make_shared<WorldHandle>(World::restore(bytes, pair_filter_of(pair_filter, trouble)).value());
  handle->filter_trouble = trouble;
  end_call(*handle);
  return handle;
}

void bind_world(py::module_& module) {
  WorldClass world(module, "World",
                   R"(Moving spheres with unknown trajectories, and every contact among them, in time order.

Somebody else moves the bodies. The world asks a probe where they are, only when that can matter, and stops
at each event. As long as bodies keep within the limits that they have promised, no two of them overlap by
more than the contact tolerance unreported.

A probe is a ready-made Motion, a BodyMap, or a function f(ids, t) -> (positions, velocities): ids is an
array of int64, shape (n,); both answers have shape (n, 3), or (n, 2) where dimensions is 2. It may raise,
which comes out of the call that asked it, and that call can be repeated.

Bodies are named by ids: whole numbers, which are 0, 1, 2, ... in the order in which bodies were added as
long as none has been removed, so arrays can be indexed by them. Units are yours: lengths, times and so on
must be consistent.

Every call checks what it is handed, and one that raises has changed nothing unless it says so. One thread
at a time may use a world; another one is refused with StateError.)");
  world
      .def(py::init(&create_world), py::kw_only(), py::arg("box") = py::none(), py::arg("periodic") = false,
           py::arg("wall_filter") = py::none(), py::arg("dimensions") = 3,
           py::arg("contact_tolerance") = 1e-6, py::arg("separation_distance") = py::none(),
           py::arg("contacts") = "all", py::arg("allow_overlap") = true, py::arg("zeno_interval") = 0.0,
           py::arg("start_time") = 0.0, py::arg("spread_window_starts") = false,
           py::arg("adopt_observed_limits") = true,
           R"(box: walls, a Box or a pair of corners; without one the world is unbounded.
periodic: True, or axes such as "xy", on which the box repeats instead of having walls.
wall_filter: the filter of all walls, a dict with category, mask and group or some of these (set_filter());
they meet a body as another body with this filter would. Without one they meet every body.
dimensions: 3, or 2 for discs in the plane z = 0; corners may then have two numbers, and True means "xy".
contact_tolerance (length, > 0): a contact begins when the gap is at most this, and no gap falls below minus
this unreported.
separation_distance (length, > contact_tolerance; default 4 of it): a contact ends when the gap has grown to
this.
contacts: which contact events the world reports. "all": a begin and an end for each contact, and a begin for
each further approach in between (event.already_touching). "impacts", for what only bounces: a begin for each
approach, and no ends. "begin_and_end", for contacts that are watched: one begin and one end,
and the first approach if the contact began without one or a response has parted the two.
allow_overlap: when False, add() refuses a body that certainly overlaps another or a wall.
zeno_interval (time, >= 0): contacts of a body that follow each other sooner are marked as repeated, and
bounce() takes no energy from those; otherwise a ball that comes to rest would bounce infinitely often in a
finite time.
spread_window_starts: accepted, without effect.
adopt_observed_limits: a report that breaks the promise of its body raises the body's acceleration_limit to
what explains the report, so that a body whose gravity was forgotten still meets what it falls on. Raises ValueError (InvalidValue) that names the argument.)")
      .def_property_readonly(
          "definition",
          reading("definition", [](const World& made) { return arguments_of(made.definition()); }),
          "What the world was made from: World(**world.definition) makes another one.")
      .def_property_readonly("time", &WorldHandle::time,
                             R"(The current time.

While another thread is at work in the world this is a time that it has reached, at most 0.1 s ago or so;
it takes no lock but the GIL.)")
      .def("__len__", reading("len", [](const World& now) { return now.size(); }))
      .def("__contains__",
           [](WorldHandle& handle, const py::object& body) {
             const auto turn = handle.take("contains");
             return handle.world.contains(id_of(body, {"contains", "body"}));
           })
      .def("__repr__", reading("repr",
                               [](const World& now) {
                                 return py::str("<World of {} bodies at {}>").format(now.size(), now.time());
                               }))
      .def("clone", clone, "A world of its own that goes on as this one does, to the bit. Cost: O(n).")
      .def("__copy__", clone)
      .def("__deepcopy__", [](WorldHandle& handle, const py::object&) { return clone(handle); })
      .def("save", save,
           R"(The whole world as bytes: World.restore() makes one that goes on as this one does, to the bit.

What moves the bodies, and a pair filter, are the caller's to save.)")
      .def_static("restore", restored, py::arg("snapshot"), py::arg("pair_filter") = py::none(),
                  "The world that save() wrote. Raises InvalidValue (bad_snapshot) for bytes that are none.")
      .def("__reduce__", pickled);
  bind_bodies(world);
  bind_rigid_bodies(module, world);
  bind_going_on(module, world);
  bind_answers(module, world);
  bind_inspection(module, world);
}

}  // namespace kinesphere::python
