#include "window/windows.hpp"

#include <cmath>

namespace kinesphere {

Box Windows::box_of(std::uint32_t number, double now) const {
  const Registration& here = registrations_[number];
  return space_.within(layers_[here.layer].box_at(here.place, now));
}

std::size_t Windows::size() const {
  std::size_t all = 0;
  for (const WindowLayer& layer : layers_) all += layer.capsules.size();
  return all;
}

std::size_t Windows::moving() const {
  std::size_t all = 0;
  for (const WindowLayer& layer : layers_)
    if (layer.window.end < infinity) all += layer.capsules.size();
  return all;
}

double Windows::least_width() const {
  double least = infinity;
  for (const WindowLayer& layer : layers_)
    if (!layer.is_empty()) least = std::min(least, layer.widest());
  return least;
}

/// The layer of this window and level, which may be without a frame yet, if it is empty.
std::uint32_t Windows::layer_for(const Window& window, int level) {
  std::uint32_t free = none;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    const WindowLayer& layer = layers_[k];
    if (layer.is_of(window, level)) return k;
    // One that is over, though others go on, is of no use to anybody.
    const bool over =
        !layer.fresh && layer.is_empty() && window.end < infinity && layer.window.end <= window.begin();
    if ((layer.window.end == -infinity || over) && free == none) free = k;
  }
  if (free == none) {
    free = static_cast<std::uint32_t>(layers_.size());
    layers_.emplace_back();
  }
  WindowLayer& layer = layers_[free];
  layer = {.window = window, .level = level, .capsules = std::move(layer.capsules)};
  return free;
}

void Windows::open(WindowLayer& layer, double origin) {
  layer.open(base_, origin, levels_.coarseness(layer.window.tier, layer.level));
  next_end_ = std::min(next_end_, layer.window.end);
}

void Windows::add(std::uint32_t number, std::uint32_t layer, const RoomyBound& bound, double now) {
  WindowLayer& to = layers_[layer];
  registrations_[number] = {to.window.end, layer,
                            to.capsules.add(number, to.capsule(bound, now), to.time(now))};
}

Windows::Entry Windows::prepare(std::uint32_t number, const RoomyBound& bound, double now,
                                const Window& window) const {
  Entry entry{.level = levels_.level_to_enter(SizeLevels::level_of(bound, window))};
  if (!contains(number)) return entry;
  const Registration& here = registrations_[number];
  const WindowLayer& layer = layers_[here.layer];
  if (!layer.is_of(window, entry.level)) return entry;
  entry.capsule = layer.capsule(bound, now);
  const auto overhang = layer.capsules.overhang_at(here.place, entry.capsule, layer.time(now));
  if (!overhang) return entry;
  entry.layer = here.layer;
  entry.place = here.place;
  entry.overhang = *overhang;
  return entry;
}

/// Several threads may do that at the same time, for different bodies.
void Windows::replace(const Entry& entry, double now, Layer::Growth& growth) {
  WindowLayer& layer = layers_[entry.layer];
  layer.capsules.replace(entry.place, entry.capsule, layer.time(now), entry.overhang, growth);
}

/// As the body is of the same size for the same window, whenever in it the body enters, and as a layer has
/// the same frame, whoever enters first, searches find the same in whatever order bodies enter.
void Windows::enter(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) {
  const Entry entry = prepare(number, bound, now, window);
  if (entry.layer != none) {
    Layer::Growth growth;
    replace(entry, now, growth);
    return layers_[entry.layer].grow(growth);
  }
  if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
  const std::uint32_t layer = layer_for(window, entry.level);
  ++layers_[layer].changes;
  if (registrations_[number].layer == layer) {
    take_out(number);
  } else if (registrations_[number].layer != none) {
    leave(number);
  }
  if (!layers_[layer].has_frame) {
    if (!has_base_) base_ = bound.moved.centre;
    has_base_ = true;
    open(layers_[layer], window.end < infinity ? window.begin() : 0.0);
  }
  add(number, layer, bound, now);
}

void Windows::leave(std::uint32_t number) {
  ++layers_[registrations_[number].layer].changes;
  take_out(number);
}

void Windows::take_out(std::uint32_t number) {
  Registration& here = registrations_[number];
  layers_[here.layer].capsules.remove(here.place);
  here.layer = none;
}

void Windows::sort(WindowLayer& layer, Shift& shift) {
  layer.capsules.sort(
      shift, [this](std::uint32_t number, std::uint32_t place) { registrations_[number].place = place; });
}

void Windows::tidy(Shift& shift) {
  for (WindowLayer& layer : layers_)
    if (layer.capsules.is_untidy()) sort(layer, shift);
}

std::optional<std::string> Windows::check(std::uint32_t number) const {
  const Registration& here = registrations_[number];
  if (here.layer >= layers_.size()) return "is in a layer that is not there";
  const CapsuleTable& table = layers_[here.layer].capsules.table();
  if (here.place >= table.places() || table.number_at(here.place) != number)
    return "is not where its layer has it";
  if (here.end != layers_[here.layer].window.end) return "is not in the window of its layer";
  return std::nullopt;
}

bool Windows::is_sound(std::size_t bodies) const {
  if (registrations_.size() > bodies || !levels_.is_sound() || !is_finite(base_) || std::isnan(next_end_))
    return false;
  std::size_t registered = 0;
  for (std::uint32_t number = 0; number < registrations_.size(); ++number) {
    if (!contains(number)) continue;
    ++registered;
    if (std::isnan(registrations_[number].end) || check(number)) return false;
  }
  return registered == size() &&
         std::all_of(layers_.begin(), layers_.end(), [this](const WindowLayer& layer) {
           return layer.is_sound() && (layer.is_empty() || next_end_ <= layer.window.end);
         });
}

}  // namespace kinesphere
