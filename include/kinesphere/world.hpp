// The world: moving spheres with unknown trajectories, and every contact among them, in time order.
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
// The caller moves the bodies and the world watches them: it asks the probe for the state of a body only when
// that can matter, and stops at each event. At each stop, also between the events of one instant, bodies may
// be added, removed and changed in any way. The guarantee: as long as bodies move within the limits that
// they have promised (BodyDefinition), no two of them overlap by more than the contact tolerance unreported.
// docs/guarantee.md has the proof.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/answers.hpp"
#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/event_range.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// What the world knows of a body now.
struct BodyView {
  BodyDefinition definition{};  ///< with the state of the last report
  Bound bound{};                ///< since the last report
  /// Contains the body, and all that it senses, from now until box_end, unless it was changed since the last
  /// advance. Of no use, with box_end now, for one that the next advance has to find a place for.
  Box box{};
  double box_end;
  /// Where space repeats: how many boxes the body has gone beyond the first one. definition.position, which
  /// is in the first, plus the size of the box times this is on the path from where the caller last placed
  /// the body (add, teleport, enable) to here.
  std::array<std::int64_t, 3> image{};
  bool enabled;  ///< while it is false, bound and box are stale
  /// It never moves: shape_of() tells its shape. Its state is that of one point of it, and box_end is
  /// infinite.
  bool is_static;
  /// It rests (World::sleep): it is not probed, and its bound stands still.
  bool sleeping;
};

/// The first thing that audit() found wrong.
struct AuditFinding {
  /// "registration", "certificate", "contact", "sensor", "wall", "filter" or "queue"; "call" where the audit
  /// could not be made
  std::string where;
  std::string what;  ///< which bodies, what is recorded, what it should be
};

enum class CallState;
class Recorder;
class Workers;

/// Errors. Every call checks what it is handed, in every build type, and a call that returns an error has
/// changed nothing. Besides the errors that stand at a call,
///   - a call that names a body may return unknown_body, stale_body (the body has been removed) or
///     foreign_body (the id is one of another world);
///   - a call that changes the world or could probe, and every other call marked with probe_in_progress
///   below,
///     returns that inside this world's own probe, filter_in_progress inside its own pair filter, and
///     run_in_progress inside the mover, respond and sink of its own run();
///   - a call that takes a Probe may return null_probe and, for a bad answer, not_finite or out_of_range;
///   - a world that has been moved from answers every call with moved_from, or throws BadResult where a call
///     returns no Result.
///
/// Threads. One thread at a time may use a world, which may have the help of others in run(); const calls may
/// run at the same time as other const calls of the same world, as long as its pair filter may be called so.
/// Different worlds, clones too, are independent.
///
/// Lifetimes. References that a world gives out (definition(), counters(), sensor()) are good as long as the
/// world lives and is not assigned to; what they refer to changes as the world goes on. sensor() is good
/// until the next set_sensor(). The spans of a probe are good during its call. All else is a copy.
class World {
 public:
  /// Errors: not_finite or out_of_range, naming the field.
  [[nodiscard]] static Result<World> create(const WorldDefinition& definition);

  /// Of a world that has been moved from all calls fail with moved_from; those that do not return a Result
  /// throw BadResult. It may be assigned to and destroyed. A world that is moved from, assigned to or
  /// destroyed inside its own probe, pair filter or run stops the program, with a message: the call that
  /// asked has nowhere to return to.
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Adds a body at the current time. Errors: not_finite; out_of_range (a negative radius, limit or error; a
  /// number beyond limits.hpp; where space
  /// repeats, a radius or sensor distance for which the box is too small); outside_domain; overlapping;
  /// probe_in_progress. Cost: O(1) here (a search where overlaps are not allowed), a search at the
  /// next advance.
  Result<BodyId> add(const BodyDefinition& body);
  /// Makes room for this many bodies in all, as std::vector::reserve() does: adding them takes less time and
  /// memory then, and nothing else changes. Errors: probe_in_progress; out_of_range (more than 2^32 - 1).
  Result<void> reserve(std::size_t bodies);
  /// Adds all of them or, on an error (as above, naming the one), none.
  Result<std::vector<BodyId>> add_all(std::span<const BodyDefinition> bodies);

  /// Adds a body that never moves. It has an id, a filter and contacts like any other, and is the `first` or
  /// `second` of their events; it is never probed, and fixed bodies do not concern each other. It may reach
  /// out of the box of the world. Errors: not_finite; out_of_range (a coordinate, offset or radius beyond
  /// limits.hpp, a negative radius, a box without lower <= upper, a triangle thinner than 2^-20
  /// of its longest side, a normal whose length differs from 1 by more than 10^-6: the world makes it 1);
  /// unsupported (all but balls where space repeats, a triangle in two dimensions); overlapping;
  /// probe_in_progress. Cost: O(1) here (a search where overlaps are not allowed), a search at the
  /// next advance.
  Result<BodyId> add_static(const StaticDefinition& body);
  /// Adds a zone: a fixed body that touches nobody and tells who comes in and goes, by sensor_enter and
  /// sensor_leave at distance 0. It belongs to the sensor class zone_class (255), which gets that distance
  /// with the first zone if it has none; set_sensor(zone_class, ...) gives all zones other distances or
  /// another mask, set_filter one of them another filter. Errors and cost: as add_static().
  Result<BodyId> add_zone(const Shape& shape, std::uint64_t user_data = 0);
  /// Adds all of them or, on an error (as above, naming the one), none.
  Result<std::vector<BodyId>> add_static_all(std::span<const StaticDefinition> bodies);
  /// The shape of a fixed body as the world keeps it; of any other a ball at its last report.
  Result<Shape> shape_of(BodyId body) const;

  /// Removes a body. Its contacts end: the end events come at the next advance, with its state as its last
  /// report predicts it (ContactMode::impacts has no ends). Errors: probe_in_progress. Cost: O(1 +
  /// contacts).
  Result<void> remove(BodyId body);
  /// Removes all of them or, on an error (as above, naming the one; a body that is named twice is stale the
  /// second time), none.
  Result<void> remove_all(std::span<const BodyId> bodies);

  /// Tells the world that the velocity of this body is `velocity` from the current time on; the probe
  /// must answer accordingly, or a bound_violation says by how much it does not. Everything certified about
  /// the body so far is void. If it has not been probed at this very time (both bodies of a contact have) the
  /// next advance does so first. Errors: disabled_body; static_body; not_finite; out_of_range (beyond
  /// limits.hpp, or z other than 0 in two dimensions); probe_in_progress. Cost: O(1) here, a search at
  /// the next advance.
  Result<void> set_velocity(BodyId body, const Vec3& velocity);

  // Further changes. A contact that one of them certainly ends is reported as ended at the next advance,
  // before all other events, with the states from before the change; a contact that survives emits nothing;
  // an overlap that a change creates begins at once. Each costs O(1 + contacts) here (and a search
  // where overlaps are not allowed: then what add() refuses is refused here too) and a search at the
  // next advance, which first probes the body if its last report is older than the change. Errors of all:
  // probe_in_progress, and as add() for what they set.

  /// The body is in another state from the current time on. ContactMode::impacts: its next approach to
  /// anything is a new contact, as after set_velocity(). Errors: disabled_body, static_body.
  Result<void> teleport(BodyId body, const State& state);
  /// Errors: static_body.
  Result<void> set_radius(BodyId body, double radius);
  /// From the current time on the body moves within these limits. Errors: static_body.
  Result<void> set_motion_limits(BodyId body, const MotionLimits& limits);

  /// A disabled body touches nobody and is never probed. It keeps its id, and all but its state may be set.
  /// Its contacts end as in remove(). Errors: disabled_body.
  Result<void> disable(BodyId body);
  /// The body is back, in this state at the current time. A fixed body is back where it was, and `state` is
  /// ignored. Errors: enabled_body.
  Result<void> enable(BodyId body, const State& state);

  /// The body stays exactly where it is from now on, until it is woken: while it rests it is not probed, its
  /// bound stands still, and its contacts with fixed and other resting bodies last without being looked at.
  /// The next advance probes it once if its last report is older than this call, and the velocity has to be
  /// zero then. An event `woken` tells that a body is awake again, with the limits that it had. What wakes
  /// it:
  ///   - an event contact_begin or contact_end that it is part of;
  ///   - set_velocity, teleport, set_radius and set_motion_limits of the body itself, and wake();
  ///   - the waking, removal, disabling, teleport or change of radius of a body in touch with it, one whose
  ///   gap
  ///     to it is at most the separation distance and the tolerance: so a whole island wakes together.
  /// ContactMode::impacts has no contact_end: a body that rests upon one that is awake is not told when that
  /// one leaves. A body that rests already goes on resting. Errors: disabled_body, static_body.
  Result<void> sleep(BodyId body);
  /// Wakes the body and its island. One that is awake stays so, and nothing happens. Errors: disabled_body,
  /// static_body.
  Result<void> wake(BodyId body);

  /// Contacts that the filter does not let pass end; overlaps that it newly lets pass begin at once, also
  /// where overlaps are not allowed.
  Result<void> set_filter(BodyId body, const Filter& filter);
  /// A predicate of your own, asked about pairs whose filters let them touch; an empty one lets all touch.
  /// The world asks it about pairs that may meet soon, in audit(), when it looks for certain overlaps
  /// (then about the id that a new body is going to have), and about the contacts of a body in the two calls
  /// below. Between those calls its answers must not change. It must not throw and must be symmetric. Of this
  /// world it may read what is kept of bodies: body(), bodies(), user_data(), shape_of(), contains(),
  /// touching(), sensed(), sensor(), time(), size(), definition() and counters(). All other calls, which
  /// would change the world or ask the filter again, fail inside it with filter_in_progress, and audit()
  /// finds that it was called there. Cost: all bodies search again at the next advance.
  Result<void> set_pair_filter(PairFilter filter);
  /// Tells the world that the pair filter's answers about this body have changed.
  Result<void> refresh_filter(BodyId body);

  /// From now on the body touches others, or does not (BodyDefinition::solid).
  Result<void> set_solid(BodyId body, bool solid);
  /// From now on all bodies of this class have this sensor; without it they sense nothing. Where two bodies
  /// are within a distance that no longer counts, the next advance tells a sensor_leave; where they are
  /// within one that newly counts, a sensor_enter. Errors: probe_in_progress; not_finite or out_of_range for
  /// a distance that is negative or beyond limits.hpp or, where space repeats, so large that a
  /// body has no room for it, which is named. Cost: O(n) here, and each body of the class searches again at
  /// the next advance.
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  Result<void> set_sensor_class(BodyId body, SensorClass sensor_class);
  const Sensor& sensor(SensorClass sensor_class) const;

  Result<void> set_user_data(BodyId body, std::uint64_t data);
  Result<std::uint64_t> user_data(BodyId body) const;

  /// All events up to time `until`, for a range-for that goes through them:
  ///   for (const Event& event : world.events(60.0, probe)) ...
  /// The world goes on as the loop does, one advance() for each event. When the loop has run to its end,
  /// time() == until; when it is left early, time() is that of the last event. Bodies may be changed inside
  /// the loop. The errors of advance() are thrown as BadResult.
  [[nodiscard]] EventRange events(double until, Probe probe);

  /// Goes on to the next event, at most to time `until`. Returns the event, with time() at its time, or
  /// nothing, with time() == until. Events come in the order of (time, kind, first, second, wall, distance);
  /// those that a new velocity causes at the same instant follow in a new round of that order, and contacts
  /// that other changes have ended come first.
  /// Errors: time_backwards or not_finite for `until`; probe_in_progress; null_probe; not_finite or
  /// out_of_range naming the body when the probe answers with such a state: that answer is dropped, time() is
  /// when it was asked for, no event or fact is lost, and the call may be repeated. The same holds when the
  /// probe throws.
  [[nodiscard]] Result<std::optional<Event>> advance(double until, Probe probe);

  /// Goes on to time `until`: at each event asks respond for its answer, gives the velocities in it to the
  /// mover and to the world, and tells the sink. The events are those of a loop over advance() that answers
  /// in the same way, to the last bit, and so are the states that are asked for and a recording. What is
  /// counted of the work inside may differ where there are several workers.
  ///
  /// Inside the sink body(), touching(), sensed(), time() and whatever else can be read inside a pair filter
  /// may be called. They show the world at a moment that is not before the event and may be after it: what is
  /// to depend on the event alone should be taken from the event. Inside mover and respond no call of this
  /// world is allowed. Calls marked with probe_in_progress fail with run_in_progress inside all three.
  ///
  /// Interruptions. On an error, and when mover, respond or the sink throw (which passes through run), the
  /// world stands at a stop and can go on. No event is lost, none is told twice:
  ///   - an event whose answer was refused, or could not be had or applied because respond or the mover
  ///   threw,
  ///     has changed no body; the next run() asks respond about it before anything else;
  ///   - an event at which the sink threw has been answered and counts as told; those that were answered but
  ///     not told are told first by the next run().
  /// In both cases advance() returns these events instead, before anything else, whatever their time: so it
  /// passes over an event that respond cannot answer. Until they have come save(), start_recording() and
  /// stop_recording() fail with run_in_progress.
  ///
  /// The workers (workers.hpp) share the work, with the same outcome. Where there are several, events of some
  /// time are told together, and one event after the other is answered where bodies rest, a pair filter is
  /// set, or the world is being recorded or timed.
  ///
  /// Errors: as advance(); run_in_progress; null_callback; workers_busy; for a velocity of an answer those of
  /// set_velocity() and, for the second body of an event that has none, unknown_body.
  Result<void> run(double until, MotionSource& source, const ResponseFn& respond, const EventFn& sink,
                   Workers* workers = nullptr);
  /// The same for bodies that nobody answers.
  Result<void> run(double until, const Probe& probe, const EventFn& sink, Workers* workers = nullptr);

  double time() const;
  std::size_t size() const;
  const WorldDefinition& definition() const;
  /// Whether the id is one of this world whose body has not been removed.
  bool contains(BodyId body) const;
  Result<BodyView> body(BodyId id) const;
  /// The living bodies, disabled ones too, by index.
  std::vector<BodyId> bodies() const;
  const Counters& counters() const;

  // What the events so far add up to.

  /// Whom the body touches, in the order in which the contacts began.
  Result<std::vector<BodyId>> touching(BodyId body) const;
  /// Which sensor distances it is within: by partner, of each from the outermost inward.
  Result<std::vector<SensorOverlap>> sensor_overlaps(BodyId body) const;

  // Seeing inside (inspection.hpp).

  /// Cost: O(n).
  Memory memory() const;
  /// Cost: all bodies.
  std::vector<CellView> cells() const;
  /// Of pairs, and of bodies with the walls, that may change before the first box_end of the two, in no
  /// particular order. Cost: all of them.
  std::vector<Certificate> certificates() const;
  /// Timing costs two looks at the clock a call of advance() and a probe; at first it is off, and costs
  /// nothing. Switched on it begins from zero. It is no part of snapshots, clones and recordings. Errors:
  /// probe_in_progress.
  Result<void> set_profiling(bool on);
  /// What was spent while timing was on.
  Timings timings() const;

  /// Rebuilds from scratch what should be true now (every registration, certificate and contact)
  /// and returns the first difference. Meant for tests: O(n^2). From inside a probe or a pair filter of this
  /// world it does no more than say so.
  std::optional<AuditFinding> audit() const;

  // Certificates as answers (answers.hpp). Errors of all: probe_in_progress. With a Probe also as advance():
  // null_probe; not_finite or out_of_range for a bad answer, which is dropped.

  /// The two do not begin to touch before this. Errors: out_of_range for the same body twice. Cost:
  /// O(certificates of the world); with a probe at most two states.
  Result<SafeTime> safe_until(BodyId first, BodyId second) const;
  Result<SafeTime> safe_until(BodyId first, BodyId second, Probe probe);
  /// The body begins to touch no other and no wall before this. Cost: O(n), for most bodies a comparison;
  /// with a probe that again for each state that limits the answer.
  Result<SafeTime> safe_until(BodyId body) const;
  Result<SafeTime> safe_until(BodyId body, Probe probe);
  /// Nothing begins to touch before this. Cost: O(n) in a crowd; O(n^2) where the first
  /// contact is far off. With a probe that again, at most 32 times.
  Result<SafeTime> safe_until() const;
  Result<SafeTime> safe_until(Probe probe);
  /// As safe_until(body), naming what limits the answer: the partner or wall that may come first.
  Result<EarliestContact> earliest_contact(BodyId body) const;
  Result<EarliestContact> earliest_contact(BodyId body, Probe probe);
  /// The surfaces of the two do not come within `distance` (length >= 0, at most that of queries in
  /// limits.hpp) of each other before this. It is about where the bodies are and nothing else: filters and
  /// solid do not count. Errors: as safe_until(first, second); not_finite or out_of_range for `distance`. Of
  /// two fixed bodies that are not both balls nothing is known: the answer is now. Cost: O(1); with a probe
  /// at most two states.
  Result<SafeSeparation> safe_until(BodyId first, BodyId second, double distance) const;
  Result<SafeSeparation> safe_until(BodyId first, BodyId second, double distance, Probe probe);
  /// The same for a body and all others that its filter and the pair filter let it meet (also those that are
  /// not solid), and walls: who may be the first within `distance`. Two fixed bodies do not meet. Errors: as
  /// safe_until(first); not_finite or out_of_range for `distance`. Cost: O(n); with a probe that again for
  /// each state that limits the answer.
  Result<EarliestApproach> earliest_approach(BodyId body, double distance) const;
  Result<EarliestApproach> earliest_approach(BodyId body, double distance, Probe probe);
  /// How far the two are apart at `time` >= now, at least and at most. Errors: as safe_until(first, second);
  /// not_finite or time_backwards for `time`. Of two fixed bodies that are not both balls nothing is known.
  /// Cost: O(1); with a probe at most two states.
  Result<DistanceLimits> distance_limits(BodyId first, BodyId second, double time) const;
  Result<DistanceLimits> distance_limits(BodyId first, BodyId second, double time, Probe probe);

  // Queries at the current time (queries.hpp). Errors: probe_in_progress; not_finite or out_of_range for
  // points and lengths beyond limits.hpp, and for negative lengths; with a Probe
  // also as above. Cost: a search, what it finds, and the bodies added or changed since the last
  // advance.

  /// The bodies that may overlap a sphere, by index. With a probe: one state for each that is in doubt.
  Result<std::vector<OverlapHit>> overlapping(const Vec3& centre, double radius) const;
  Result<std::vector<OverlapHit>> overlapping(const Vec3& centre, double radius, Probe probe);
  /// The bodies that may overlap a box (lower <= upper on each axis), by index.
  Result<std::vector<OverlapHit>> overlapping(const Box& box) const;
  Result<std::vector<OverlapHit>> overlapping(const Box& box, Probe probe);
  /// All bodies that may be among the `count` nearest to a point, by lower limit of their distance: at least
  /// `count`, or all there are. With a probe no more than that, except for ties and position errors, and all
  /// of them probed. Cost: searches of doubling size.
  Result<std::vector<NearestHit>> nearest(const Vec3& point, std::size_t count) const;
  Result<std::vector<NearestHit>> nearest(const Vec3& point, std::size_t count, Probe probe);
  /// All bodies that may be the first on the way from `origin` along `direction` (of any length > 0), by
  /// lower limit of that way: empty when there certainly is none within `length`. A single body that is
  /// certainly the first is marked so. With a probe all of them are probed. Walls do not count. Where space
  /// repeats the length may be at most 64 boxes, and a sphere's radius half a box (out_of_range). Cost: at
  /// most 64 searches along the way.
  Result<std::vector<CastHit>> ray_cast(const Vec3& origin, const Vec3& direction, double length) const;
  Result<std::vector<CastHit>> ray_cast(const Vec3& origin, const Vec3& direction, double length,
                                        Probe probe);
  /// The same for a sphere of this radius.
  Result<std::vector<CastHit>> sphere_cast(const Vec3& origin, double radius, const Vec3& direction,
                                           double length) const;
  Result<std::vector<CastHit>> sphere_cast(const Vec3& origin, double radius, const Vec3& direction,
                                           double length, Probe probe);

  /// The whole world as bytes, at any stop. A world restored from them goes on as this one does, to the bit:
  /// the same events, probes and counters, in this process or another, on this machine or another. What
  /// moves the bodies is the caller's to save, and so is the pair filter. Errors: probe_in_progress. Cost:
  /// O(n), about 0.25 KB a body.
  Result<std::vector<std::byte>> save() const;
  /// The world that save() wrote, with the pair filter that it had (setting it later instead makes all bodies
  /// search again). Errors: bad_snapshot for bytes that are foreign, cut short, damaged, of another format
  /// version, or that describe a world that cannot be; never worse than that, whatever they are.
  static Result<World> restore(std::span<const std::byte> snapshot, PairFilter pair_filter = {});
  /// A world of its own that goes on as this one does: the fast way to roll back in the same process. It is
  /// not being recorded. Errors: probe_in_progress. Cost: O(n).
  Result<World> clone() const;

  /// From now on all that goes into this world and comes out of it is recorded (recording.hpp), in memory,
  /// about 70 bytes a report, 10 to 140 a change and 230 an event. A world that is moved takes its recording
  /// along; one that is assigned to loses it. Errors: probe_in_progress; recording when it is already. Cost:
  /// as save(); later little more than copying what is recorded.
  Result<void> start_recording();
  /// The recording: Replay::open. Errors: probe_in_progress; not_recording. Cost: as save().
  Result<std::vector<std::byte>> stop_recording();
  bool recording() const;

 private:
  friend class Replay;
  class Engine;
  class WorldEditor;
  class Preconditions;
  class StaleProber;
  class Run;
  struct UntoldEvents;
  explicit World(std::unique_ptr<Engine> engine);
  CallState activity() const;
  void require_idle(const char* done) const noexcept;
  /// Throws BadResult with moved_from.
  const Engine& engine(std::string_view call) const;

  // The only ways to change the engine. A recording learns of each.
  Engine& changeable();
  /// For this change, which has been found to be possible.
  template <class Change>
  WorldEditor changing(const Change& change);
  Result<std::optional<Event>> engine_advance(double until, const Probe& probe);
  Result<std::optional<Event>> recorded_advance(double until, const Probe& probe);
  Result<std::optional<Event>> timed_advance(double until, const Probe& probe);
  /// For calls that probe outside advance(): those bodies whose reports are old. True when there were any.
  Result<bool> refresh(std::span<const std::uint32_t> numbers, const Probe& probe, std::string_view call);

  std::unique_ptr<const Engine> engine_;
  std::unique_ptr<Recorder> recorder_;    ///< while there is a recording
  std::unique_ptr<UntoldEvents> untold_;  ///< from the first run() on
  bool running_ = false;                  ///< in a run()
  Timings timings_{};
  bool profiling_ = false;
};

}  // namespace kinesphere
