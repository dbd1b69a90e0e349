// Rigid bodies: their parts and rotations.
#pragma once

#include <pybind11/pybind11.h>

#include "exchange.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere::python {

/// The arguments of add_rigid_body() that World and BodyMap share.
struct RigidArguments {
  const py::object& parts;
  const py::object& orientation;
  const py::object& angular_velocity;
  double angular_acceleration_limit;
  double largest_angular_speed;
  const py::object& inertia;

  RigidBody read(const BodyDefinition& body) const;
};

}  // namespace kinesphere::python
