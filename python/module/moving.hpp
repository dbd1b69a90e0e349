// Motion sources and responses that Python passes to calls of a world.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "guard.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/step_potential.hpp"
#include "motions.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// The source of states: a ready-made motion, a map, or a Python function. Must be made and
/// destroyed under the GIL, and is called without it. Marks ready-made ones as in use until
/// destruction.
class Asked {
 public:
  /// Throws BadResult with null_probe for None, TypeError for an object that cannot be called.
  Asked(const py::object& given, std::string_view call, bool plane);

  Probe probe();
  /// Null for a Python function.
  MotionSource* mover() { return mover_.get(); }
  /// Null unless the source is a map.
  BodyMap* map() { return map_; }
  /// Calls a Python function, under the GIL, that may use the ready-made ones.
  template <class Function>
  void call_at_stop(const Function& function) {
    interruptions_.call([&] {
      turns_.clear();
      function();
      take_turns();
    });
  }
  /// Returns the interruptions for the other callbacks of this call.
  Interruptions& interruptions() { return interruptions_; }

 private:
  void ask(std::span<const BodyId> ids, double time, std::span<State> states);
  /// Marks what gives the states as in use.
  void take_turns();

  std::string call_;
  bool plane_;
  py::object given_;
  std::unique_ptr<MotionSource> mover_;
  BodyMap* map_ = nullptr;
  std::vector<InUse::Use> turns_;
  Interruptions interruptions_;
};

/// Refuses numbers with which bodies would gain energy.
void require_bounce(std::string_view call, double restitution, double resting_speed = 0.0);

/// The ready-made response: bodies bounce.
class Bouncing {
 public:
  Bouncing(const py::object& masses, double restitution, double resting_speed);
  Response answer(const Event& event) const;
  /// True if bodies lose speed in contacts, but not in repeated ones, so that stacks never come to rest.
  bool hops() const { return restitution_ < 1.0 && resting_speed_ == 0.0; }
  /// True if bodies come to rest upon each other. Then jams among them are usual.
  bool settles() const { return resting_speed_ > 0.0; }
  /// Returns the arguments of the constructor.
  py::tuple arguments() const;

 private:
  /// Returns the given mass of a body, or `own` if none were given.
  double mass(BodyId body, double own) const;

  std::shared_ptr<const std::vector<double>> masses_;  ///< null: bodies have masses of their own
  double restitution_;
  double resting_speed_;
};

/// Returns the response of rough balls to a begin.
Response answer_of_rough(const Event& event, const Roughness& rough);

/// A Bouncing, a Roughness or a StepPotential as a response, or one of these for each state of pairs. Needs
/// no GIL.
class ReadyResponse {
 public:
  /// Returns nothing for an object that is none of these. Throws TypeError and InvalidValue, with the name of
  /// the call, for a dict of something else.
  static std::optional<ReadyResponse> of(const py::object& given, std::string_view call);

  Response operator()(const Event& event) const;
  /// True if Bouncing::hops() or Bouncing::settles() holds for one of them.
  bool any(bool (Bouncing::*holds)() const) const;

 private:
  using One = std::variant<Bouncing, Roughness, StepPotential>;

  static std::optional<One> one_of(py::handle given);

  std::optional<One> for_all_;
  std::map<std::int32_t, One> by_state_;  ///< pairs in other states go on as before
};

/// Converts the result of a Python function for an event: None, or for each of the two bodies a velocity, a
/// tuple (velocity, angular velocity), the name of a BodyAction, or None, and possibly "stop" behind them.
Response answer_of(const py::object& returned, bool plane);

void bind_moving(py::module_& module);

}  // namespace kinesphere::python
