// Windows end for many bodies at once, which start in others: they are sorted into layers that are filled as
// a whole.
#include <algorithm>

#include "broadphase/broad_phase.hpp"

namespace kinesphere {
namespace {

/// A layer that lasts while others start is sorted with them if more than this has changed in it, and more
/// than a half.
constexpr std::uint64_t least_changes = 64;

}  // namespace

/// Calls visit(number) for the bodies whose windows have ended: if these are many, in the order of their
/// numbers. Else going through all would take longer than sorting them.
template <class Visit>
void BroadPhase::for_each_ended(double now, bool all, Visit visit) const {
  const auto has_ended = [=](double end) { return all ? end < infinity : end <= now; };
  std::size_t most = 0;
  for (const GridLevel& layer : levels_)
    if (has_ended(layer.window.end)) most += layer.spheres.size();
  constexpr std::size_t few_of_all = 16;
  if (few_of_all * most >= registrations_.size()) {
    for (std::uint32_t number = 0; number < registrations_.size(); ++number)
      if (contains(number) && has_ended(registrations_[number].end)) visit(number);
    return;
  }
  for (const GridLevel& layer : levels_) {
    if (!has_ended(layer.window.end)) continue;
    const SweptSphereTable& table = layer.spheres.table();
    for (std::uint32_t place = 0; place < table.slots(); ++place) {
      const std::uint32_t number = table.number_at(place);
      if (number != SweptSphereTable::nobody) visit(number);
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
  for (GridLevel& layer : levels_) {
    const bool has_ended = all ? layer.window.end < infinity : layer.window.end <= now;
    layer.fresh = false;
    if (has_ended || layer.is_empty()) {
      layer.spheres.clear({});
      layer.window.end = -infinity;
    } else {
      next_end_ = std::min(next_end_, layer.window.end);
    }
  }
}

std::vector<int> BroadPhase::held_rungs() const {
  std::vector<int> held;
  for (const GridLevel& layer : levels_)
    if (!layer.fresh && !layer.is_empty()) held.push_back(layer.window.rung);
  return held;
}

std::size_t BroadPhase::started() const {
  std::size_t all = 0;
  for (const GridLevel& layer : levels_)
    if (layer.fresh) all += layer.spheres.table().slots();
  return all;
}

/// Gives each its place in what is to become a layer.
std::vector<BroadPhase::Opening> BroadPhase::choose_levels(std::span<const Starter> starters, Sizes& sizes) {
  std::vector<Opening> openings;
  // Most are like the one before.
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
    if (at == openings.size() || !suits(openings[at])) {
      const auto found = std::find_if(openings.begin(), openings.end(), suits);
      at = static_cast<std::size_t>(found - openings.begin());
      if (found == openings.end()) {
        openings.push_back({level_for(starter.window, level), starter.number, 0});
        levels_[openings.back().level].fresh = true;
      }
    }
    if (starter.number >= registrations_.size()) registrations_.resize(starter.number + std::size_t{1});
    registrations_[starter.number] = {starter.window.end, openings[at].level,
                                      static_cast<std::uint32_t>(openings[at].bodies++)};
  }
  return openings;
}

/// Of the layers that bodies start in, which are empty, the capsules are given.
void BroadPhase::finish_start(const std::vector<UnsortedSweptSpheres>& unsorted, PoolLease& shift) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    GridLevel& layer = levels_[k];
    if (layer.fresh) {
      sort_to_start(layer, [&] {
        layer.spheres.fill(unsorted[k], shift, [&](std::uint32_t number, std::uint32_t place) {
          registrations_[number].slot = place;
        });
      });
    } else if (layer.changes > least_changes + layer.spheres.size() / 2) {
      sort_to_start(layer, [&] { sort(layer, shift); });
    }
  }
}

/// What is known of the layer from now on is the same, whatever has been changed in which order.
template <class Sort>
void BroadPhase::sort_to_start(GridLevel& layer, Sort sort_layer) {
  const float before = size_classes_.coarseness(layer.window.rung, layer.size_class);
  layer.spheres.set_coarseness(before);
  sort_layer();
  layer.changes = 0;
  const float after = layer.spheres.coarseness();
  if (after != before) size_classes_.set_coarseness(layer.window.rung, layer.size_class, after);
}

/// For the next start, if most bodies have started now.
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
