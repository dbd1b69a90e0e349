// Bodies that a Python function moves, and that a run may give velocities.
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "guard.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Gives the states of bodies from their last origins, which are kept here by index of their ids.
struct MoverHandle {
  py::object function;
  std::vector<MotionOrigin> departures;
  InUse in_use{};

  /// Throws BadResult with unknown_body.
  const MotionOrigin& origin(BodyId body) const;
};

/// Calls the function. Precondition: the GIL is held.
void ask(const MoverHandle& handle, std::span<const BodyId> ids, double time, std::span<State> states,
         std::string_view call, bool plane);

/// The motion source of one call of a world.
class FunctionMover final : public MotionSource {
 public:
  FunctionMover(MoverHandle& handle, Interruptions& interruptions, std::string call, bool plane)
      : handle_(handle), interruptions_(interruptions), call_(std::move(call)), plane_(plane) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    interruptions_.call([&] { ask(handle_, ids, time, states, call_, plane_); });
  }
  MotionOrigin origin(BodyId body) const override { return handle_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& departure) override {
    handle_.departures.at(body.index) = departure;
  }

 private:
  MoverHandle& handle_;
  Interruptions& interruptions_;
  std::string call_;
  bool plane_;
};

void bind_mover(py::module_& module);

}  // namespace kinesphere::python
