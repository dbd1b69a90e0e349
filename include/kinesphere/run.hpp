// Who moves the bodies, answers events and hears of them while World::run goes on by itself.
//
//   SingleMotionSource mover(motion);
//   const auto respond = [&](const Event& event) -> Answer {
//     if (event.kind != EventKind::contact_begin) return {};
//     const Bounce after = bounce(event, 1, 1, 0.9);
//     return {after.first_velocity, after.second_velocity};
//   };
//   const auto sink = [&](const Event& event) { log(event); };
//   world.run(60.0, mover, respond, sink).value();
//
// The same could be written as a loop over World::advance(). The loop may do anything at an event; run()
// knows beforehand what an event can do: change the velocities of its bodies, as a function of the event
// alone.
#pragma once

#include <optional>
#include <span>

#include "kinesphere/body.hpp"
#include "kinesphere/callback.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere {

/// Where a body set out from the last time that anybody changed it, and when.
struct MotionOrigin {
  double time = 0.0;
  State state{};
};

/// Moves the bodies of a world for World::run. Those of a Motion are moved by a SingleMotionSource, those of
/// a BodyMap by BodyMap::source().
///
/// A body moves as its departure says: the state of a body at a time depends on that body, that time and its
/// departure, and on nothing else; not on the times that were asked for before, nor on other bodies. Times
/// may be asked for in any order, from the departure on.
///
/// All three functions are called from several threads at the same time, for different bodies; never for the
/// same body at the same time. They may throw: World::run says what holds then. None of them may call the
/// world.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Sets states[k] to the state of ids[k] at `time`, as a Probe does.
  virtual void states(std::span<const BodyId> ids, double time, std::span<State> states) = 0;
  virtual MotionOrigin origin(BodyId body) const = 0;
  /// From now on the body is one that set out from there. World::run calls it with the velocity of an answer,
  /// and with an earlier departure to take that back: then it may throw only when that is done, as the world
  /// would believe the body to be elsewhere.
  virtual void set_origin(BodyId body, const MotionOrigin& origin) = 0;
};

/// What an event does to its bodies: the velocities that they have from then on. A body that is given none
/// goes on as it did.
struct Response {
  std::optional<Vec3> first_velocity{};
  std::optional<Vec3> second_velocity{};
};

/// Any callable `Answer(const Event&)`. The same event must get the same answer, at any time and in any
/// thread: it is called from several threads at the same time, and may be called again for an event that it
/// has answered already. It may read what does not change during the run, such as masses by BodyId::index or
/// by user data; it may not call the world. It may throw. Lifetimes are those of a Probe.
using ResponseFn = Callback<Response(const Event& event)>;

/// Any callable `void(const Event&)`. It is told each event once, in the order of events, in the thread that
/// called World::run. It may do anything but change the world. It may throw. Lifetimes are those of a Probe.
using EventFn = Callback<void(const Event& event)>;

}  // namespace kinesphere
