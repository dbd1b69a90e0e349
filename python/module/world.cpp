#include "world.hpp"

#include <cmath>
#include <string>

#include "definitions.hpp"
#include "errors.hpp"
#include "exchange.hpp"
#include "shapes.hpp"

namespace kinesphere::python {
namespace {

std::optional<Filter> filter_of(const py::object& given, const Argument& argument) {
  if (given.is_none()) return std::nullopt;
  const auto wrong = [&] {
    refuse_type(argument, "must be a dict of whole numbers, such as {\"category\": 2}", given);
  };
  if (!py::isinstance<py::dict>(given)) wrong();
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
      wrong();
    }
  return filter;
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

py::bytes save(WorldHandle& handle) {
  const auto turn = handle.take("save");
  return bytes_of(
      without_gil(handle, [&] { return handle.change([](auto& of) { return of.save(); }); }).value());
}

Axes axes_of(const py::object& given, const Argument& argument, bool plane) {
  if (py::isinstance<py::bool_>(given)) {
    const bool all = given.cast<bool>();
    return {all, all, all && !plane};
  }
  if (!py::isinstance<py::str>(given))
    refuse_type(argument, "must be a bool or a text such as \"xy\"", given);
  const auto text = given.cast<std::string>();
  if (text.find_first_not_of("xyz") != std::string::npos)
    refuse(argument, "must be a text of the letters x, y and z", "is \"" + text + "\"");
  const auto has = [&](char axis) { return text.find(axis) != std::string::npos; };
  if (plane && has('z'))
    refuse(argument, "must be of x and y in two dimensions, such as \"xy\"",
           "is " + py::repr(given).cast<std::string>());
  return {has('x'), has('y'), has('z')};
}

void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   std::optional<Box>& box) {
  box = box_of(given, argument, definition.dimensions == 2);
}
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   Axes& axes) {
  axes = axes_of(given, argument, definition.dimensions == 2);
}
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& /*definition*/,
                   std::optional<Filter>& filter) {
  filter = filter_of(given, argument);
}
void read_argument(const std::string& given, const Argument& argument, const WorldDefinition& /*definition*/,
                   ContactEvents& contacts) {
  contacts = contact_events_of(given, argument);
}
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& /*definition*/,
                   double& number) {
  if (given.is_none()) return;
  number = given.cast<double>();
  if (std::isnan(number)) refuse(argument, "must be a number", "is nan", ErrorCode::not_finite);
}

py::object argument_of(const Axes& axes) {
  return py::str(std::string(axes.x ? "x" : "") + (axes.y ? "y" : "") + (axes.z ? "z" : ""));
}
py::object argument_of(ContactEvents contacts) {
  return py::str(contacts == ContactEvents::all ? "all" : wants_ends(contacts) ? "begin_and_end" : "impacts");
}
py::object argument_of(const std::optional<Filter>& filter) {
  if (!filter) return py::none();
  return py::dict(py::arg("category") = filter->category, py::arg("mask") = filter->mask,
                  py::arg("group") = filter->group);
}

std::shared_ptr<py::object> kept_by_engine(const py::object& function) {
  return {new py::object(function), [](py::object* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

std::shared_ptr<FilterTrouble> trouble_of(const py::object& function) {
  return function.is_none() ? nullptr : std::make_shared<FilterTrouble>();
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
  const auto trouble = trouble_of(pair_filter);
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
  bind_world_arguments(world, [](const WorldDefinition& definition) {
    return std::make_shared<WorldHandle>(World::create(definition).value());
  });
  world
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
      .def("_repr_html_",
           [](const py::object& self) {
             return package_attribute("kinesphere.notebooks", "world_html")(self);
           })
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
  bind_game(module, world);
}

}  // namespace kinesphere::python
