// Bodies too fast for squares in single precision, in a clone of the world.
//
// Such a body may cross everything in a world in the shortest time step. The clone must stay clean, must come
// to an end, and may refuse only values out of range; if the body ends inside another one, the two must
// touch.
#include <algorithm>
#include <cmath>

#include "kinesphere/inspection.hpp"
#include "number/infinity.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

constexpr int most_events_of_a_sprint = 20000;

void require_clean(const World& world) {
  if (const auto finding = world.inspection().audit())
    throw Disagreement("audit of a sprint: " + finding->where + ": " + finding->what);
}

/// Returns false if the probe's answers went out of range.
bool goes_on(World& world, double until, Probe probe) {
  for (int count = 0; count < most_events_of_a_sprint; ++count) {
    const auto event = world.advance(until, probe);
    if (!event) {
      require(event.error().code == ErrorCode::out_of_range, "a sprint is refused for a wrong reason");
      return false;
    }
    if (!*event) return true;
    if (count % 64 == 0) require_clean(world);
  }
  throw Disagreement("a sprint does not come to an end");
}

}  // namespace

/// Checks that the body touches what it overlaps at `place`, where it has arrived.
void Player::check_touching(const World& world, BodyId id, const Vec3& place) const {
  const std::vector<BodyId> touching = world.touching(id).value();
  for (const BodyId other : truth_.present()) {
    const Contact contact = id < other ? Contact{id, other} : Contact{other, id};
    if (other == id || !truth_.may_be_told(contact) || !wants_ends(truth_.wanted(contact))) continue;
    const Real gap =
        truth_.gaps.to_point(truth_.at(other), vector(place), now()) - truth_.at(id).radius.radius;
    require(gap >= -truth_.tolerance() - truth_.slack() || std::ranges::count(touching, other) > 0,
            "a sprint ends with an unreported body");
  }
}

void Player::sprint() {
  const Thing* const thing = moving_thing();
  const Scenario& s = scenario();
  if (!thing || thing->sort != Sort::ball || s.is_periodic() || s.rigid || s.radii || s.errors || s.far ||
      s.late || s.scaled)
    return;
  World world = world_.clone().value();
  if (truth_.has_pair_filter) world.set_pair_filter(pair_filter()).value();
  const BodyId id = thing->id;
  const double speed = std::pow(10.0, draw_.uniform(14.0, 60.0));
  Vec3 velocity = draw_.direction();
  if (norm(velocity) < 0.1) return;
  velocity *= speed / norm(velocity);
  const double start = now();
  const State before = state_of(*thing, start);
  bool fast = true;
  const auto state = [&](BodyId body, double time) -> State {
    if (body != id) return state_of(truth_.at(body), time);
    return fast ? State{before.position + velocity * (time - start), velocity}
                : State{before.position, Vec3{}};
  };
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state(ids[k], time);
  };
  world.set_velocity(id, velocity).value();
  require_clean(world);
  bool in_range = goes_on(world, start, probe);
  require_clean(world);
  const double least = std::nextafter(start, infinity);
  const double end = std::max(least, start + s.edge * draw_.uniform() / speed);
  in_range = in_range && goes_on(world, end, probe);
  if (in_range) {
    require_clean(world);
    check_touching(world, id, state(id, end).position);
  }
  fast = false;
  if (!world.teleport(id, {before.position, {}})) return;
  require_clean(world);
  require(goes_on(world, world.time() + 1e-3, probe), "a sprint is not over");
  require_clean(world);
}

}  // namespace kinesphere::stream
