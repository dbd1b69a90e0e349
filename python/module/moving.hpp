// Motion sources and responses that Python passes to calls of a world.
#pragma once

#include <pybind11/pybind11.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "guard.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/run.hpp"
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
  /// Returns the interruptions for the other callbacks of this call.
  Interruptions& interruptions() { return interruptions_; }

 private:
  void ask(std::span<const BodyId> ids, double time, std::span<State> states);
  void keep_to_itself(InUse& in_use, std::string_view what) {
    turns_.push_back(in_use.take_alone(call_, what));
  }

  std::string call_;
  bool plane_;
  py::object given_;
  std::unique_ptr<MotionSource> mover_;
  std::vector<InUse::Use> turns_;
  Interruptions interruptions_;
};

/// The ready-made response: bodies bounce.
class Bouncing {
 public:
  Bouncing(const py::object& masses, double restitution, double resting_speed);
  /// `is_fixed`: returns whether a body is static; its mass counts as infinite.
  template <class IsFixed>
  Response answer(const Event& event, const IsFixed& is_fixed) const;

 private:
  double mass(BodyId body) const;

  std::vector<double> masses_;
  std::optional<double> common_mass_;
  double restitution_;
  double resting_speed_;
};

template <class IsFixed>
Response Bouncing::answer(const Event& event, const IsFixed& is_fixed) const {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (!begins || event.approach_speed <= 0.0) return {};
  const bool is_pair = event.second != no_body;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double first = is_fixed(event.first) ? infinite : mass(event.first);
  const double second = !is_pair ? first : is_fixed(event.second) ? infinite : mass(event.second);
  const Bounce after = resting_speed_ > 0.0 ? settle(event, first, second, restitution_, resting_speed_)
                                            : bounce(event, first, second, restitution_);
  Response answer;
  if (first < infinite) answer.first_velocity = after.first_velocity;
  if (is_pair && second < infinite) answer.second_velocity = after.second_velocity;
  return answer;
}

/// Converts the result of a Python function for an event: None, or a velocity or None for each of
/// the two bodies.
Response answer_of(const py::object& returned, bool plane);

void bind_moving(py::module_& module);

}  // namespace kinesphere::python
