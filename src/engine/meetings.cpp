#include "engine/meetings.hpp"

#include <algorithm>

#include "engine/facts.hpp"
#include "engine/room.hpp"
#include "window/neighbour_search.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t kicks_at_once = 256;

/// As Meeting::until; +infinity where they do not meet.
double meeting_of(const Bodies& bodies, const BodyKick& earlier, const BodyKick& later) {
  const double now = later.time;
  const double end = std::min(earlier.window.end, later.window.end);
  if (!(now < end) || !bodies.may_meet(earlier.number, later.number)) return infinity;
  if (end == infinity) return Meeting::unknown;
  const auto known = [](const BodyKick& kick) {
    return Known{kick.number, &kick.bound, kick.window.end, &kick.middle};
  };
  const double until = apart_until(bodies, known(earlier), known(later), now);
  // A later report makes the bound smaller: two that stay apart still do. What comes first at one instant,
  // the two islands do not know.
  const bool as_kicked = earlier.time < now && now < earlier.since.change;
  return as_kicked || earlier.since.kick < now || until == infinity ? until : Meeting::unknown;
}

}  // namespace

std::vector<Meeting> meetings(const Tables& tables, std::span<const GroupKick> kicks, std::size_t fresh,
                              double begin, Shift& shift) {
  const Bodies& bodies = tables.bodies;
  const auto bound_at_begin = [&](std::uint32_t k) {
    const BodyKick& kick = *kicks[k].kick;
    return room_for(bodies, kick.number, MovedBound(kick.bound, begin));
  };
  std::vector<Windows::Starter> starters(fresh);
  shift.for_each(fresh, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      const auto number = static_cast<std::uint32_t>(k);
      const Window& window = kicks[k].kick->window;
      starters[k] = {number, SizeLevels::level_of(bound_at_begin(number), window), window};
    }
  });
  Windows windows(bodies.space());
  windows.start(starters, begin, bound_at_begin, shift);
  std::vector<NeighbourSearch> searches(shift.count());
  std::vector<std::vector<Meeting>> meeting(shift.count());
  const auto compare = [&](std::uint32_t a, std::uint32_t b, std::size_t worker) {
    if (kicks[a].own == kicks[b].own) return;
    const bool in_order = kicks[a].kick->time < kicks[b].kick->time;
    const BodyKick& earlier = *kicks[in_order ? a : b].kick;
    const BodyKick& later = *kicks[in_order ? b : a].kick;
    const double until = meeting_of(bodies, earlier, later);
    if (until < infinity) meeting[worker].push_back({a, b, until, earlier.since.kick < later.time});
  };
  shift.for_each(fresh, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    for (const auto& [a, b] : searches[worker].near_started(windows, from, to, begin, bound_at_begin))
      compare(a, b, worker);
  });
  shift.for_each(
      kicks.size() - fresh, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        for (auto k = static_cast<std::uint32_t>(fresh + from); k < fresh + to; ++k) {
          const double end = kicks[k].kick->window.end;
          for (const std::uint32_t other : searches[worker].near(windows, k, bound_at_begin(k), begin, end))
            compare(k, other, worker);
        }
      });
  std::vector<Meeting> all;
  for (const std::vector<Meeting>& some : meeting) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace kinesphere
