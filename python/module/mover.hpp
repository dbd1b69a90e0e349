// Bodies that a Python function moves, and that a run may give velocities.
#pragma once

#include <pybind11/pybind11.h>

#include <limits>
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
      : handle_(handle),
        interruptions_(interruptions),
        call_(std::move(call)),
        plane_(plane),
        answers_(handle.departures.size()) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override { return handle_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& departure) override {
    handle_.departures.at(body.index) = departure;
    answers_.at(body.index).time = std::numeric_limits<double>::quiet_NaN();
  }

 private:
  MoverHandle& handle_;
  Interruptions& interruptions_;
  std::string call_;
  bool plane_;
  /// The last answer of each body that was asked with few others: a response asks again at the time of its
  /// event.
  struct Answer {
    double time = std::numeric_limits<double>::quiet_NaN();
    State state{};
  };
  std::vector<Answer> answers_;  ///< by index of the id
};

void bind_mover(py::module_& module);

}  // namespace kinesphere::python
