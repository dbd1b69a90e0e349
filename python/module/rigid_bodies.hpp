// Rigid bodies: their parts and rotations.
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <vector>

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

/// Reads a quaternion, of shape (4,), and one or more of shape (n, 4). Neither checks the length.
Quaternion quaternion_of(const py::object& given, const Argument& argument);
std::vector<Quaternion> quaternions_of(const py::object& given, const Argument& argument);
/// Returns an array of shape (n, 4).
py::object array_of(std::span<const Quaternion> rotations);
/// Returns arrays of shape (n, 4) and (n, 3).
py::tuple arrays_of(std::span<const Rotation> rotations);

}  // namespace kinesphere::python
