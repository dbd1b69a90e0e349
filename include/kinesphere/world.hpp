// The world: moving spheres with unknown trajectories, and every contact among them, in time order.
//
//   #include <kinesphere/world.hpp>
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
//   while (auto event = world.advance(60.0, probe).value()) {
//     if (event->kind == EventKind::contact_begin) {
//       Vec3 bounced = ...;
//       my_simulation.set_velocity(event->first, event->time, bounced);
//       world.kick(event->first, bounced).value();
//     }
//   }
//   // now world.time() == 60
//
// The caller moves the bodies and the world watches them: it asks the probe for the state of a body
// only when that can matter, and stops at each event. Between stops bodies may be kicked, added and
// removed. The guarantee: as long as bodies keep their promises (BodyDefinition), no two of them
// overlap by more than the contact tolerance unreported. docs/guarantee.md has the proof.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Where a body's promise stands now.
struct BodyView {
  BodyDefinition definition{};  ///< with the state of the last report
  Bound bound{};                ///< since the last report
  Box box{};                    ///< which holds the body until box_end
  double box_end;
};

/// The first thing that audit() found wrong.
struct AuditFinding {
  std::string where;  ///< "registration", "certificate", "contact", "wall" or "queue"
  std::string what;   ///< which bodies, what is recorded, what it should be
};

class World {
 public:
  /// Errors: not_finite or out_of_range, naming the field.
  static Result<World> create(const WorldDefinition& definition);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Adds a body at the current time. Errors: not_finite; out_of_range (a negative radius, limit or
  /// error; a coordinate beyond 2^41 contact tolerances, where doubles could no longer keep
  /// the promise); outside_domain; overlapping. Cost: O(1) here (a grid search where overlaps are not
  /// allowed), a grid search at the next advance.
  Result<BodyId> add(const BodyDefinition& body);
  /// Adds all of them or, on an error (as above, naming the one), none.
  Result<std::vector<BodyId>> add_all(std::span<const BodyDefinition> bodies);

  /// Removes a body. Its contacts end: the end events come at the next advance, with its state as its last
  /// report predicts it (ContactMode::impacts has no ends).
  /// Errors: unknown_body, stale_body. Cost: O(log n + contacts).
  Result<void> remove(BodyId body);

  /// Tells the world that the velocity of this body is `velocity` from the current time on; the probe
  /// must answer accordingly, or a bound_violation says by how much it does not. Everything certified about
  /// the body so far is void. If it has not been probed at this very time (both bodies of a contact have) the
  /// next advance does so first. Errors: unknown_body, stale_body, not_finite. Cost: O(1) here, a grid search
  /// at the next advance.
  Result<void> kick(BodyId body, const Vec3& velocity);

  /// Goes on to the next event, at most to time `until`. Returns the event, with time() at its time, or
  /// nothing, with time() == until. Events come in the order of (time, kind, first, second, wall);
  /// those that a kick causes at the same instant follow in a new round of that order.
  /// Errors: time_backwards or not_finite for `until`; not_finite or out_of_range naming the body when
  /// the probe answers with such a state: that answer is dropped, time() is when it was asked for, no
  /// event or fact is lost, and the call may be repeated. The same holds when the probe throws.
  Result<std::optional<Event>> advance(double until, Probe probe);

  double time() const;
  std::size_t size() const;
  const WorldDefinition& definition() const;
  bool contains(BodyId body) const;
  /// Errors: unknown_body, stale_body.
  Result<BodyView> body(BodyId id) const;
  /// The living bodies, by index.
  std::vector<BodyId> bodies() const;
  const Counters& counters() const;

  /// Rebuilds from scratch what should be true now (every registration, certificate and scheduled time)
  /// and returns the first difference. Meant for tests: O(n^2).
  std::optional<AuditFinding> audit() const;

 private:
  class Engine;
  explicit World(std::unique_ptr<Engine> engine);
  Result<void> check_new(const BodyDefinition& body, std::string_view call) const;
  Result<void> check_alive(BodyId body, std::string_view call) const;
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinesphere
