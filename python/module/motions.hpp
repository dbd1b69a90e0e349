// Ready-made motions: nothing of Python is called for their states.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

#include "guard.hpp"
#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/motion.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// A motion as Python has it. It stands still in memory, as movers and maps refer to it.
struct MotionHandle {
  explicit MotionHandle(std::unique_ptr<Motion> held) : motion(std::move(held)) {}
  std::unique_ptr<Motion> motion;
  InUse in_use{};
};

/// The class of each kind of motion is one of these, so that functions of the kind find it.
template <class Kind>
struct HandleOf : MotionHandle {
  explicit HandleOf(Result<Kind> created) : HandleOf(std::make_unique<Kind>(std::move(created).value())) {}
  explicit HandleOf(std::unique_ptr<Motion> held) : MotionHandle(std::move(held)) {}
  Kind& get() const { return static_cast<Kind&>(*motion); }
};

/// A map with the motions that it knows bodies of, which live as long as it does.
struct BodyMapHandle {
  BodyMap map{};
  std::vector<py::object> motions{};
  InUse in_use{};
};

/// Of the class that this kind of motion has in Python.
py::object object_of(std::unique_ptr<Motion> motion);

void bind_motions(py::module_& module);

}  // namespace kinesphere::python
