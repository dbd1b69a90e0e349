// The module kinesphere._kinesphere: the library as the Python package sees it.
#include <pybind11/pybind11.h>

#include <string>

#include "errors.hpp"
#include "kinesphere/body_id.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/version.hpp"
#include "monitor.hpp"
#include "motions.hpp"
#include "mover.hpp"
#include "moving.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {

PYBIND11_MODULE(_kinesphere, module) {
  module.attr("version") = std::string(version);
  module.attr("no_body") = no_body.pack();
  module.attr("zone_class") = zone_class;
  bind_errors(module);
  bind_shapes(module);
  bind_events(module);
  bind_motions(module);
  bind_moving(module);
  bind_mover(module);
  bind_world(module);
  bind_body_map(module);
  bind_replay(module);
  bind_placement(module);
  bind_scenes(module);
  bind_tracks(module);
  bind_paths(module);
  bind_monitor(module);
  bind_arguments(module);
  // Users see the names of the package.
  for (const auto& [name, member] : py::reinterpret_borrow<py::dict>(module.attr("__dict__")))
    if (py::isinstance<py::type>(member)) py::setattr(member, "__module__", py::str("kinesphere"));
}

}  // namespace kinesphere::python
