// The scenes of the command-line program, to the last bit.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "definitions.hpp"
#include "errors.hpp"
#include "exchange.hpp"
#include "motions.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

template <class Value>
void set(const py::object& given, Value& parameter) {
  if (!given.is_none()) parameter = given.cast<Value>();
}

std::shared_ptr<SceneHandle> scene_of(const SceneParameters& parameters) {
  auto made = [&] {
    const py::gil_scoped_release released;
    return make_scene(parameters);
  }();
  return std::make_shared<SceneHandle>(std::move(made).value(), parameters);
}

std::shared_ptr<SceneHandle> create_scene(const std::string& name, const py::object& bodies,
                                          const py::object& seed, const py::object& seconds,
                                          const py::object& packing, const py::object& radius_min,
                                          const py::object& radius_max, const py::object& speed_min,
                                          const py::object& speed_max, const py::object& limit_min,
                                          const py::object& limit_max, const py::object& restitution,
                                          const py::object& contact_tolerance) {
  for (const SceneParameters& known : built_in_scenes()) {
    if (known.name != name) continue;
    SceneParameters parameters = known;
    set(bodies, parameters.bodies);
    set(seed, parameters.seed);
    set(seconds, parameters.seconds);
    set(packing, parameters.packing);
    set(radius_min, parameters.radius_min);
    set(radius_max, parameters.radius_max);
    set(speed_min, parameters.speed_min);
    set(speed_max, parameters.speed_max);
    set(limit_min, parameters.limit_min);
    set(limit_max, parameters.limit_max);
    set(restitution, parameters.restitution);
    set(contact_tolerance, parameters.contact_tolerance);
    return scene_of(parameters);
  }
  refuse({"Scene", "name"}, "must be one of scene_names()", "is \"" + name + "\"");
}

/// A field of a scene file (programs/kinesphere/scenes/scene_file.cpp).
struct SceneField {
  std::string_view name;
  void (*set)(SceneParameters&, const py::object&, const Argument&);
  py::object (*get)(const SceneParameters&);
};

template <auto member>
constexpr SceneField field(std::string_view name) {
  return {name,
          [](SceneParameters& p, const py::object& given, const Argument&) {
            p.*member = given.cast<std::remove_reference_t<decltype(p.*member)>>();
          },
          [](const SceneParameters& p) -> py::object { return py::cast(p.*member); }};
}
template <auto least, auto largest>
constexpr SceneField range_field(std::string_view name) {
  return {name,
          [](SceneParameters& p, const py::object& given, const Argument&) {
            std::tie(p.*least, p.*largest) = given.cast<std::pair<double, double>>();
          },
          [](const SceneParameters& p) -> py::object { return py::make_tuple(p.*least, p.*largest); }};
}
/// `names` are those of the values 0, 1 and so on.
template <auto member, const auto& names>
constexpr SceneField named_field(std::string_view name) {
  return {name,
          [](SceneParameters& p, const py::object& given, const Argument&) {
            const auto found = std::find(names.begin(), names.end(), given.cast<std::string>());
            if (found == names.end()) throw py::cast_error();
            p.*member = static_cast<std::remove_reference_t<decltype(p.*member)>>(found - names.begin());
          },
          [](const SceneParameters& p) -> py::object {
            return py::str(std::string(names[static_cast<std::size_t>(p.*member)]));
          }};
}

constexpr SceneField scene_fields[] = {
    field<&SceneParameters::name>("name"),
    named_field<&SceneParameters::motion, motion_names>("motion"),
    field<&SceneParameters::bodies>("bodies"),
    range_field<&SceneParameters::radius_min, &SceneParameters::radius_max>("radius"),
    range_field<&SceneParameters::speed_min, &SceneParameters::speed_max>("speed"),
    range_field<&SceneParameters::limit_min, &SceneParameters::limit_max>("limit"),
    {"gravity",
     [](SceneParameters& p, const py::object& given, const Argument& argument) {
       p.gravity = vector_of(given, argument, false);
     },
     [](const SceneParameters& p) -> py::object { return array_of(p.gravity); }},
    {"box",
     [](SceneParameters& p, const py::object& given, const Argument& argument) {
       p.box = box_of(given, argument, false).value_or(p.box);
     },
     [](const SceneParameters& p) -> py::object { return py::cast(p.box); }},
    field<&SceneParameters::packing>("packing"),
    field<&SceneParameters::periodic>("periodic"),
    field<&SceneParameters::walls>("walls"),
    field<&SceneParameters::redraw_interval>("redraw_interval"),
    named_field<&SceneParameters::response, response_names>("response"),
    field<&SceneParameters::restitution>("restitution"),
    field<&SceneParameters::resting_speed>("resting_speed"),
    field<&SceneParameters::contact_tolerance>("contact_tolerance"),
    field<&SceneParameters::zeno_interval>("zeno_interval"),
    field<&SceneParameters::seconds>("seconds"),
    field<&SceneParameters::seed>("seed"),
};

/// Makes a scene of the fields of a scene file.
std::shared_ptr<SceneHandle> scene_of_fields(const py::dict& fields) {
  SceneParameters parameters;
  for (const auto& [key, value] : fields) {
    const auto name = py::str(key).cast<std::string>();
    const Argument argument{"read_scene", name};
    const auto* const known = std::find_if(std::begin(scene_fields), std::end(scene_fields),
                                           [&](const SceneField& one) { return one.name == name; });
    if (known == std::end(scene_fields)) refuse(argument, "must be a field of a scene file", "is none");
    try {
      known->set(parameters, py::reinterpret_borrow<py::object>(value), argument);
    } catch (const py::cast_error&) {
      refuse(argument, "must be what a scene file has there", "is " + py::repr(value).cast<std::string>());
    }
  }
  return scene_of(parameters);
}

/// Returns a call that makes the scene again.
py::tuple reduced_scene(const py::object& self) {
  py::dict fields;
  for (const SceneField& one : scene_fields)
    fields[py::str(std::string(one.name))] = one.get(self.cast<const SceneHandle&>().parameters);
  return py::make_tuple(package_attribute("kinesphere.scene_files", "scene_of"), py::make_tuple(fields));
}

}  // namespace

void bind_scenes(py::module_& module) {
  module.def(
      "scene_names",
      [] {
        py::list names;
        for (const SceneParameters& known : built_in_scenes()) names.append(known.name);
        return names;
      },
      "The built-in scenes of the program `kinesphere`: \"paper1\" and so on.");
  module.def("_scene", scene_of_fields, py::arg("fields"));
  const auto none = [](const char* name) { return py::arg(name) = py::none(); };
  py::class_<SceneHandle, std::shared_ptr<SceneHandle>>(
      module, "Scene",
      R"(A built-in scene of the program `kinesphere`, to the last bit.

    scene = Scene("paper1", bodies=500)
    world, motion = World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    events = world.run(scene.end_time, motion, scene)

What may differ from the scene as it is built in is named as in `kinesphere run --help`. read_scene() makes one
of a scene file.)")
      .def(py::init(&create_scene), py::arg("name"), py::kw_only(), none("bodies"), none("seed"),
           none("seconds"), none("packing"), none("radius_min"), none("radius_max"), none("speed_min"),
           none("speed_max"), none("limit_min"), none("limit_max"), none("restitution"),
           none("contact_tolerance"))
      .def_readonly("name", &SceneHandle::name)
      .def_property_readonly(
          "definition", [](const SceneHandle& scene) { return arguments_of(scene.world); },
          "World(**scene.definition).")
      .def_property_readonly(
          "radii",
          [](const SceneHandle& scene) {
            std::vector<double> radii;
            for (const SceneBody& body : scene.bodies) radii.push_back(body.radius);
            return array_of(radii);
          },
          "Of each body (length), shape (n,).")
      .def_property_readonly(
          "masses",
          [](const SceneHandle& scene) {
            std::vector<double> masses;
            for (const SceneBody& body : scene.bodies)
              masses.push_back(body.radius * body.radius * body.radius);
            return array_of(masses);
          },
          "The cubes of the radii, shape (n,): Bouncing(scene.masses, scene.restitution) answers as the "
          "scene does.")
      .def_readonly("end_time", &SceneHandle::end_time)
      .def_readonly("restitution", &SceneHandle::restitution)
      .def(
          "motion", [](const SceneHandle& scene) { return object_of(scene.motion->clone()); },
          "What moves the bodies, from the start: a new Motion each time.")
      .def("__len__", [](const SceneHandle& scene) { return scene.bodies.size(); })
      .def("__repr__",
           [](const SceneHandle& scene) {
             return py::str("<Scene {}: {} bodies, until {}>")
                 .format(scene.name, scene.bodies.size(), scene.end_time);
           })
      .def("__reduce__", reduced_scene);
}

}  // namespace kinesphere::python
