// Ready-made motions: their states need no call of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "guard.hpp"
#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/motion.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// A motion as Python has it. Its address is fixed, since sources and maps refer to it.
struct MotionHandle {
  explicit MotionHandle(std::unique_ptr<Motion> held) : motion(std::move(held)) {}
  std::unique_ptr<Motion> motion;
  InUse in_use{};

  InUse::Use take(std::string_view call) { return in_use.take_alone(call, "motion"); }
};

/// Each kind of motion is bound as a class derived from this, so that its functions find the type.
template <class Kind>
struct HandleOf : MotionHandle {
  explicit HandleOf(Result<Kind> created) : HandleOf(std::make_unique<Kind>(std::move(created).value())) {}
  explicit HandleOf(std::unique_ptr<Motion> held) : MotionHandle(std::move(held)) {}
  Kind& get() const { return static_cast<Kind&>(*motion); }
};

/// A map with its motions, which live as long as it does.
struct BodyMapHandle {
  std::unique_ptr<BodyMap> map = std::make_unique<BodyMap>();
  std::vector<py::object> motions{};
  InUse in_use{};
};

/// Returns an object of the Python class of this kind of motion.
py::object object_of(std::unique_ptr<Motion> motion);

void bind_motions(py::module_& module);

}  // namespace kinesphere::python
