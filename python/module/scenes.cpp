// The scenes of the command-line program, to the last bit.
#include <memory>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "motions.hpp"
#include "scenes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

template <class Value>
void set(const py::object& given, Value& parameter) {
  if (!given.is_none()) parameter = given.cast<Value>();
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
    auto made = [&] {
      const py::gil_scoped_release released;
      return make_scene(parameters);
    }();
    return std::make_shared<SceneHandle>(std::move(made).value(), parameters);
  }
  refuse({"Scene", "name"}, "must be one of scene_names()", "is \"" + name + "\"");
}

/// Returns a call that makes the scene again.
py::tuple reduced_scene(const py::object& self) {
  const SceneParameters& given = self.cast<const SceneHandle&>().parameters;
  py::dict arguments;
  arguments["bodies"] = given.bodies;
  arguments["seed"] = given.seed;
  arguments["seconds"] = given.seconds;
  arguments["packing"] = given.packing;
  arguments["radius_min"] = given.radius_min;
  arguments["radius_max"] = given.radius_max;
  arguments["speed_min"] = given.speed_min;
  arguments["speed_max"] = given.speed_max;
  arguments["limit_min"] = given.limit_min;
  arguments["limit_max"] = given.limit_max;
  arguments["restitution"] = given.restitution;
  arguments["contact_tolerance"] = given.contact_tolerance;
  return py::make_tuple(package_attribute("kinesphere.pickles", "made"),
                        py::make_tuple(self.get_type(), py::make_tuple(given.name), arguments));
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
  const auto none = [](const char* name) { return py::arg(name) = py::none(); };
  py::class_<SceneHandle, std::shared_ptr<SceneHandle>>(
      module, "Scene",
      R"(A built-in scene of the program `kinesphere`, to the last bit.

    scene = Scene("paper1", bodies=500)
    world, motion = World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    events = world.run(scene.end_time, motion, scene)

What may differ from the scene as it is built in is named as in `kinesphere run --help`.)")
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
