// Boxes and the other shapes of static bodies.
#pragma once

#include <pybind11/pybind11.h>

#include "exchange.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere::python {

/// Reads a kinesphere.Box, or a pair of its corners; nothing for None.
std::optional<Box> box_of(const py::object& given, const Argument& argument);
Shape shape_of(const py::object& given, const Argument& argument);
py::object object_of(const Shape& shape);

void bind_shapes(py::module_& module);

}  // namespace kinesphere::python
