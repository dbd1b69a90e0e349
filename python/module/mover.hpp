// Bodies that are moved by a function of Python's and may be given velocities by a run.
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "guard.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Says where bodies are from where they set out last, which is kept here, by the index of their ids.
struct MoverHandle {
  py::object function;
  std::vector<MotionOrigin> departures;
  InUse in_use{};

  /// Throws BadResult with unknown_body.
  const MotionOrigin& origin(BodyId body) const;
};

/// Asks the function: under the GIL.
void ask(const MoverHandle& handle, std::span<const BodyId> ids, double time, std::span<State> states,
         std::string_view call, bool plane);

/// Within one call of a world.
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
