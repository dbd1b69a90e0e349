// Bulk restart of windows: the bodies whose windows end start in others. They are sorted into grid levels,
// each of which is filled as a whole.
#include <algorithm>
#include <cassert>
#include <utility>

#include "broadphase/broad_phase.hpp"

namespace kinesphere {
namespace {

/// A grid level that lasts through a restart is sorted again if its changes since the last sort exceed this
/// number plus half of its bodies.
constexpr std::uint64_t least_changes = 64;
/// Grid levels get spare slots if more than one body in so many has changed in the windows before. Fewer
/// changes cost less than longer searches.
constexpr std::uint64_t bodies_for_a_change = 3;
/// They get none if bodies have changed more often than this on average: the slots would soon be taken.
constexpr std::uint64_t most_changes_of_a_body = 3;

bool has_ended(double end, double now, bool all) { return all ? end < infinity : end <= now; }

}  // namespace

/// Calls visit(number) for each body whose window has ended. The order is ascending if the levels that end
/// hold at least a sixteenth of all registrations; otherwise it is unspecified, because a scan of all bodies
/// would take longer than sorting the few.
template <class Visit>
void BroadPhase::for_each_ended(double now, bool all, Visit visit) const {
  std::size_t most = 0;
  for (const GridLevel& layer : levels_)
    if (has_ended(layer.window.end, now, all)) most += layer.spheres.size();
  constexpr std::size_t few_of_all = 16;
  if (few_of_all * most >= registrations_.size()) {
    for (std::uint32_t number = 0; number < registrations_.size(); ++number)
      if (contains(number) && has_ended(registrations_[number].end, now, all)) visit(number);
    return;
  }
  for (const GridLevel& layer : levels_) {
    if (!has_ended(layer.window.end, now, all)) continue;
    const SweptSphereTable& table = layer.spheres.table();
    for (std::uint32_t slot = 0; slot < table.slots(); ++slot) {
      const std::uint32_t number = table.number_at(slot);
      if (number != SweptSphereTable::free_slot) visit(number);
    }
  }
}

std::vector<std::uint32_t> BroadPhase::ended(double now, bool all) const {
  std::vector<std::uint32_t> numbers;
  for_each_ended(now, all, [&](std::uint32_t number) { numbers.push_back(number); });
  if (!std::is_sorted(numbers.begin(), numbers.end())) std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void BroadPhase::end_windows(double now, bool all) {
  size_classes_.use_merged();
  next_end_ = infinity;
  for_each_ended(now, all, [this](std::uint32_t number) { registrations_[number].level = none; });
  std::uint64_t changes = 0;
  std::uint64_t bodies = 0;
  for (GridLevel& layer : levels_) {
    layer.fresh = false;
    if (has_ended(layer.window.end, now, all) || layer.is_empty()) {
      changes += std::exchange(layer.changes, 0);
      bodies += layer.spheres.size();
      layer.spheres.clear({});
      layer.window.end = -infinity;
    } else {
      next_end_ = std::min(next_end_, layer.window.end);
    }
  }
  if (bodies > 0)
    has_many_changes_ = bodies_for_a_change * changes > bodies && changes <= most_changes_of_a_body * bodies;
}

std::vector<int> BroadPhase::held_rungs() const {
  std::vector<int> held;
  for (const GridLevel& layer : levels_)
    if (!layer.fresh && !layer.is_empty()) held.push_back(layer.window.rung);
  return held;
}

std::size_t BroadPhase::started_slots() const {
  std::size_t all = 0;
  for (const GridLevel& layer : levels_)
    if (layer.fresh) all += layer.spheres.sorted_slots();
  return all;
}

/// Assigns each starter a grid level and an index among those that start in it, and counts the starters by
/// size class. Returns the first starter of each level that is opened.
std::vector<std::uint32_t> BroadPhase::choose_levels(std::span<const Starter> starters) {
  auto& [openings, sizes] = filling_;
  std::vector<std::uint32_t> first_bodies;
  // Most starters go where the previous one went, so that level and size class are tried first.
  std::size_t at = 0;
  auto size = sizes.end();
  for (const Starter& starter : starters) {
    if (size == sizes.end() || size->first != starter.size_class)
      size = sizes.try_emplace(starter.size_class).first;
    ++size->second;
    const int level = size_classes_.size_class_to_start(starter.size_class);
    const auto suits = [&](const Opening& opening) {
      return levels_[opening.level].is_of(starter.window, level);
    };
    if (at >= openings.size() || !suits(openings[at])) {
      const auto found = std::find_if(openings.begin(), openings.end(), suits);
      at = static_cast<std::size_t>(found - openings.begin());
      if (found == openings.end()) {
        openings.push_back({level_for(starter.window, level)});
        first_bodies.push_back(starter.number);
        levels_[openings.back().level].fresh = true;
      }
    }
    if (starter.number >= registrations_.size()) registrations_.resize(starter.number + std::size_t{1});
    std::vector<std::uint32_t>& numbers = openings[at].unsorted.numbers;
    registrations_[starter.number] = {starter.window.end, openings[at].level,
                                      static_cast<std::uint32_t>(numbers.size())};
    numbers.push_back(starter.number);
    note_change(starter.number);
  }
  for (auto& [level, unsorted] : openings) unsorted.spheres.resize(unsorted.numbers.size());
  return first_bodies;
}

void BroadPhase::remove_starter(std::uint32_t number) {
  assert(is_starter(number));
  Registration& here = registrations_[number];
  for (auto& [level, unsorted] : filling_.openings) {
    if (level != here.level) continue;
    auto& [numbers, spheres] = unsorted;
    registrations_[numbers.back()].slot = here.slot;
    numbers[here.slot] = numbers.back();
    spheres[here.slot] = spheres.back();
    numbers.pop_back();
    spheres.pop_back();
  }
  here.level = none;
}

/// Fills the grid levels in which bodies start, which are empty, and sorts the lasting levels that have
/// changed much.
void BroadPhase::finish_start(PoolLease& lease) {
  for (const Opening& opening : filling_.openings) {
    GridLevel& layer = levels_[opening.level];
    sort_to_start(layer, [&] {
      layer.spheres.fill(opening.unsorted, lease, [&](std::uint32_t number, std::uint32_t slot) {
        registrations_[number].slot = slot;
      });
    });
  }
  for (GridLevel& layer : levels_)
    if (!layer.fresh && layer.changes > least_changes + layer.spheres.size() / 2)
      sort_to_start(layer, [&] { sort(layer, lease); });
  merge_size_classes(filling_.sizes);
  filling_ = {};
}

BroadPhase BroadPhase::successor(double end) const {
  BroadPhase next(space_);
  next.size_classes_ = size_classes_;
  next.size_classes_.use_merged();
  next.has_many_changes_ = true;
  next.registrations_.resize(registrations_.size());
  for (const GridLevel& layer : levels_) {
    if (layer.is_empty() || layer.window.end <= end) continue;
    const auto level = static_cast<std::uint32_t>(next.levels_.size());
    const SweptSphereTable& table = next.levels_.emplace_back(layer).spheres.table();
    next.levels_.back().fresh = false;
    next.next_end_ = std::min(next.next_end_, layer.window.end);
    for (std::uint32_t slot = 0; slot < table.slots(); ++slot)
      if (table.number_at(slot) != SweptSphereTable::free_slot)
        next.registrations_[table.number_at(slot)] = {layer.window.end, level, slot};
  }
  return next;
}

void BroadPhase::take_over(BroadPhase&& successor) {
  *this = std::move(successor);
  next_end_ = infinity;
  for (GridLevel& layer : levels_) {
    layer.fresh = false;
    if (!layer.is_empty()) next_end_ = std::min(next_end_, layer.window.end);
  }
}

/// Returns the index of a sorted slot of a fresh level among all such slots.
std::size_t BroadPhase::index_of(const Registration& started) const {
  std::size_t index = started.slot;
  for (std::uint32_t level = 0; level < started.level; ++level)
    if (levels_[level].fresh) index += levels_[level].spheres.sorted_slots();
  return index;
}

/// Returns true if `a` has started, in a slot from `first` on, and searches for `b`.
bool BroadPhase::searches_for(std::uint32_t a, std::uint32_t b, std::size_t first) const {
  const Registration& one = registrations_[a];
  const Registration& other = registrations_[b];
  const GridLevel& own = levels_[one.level];
  const std::uint32_t sorted = own.spheres.sorted_slots();
  if (!own.fresh || one.slot >= sorted || index_of(one) < first) return false;
  if (one.level == other.level) return one.slot < other.slot && other.slot < sorted;
  return !levels_[other.level].fresh || !levels_[other.level].is_before(own);
}

void BroadPhase::record_changes(bool on) {
  changes_.clear();
  records_changes_ = on;
}

std::vector<std::uint32_t> BroadPhase::take_changes() {
  std::sort(changes_.begin(), changes_.end());
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
  return std::exchange(changes_, {});
}

/// Sorts a level from the coarseness recorded in size_classes_, so that the result does not depend on what
/// has changed in the level or in which order.
template <class Sort>
void BroadPhase::sort_to_start(GridLevel& layer, Sort sort_layer) {
  const float before = size_classes_.coarseness(layer.window.rung, layer.size_class);
  layer.spheres.set_coarseness(before);
  sort_layer();
  layer.changes = 0;
  const float after = layer.spheres.coarseness();
  if (after != before) size_classes_.set_coarseness(layer.window.rung, layer.size_class, after);
}

/// Chooses merged size classes for the next start, if at least half of all bodies have started now.
void BroadPhase::merge_size_classes(const Sizes& sizes) {
  const bool flat = space_.is_flat();
  double volume = 0.0;
  std::size_t all = 0;
  for (const GridLevel& layer : levels_) {
    if (!layer.fresh || layer.is_empty()) continue;
    all += layer.spheres.size();
    const double unit = SizeClasses::unit_of(layer.size_class);
    const double units = flat ? unit * unit : unit * unit * unit;
    volume =
        std::max(volume, static_cast<double>(layer.spheres.size()) * units / layer.spheres.density(flat));
  }
  if (2 * all >= size()) size_classes_.merge(sizes, volume, flat);
}

}  // namespace kinesphere
