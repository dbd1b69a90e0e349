#include "engine/meetings.hpp"

#include <algorithm>

#include "bound/encounter.hpp"
#include "engine/room.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t kicks_at_once = 256;

bool may_meet(const Bodies& bodies, const BodyKick& a, const BodyKick& b) {
  if (!bodies.may_meet(a.number, b.number)) return false;
  const double from = std::max(a.time, b.time);
  const double end = std::min(a.window.end, b.window.end);
  if (!(from < end)) return false;
  MovedBound moved(b.bound, from);
  if (bodies.space().repeats()) moved.centre += bodies.space().shift_between_homes(b.middle, a.middle);
  const Encounter pair(MovedBound(a.bound, from), moved);
  const double near = reach_of_pair(bodies, a.number, b.number) + bodies.definition().contact_tolerance;
  return !pair.stay_apart(end - from, near);
}

}  // namespace

std::vector<Windows::Pair> meetings(const Tables& tables, std::span<const GroupKick> kicks, std::size_t fresh,
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
      starters[k] = {number, Windows::level_of(bound_at_begin(number), window), window};
    }
  });
  Windows windows(bodies.space());
  windows.start(starters, begin, bound_at_begin, shift);
  std::vector<Windows::Scratch> scratch(shift.count());
  std::vector<std::vector<Windows::Pair>> meeting(shift.count());
  const auto compare = [&](std::uint32_t a, std::uint32_t b, std::size_t worker) {
    if (kicks[a].own != kicks[b].own && may_meet(bodies, *kicks[a].kick, *kicks[b].kick))
      meeting[worker].push_back({a, b});
  };
  shift.for_each(fresh, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    for (const auto& [a, b] : windows.near_started(from, to, begin, bound_at_begin, scratch[worker]))
      compare(a, b, worker);
  });
  shift.for_each(
      kicks.size() - fresh, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        for (auto k = static_cast<std::uint32_t>(fresh + from); k < fresh + to; ++k) {
          const double end = kicks[k].kick->window.end;
          for (const std::uint32_t other : windows.near(k, bound_at_begin(k), begin, end, scratch[worker]))
            compare(k, other, worker);
        }
      });
  std::vector<Windows::Pair> all;
  for (const std::vector<Windows::Pair>& some : meeting) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace kinesphere
