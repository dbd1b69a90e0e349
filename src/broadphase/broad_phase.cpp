#include "broadphase/broad_phase.hpp"

#include <cassert>
#include <cmath>

namespace kinesphere {

Box BroadPhase::box_of(std::uint32_t number, double now) const {
  const Registration& here = registrations_[number];
  return space_.within(levels_[here.level].box_at(here.slot, now));
}

std::size_t BroadPhase::size() const {
  std::size_t all = 0;
  for (const GridLevel& level : levels_) all += level.spheres.size();
  return all;
}

std::size_t BroadPhase::size_of(const Window& window) const {
  std::size_t all = 0;
  for (const GridLevel& level : levels_)
    if (level.window == window) all += level.spheres.size();
  return all;
}

std::size_t BroadPhase::moving() const {
  std::size_t all = 0;
  for (const GridLevel& level : levels_)
    if (level.window.end < infinity) all += level.spheres.size();
  return all;
}

double BroadPhase::least_width() const {
  double least = infinity;
  for (const GridLevel& level : levels_)
    if (!level.is_empty()) least = std::min(least, level.widest());
  return least;
}

/// Returns the index of the grid level with this window and size class. If there is none, an unused level is
/// taken or one is added; it has no frame until open().
std::uint32_t BroadPhase::level_for(const Window& window, int size_class) {
  std::uint32_t free = none;
  for (std::uint32_t k = 0; k < levels_.size(); ++k) {
    const GridLevel& level = levels_[k];
    if (level.is_of(window, size_class)) return k;
    // An empty level whose window has ended can be reused, even while other windows last.
    const bool over =
        !level.fresh && level.is_empty() && window.end < infinity && level.window.end <= window.begin();
    if ((level.window.end == -infinity || over) && free == none) free = k;
  }
  if (free == none) {
    free = static_cast<std::uint32_t>(levels_.size());
    levels_.emplace_back();
  }
  GridLevel& level = levels_[free];
  level = {.window = window, .size_class = size_class, .spheres = std::move(level.spheres)};
  return free;
}

void BroadPhase::open(GridLevel& level, double origin) {
  level.open(base_, origin, size_classes_.coarseness(level.window.rung, level.size_class));
  level.spheres.set_spare_slots(has_many_changes_ && level.window.end < infinity);
  next_end_ = std::min(next_end_, level.window.end);
}

void BroadPhase::add(std::uint32_t number, std::uint32_t level, const InflatedBound& bound, double now) {
  GridLevel& to = levels_[level];
  registrations_[number] = {to.window.end, level,
                            to.spheres.add(number, to.swept_sphere(bound, now), to.time(now))};
}

BroadPhase::Entry BroadPhase::prepare(std::uint32_t number, const InflatedBound& bound, double now,
                                      const Window& window) const {
  Entry entry{.size_class = size_classes_.size_class_to_enter(SizeClasses::size_class_of(bound, window))};
  if (!contains(number)) return entry;
  const Registration& here = registrations_[number];
  const GridLevel& level = levels_[here.level];
  if (!level.is_of(window, entry.size_class)) return entry;
  entry.sphere = level.swept_sphere(bound, now);
  const auto looseness = level.spheres.looseness_at(here.slot, entry.sphere, level.time(now));
  if (!looseness) return entry;
  entry.level = here.level;
  entry.slot = here.slot;
  entry.looseness = *looseness;
  return entry;
}

/// Thread safety: concurrent calls for different bodies are safe.
void BroadPhase::replace(const Entry& entry, double now, SweptSphereGrid::Growth& growth) {
  GridLevel& level = levels_[entry.level];
  level.spheres.replace(entry.slot, entry.sphere, level.time(now), entry.looseness, growth);
}

/// The order in which bodies enter does not change what searches find: a body's size class depends on its
/// window, but not on when in it the body enters, and a level has the same frame whichever body enters first.
void BroadPhase::enter(std::uint32_t number, const InflatedBound& bound, double now, const Window& window) {
  note_change(number);
  const Entry entry = prepare(number, bound, now, window);
  if (entry.level != none) {
    SweptSphereGrid::Growth growth;
    replace(entry, now, growth);
    return levels_[entry.level].grow(growth);
  }
  if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
  const std::uint32_t level = level_for(window, entry.size_class);
  ++levels_[level].changes;
  if (registrations_[number].level == level) {
    take_out(number);
  } else if (registrations_[number].level != none) {
    leave(number);
  }
  if (!levels_[level].has_frame) {
    if (!has_base_) base_ = bound.moved.centre;
    has_base_ = true;
    // A window that begins later than now is entered early, as at the last take_over().
    const double begin = window.end < infinity ? window.begin() : 0.0;
    open(levels_[level], begin > now && window.end < infinity ? taken_over_ : begin);
  }
  add(number, level, bound, now);
}

void BroadPhase::leave(std::uint32_t number) {
  assert(contains(number));
  note_change(number);
  ++levels_[registrations_[number].level].changes;
  take_out(number);
}

void BroadPhase::take_out(std::uint32_t number) {
  Registration& here = registrations_[number];
  levels_[here.level].spheres.remove(here.slot);
  here.level = none;
}

void BroadPhase::sort(GridLevel& level, PoolLease& lease) {
  level.spheres.sort(
      lease, [this](std::uint32_t number, std::uint32_t slot) { registrations_[number].slot = slot; });
}

void BroadPhase::tidy(PoolLease& lease) {
  for (GridLevel& level : levels_)
    if (level.spheres.is_untidy()) sort(level, lease);
}

std::optional<std::string> BroadPhase::check(std::uint32_t number) const {
  const Registration& here = registrations_[number];
  if (here.level >= levels_.size()) return "is in a level that is not there";
  if (!is_in_its_level(number)) return "is not where its level has it";
  if (here.end != levels_[here.level].window.end) return "is not in the window of its level";
  return std::nullopt;
}

/// Returns where the bodies that start in a level are kept until they are sorted; nullptr if none do.
const BroadPhase::Opening* BroadPhase::opening_of(std::uint32_t level) const {
  const auto found = std::find_if(filling_.openings.begin(), filling_.openings.end(),
                                  [=](const Opening& opening) { return opening.level == level; });
  return found == filling_.openings.end() ? nullptr : &*found;
}

/// True if the slot of the body is its own, or its index among the swept spheres that are not sorted yet.
bool BroadPhase::is_in_its_level(std::uint32_t number) const {
  const auto& [end, level, slot] = registrations_[number];
  if (const Opening* const opening = opening_of(level)) {
    const std::vector<std::uint32_t>& numbers = opening->unsorted.numbers;
    return slot < numbers.size() && numbers[slot] == number;
  }
  const SweptSphereTable& table = levels_[level].spheres.table();
  return slot < table.slots() && table.number_at(slot) == number;
}

bool BroadPhase::filling_is_valid() const {
  return std::all_of(filling_.openings.begin(), filling_.openings.end(),
                     [this](const Opening& opening) {
                       const auto& [level, unsorted, spread, cells] = opening;
                       return level < levels_.size() && levels_[level].has_frame && levels_[level].fresh &&
                              levels_[level].window.is_valid() &&
                              levels_[level].spheres.table().slots() == 0 &&
                              unsorted.spheres.size() == unsorted.numbers.size() &&
                              (!filling_.has_cells || (cells.size() == unsorted.spheres.size() &&
                                                       levels_[level].spheres.can_fill(cells)));
                     }) &&
         std::all_of(filling_.sizes.begin(), filling_.sizes.end(),
                     [](const auto& size) { return SizeClasses::is_size_class(size.first); });
}

bool BroadPhase::is_valid_successor(std::size_t bodies, bool is_surveyed, bool has_cells) const {
  if (filling_.is_surveyed != is_surveyed || filling_.has_cells != has_cells) return false;
  if (registrations_.size() > bodies || !size_classes_.is_valid() || !is_finite(base_) ||
      std::isnan(next_end_) || !filling_is_valid() ||
      std::any_of(changes_.begin(), changes_.end(), [=](std::uint32_t number) { return number >= bodies; }))
    return false;
  if (std::isnan(search_begin_) || std::isnan(taken_over_) || awaiting_.size() > registrations_.size())
    return false;
  std::size_t registered = 0;
  for (std::uint32_t number = 0; number < registrations_.size(); ++number) {
    if (!contains(number)) {
      if (search_of(number) != Search::none) return false;
      continue;
    }
    ++registered;
    if (std::isnan(registrations_[number].end) || check(number)) return false;
    if (search_of(number) != Search::none && !(end_of(number) > search_begin_)) return false;
  }
  std::size_t in_levels = size();
  for (const Opening& opening : filling_.openings) in_levels += opening.unsorted.numbers.size();
  return registered == in_levels &&
         std::all_of(levels_.begin(), levels_.end(), [this](const GridLevel& level) {
           return level.is_valid() && (level.is_empty() || next_end_ <= level.window.end);
         });
}

bool BroadPhase::is_valid_copy(std::size_t bodies) const {
  return std::all_of(levels_.begin(), levels_.end(), [=](const GridLevel& level) {
    const SweptSphereTable& table = level.spheres.table();
    for (std::uint32_t slot = 0; slot < table.slots(); ++slot)
      if (table.number_at(slot) >= bodies && table.number_at(slot) != SweptSphereTable::free_slot)
        return false;
    return level.is_valid();
  });
}

}  // namespace kinesphere
