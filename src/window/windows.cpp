#include "window/windows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Levels differ by this many powers of two in the size of capsules.
constexpr int powers_in_a_level = 3;
/// The shortest window at a time may not be shorter than what its multiples can tell.
constexpr int digits = 50;
constexpr int longest_tier = 300;
constexpr int largest_level = 300;

int power_below(double value, int largest) { return std::clamp(exponent_of(value), -largest, largest); }

double end_of_window(int tier, double now) {
  return (std::floor(now * power_of_two(-tier)) + 1.0) * power_of_two(tier);
}

double largest_part(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

int level_of(const RoomyBound& bound, double duration) {
  const double width =
      2.0 * (bound.moved.radius_after(duration) + bound.room) + largest_part(bound.moved.velocity) * duration;
  const int power = power_below(width, largest_level);
  return power >= 0 ? power / powers_in_a_level : -((powers_in_a_level - 1 - power) / powers_in_a_level);
}

/// What the last search of a layer has cost.
void note_cost(Windows::Scratch& scratch, std::size_t found) {
  scratch.cost.found += found;
  for (const Run& run : scratch.layer.runs) scratch.cost.capsules += run.end - run.begin;
  scratch.cost.rows += scratch.layer.runs.size();
}

/// What stands still is as large as it is, for however long.
double duration_until(double end, double now) { return end < infinity ? end - now : 0.0; }

bool is_within_a_period(const Box& box, const Space& space) {
  for (int axis = 0; axis < 3; ++axis)
    if (space.repeats(axis) && !(box.upper[axis] - box.lower[axis] < space.period()[axis])) return false;
  return true;
}

}  // namespace

Box RoomyBound::box_of_way(double duration) const {
  const Vec3 end = moved.centre + moved.velocity * duration;
  const double half = moved.radius_after(duration) + room;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(moved.centre[axis], end[axis]) - half;
    box.upper[axis] = std::max(moved.centre[axis], end[axis]) + half;
  }
  return box;
}

void Windows::reserve(std::size_t bodies) { registrations_.reserve(bodies); }

std::size_t Windows::size() const {
  std::size_t all = 0;
  for (const Member& member : layers_) all += member.layer.size();
  return all;
}

std::size_t Windows::moving() const {
  std::size_t all = 0;
  for (const Member& member : layers_)
    if (member.end < infinity) all += member.layer.size();
  return all;
}

/// The layer of this window and level, or an empty one that becomes it now.
std::uint32_t Windows::layer_for(const Window& window, const Vec3& base, int level, double now) {
  const auto& [tier, end] = window;
  std::uint32_t empty = none;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    Member& member = layers_[k];
    if (member.layer.size() == 0) {
      if (empty == none) empty = k;
    } else if (member.tier == tier && member.level == level && member.end == end) {
      return k;
    }
  }
  if (empty == none) {
    empty = static_cast<std::uint32_t>(layers_.size());
    layers_.emplace_back();
  }
  Member& member = layers_[empty];
  member.tier = tier;
  member.level = level;
  member.end = end;
  member.fresh = false;
  CapsuleFrame frame{.base = base, .per_length = power_of_two(-powers_in_a_level * level)};
  if (end < infinity) {
    frame.origin = now;
    frame.per_time = 1.0 / (end - now);
  }
  member.layer.clear(frame);
  next_end_ = std::min(next_end_, end);
  return empty;
}

Capsule Windows::Member::capsule(const RoomyBound& bound, double now) const {
  return capsule_of(bound.moved, now, duration_until(end, now), bound.room, layer.frame());
}

/// In the frame of its layer.
float Windows::Member::time(double now) const { return end < infinity ? layer.frame().time(now) : 0.0f; }

void Windows::add(std::uint32_t number, std::uint32_t layer, const RoomyBound& bound, double now) {
  Member& member = layers_[layer];
  const std::uint32_t place = member.layer.add(number, member.capsule(bound, now), member.time(now));
  registrations_[number] = {member.end, layer, place};
}

Window Windows::window_at(double now, int tier) {
  const int shortest = power_below(std::abs(now), longest_tier) - digits;
  const int possible = std::clamp(tier, std::max(shortest, -longest_tier), longest_tier);
  return {possible, end_of_window(possible, now)};
}

void Windows::enter(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) {
  if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
  if (const Registration& here = registrations_[number]; here.layer != none) {
    Member& member = layers_[here.layer];
    if (member.tier == window.tier && member.end == window.end) {
      if (member.layer.replace(here.place, member.capsule(bound, now), member.time(now))) return;
    }
    leave(number);
  }
  const int level = layer_level(level_of(bound, duration_until(window.end, now)));
  add(number, layer_for(window, bound.moved.centre, level, now), bound, now);
}

/// Of its size, or of the larger ones that it is merged with.
int Windows::layer_level(int level) const {
  for (const Merged& merged : merged_)
    if (merged.level == level) return merged.into;
  return level;
}

/// Next time bodies will share the layer of the next larger ones if searches there find few of them.
void Windows::merge_levels() {
  constexpr double few = 48.0;
  constexpr double widths_searched = 2.5;
  double volume = 0.0;
  std::size_t all = 0;
  for (const Member& member : layers_) {
    if (!member.fresh || member.layer.size() == 0) continue;
    all += member.layer.size();
    const double unit = 1.0 / member.layer.frame().per_length;
    const double units = space_.is_flat() ? unit * unit : unit * unit * unit;
    volume = std::max(
        volume, static_cast<double>(member.layer.size()) * units / member.layer.density(space_.is_flat()));
  }
  if (2 * all < size()) return;
  merged_.clear();
  std::vector<int> together;
  double density = 0.0;
  for (auto at = sizes_.begin(); at != sizes_.end(); ++at) {
    together.push_back(at->first);
    density += static_cast<double>(at->second) / volume;
    const auto next = std::next(at);
    const double width =
        widths_searched * power_of_two(powers_in_a_level * (next == sizes_.end() ? 0 : next->first) + 2);
    const double found = density * (space_.is_flat() ? width * width : width * width * width);
    if (next != sizes_.end() && found < few) continue;
    for (const int level : together) merged_.push_back({level, at->first});
    together.clear();
    density = 0.0;
  }
}

void Windows::leave(std::uint32_t number) {
  Registration& here = registrations_[number];
  layers_[here.layer].layer.remove(here.place);
  here.layer = none;
}

void Windows::sort(std::uint32_t layer) {
  layers_[layer].layer.sort(
      [this](std::uint32_t number, std::uint32_t place) { registrations_[number].place = place; });
}

/// Calls finds(place) for what may be near in one layer, in this image of it, from now on until `end` or
/// until the window of the layer ends.
template <class Finds>
void Windows::search_image(const Member& member, const RoomyBound& bound, double now, double end, Finds finds,
                           Scratch& scratch) const {
  const Layer& layer = member.layer;
  CapsuleFrame frame = layer.frame();
  float from = 0.0f;
  float to = 0.0f;
  if (end < infinity && member.end == infinity) {
    // What stands still has no times of its own.
    frame.origin = now;
    frame.per_time = power_of_two(-power_below(end - now, longest_tier));
  }
  if (end < infinity || member.end < infinity) {
    from = frame.time(now);
    to = frame.time(std::min(end, member.end));
  }
  const CapsuleQuery query{capsule_of(bound.moved, now, duration_until(end, now), bound.room, frame), from,
                           to};
  const auto found = layer.search(query, scratch.layer);
  note_cost(scratch, found.size());
  for (const std::uint32_t place : found) finds(place);
}

/// Calls finds(place, shifted) for what may be near in one layer, in all images; `shifted` in another one.
template <class Finds>
void Windows::search(const Member& member, const RoomyBound& bound, double now, double end, Finds finds,
                     Scratch& scratch) const {
  const auto search_shifted = [&](const Vec3& shift) {
    RoomyBound image = bound;
    image.moved.centre += shift;
    search_image(
        member, image, now, end, [&](std::uint32_t place) { finds(place, shift != Vec3{}); }, scratch);
  };
  if (!space_.repeats()) return search_shifted({});
  const Box box = bound.box_of_way(duration_until(end, now));
  if (!is_within_a_period(box, space_)) {
    // It may overlap several images of all: a search of one would not do.
    for (std::uint32_t place = 0; place < member.layer.places(); ++place) finds(place, true);
    return;
  }
  space_.for_each_image(box, member.layer.widest() / member.layer.frame().per_length,
                        [&](const Box&, const Vec3& shift) { search_shifted(shift); });
}

std::span<const std::uint32_t> Windows::near(std::uint32_t number, const RoomyBound& bound, double now,
                                             Scratch& scratch) const {
  scratch.numbers.clear();
  const double end = registrations_[number].end;
  for (const Member& member : layers_) {
    if (member.layer.size() == 0) continue;
    const auto note = [&](std::uint32_t place, bool) {
      const std::uint32_t other = member.layer.number_at(place);
      if (other != number && other != Layer::nobody) scratch.numbers.push_back(other);
    };
    search(member, bound, now, end, note, scratch);
  }
  return scratch.numbers;
}

std::span<const std::uint32_t> Windows::in_box(const Box& box, double now, Scratch& scratch) const {
  scratch.numbers.clear();
  for (const Member& member : layers_) {
    if (member.layer.size() == 0) continue;
    const double end = member.end < infinity ? now : infinity;
    const auto search_near = [&](const Box& image, const Vec3&) {
      Bound ball{.time = now, .position = 0.5 * (image.lower + image.upper)};
      ball.radius = 0.5 * norm(image.upper - image.lower);
      const auto note = [&](std::uint32_t place) {
        const std::uint32_t number = member.layer.number_at(place);
        if (number != Layer::nobody) scratch.numbers.push_back(number);
      };
      search_image(member, {MovedBound(ball, now), 0.0}, now, end, note, scratch);
    };
    space_.for_each_image(box, member.layer.widest() / member.layer.frame().per_length, search_near);
  }
  return scratch.numbers;
}

double Windows::least_width() const {
  double least = infinity;
  for (const Member& member : layers_)
    if (member.layer.size() > 0)
      least = std::min(least, member.layer.widest() / member.layer.frame().per_length);
  return least;
}

std::vector<std::uint32_t> Windows::ended(double now, bool all) const {
  std::vector<std::uint32_t> numbers;
  for (const Member& member : layers_) {
    if (all ? member.end == infinity : member.end > now) continue;
    for (std::uint32_t place = 0; place < member.layer.places(); ++place) {
      const std::uint32_t number = member.layer.number_at(place);
      if (number != Layer::nobody) numbers.push_back(number);
    }
  }
  return numbers;
}

void Windows::end_windows(double now, bool all) {
  for (const std::uint32_t number : ended(now, all)) registrations_[number].layer = none;
  for (Member& member : layers_) {
    member.fresh = false;
    if (all ? member.end < infinity : member.end <= now) member.layer.clear({});
  }
  next_end_ = infinity;
  for (const Member& member : layers_)
    if (member.layer.size() > 0) next_end_ = std::min(next_end_, member.end);
}

bool Windows::is_free(const Window& window) const {
  return std::none_of(layers_.begin(), layers_.end(), [&](const Member& member) {
    return member.tier == window.tier && !member.fresh && member.layer.size() > 0;
  });
}

void Windows::start(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) {
  if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
  const int level = level_of(bound, duration_until(window.end, now));
  ++sizes_[level];
  const std::uint32_t layer = layer_for(window, bound.moved.centre, layer_level(level), now);
  if (layers_[layer].layer.size() == 0) layers_[layer].fresh = true;
  add(number, layer, bound, now);
}

void Windows::tidy() {
  for (std::uint32_t k = 0; k < layers_.size(); ++k)
    if (layers_[k].layer.is_untidy()) sort(k);
}

void Windows::finish_start() {
  std::size_t layers = 0;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    if (layers_[k].layer.size() > 0) ++layers;
    if (layers_[k].fresh) sort(k);
  }
  needs_bounds_ = layers > 1 || space_.repeats();
  merge_levels();
  sizes_.clear();
}

std::size_t Windows::started() const {
  std::size_t all = 0;
  for (const Member& member : layers_)
    if (member.fresh) all += member.layer.places();
  return all;
}

Windows::Started Windows::started_at(std::size_t k) const {
  for (std::uint32_t layer = 0; layer < layers_.size(); ++layer) {
    if (!layers_[layer].fresh) continue;
    const std::size_t places = layers_[layer].layer.places();
    if (k < places) return {layer, static_cast<std::uint32_t>(k)};
    k -= places;
  }
  assert(false);
  return {none, 0};
}

std::uint32_t Windows::started_number(std::size_t k) const {
  const Started at = started_at(k);
  return layers_[at.layer].layer.number_at(at.place);
}

void Windows::near_behind(const Started& at, Scratch& scratch) const {
  const Layer& layer = layers_[at.layer].layer;
  const auto found = layer.search_behind(at.place, scratch.layer);
  note_cost(scratch, found.size());
  for (const std::uint32_t place : found) scratch.numbers.push_back(layer.number_at(place));
}

void Windows::near_behind(const Started& at, const RoomyBound& bound, double now, Scratch& scratch) const {
  near_behind(at, scratch);
  const std::uint32_t number = layers_[at.layer].layer.number_at(at.place);
  const double end = registrations_[number].end;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    const Member& member = layers_[k];
    if (member.layer.size() == 0 || (member.fresh && k < at.layer) || (k == at.layer && !space_.repeats()))
      continue;
    const auto note = [&](std::uint32_t place, bool shifted) {
      if (k == at.layer && (!shifted || place <= at.place)) return;
      const std::uint32_t other = member.layer.number_at(place);
      if (other != Layer::nobody) scratch.numbers.push_back(other);
    };
    search(member, bound, now, end, note, scratch);
  }
}

Box Windows::box_of(std::uint32_t number, double now) const {
  const Registration& here = registrations_[number];
  const Layer& layer = layers_[here.layer].layer;
  const CapsuleFrame& frame = layer.frame();
  const Capsule capsule = layer.capsule_at(here.place);
  const float from = here.end < infinity ? frame.time(now) : 0.0f;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double first = double(capsule.centre[k]) + double(capsule.velocity[k]) * double(from);
    const double last = double(capsule.centre[k]) + double(capsule.velocity[k]);
    const double radius = capsule.radius;
    const double at_end = here.end < infinity ? last : first;
    box.lower[axis] = frame.base[axis] + (std::min(first, at_end) - radius) / frame.per_length;
    box.upper[axis] = frame.base[axis] + (std::max(first, at_end) + radius) / frame.per_length;
  }
  return space_.within(box);
}

std::optional<std::string> Windows::check(std::uint32_t number) const {
  const Registration& here = registrations_[number];
  if (here.layer >= layers_.size()) return "is in a layer that is not there";
  const Member& member = layers_[here.layer];
  if (here.place >= member.layer.places() || member.layer.number_at(here.place) != number)
    return "is not where its layer has it";
  if (here.end != member.end) return "is not in the window of its layer";
  return std::nullopt;
}

bool Windows::is_sound(std::size_t bodies) const {
  if (registrations_.size() > bodies) return false;
  const auto is_level = [](int level) { return -largest_level <= level && level <= largest_level; };
  for (const Merged& merged : merged_)
    if (!is_level(merged.level) || !is_level(merged.into)) return false;
  std::size_t registered = 0;
  for (std::uint32_t number = 0; number < registrations_.size(); ++number) {
    if (!contains(number)) continue;
    ++registered;
    if (std::isnan(registrations_[number].end) || check(number)) return false;
  }
  return registered == size() && std::all_of(layers_.begin(), layers_.end(), [](const Member& member) {
           const bool possible = member.tier == never_ends
                                     ? member.end == infinity
                                     : std::abs(member.tier) <= longest_tier && std::isfinite(member.end);
           return member.layer.is_sound() && (possible || member.layer.size() == 0) &&
                  std::abs(member.level) <= largest_level;
         });
}

std::size_t Windows::bytes() const {
  std::size_t all = registrations_.capacity() * sizeof(Registration) + layers_.capacity() * sizeof(Member);
  for (const Member& member : layers_) all += member.layer.bytes();
  return all;
}

}  // namespace kinesphere
