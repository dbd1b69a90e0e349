// Boxes and other shapes of bodies.
#pragma once

#include <pybind11/pybind11.h>

#include "exchange.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere::python {

/// Reads a kinesphere.Box, or a pair of its corners; nothing for None. In the plane corners may have two
/// numbers: the box then reaches as far above and below z = 0 as half of its longer side.
std::optional<Box> box_of(const py::object& given, const Argument& argument, bool plane);
Shape shape_of(const py::object& given, const Argument& argument);
/// Reads vertices of shape (n, 3) and corners of shape (m, 3). `call` is the name in errors.
Mesh mesh_of(const py::object& vertices, const py::object& corners, const char* call);
py::object object_of(const Shape& shape);

/// A part of a rigid body that Python has as a Hull, and not as a Ball or Capsule.
struct Hull {
  RigidPart part;

  friend bool operator==(const Hull&, const Hull&) = default;
};

void bind_shapes(py::module_& module);

}  // namespace kinesphere::python
