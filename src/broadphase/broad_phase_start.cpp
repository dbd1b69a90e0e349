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
/// Grid levels get spare slots if more than one body in this number has changed in the windows before. Fewer
/// changes cost less than longer searches.
constexpr std::uint64_t bodies_for_a_change = 3;
/// Grid levels get no spare slots if bodies have changed more often than this on average: the slots would
/// soon be taken.
constexpr std::uint64_t most_changes_of_a_body = 3;

bool has_ended(double end, double now, bool all) { return all ? end < infinity : end <= now; }

}  // namespace

/// Calls visit(number) for each body whose window has ended. The order is ascending if the levels that end
/// hold at least a sixteenth of all registrations; otherwise it is unspecified, because a scan of all bodies
/// would take longer than sorting the few.
template <class Visit>
void BroadPhase::for_each_ended(double now, bool all, Visit visit) const {
  std::size_t most = 0;
  for (const GridLevel& level : levels_)
    if (has_ended(level.window.end, now, all)) most += level.spheres.size();
  constexpr std::size_t few_of_all = 16;
  if (few_of_all * most >= registrations_.size()) {
    for (std::uint32_t number = 0; number < registrations_.size(); ++number)
      if (contains(number) && has_ended(registrations_[number].end, now, all)) visit(number);
    return;
  }
  for (const GridLevel& level : levels_) {
    if (!has_ended(level.window.end, now, all)) continue;
    const SweptSphereTable& table = level.spheres.table();
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
  for (GridLevel& level : levels_) {
    level.fresh = false;
    if (has_ended(level.window.end, now, all) || level.is_empty()) {
      changes += std::exchange(level.changes, 0);
      bodies += level.spheres.size();
      level.spheres.clear({});
      level.window.end = -infinity;
    } else {
      next_end_ = std::min(next_end_, level.window.end);
    }
  }
  note_changes_of_ended(changes, bodies);
}

/// Decides, by the changes of bodies in windows that have ended, whether spare slots pay.
void BroadPhase::note_changes_of_ended(std::uint64_t changes, std::uint64_t bodies) {
  if (bodies > 0)
    has_many_changes_ = bodies_for_a_change * changes > bodies && changes <= most_changes_of_a_body * bodies;
}

std::vector<int> BroadPhase::held_rungs() const {
  std::vector<int> held;
  for (const GridLevel& level : levels_)
    if (!level.fresh && !level.is_empty()) held.push_back(level.window.rung);
  return held;
}

std::size_t BroadPhase::started_slots() const {
  std::size_t all = 0;
  for (const GridLevel& level : levels_)
    if (level.fresh) all += level.spheres.sorted_slots();
  return all;
}

/// Assigns each starter a grid level and an index among those that start in it, and counts the starters by
/// size class. Returns the first starter of each level that is opened.
std::vector<std::uint32_t> BroadPhase::choose_levels(std::span<const Starter> starters) {
  auto& [openings, sizes, is_surveyed, has_cells] = filling_;
  assert(!is_surveyed && !has_cells);
  std::vector<std::uint32_t> first_bodies;
  // Most starters go where the previous one went, so that level and size class are tried first.
  std::size_t at = 0;
  auto size = sizes.end();
  for (const Starter& starter : starters) {
    if (size == sizes.end() || size->first != starter.size_class)
      size = sizes.try_emplace(starter.size_class).first;
    ++size->second;
    const int size_class = size_classes_.size_class_to_start(starter.size_class);
    const auto suits = [&](const Opening& opening) {
      return levels_[opening.level].is_of(starter.window, size_class);
    };
    if (at >= openings.size() || !suits(openings[at])) {
      const auto found = std::find_if(openings.begin(), openings.end(), suits);
      at = static_cast<std::size_t>(found - openings.begin());
      if (found == openings.end()) {
        openings.push_back({level_for(starter.window, size_class)});
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
  for (Opening& opening : openings) opening.unsorted.spheres.resize(opening.unsorted.numbers.size());
  return first_bodies;
}

void BroadPhase::remove_starter(std::uint32_t number) {
  assert(is_starter(number) && !filling_.is_surveyed);
  Registration& here = registrations_[number];
  for (auto& [level, unsorted, spread, cells] : filling_.openings) {
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

void BroadPhase::survey(PoolLease& lease) {
  for (Opening& opening : filling_.openings)
    opening.spread = SweptSphereGrid::spread_of(opening.unsorted, lease);
  filling_.is_surveyed = true;
}

void BroadPhase::choose_cells(PoolLease& lease) {
  if (!filling_.is_surveyed) survey(lease);
  for (Opening& opening : filling_.openings) {
    GridLevel& level = levels_[opening.level];
    sort_to_start(
        level, [&] { level.spheres.choose_cells(opening.unsorted, opening.spread, opening.cells, lease); });
  }
  filling_.has_cells = true;
}

/// Fills the grid levels in which bodies start, which are empty, and sorts the lasting levels that have
/// changed much.
void BroadPhase::finish_start(PoolLease& lease) {
  if (!filling_.has_cells) choose_cells(lease);
  for (const Opening& opening : filling_.openings)
    levels_[opening.level].spheres.fill(
        opening.unsorted, opening.cells, lease,
        [&](std::uint32_t number, std::uint32_t slot) { registrations_[number].slot = slot; });
  for (GridLevel& level : levels_)
    if (!level.fresh && level.changes > least_changes + level.spheres.size() / 2) {
      // Which levels are sorted depends on the number of threads, so their coarseness is not recorded.
      level.spheres.set_coarseness(size_classes_.coarseness(level.window.rung, level.size_class));
      sort(level, lease);
      level.changes = 0;
    }
  merge_size_classes(filling_.sizes);
  filling_ = {};
}

BroadPhase BroadPhase::successor(double begin, double entry, std::uint64_t changes) const {
  BroadPhase next(space_);
  next.search_begin_ = begin;
  next.taken_over_ = entry;
  next.registrations_.resize(registrations_.size());
  next.size_classes_ = size_classes_;
  next.size_classes_.use_merged();
  next.note_changes_of_ended(changes, size());
  return next;
}

/// Takes the starters of a successor out of their grid levels, but not out of registrations_. Levels that
/// only had starters become unused.
void BroadPhase::take_out_starters(const BroadPhase& successor) {
  std::vector<std::size_t> starters(levels_.size());
  const auto for_each_starter = [&](auto visit) {
    for (std::uint32_t number = 0; number < successor.registrations_.size(); ++number)
      if (successor.contains(number) && contains(number)) visit(registrations_[number]);
  };
  for_each_starter([&](const Registration& here) { ++starters[here.level]; });
  bool are_all = true;
  std::uint64_t changes = 0;
  std::uint64_t bodies = 0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    GridLevel& level = levels_[k];
    level.fresh = false;
    if (starters[k] > 0) changes += std::exchange(level.changes, 0);
    bodies += starters[k];
    if (starters[k] < level.spheres.size()) {
      are_all = are_all && starters[k] == 0;
      continue;
    }
    level.spheres.clear({});
    level.window.end = -infinity;
  }
  note_changes_of_ended(changes, bodies);
  if (are_all) return;
  for_each_starter([&](const Registration& here) {
    if (levels_[here.level].window.end > -infinity) levels_[here.level].spheres.remove(here.slot);
  });
}

BroadPhase BroadPhase::take_over(BroadPhase&& successor) {
  take_out_starters(successor);
  for (GridLevel& started : successor.levels_) {
    if (started.is_empty()) continue;
    started.fresh = true;
    const auto unused = std::find_if(levels_.begin(), levels_.end(),
                                     [](const GridLevel& level) { return level.window.end == -infinity; });
    (unused == levels_.end() ? levels_.emplace_back() : *unused) = std::move(started);
  }
  registrations_.resize(std::max(registrations_.size(), successor.registrations_.size()));
  size_classes_ = std::move(successor.size_classes_);
  base_ = successor.base_;
  has_base_ = successor.has_base_;
  taken_over_ = successor.taken_over_;
  search_begin_ = successor.search_begin_;
  awaiting_.assign(registrations_.size(), Search::none);
  next_end_ = infinity;
  BroadPhase copy(space_);
  for (std::uint32_t index = 0; index < levels_.size(); ++index) {
    const GridLevel& level = levels_[index];
    if (level.is_empty()) continue;
    next_end_ = std::min(next_end_, level.window.end);
    if (level.window.end <= search_begin_) continue;
    copy.levels_.push_back(level);
    const SweptSphereTable& table = level.spheres.table();
    for (std::uint32_t slot = 0; slot < table.slots(); ++slot) {
      const std::uint32_t number = table.number_at(slot);
      if (number == SweptSphereTable::free_slot) continue;
      if (level.fresh) registrations_[number] = {level.window.end, index, slot};
      const bool is_sorted = slot < level.spheres.sorted_slots();
      awaiting_[number] = !level.fresh ? Search::found : is_sorted ? Search::starts : Search::starts_alone;
    }
  }
  return copy;
}

void BroadPhase::end_search() {
  awaiting_.clear();
  search_begin_ = -infinity;
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
void BroadPhase::sort_to_start(GridLevel& level, Sort sort_level) {
  const float before = size_classes_.coarseness(level.window.rung, level.size_class);
  level.spheres.set_coarseness(before);
  sort_level();
  level.changes = 0;
  const float after = level.spheres.coarseness();
  if (after != before) size_classes_.set_coarseness(level.window.rung, level.size_class, after);
}

/// Chooses merged size classes for the next start, if at least half of all bodies have started now.
void BroadPhase::merge_size_classes(const Sizes& sizes) {
  const bool flat = space_.is_flat();
  double volume = 0.0;
  std::size_t all = 0;
  for (const GridLevel& level : levels_) {
    if (!level.fresh || level.is_empty()) continue;
    all += level.spheres.size();
    const double unit = SizeClasses::unit_of(level.size_class);
    const double units = flat ? unit * unit : unit * unit * unit;
    volume =
        std::max(volume, static_cast<double>(level.spheres.size()) * units / level.spheres.density(flat));
  }
  if (2 * all >= size()) size_classes_.merge(sizes, volume, flat);
}

}  // namespace kinesphere
