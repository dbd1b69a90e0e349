#include "speculation/conflicts.hpp"

#include <algorithm>

#include "bodies/body_bounds.hpp"
#include "broadphase/neighbour_search.hpp"
#include "processor/pair_certifier.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t updates_at_once = 256;

/// Returns Conflict::until of two updates; +infinity if the bodies do not meet.
double conflict_of(const Bodies& bodies, const SweptSphereUpdate& earlier, const SweptSphereUpdate& later) {
  const double now = later.time;
  const double end = std::min(earlier.window.end, later.window.end);
  if (!(now < end) || !bodies.may_meet(earlier.number, later.number)) return infinity;
  if (end == infinity) return Conflict::unknown;
  const auto known = [](const SweptSphereUpdate& update) {
    return BoundRef{update.number, &update.bound, update.window.end, &update.middle};
  };
  const double until = apart_until(bodies, known(earlier), known(later), now);
  // apart_until() knows the balls around shapes that move, not the shapes.
  if (until < infinity && (bodies[earlier.number].has_shape() || bodies[later.number].has_shape()))
    return Conflict::unknown;
  // A later report only shrinks a bound, so two bodies certified apart stay apart. The order of changes at
  // one instant is not known across clusters.
  const bool had_velocity_changed = earlier.time < now && now < earlier.first_change.changed;
  return had_velocity_changed || earlier.first_change.invalidated < now || until == infinity
             ? until
             : Conflict::unknown;
}

}  // namespace

std::vector<Conflict> find_conflicts(const WorldState& state, std::span<const ClusterUpdate> updates,
                                     std::size_t fresh, double begin, PoolLease& lease) {
  const Bodies& bodies = state.bodies;
  const auto bound_at_begin = [&](std::uint32_t k) {
    const SweptSphereUpdate& update = *updates[k].update;
    return margin_for(bodies, update.number, BoundAt(update.bound, begin));
  };
  std::vector<BroadPhase::Starter> starters(fresh);
  lease.for_each(fresh, updates_at_once, [&](std::size_t k, std::size_t) {
    const auto number = static_cast<std::uint32_t>(k);
    const Window& window = updates[k].update->window;
    starters[k] = {number, SizeClasses::size_class_of(bound_at_begin(number), window), window};
  });
  BroadPhase windows(bodies.space());
  windows.start(starters, begin, bound_at_begin, lease);
  std::vector<NeighbourSearch> searches(lease.count());
  std::vector<std::vector<Conflict>> meeting(lease.count());
  const auto compare = [&](std::uint32_t a, std::uint32_t b, std::size_t worker) {
    if (updates[a].cluster == updates[b].cluster) return;
    const bool in_order = updates[a].update->time < updates[b].update->time;
    const SweptSphereUpdate& earlier = *updates[in_order ? a : b].update;
    const SweptSphereUpdate& later = *updates[in_order ? b : a].update;
    const double until = conflict_of(bodies, earlier, later);
    if (until < infinity)
      meeting[worker].push_back({a, b, until, earlier.first_change.invalidated < later.time});
  };
  lease.parallel_for(fresh, updates_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    for (const auto& [a, b] : searches[worker].near_started(windows, from, to, begin, bound_at_begin))
      compare(a, b, worker);
  });
  lease.for_each(updates.size() - fresh, updates_at_once, [&](std::size_t later, std::size_t worker) {
    const auto k = static_cast<std::uint32_t>(fresh + later);
    const double end = updates[k].update->window.end;
    for (const std::uint32_t other : searches[worker].near(windows, k, bound_at_begin(k), begin, end))
      compare(k, other, worker);
  });
  std::vector<Conflict> all;
  for (const std::vector<Conflict>& some : meeting) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace kinesphere
