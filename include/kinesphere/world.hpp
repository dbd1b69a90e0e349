// A World watches moving spheres with unknown trajectories and reports every contact among them in time
// order.
//
//   #include <kinesphere/kinesphere.hpp>
//   using namespace kinesphere;
//
//   World world = World::create({.box = Box{{0, 0, 0}, {100, 100, 100}}}).value();
//   BodyId ball = world.add({.radius = 1, .acceleration_limit = 10,
//                            .position = {50, 50, 50}, .velocity = {5, 0, 0}}).value();
//   // ... more bodies
//
//   auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
//     for (std::size_t k = 0; k < ids.size(); ++k) states[k] = my_simulation.state(ids[k], time);
//   };
//   for (const Event& event : world.events(60.0, probe)) {
//     if (event.kind == EventKind::contact_begin) {
//       Vec3 bounced = ...;
//       my_simulation.set_velocity(event.first, event.time, bounced);
//       world.set_velocity(event.first, bounced).value();
//     }
//   }
//   // now world.time() == 60
//
// The caller moves the bodies. The world probes the state of a body only when that state can matter, and
// stops at each event. At each stop, also between two events of one instant, the caller may add, remove and
// change bodies.
//
// Guarantee: while every body keeps its motion limits (BodyDefinition), no two bodies overlap by more than
// the contact tolerance without a report. docs/guarantee.md has the proof.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/event_range.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/timer.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// The world's present knowledge of one body, as World::body() returns it.
struct BodyView {
  BodyDefinition definition{};  ///< its state is that of the last report, its radius the present one
  Bound bound{};                ///< time-varying bound, valid since the last report
  /// Box that contains the body and its sensor range from now until box_end. Invalid (box_end == time())
  /// until the next advance() if the body was just added or changed.
  Box box{};
  double box_end;
  /// Periodic axes: the number of whole boxes that the body has travelled beyond the primary image.
  /// definition.position lies in the primary image. Adding image times the box size gives a position on the
  /// path that starts where the caller last placed the body (add, teleport, enable).
  std::array<std::int64_t, 3> image{};
  bool enabled;  ///< false for a disabled body: bound and box are stale then
  /// True for a static body. Its state is that of one point of its shape, and box_end is infinite.
  bool is_static;
  /// True while the body sleeps (World::sleep): it is not probed, and its bound stays constant.
  bool sleeping;
  /// The shape of a static body as the world stores it, that of a moving shape relative to its position, or,
  /// for any other body, a ball at the position of its last report.
  Shape shape{};
  /// A rigid body, with the state and the rotation of its last report; nothing for any other body.
  std::optional<RigidBody> rigid{};

  friend bool operator==(const BodyView&, const BodyView&) = default;
};

/// Properties that World::change() gives a body; those that are not given stay as they are.
struct BodyChange {
  /// As BodyDefinition::radius. Errors: static_body (set_shape() changes a static body); unsupported for a
  /// moving shape and a rigid body.
  std::optional<double> radius{};
  /// Limits within which the body moves from now on. Errors: static_body.
  std::optional<MotionLimits> motion_limits{};
  /// Contacts that the new filter excludes end. Overlaps that it newly admits begin at once, also if
  /// allow_overlap is false.
  std::optional<Filter> filter{};
  /// Whether the body has contacts from now on (BodyDefinition::solid).
  std::optional<bool> solid{};
  std::optional<SensorClass> sensor_class{};
  /// The mass that events have from now on (BodyDefinition::mass). Errors: static_body; not_finite for NaN.
  std::optional<double> mass{};
  std::optional<std::uint64_t> user_data{};
  /// Angular velocity (radians / time) of a rigid body from the current time on, as World::set_velocity()
  /// gives its velocity. Errors: disabled_body; unsupported for a body that is not rigid; not_finite;
  /// out_of_range for more than its largest_angular_speed.
  std::optional<Vec3> angular_velocity{};
  /// Turns a rigid body at once, as World::teleport() moves it. Errors: as for angular_velocity; out_of_range
  /// for an orientation that has not length 1; outside_domain and overlapping as for teleport().
  std::optional<Rotation> rotation{};
  /// Rate at which the radius changes from the current time on (BodyDefinition::radius_rate). Errors:
  /// static_body; not_finite; out_of_range; unsupported for a moving shape and a rigid body.
  std::optional<double> radius_rate{};

  friend constexpr bool operator==(const BodyChange&, const BodyChange&) = default;
};

enum class CallState;
class Recorder;
struct Timings;
class Workers;

/// Moving bodies with unknown trajectories, and every contact among them in time order.
///
/// Errors. Every call validates its arguments in every build type, and a call that returns an error has
/// changed nothing. Besides the errors listed at each call,
///   - a call that names a body may return unknown_body, stale_body (the body has been removed) or
///     foreign_body (another world issued the id);
///   - a call that changes the world or could probe, and every other call that lists probe_in_progress,
///     returns probe_in_progress inside this world's own probe, filter_in_progress inside its own pair
///     filter, and run_in_progress inside the motion source, response function and event function of its
///     own run();
///   - a call that takes a Probe may return null_probe and, for an invalid state, not_finite or
///     out_of_range;
///   - a moved-from world answers every call with moved_from, or throws BadResult where a call returns no
///     Result (result.hpp says which calls return errors and which throw).
///
/// Threads. One thread at a time may use a world; run() and use_workers() may use further threads (Workers).
/// Const calls may run concurrently with other const calls of the same world if its pair filter may be called
/// concurrently. Different worlds, including clones, are independent.
///
/// Lifetimes. References that a world returns (definition(), counters(), sensor()) stay valid until the
/// world is destroyed or assigned to; the referenced values change as the world advances. The reference
/// from sensor() is valid until the next set_sensor(). The spans passed to a probe are valid during that
/// call. Everything else is returned by value.
class World {
 public:
  class Queries;
  class Certificates;
  class Inspection;

  /// Creates a world without bodies, at start_time. Errors: not_finite or out_of_range, naming the field.
  [[nodiscard]] static Result<World> create(const WorldDefinition& definition);

  /// A moved-from world may only be assigned to and destroyed: every other call fails with moved_from, or
  /// throws BadResult where it returns no Result. Moving, assigning to or destroying a world inside its own
  /// probe, pair filter or run() prints a message and terminates the program, because the active call
  /// cannot return.
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Adds a body at the current time. Errors: not_finite; out_of_range (a negative radius, limit or error;
  /// a number beyond limits.hpp; on periodic axes, a radius or sensor distance that is too large for the
  /// box); outside_domain; overlapping; probe_in_progress. Cost: O(1) here (plus a search if allow_overlap
  /// is false), and a search at the next advance.
  Result<BodyId> add(const BodyDefinition& body);
  /// Reserves memory for `bodies` bodies in total, like std::vector::reserve(). Adding them takes less time
  /// and memory afterwards; nothing else changes. Errors: probe_in_progress; out_of_range (more than 2^32 -
  /// 1).
  Result<void> reserve(std::size_t bodies);
  /// Adds all bodies or, on an error, none. Errors: as add(), naming the body.
  Result<std::vector<BodyId>> add_all(std::span<const BodyDefinition> bodies);

  /// Adds a body that never moves. It has an id, a filter and contacts like any other body, and appears as
  /// `first` or `second` in their events. It is never probed, two static bodies never interact, and its
  /// shape may extend beyond the box of the world. Errors: not_finite; out_of_range (a coordinate, offset
  /// or radius beyond limits.hpp, a negative radius, a box without lower <= upper, a triangle thinner than
  /// 2^-20 of its longest side, a normal whose length differs from 1 by more than 10^-6; smaller
  /// differences are normalized); unsupported (on periodic axes every shape but Ball; a triangle in two
  /// dimensions, and a mesh there that Mesh::chain() does not make); overlapping; probe_in_progress. Cost:
  /// O(1) here (plus a search if allow_overlap is false), and a search at the next advance.
  Result<BodyId> add_static(const StaticDefinition& body);
  /// Adds a zone: a static body that has no contacts and reports the bodies that enter and leave it, with
  /// sensor_enter and sensor_leave at distance 0. Zones belong to the sensor class zone_class (255). If
  /// that class has no sensor distance yet, the first zone sets it to 0. set_sensor(zone_class, ...)
  /// changes the distances and the mask of all zones; change() the filter of one zone. Errors
  /// and cost: as add_static().
  Result<BodyId> add_zone(const Shape& shape, std::uint64_t user_data = 0);
  /// Adds all static bodies or, on an error, none. Errors: as add_static(), naming the body.
  Result<std::vector<BodyId>> add_static_all(std::span<const StaticDefinition> bodies);
  /// Adds a surface of triangles as one static body that never moves: add_static() of Mesh::create(vertices,
  /// corners). Errors: those of both.
  Result<BodyId> add_mesh(std::span<const Vec3> vertices,
                          std::span<const std::array<std::uint32_t, 3>> corners, const Filter& filter = {});
  /// Adds a body that carries a shape (MovingShape). It moves, is probed and is changed like any body of
  /// add(), and does not turn. All bodies meet its surface, static ones and other moving shapes too; events
  /// of the two have the surface's velocity, and bounce() uses it. It meets no walls of the box of the world
  /// and may be anywhere, so that a piston slides in that box; static bodies stop it, unless its filter lets
  /// it pass. The gap of two shapes is, where they overlap, minus the shortest way that parts them; triangles
  /// and meshes have no inside. Errors: as add(), but for outside_domain, and as add_static() for the shape;
  /// unsupported for a Ball and a HalfSpace, and where an axis is periodic. Cost: as add(), with the radius
  /// of the ball around the position that contains the shape. A check of two boxes costs about that of a ball
  /// and a box; one with a triangle takes some microseconds; with a mesh of n triangles O(log n) of these,
  /// and n times that for two meshes.
  Result<BodyId> add_moving_shape(const MovingShape& body);

  /// Adds a rigid body (RigidBody): balls and capsules that move and turn together. Its parts meet other
  /// bodies, rigid ones and those with shapes included, and walls. It is one body: it has one id, one filter
  /// and one state in a probe; events name the parts, the angular velocities and what an impulse does to
  /// these, so that bounce() turns bodies. Queries treat a rigid body as its parts or as the ball around
  /// them, always to the safe side. Errors: as add(), but for the ball around the body, which may reach
  /// beyond a wall; not_finite or out_of_range for parts, rotation, inertia and limits. Cost: as add() with
  /// the radius of that ball; a check of two bodies that are near looks at all their parts, and closely at
  /// the few pairs of parts that face each other.
  Result<BodyId> add_rigid_body(const RigidBody& body);
  /// Sets the function that gives rotations of rigid bodies; an empty one removes it. Without one, only
  /// bodies that keep their angular velocity (angular_acceleration_limit 0) can be probed. Snapshots do not
  /// contain it, and recordings contain its answers. While there is one, run() uses one thread. Errors:
  /// probe_in_progress.
  Result<void> set_rotation_probe(RotationProbe probe);

  /// Gives a static body, a zone or a moving shape another shape from the current time on: it grows, shrinks,
  /// turns or moves. Contacts and sensor overlaps that the new shape certainly ends are reported as ended,
  /// with the states and the shape from before; those that it may end are decided at once from fresh reports.
  /// Those that persist cause no event, so a zone that grows around a body inside it reports nothing. Those
  /// that the new shape creates begin at once. Nothing is swept in between: a body that the shape jumps over
  /// is not reported. Errors: as add_static(); unsupported for a ball that can move. Cost: O(1 + contacts)
  /// here (plus a search if allow_overlap is false), and a search and one state for each linked body at the
  /// next advance.
  Result<void> set_shape(BodyId body, const Shape& shape);

  /// Removes a body or several; on an error, none. Their contacts end: the next advance reports their ends,
  /// with the bodies' states extrapolated from their last reports (ContactEvents::impacts reports no ends).
  /// Errors: probe_in_progress; a body that is listed twice is stale_body the second time. Cost: O(1 +
  /// contacts) for each.
  Result<void> remove(BodyIds bodies);

  /// Informs the world that this body has the velocity `velocity` from the current time on. The probe must
  /// agree; otherwise a bound_violation reports the difference. The call invalidates every certificate of
  /// the body. If the body has not been probed at the current time (after a contact, its two bodies have
  /// been), the next advance probes it first. Where images slide (WorldDefinition::shear_rate), it is the
  /// velocity that a probe gives now, with a position in whichever image. Errors: disabled_body; static_body;
  /// not_finite; out_of_range (beyond limits.hpp, or z other than 0 in two dimensions); probe_in_progress.
  /// Cost: O(1) here, and a search at the next advance.
  Result<void> set_velocity(BodyId body, const Vec3& velocity);
  /// Returns the error that set_velocity() would return now, and changes nothing: for a caller who changes
  /// the body's motion first, as a BodyMap does. Cost: O(1).
  Result<void> check_set_velocity(BodyId body, const Vec3& velocity) const;
  /// Sets the velocities of all these bodies or, on an error, of none. Errors: as set_velocity(), naming the
  /// body; out_of_range if the number of velocities differs from the number of bodies.
  Result<void> set_velocities(std::span<const BodyId> bodies, std::span<const Vec3> velocities);

  // Further changes. The next advance reports a contact that a change certainly ends as ended, before all
  // other events, with the states from before the change. A contact that persists causes no event. An
  // overlap that a change creates begins at once. Cost of each: O(1 + contacts) here, and a search at the
  // next advance, which first probes the body if its last report is older than the change. If allow_overlap
  // is false, each change also searches here, and refuses what add() refuses. Errors of all:
  // probe_in_progress, and those of add() for the values that they set.

  /// Puts the body into another state from the current time on. A static body moves by set_shape(). The
  /// body's next approach to any partner is reported, also in touch. A rigid body whose rotation a
  /// RotationProbe tells is taken to have turned evenly since its last report: say how it is turned, by
  /// change(), before. Errors: disabled_body, static_body.
  Result<void> teleport(BodyId body, const State& state);
  /// Returns the error that teleport() would return now, and changes nothing, as check_set_velocity() does.
  /// Cost: O(1); a search if allow_overlap is false.
  Result<void> check_teleport(BodyId body, const State& state) const;
  /// Changes one property of the body or several from the current time on or, on an error, none. Several
  /// are changed in the order of BodyChange, and each must be valid after those before it.
  Result<void> change(BodyId body, const BodyChange& change);
  /// Returns the error that change() would return now, and changes nothing, as check_set_velocity() does.
  Result<void> check_change(BodyId body, const BodyChange& change) const;

  /// Disables the body: it has no contacts and is never probed. It keeps its id, and everything except its
  /// state may be set. Its contacts end as in remove(). Errors: disabled_body.
  Result<void> disable(BodyId body);
  /// Enables the body again, in state `state` at the current time. A static body returns to its former
  /// place, and `state` is ignored. Errors: enabled_body.
  Result<void> enable(BodyId body, const State& state);

  /// Puts the body to sleep: it stays exactly where it is until it wakes. A sleeping body is not probed,
  /// its bound stays constant, and its contacts with static and other sleeping bodies persist without being
  /// rechecked. The next advance probes the body once if its last report is older than this call or has a
  /// velocity; its velocity must then be zero, or a bound_violation reports it. The event EventKind::woke
  /// reports that a body is awake again, with its former motion limits. A body wakes by
  ///   - an event contact_begin or contact_end in which it takes part;
  ///   - set_velocity, teleport and a change of the radius or of the motion limits of the body itself, and
  ///     wake();
  ///   - the waking, removal, disabling, teleport or change of radius or shape of a body in contact with it,
  ///     one whose gap to it is at most the separation distance plus the tolerance. A whole island therefore
  ///     wakes together.
  /// ContactEvents::impacts has no contact_end: a body that sleeps upon an awake body does not wake when that
  /// body leaves. A call for a sleeping body changes nothing; one for a body that woke at this time
  /// cancels its event `woke`, if that has not come yet. Errors: disabled_body, static_body.
  Result<void> sleep(BodyId body);
  /// Wakes the body and its island. A call for an awake body changes nothing. Errors: disabled_body,
  /// static_body.
  Result<void> wake(BodyId body);

  /// Sets a user-defined predicate for pairs whose filters let them touch; an empty one lets all of them
  /// touch. The world calls it for pairs that may meet soon, in audit(), and in the search for certain
  /// overlaps (with the id that a new body is about to get), and for the contacts of a body in
  /// refresh_filter() and a change of its filter. Its results must not change between calls of
  /// set_pair_filter() and refresh_filter(). It must be symmetric. An exception that leaves it ends the
  /// program (std::terminate), because contacts would be missed otherwise.
  ///
  /// Inside the predicate, these members of this world may be called: body(), bodies(), user_data(),
  /// contains(), touching(), sensor_overlaps(), sensor(), time(), size(), definition() and counters(). All
  /// other calls, which would change the world or call the predicate again, fail with filter_in_progress;
  /// Inspection::audit() returns a finding that says so. Cost: all bodies search again at the next advance.
  Result<void> set_pair_filter(PairFilter filter);
  /// Informs the world that the pair filter's results for this body have changed. Cost: O(contacts and sensor
  /// overlaps of the body) here, and its search at the next advance.
  Result<void> refresh_filter(BodyId body);

  /// Sets the sensor of all bodies of this class from now on; a class without a sensor senses nothing. For
  /// bodies within a distance that no longer applies, the next advance reports sensor_leave; for bodies
  /// within a distance that newly applies, it reports sensor_enter. Errors: probe_in_progress; not_finite
  /// or out_of_range for a distance that is negative, beyond limits.hpp or, on periodic axes, too large for
  /// a body of the class, which the error names. Cost: O(n) here, and a search for each body of the class
  /// at the next advance.
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  /// Returns the sensor of a class; without distances if it has none.
  const Sensor& sensor(SensorClass sensor_class) const;

  /// Gives two bodies a state: a number of the caller's own, which the events of the two have
  /// (Event::pair_state), for instance a bond. It stays until it is set to 0 or one of the two is removed.
  /// Errors: out_of_range if the two are one body. Cost: O(states of the two), and 32 bytes a pair.
  Result<void> set_pair_state(BodyId first, BodyId second, std::int32_t state);
  /// Returns that state; 0 if it was never set.
  Result<std::int32_t> pair_state(BodyId first, BodyId second) const;
  /// To be called at the stop of a sensor_enter or sensor_leave: the two have been turned back there, by
  /// velocities that the caller gives them, and have not crossed the sensor distance. They stay on the side
  /// of it from which they came, though their gap may still be a little beyond it; when they are back, no
  /// event tells so. If they move on across the distance before, as another body hits them, the event comes
  /// again. No effect if the two still move on across the distance, if one of them is disabled, or if they no
  /// longer sense each other at that distance.
  /// Errors: out_of_range for another event than such a crossing at the present time.
  Result<void> turn_back(const Event& crossing);

  /// Schedules an event of the caller's own, EventKind::timer, which advance() and run() return at its time,
  /// after all other events of that time and before anything later. Timers of one time come in the order in
  /// which they were scheduled or last came. Bodies that the caller changes at a timer are changed at exactly
  /// that time; in run(), the response asks for a stop (Response::stop) there. Errors: probe_in_progress;
  /// time_backwards for a time that has passed; not_finite or out_of_range for the time or the period. Cost:
  /// O(log n) for n timers.
  Result<void> schedule(const Timer& timer);
  /// Removes all timers with these data that are still to come. Returns how many there were. Errors:
  /// probe_in_progress. Cost: O(n) for n timers.
  Result<std::size_t> unschedule(std::uint64_t user_data);

  /// Returns BodyDefinition::user_data; cheaper than body(). Cost: O(1).
  Result<std::uint64_t> user_data(BodyId body) const;

  /// Returns a range over all events up to time `until`:
  ///   for (const Event& event : world.events(60.0, probe)) ...
  /// The world advances as the loop does, with one advance() for each event. After the loop has finished,
  /// time() == until; after an early exit, time() is that of the last event. The loop may change bodies.
  /// Errors of advance() are thrown as BadResult.
  [[nodiscard]] EventRange events(double until, Probe probe) &;
  /// A temporary world would be gone before the loop began.
  EventRange events(double until, Probe probe) && = delete;

  /// Advances to the next event, at most to time `until`. Returns the event, with time() at its time, or
  /// nothing, with time() == until. Events are ordered by (time, kind, first, second, wall, distance).
  /// Events that a new velocity causes at the same instant follow in a new round of this order; ends of
  /// contacts that other changes caused come first. Errors: time_backwards or not_finite for `until`;
  /// probe_in_progress; null_probe; not_finite or out_of_range, naming the body, for an invalid state from
  /// the probe. In that last case the state is discarded, time() is the time of the probe, no event or
  /// certificate is lost, and the call may be repeated. This also holds when the probe throws. And
  /// out_of_range, naming the body, if a promise of it is so loose that time would reach `until` only after
  /// days of work: an acceleration limit of 1e30 in place of "any". That is known after a million steps
  /// without an event, unless `until` is more than 1e6 away. change() the limit, or advance to a nearer time,
  /// and repeat the call.
  [[nodiscard]] Result<std::optional<Event>> advance(double until, Probe probe);

  /// Advances to time `until`. For each event, run() calls `respond`, passes the velocities of the response
  /// to the motion source and to the world, removes, disables or puts to sleep the bodies for which the
  /// response says so, and calls `sink`. The events, the ids of bodies that the sink adds (Response::stop),
  /// the probed states and a recording equal, bit for bit, those of a loop over advance() that does the same.
  ///
  /// The sink may call body(), touching(), sensor_overlaps(), time() and every other member that is allowed
  /// inside a pair filter. These show the world at the event, after its response. The motion source and
  /// `respond` must not call this world. Calls that list probe_in_progress fail with run_in_progress inside
  /// all three, unless the sink receives an event whose response has Response::stop.
  ///
  /// Interruptions. After an error, or after an exception of the motion source, `respond` or the sink
  /// (which passes through run()), the world is at a stop and can continue. No event is lost and none is
  /// delivered twice:
  ///   - An event whose response was refused, or could not be obtained or applied because `respond` or the
  ///     motion source threw, has changed no body. The next run() calls `respond` for it before anything
  ///     else; advance() returns it before anything else, and can therefore pass over an event that `respond`
  ///     cannot handle. Until it has been delivered, save(), start_recording() and stop_recording() fail with
  ///     run_in_progress.
  ///   - An event at which the sink threw has been responded to and counts as delivered.
  ///
  /// Workers (workers.hpp) with several threads share the calls of the motion source for 1,024 bodies or more
  /// at one time, as where many bodies have arrived, and what follows from the answers. All else is done by
  /// this thread, so they make hardly any run faster; use_workers() shares more. The outcome is the same, bit
  /// for bit, for any number of threads. While the world is recorded or profiled, or has a rotation probe,
  /// this thread calls the motion source.
  ///
  /// Errors: as advance(); run_in_progress; null_callback; workers_busy; for a velocity or an action in a
  /// response, those of set_velocity() or sleep() and, for the second body of an event without one,
  /// unknown_body.
  Result<void> run(double until, MotionSource& source, const ResponseFn& respond, const EventFn& sink,
                   Workers* workers = nullptr);
  /// Advances to time `until` and calls `sink` for each event, without responses: the state of every body
  /// comes from `probe`. Errors and interruptions: as the run() above.
  Result<void> run(double until, const Probe& probe, const EventFn& sink, Workers* workers = nullptr);
  /// For the sink of run(): makes run() return without an error as soon as the sink does, also before
  /// `until`. Then all is as if the sink had thrown ("Interruptions"): at an event whose response has
  /// Response::stop the world stands at that event. No effect outside the sink.
  void end_run();

  /// From now on, the threads of these workers share what is to be done for thousands of bodies at one time,
  /// in whichever call: set_velocities() for 4,096 bodies or more, and in the next advance their reports and
  /// certificates, as those of bodies that have just been added. Less than that, and all events, are left to
  /// the calling thread, and so is a call that finds the workers at work elsewhere. nullptr, as at first: the
  /// calling thread does all. The outcome is the same, bit for bit, for any number of threads.
  ///
  /// Only if `call_probe`, these threads share the calls of probes for 1,024 bodies or more, too, so that
  /// several may run at one time; but not while the world is recorded or profiled, or has a rotation probe. A
  /// pair filter is always called by the calling thread.
  ///
  /// The workers must stay where they are until the last call of the world, or until it is told otherwise.
  /// Clones and restored worlds have none. Errors: probe_in_progress, filter_in_progress, run_in_progress.
  /// Cost: O(1).
  Result<void> use_workers(Workers* workers, bool call_probe = false);

  /// Return the current time, the number of bodies that have not been removed, and the definition.
  double time() const;
  std::size_t size() const;
  const WorldDefinition& definition() const;
  /// True if this world issued the id and the body has not been removed.
  bool contains(BodyId body) const;
  /// Returns what the world knows of a body now. Cost: O(1); of a rigid body, O(its points).
  Result<BodyView> body(BodyId id) const;
  /// Returns all bodies that have not been removed, including disabled ones, by index. Cost: O(n).
  std::vector<BodyId> bodies() const;
  /// Returns the counts of work so far.
  const Counters& counters() const;

  // Current contacts and sensor overlaps, as the events so far have reported them.

  /// Returns the bodies in contact with the body, in the order in which the contacts began. Cost:
  /// O(result).
  Result<std::vector<BodyId>> touching(BodyId body) const;
  /// Returns the sensor distances that the body is within, ordered by partner and, for each partner, from
  /// the largest distance to the smallest. Cost: O(result).
  Result<std::vector<SensorOverlap>> sensor_overlaps(BodyId body) const;

  // Facets: groups of calls, each in a header of its own. A facet refers to the world.

  /// Returns the spatial queries at the current time (queries.hpp), which use what is known or, given a
  /// probe, ask for what is undecided.
  Queries queries() const&;
  Queries queries(Probe probe) &;
  Queries queries() const&& = delete;
  /// Returns the certified predictions (certificates.hpp), from what is known or from fresh reports of a
  /// probe.
  Certificates certificates() const&;
  Certificates certificates(Probe probe) &;
  Certificates certificates() const&& = delete;
  /// Returns what there is to see of the internal state (inspection.hpp): memory, cells, profile, audit.
  Inspection inspection() const&;
  Inspection inspection() const&& = delete;

  /// Switches profiling on or off; it is off at first. Switched on, it starts from zero, and costs two
  /// clock reads per call of advance() and per probe, a few operations per probed state, and 64 bytes per
  /// body; switched off, it costs nothing. run() processes events one at a time meanwhile. Snapshots, clones
  /// and recordings do not contain it. Errors: probe_in_progress.
  Result<void> set_profiling(bool on);

  /// Serializes the whole world; possible at any stop. A world restored from these bytes continues bit for
  /// bit as this one does, with the same events, probes and counters, in any process and on any machine.
  /// The caller must save its own motion and the pair filter. Errors: probe_in_progress. Cost: O(n), about
  /// 0.25 KB a body.
  Result<std::vector<std::byte>> save() const;
  /// Restores the world that save() wrote. `pair_filter` must be the filter that the world had; setting it
  /// later makes all bodies search again. Errors: bad_snapshot for bytes that are foreign, truncated,
  /// damaged, of another format version, or that describe an impossible world, and for a world that had a
  /// pair filter if none is given. Arbitrary bytes cause no other failure.
  static Result<World> restore(std::span<const std::byte> snapshot, PairFilter pair_filter = {});
  /// Returns an independent copy that continues as this world does: the fast way to roll back within one
  /// process. The copy is not recorded. Errors: probe_in_progress. Cost: O(n).
  Result<World> clone() const;

  /// Starts recording all input and output of this world (recording.hpp) in memory: about 70 bytes per
  /// probed state, 10 to 140 per change and 230 per event. Moving the world moves its recording; assigning
  /// to the world discards it. Errors: probe_in_progress; recording if the world is already recorded. Cost:
  /// as save(); later little more than copying the recorded data.
  Result<void> start_recording();
  /// Stops recording and returns the recording, for Replay::open(). Errors: probe_in_progress;
  /// not_recording. Cost: as save().
  Result<std::vector<std::byte>> stop_recording();

 private:
  /// What a facet refers to.
  struct Facet {
    const World* world;
    World* probing = nullptr;  ///< the same world, if the facet may probe
    Probe probe{};

    /// Probes those of the bodies `numbers` whose reports are not from the present time. Returns true if
    /// there were any; false if the facet may not probe.
    Result<bool> refresh(std::span<const std::uint32_t> numbers, std::string_view call) const;
  };
  class Engine;
  class WorldEditor;
  class Preconditions;
  class Run;
  struct UndeliveredEvents;
  explicit World(std::unique_ptr<Engine> engine);
  CallState activity() const;
  void require_idle(const char* done) const noexcept;
  /// Returns the engine; throws BadResult with moved_from if there is none.
  const Engine& engine(std::string_view call) const;

  // Every change of the engine goes through one of these functions, so that a recording captures it.
  Engine& changeable();
  /// Returns an editor for `change`, which must have passed validation.
  template <class Change>
  WorldEditor changing(const Change& change);
  Result<std::optional<Event>> engine_advance(double until, const Probe& probe);
  Result<std::optional<Event>> recorded_advance(double until, const Probe& probe);
  bool may_probe_on_threads() const;
  Result<std::optional<Event>> timed_advance(double until, const Probe& probe);
  /// Probes those of the bodies `numbers` whose reports are older than the current time, for calls that
  /// probe outside advance(). Returns true if there were any.
  Result<bool> refresh(std::span<const std::uint32_t> numbers, const Probe& probe, std::string_view call);

  std::unique_ptr<const Engine> engine_;
  std::unique_ptr<Recorder> recorder_;              ///< null unless the world is recorded
  std::unique_ptr<UndeliveredEvents> undelivered_;  ///< null until the first run()
  bool running_ = false;                            ///< true inside run()
  bool open_ = false;                 ///< true while run() lets its sink change the world (Response::stop)
  std::unique_ptr<Timings> timings_;  ///< null before profiling
  bool profiling_ = false;
};

}  // namespace kinesphere
