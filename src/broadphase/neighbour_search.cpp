#include "broadphase/neighbour_search.hpp"

#include <cassert>
#include <functional>
#include <iterator>

namespace kinesphere {
namespace {

bool is_within_a_period(const Box& box, const Space& space) {
  for (int axis = 0; axis < 3; ++axis)
    if (space.repeats(axis) && !(box.upper[axis] - box.lower[axis] < space.period()[axis])) return false;
  return true;
}

/// Calls visit(image, is_shifted) for each image of the body, from `now` until `end`, that may meet bodies of
/// a grid level. Returns false, without a call, if the body's box is not narrower than a period: every body
/// of the level may then be near.
template <class Visit>
bool for_each_image(const Space& space, const GridLevel& level, const InflatedBound& bound, double now,
                    double end, Visit visit) {
  if (!space.repeats()) {
    visit(bound, false);
    return true;
  }
  const Box box = bound.box_of_way(duration_until(end, now));
  // A box this wide may overlap several images of another; a search with one of them would not suffice.
  if (!is_within_a_period(box, space)) return false;
  space.for_each_image(box, level.widest(), [&](const Box&, const Vec3& shift) {
    InflatedBound image = bound;
    image.moved.centre += shift;
    visit(image, shift != Vec3{});
  });
  return true;
}

}  // namespace

/// Adds all bodies of a grid level other than `number` to numbers_ that near() finds there. If `entered` is
/// not null, it is the swept sphere from `now` until `end` that the body has in this level already.
void NeighbourSearch::search_level(const Space& space, const GridLevel& level, std::uint32_t number,
                                   const InflatedBound& bound, double now, double end,
                                   const SweptSphere* entered) {
  const SweptSphereTable& table = level.spheres.table();
  const auto note = [&](std::uint32_t slot) {
    const std::uint32_t other = table.number_at(slot);
    if (other != number && other != SweptSphereTable::free_slot) numbers_.push_back(other);
  };
  searches_.clear();
  const auto add = [&](const InflatedBound& image, bool is_shifted) {
    level.spheres.add_search(entered != nullptr && !is_shifted
                                 ? SweptSphereQuery{*entered, level.time(now), level.time(end)}
                                 : level.query(image, now, end),
                             searches_);
  };
  if (for_each_image(space, level, bound, now, end, add)) {
    level.spheres.make(searches_);
    searches_.for_each_found([&](std::uint32_t, std::uint32_t slot) { note(slot); });
  } else {
    for (std::uint32_t slot = 0; slot < table.slots(); ++slot) note(slot);
  }
}

std::vector<std::uint32_t>& NeighbourSearch::near(const BroadPhase& windows, std::uint32_t number,
                                                  const InflatedBound& bound, double now, double end) {
  numbers_.clear();
  for (const GridLevel& level : windows.levels())
    if (!level.is_empty()) search_level(windows.space(), level, number, bound, now, end, nullptr);
  return numbers_;
}

std::vector<std::uint32_t>& NeighbourSearch::near_entered(const BroadPhase& windows, std::uint32_t number,
                                                          const InflatedBound& bound, double now) {
  const GridLevel& own = windows.level_of(number);
  const SweptSphere entered = windows.swept_sphere_of(number);
  numbers_.clear();
  for (const GridLevel& level : windows.levels())
    if (!level.is_empty())
      search_level(windows.space(), level, number, bound, now, own.window.end,
                   &level == &own ? &entered : nullptr);
  return numbers_;
}

std::span<const std::uint32_t> NeighbourSearch::in_box(const BroadPhase& windows, const Box& box,
                                                       double now) {
  numbers_.clear();
  for (const GridLevel& level : windows.levels()) {
    if (level.is_empty()) continue;
    const double end = level.window.end < infinity ? now : infinity;
    searches_.clear();
    windows.space().for_each_image(box, level.widest(), [&](const Box& image, const Vec3&) {
      Bound ball{.time = now, .position = 0.5 * (image.lower + image.upper)};
      ball.radius = 0.5 * norm(image.upper - image.lower);
      level.spheres.add_search(level.query({BoundAt(ball, now), 0.0}, now, end), searches_);
    });
    level.spheres.make(searches_);
    searches_.for_each_found([&](std::uint32_t, std::uint32_t slot) {
      const std::uint32_t number = level.spheres.table().number_at(slot);
      if (number != SweptSphereTable::free_slot) numbers_.push_back(number);
    });
  }
  return numbers_;
}

/// True if started bodies may have neighbours outside the present image of their own grid level.
bool NeighbourSearch::has_several_images(const BroadPhase& windows) {
  const auto levels = windows.levels();
  const auto empty = std::count_if(levels.begin(), levels.end(), std::mem_fn(&GridLevel::is_empty));
  return windows.space().repeats() || std::ssize(levels) > empty + 1;
}

/// Returns successive started bodies of one grid level from the k-th on, at most `most`.
NeighbourSearch::Started NeighbourSearch::started_at(std::span<const GridLevel> levels, std::size_t k,
                                                     std::size_t most) {
  const auto holds = [&k](const GridLevel& level) {
    if (!level.fresh) return false;
    const std::size_t slots = level.spheres.sorted_slots();
    if (k < slots) return true;
    k -= slots;
    return false;
  };
  const auto found = std::find_if(levels.begin(), levels.end(), holds);
  assert(found != levels.end());
  const std::size_t behind = found->spheres.sorted_slots() - k;
  return {*found, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(std::min(behind, most))};
}

/// Finds neighbours of the bodies `some` among the later slots of their own grid level.
void NeighbourSearch::search_behind(const Started& some, double now) {
  const SweptSphereGrid& level = some.own.spheres;
  const float from = some.own.time(now);
  searches_.clear();
  for (std::uint32_t k = 0; k < some.count; ++k) level.add_search_behind(some.slot + k, searches_, from);
  level.make(searches_);
  searches_.for_each_found([&](std::uint32_t k, std::uint32_t slot) {
    const std::uint32_t number = level.table().number_at(slot);
    if (number != SweptSphereTable::free_slot) pairs_.push_back({some.number_at(k), number});
  });
}

/// Finds neighbours of the bodies `some` in other grid levels and in other images of their own level.
void NeighbourSearch::search_other_levels(const BroadPhase& windows, const Started& some, double now) {
  for (const GridLevel& other : windows.levels()) {
    const bool is_own = &other == &some.own;
    if (other.is_empty() || (other.fresh && other.is_before(some.own)) ||
        (is_own && !windows.space().repeats()))
      continue;
    const SweptSphereTable& table = other.spheres.table();
    const auto note = [&](std::uint32_t k, std::uint32_t slot) {
      if (is_own && slot <= some.slot + k) return;
      const std::uint32_t number = table.number_at(slot);
      if (number != SweptSphereTable::free_slot) pairs_.push_back({some.number_at(k), number});
    };
    searches_.clear();
    searching_.clear();
    for (std::uint32_t k = 0; k < some.count; ++k) {
      if (!bounds_[k]) continue;
      const double end = some.own.window.end;
      const auto add = [&](const InflatedBound& image, bool shifted) {
        // search_behind() finds the neighbours in the body's own place.
        if (is_own && !shifted) return;
        other.spheres.add_search(other.query(image, now, end), searches_);
        searching_.push_back(k);
      };
      if (for_each_image(windows.space(), other, *bounds_[k], now, end, add)) continue;
      for (std::uint32_t slot = 0; slot < table.slots(); ++slot) note(k, slot);
    }
    other.spheres.make(searches_);
    searches_.for_each_found([&](std::uint32_t query, std::uint32_t slot) { note(searching_[query], slot); });
  }
}

}  // namespace kinesphere
