// Callbacks of World::run(): a motion source moves the bodies, a response function answers events, and an
// event function receives them.
//
//   SingleMotionSource source(motion);
//   const auto respond = [&](const Event& event) -> Response {
//     if (event.kind != EventKind::contact_begin) return {};
//     return response_of(event, bounce(event, 0.9));
//   };
//   const auto sink = [&](const Event& event) { log(event); };
//   world.run(60.0, source, respond, sink).value();
//
// A loop over World::advance() gives the same result, bit for bit. The loop may do anything at an event,
// whereas run() knows in advance what an event can do, as a function of the event alone: change
// the velocities of its bodies, remove them, disable them or put them to sleep. Where more is to be done, as
// adding bodies, the response asks for a stop (Response::stop), at which the sink may do what the loop may.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "kinesphere/body.hpp"
#include "kinesphere/callback.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere {

/// Time and state of the body's last externally imposed change.
struct MotionOrigin {
  double time = 0.0;
  State state{};

  friend constexpr bool operator==(const MotionOrigin&, const MotionOrigin&) = default;
};

/// Moves the bodies of a world for World::run(). SingleMotionSource adapts a Motion; BodyMap::source()
/// adapts the motions of a BodyMap.
///
/// The origin of a body determines its motion: the state of a body at a time depends on that body, that
/// time and its origin, and on nothing else, neither on earlier queries nor on other bodies. A run queries
/// states in the order of time.
///
/// Threads. A run with several threads calls states() from all of them at the same time, for different
/// bodies; origin() and set_origin() are called alone, in the thread of the run. The functions may throw (see
/// World::run()). None of them may call the world.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Sets states[k] to the state of ids[k] at `time`, as a Probe does.
  virtual void states(std::span<const BodyId> ids, double time, std::span<State> states) = 0;
  /// Returns the motion origin of a body: the time and state of its last change.
  virtual MotionOrigin origin(BodyId body) const = 0;
  /// Makes the body move from this origin from now on. World::run() calls it with the velocity of a
  /// response. If it throws for the second body of an event, the first one gets the origin back that it had
  /// before the event; if it throws then, too, world and motion source disagree about the place of that body.
  virtual void set_origin(BodyId body, const MotionOrigin& origin) = 0;
};

/// What a response does to a body, after the body has got its velocity.
enum class BodyAction : std::uint8_t {
  none,
  remove,   ///< World::remove()
  disable,  ///< World::disable()
  sleep,    ///< World::sleep(), with velocity 0, which the motion source gets as well
};
/// Returns "none", "remove", "disable" or "sleep".
std::string_view name_of(BodyAction action);

/// The effect of an event on its bodies: their velocities (length / time) from the event on, and what else is
/// done to them. A body without both continues unchanged. A response cannot know what earlier responses did
/// at the same time, so it has no effect on a body that was removed, and none but BodyAction::remove on one
/// that was disabled.
struct Response {
  std::optional<Vec3> first_velocity{};
  std::optional<Vec3> second_velocity{};
  /// Of rigid bodies (radians / time). Only a world without a RotationProbe accepts them.
  std::optional<Vec3> first_angular_velocity{};
  std::optional<Vec3> second_angular_velocity{};
  /// Done to the first body, then to the second. The motion source is not told of a removal; the sink may
  /// remove the body there (BodyMap::remove_gone).
  BodyAction first_action = BodyAction::none;
  BodyAction second_action = BodyAction::none;
  /// sensor_enter, sensor_leave: the two have been turned back at the sensor distance (World::turn_back), as
  /// at a step of a potential that they have not the energy to pass. Of no other event.
  bool turned_back = false;
  /// The state of the pair from now on (World::set_pair_state). Only for events of two bodies.
  std::optional<std::int32_t> pair_state{};
  /// The world stops at this event, so that the sink can change it: when the sink receives the event,
  /// World::time() is the time of the event, and every call is allowed that a loop over World::advance() may
  /// make at a stop, but for advance(), events() and run(). So the sink adds bodies, to the world and to its
  /// motion, or teleports them.
  bool stop = false;

  friend constexpr bool operator==(const Response&, const Response&) = default;
};

/// Any callable `Response(const Event&)`. It is called at every event, at ends too, so it looks at
/// Event::kind first: velocities that are exchanged at a contact_end as well turn the two back to each other,
/// for ever. bounce() and settle() leave ends as they are. It must be a pure function, with equal responses
/// to equal events: a run that was interrupted calls it again for the same event, and a DistributedWorld
/// calls it on several ranks, and more than once. It may read data that does not change during the run, such
/// as masses by BodyId::index or by user data. It must not call the world. It may throw. Lifetimes: as for
/// Probe.
using ResponseFn = Callback<Response(const Event& event)>;

/// Any callable `void(const Event&)`. It receives each event once, in the order of events, in the thread
/// that called World::run(). It may do anything except change the world, and may do that at an event whose
/// response has Response::stop. It may throw. Lifetimes: as for Probe.
using EventFn = Callback<void(const Event& event)>;

}  // namespace kinesphere
