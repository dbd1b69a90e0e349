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
/// A layer that lasts while others start is sorted with them if more than this has changed in it, and more
/// than a half.
constexpr std::uint64_t least_changes = 64;

int power_below(double value, int largest) { return std::clamp(exponent_of(value), -largest, largest); }

double end_of_window(int tier, double now) {
  return (std::floor(now * power_of_two(-tier)) + 1.0) * power_of_two(tier);
}

double largest_part(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

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

/// By the size of its capsule for the whole window.
int Windows::level_of(const RoomyBound& bound, const Window& window) {
  const double duration = window.end < infinity ? power_of_two(window.tier) : 0.0;
  const double width =
      2.0 * (bound.moved.radius_after(duration) + bound.room) + largest_part(bound.moved.velocity) * duration;
  const int power = power_below(width, largest_level);
  return power >= 0 ? power / powers_in_a_level : -((powers_in_a_level - 1 - power) / powers_in_a_level);
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

/// The layer of this window and level, which may be without a frame yet, if it is empty.
std::uint32_t Windows::layer_for(const Window& window, int level) {
  std::uint32_t free = none;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    const Member& member = layers_[k];
    if (member.tier == window.tier && member.level == level && member.end == window.end) return k;
    // One that is over, though others go on, is of no use to anybody.
    const bool over = !member.fresh && member.layer.size() == 0 && window.end < infinity &&
                      member.end <= window.end - power_of_two(window.tier);
    if ((member.end == -infinity || over) && free == none) free = k;
  }
  if (free == none) {
    free = static_cast<std::uint32_t>(layers_.size());
    layers_.emplace_back();
  }
  Member& member = layers_[free];
  member = {.tier = window.tier, .level = level, .end = window.end, .layer = std::move(member.layer)};
  return free;
}

/// Gives an empty layer a frame.
void Windows::open(Member& member, const Vec3& base, double origin) {
  CapsuleFrame frame{.base = base, .per_length = power_of_two(-powers_in_a_level * member.level)};
  if (member.end < infinity) {
    frame.origin = origin;
    frame.per_time = 1.0 / (member.end - origin);
  }
  member.layer.clear(frame);
  member.layer.set_coarseness(coarseness_of(member));
  member.has_frame = true;
  next_end_ = std::min(next_end_, member.end);
}

float Windows::coarseness_of(const Member& member) const {
  for (const Coarseness& known : coarse_)
    if (known.tier == member.tier && known.level == member.level) return known.coarseness;
  return 1.0f;
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

Windows::Entry Windows::prepare(std::uint32_t number, const RoomyBound& bound, double now,
                                const Window& window) const {
  Entry entry{.level = level_to_enter(level_of(bound, window))};
  if (!contains(number)) return entry;
  const Registration& here = registrations_[number];
  const Member& member = layers_[here.layer];
  if (member.tier != window.tier || member.level != entry.level || member.end != window.end) return entry;
  entry.capsule = member.capsule(bound, now);
  const auto overhang = member.layer.overhang_at(here.place, entry.capsule, member.time(now));
  if (!overhang) return entry;
  entry.layer = here.layer;
  entry.place = here.place;
  entry.overhang = *overhang;
  return entry;
}

/// Several threads may do that at the same time, for different bodies.
void Windows::replace(const Entry& entry, double now, Layer::Growth& growth) {
  Member& member = layers_[entry.layer];
  member.layer.replace(entry.place, entry.capsule, member.time(now), entry.overhang, growth);
}

void Windows::grow(Member& member, const Layer::Growth& growth) {
  member.changes += growth.replaced;
  member.layer.grow(growth);
}

/// As the body is of the same size for the same window, whenever in it the body enters, and as a layer has
/// the same frame, whoever enters first, searches find the same in whatever order bodies enter.
void Windows::enter(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) {
  const Entry entry = prepare(number, bound, now, window);
  if (entry.layer != none) {
    Layer::Growth growth;
    replace(entry, now, growth);
    return grow(layers_[entry.layer], growth);
  }
  if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
  const std::uint32_t layer = layer_for(window, entry.level);
  Member& member = layers_[layer];
  ++member.changes;
  if (registrations_[number].layer == layer) {
    take_out(number);
  } else if (registrations_[number].layer != none) {
    leave(number);
  }
  if (!member.has_frame) {
    if (!has_base_) base_ = bound.moved.centre;
    has_base_ = true;
    open(member, base_, window.end < infinity ? window.end - power_of_two(window.tier) : 0.0);
  }
  add(number, layer, bound, now);
}

/// Of its size, or of the larger ones that it is merged with.
int Windows::level_to_start(int level) const {
  for (const Merged& merged : merged_)
    if (merged.level == level) return merged.into;
  return level;
}

/// The same where few enter, for whom alone no layer is worth while.
int Windows::level_to_enter(int level) const {
  for (const Merged& merged : merged_)
    if (merged.level >= level) return merged.into;
  return level;
}

/// Next time bodies will share the layer of the next larger ones if searches there find few of them.
void Windows::merge_levels(const Sizes& sizes) {
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
  next_merged_.clear();
  std::vector<int> together;
  double density = 0.0;
  for (auto at = sizes.begin(); at != sizes.end(); ++at) {
    together.push_back(at->first);
    density += static_cast<double>(at->second) / volume;
    const auto next = std::next(at);
    const double width =
        widths_searched * power_of_two(powers_in_a_level * (next == sizes.end() ? 0 : next->first) + 2);
    const double found = density * (space_.is_flat() ? width * width : width * width * width);
    if (next != sizes.end() && found < few) continue;
    for (const int level : together) next_merged_.push_back({level, at->first});
    together.clear();
    density = 0.0;
  }
}

void Windows::leave(std::uint32_t number) {
  ++layers_[registrations_[number].layer].changes;
  take_out(number);
}

void Windows::take_out(std::uint32_t number) {
  Registration& here = registrations_[number];
  layers_[here.layer].layer.remove(here.place);
  here.layer = none;
}

void Windows::sort(std::uint32_t layer, Shift& shift) {
  layers_[layer].layer.sort(
      shift, [this](std::uint32_t number, std::uint32_t place) { registrations_[number].place = place; });
}

/// In one layer, from now on until `end` or until the window of the layer ends.
CapsuleQuery Windows::query_for(const Member& member, const RoomyBound& bound, double now, double end) {
  CapsuleFrame frame = member.layer.frame();
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
  return {capsule_of(bound.moved, now, duration_until(end, now), bound.room, frame), from, to};
}

/// Adds searches of one layer, in all images, for the k-th of some bodies, from now on until `end` or until
/// the window of the layer ends. False where that would not do: all that are there may be near.
bool Windows::add_searches(const Member& member, std::uint32_t k, const RoomyBound& bound, double now,
                           double end, Scratch& scratch) const {
  const auto add = [&](const Vec3& shift) {
    RoomyBound image = bound;
    image.moved.centre += shift;
    member.layer.add_search(query_for(member, image, now, end), scratch.layer);
    scratch.images.push_back({k, shift != Vec3{}});
  };
  if (!space_.repeats()) {
    add({});
    return true;
  }
  const Box box = bound.box_of_way(duration_until(end, now));
  // It may overlap several images of all: a search of one would not do.
  if (!is_within_a_period(box, space_)) return false;
  space_.for_each_image(box, member.layer.widest() / member.layer.frame().per_length,
                        [&](const Box&, const Vec3& shift) { add(shift); });
  return true;
}

std::span<const std::uint32_t> Windows::near(std::uint32_t number, const RoomyBound& bound, double now,
                                             double end, Scratch& scratch) const {
  scratch.numbers.clear();
  for (const Member& member : layers_) {
    const Layer& layer = member.layer;
    if (layer.size() == 0) continue;
    const auto note = [&](std::uint32_t place) {
      const std::uint32_t other = layer.number_at(place);
      if (other != number && other != Layer::nobody) scratch.numbers.push_back(other);
    };
    scratch.layer.clear();
    scratch.images.clear();
    if (add_searches(member, 0, bound, now, end, scratch)) {
      layer.make(scratch.layer);
      scratch.layer.for_each_found([&](std::uint32_t, std::uint32_t place) { note(place); });
    } else {
      for (std::uint32_t place = 0; place < layer.places(); ++place) note(place);
    }
  }
  return scratch.numbers;
}

std::span<const std::uint32_t> Windows::in_box(const Box& box, double now, Scratch& scratch) const {
  scratch.numbers.clear();
  for (const Member& member : layers_) {
    if (member.layer.size() == 0) continue;
    const double end = member.end < infinity ? now : infinity;
    const auto add_search = [&](const Box& image, const Vec3&) {
      Bound ball{.time = now, .position = 0.5 * (image.lower + image.upper)};
      ball.radius = 0.5 * norm(image.upper - image.lower);
      const RoomyBound bound{MovedBound(ball, now), 0.0};
      member.layer.add_search(query_for(member, bound, now, end), scratch.layer);
    };
    scratch.layer.clear();
    space_.for_each_image(box, member.layer.widest() / member.layer.frame().per_length, add_search);
    member.layer.make(scratch.layer);
    scratch.layer.for_each_found([&](std::uint32_t, std::uint32_t place) {
      const std::uint32_t number = member.layer.number_at(place);
      if (number != Layer::nobody) scratch.numbers.push_back(number);
    });
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

/// Calls visit(number) for the bodies whose windows have ended: if these are many, in the order of their
/// numbers. Else going through all would take longer than sorting them.
template <class Visit>
void Windows::for_each_ended(double now, bool all, Visit visit) const {
  const auto has_ended = [=](double end) { return all ? end < infinity : end <= now; };
  std::size_t most = 0;
  for (const Member& member : layers_)
    if (has_ended(member.end)) most += member.layer.size();
  constexpr std::size_t few_of_all = 16;
  if (few_of_all * most >= registrations_.size()) {
    for (std::uint32_t number = 0; number < registrations_.size(); ++number)
      if (contains(number) && has_ended(registrations_[number].end)) visit(number);
    return;
  }
  for (const Member& member : layers_) {
    if (!has_ended(member.end)) continue;
    for (std::uint32_t place = 0; place < member.layer.places(); ++place) {
      const std::uint32_t number = member.layer.number_at(place);
      if (number != Layer::nobody) visit(number);
    }
  }
}

std::vector<std::uint32_t> Windows::ended(double now, bool all) const {
  std::vector<std::uint32_t> numbers;
  for_each_ended(now, all, [&](std::uint32_t number) { numbers.push_back(number); });
  if (!std::is_sorted(numbers.begin(), numbers.end())) std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void Windows::end_windows(double now, bool all) {
  merged_ = next_merged_;
  next_end_ = infinity;
  for_each_ended(now, all, [this](std::uint32_t number) { registrations_[number].layer = none; });
  for (Member& member : layers_) {
    const bool has_ended = all ? member.end < infinity : member.end <= now;
    member.fresh = false;
    if (has_ended || member.layer.size() == 0) {
      member.layer.clear({});
      member.end = -infinity;
    } else {
      next_end_ = std::min(next_end_, member.end);
    }
  }
}

std::vector<int> Windows::held_tiers() const {
  std::vector<int> held;
  for (const Member& member : layers_)
    if (!member.fresh && member.layer.size() > 0) held.push_back(member.tier);
  return held;
}

Window Windows::free_window(double now, int tier, std::span<const int> held) {
  Window window = window_at(now, tier);
  while (std::find(held.begin(), held.end(), window.tier) != held.end()) {
    const Window shorter = window_at(now, window.tier - Tempo::powers_between_tiers);
    if (shorter.tier == window.tier) return {window.tier, now};
    window = shorter;
  }
  return window;
}

/// Gives each its place in what is to become a layer.
std::vector<Windows::Opening> Windows::choose_layers(std::span<const Starter> starters, Sizes& sizes) {
  std::vector<Opening> openings;
  // Most are like the one before.
  std::size_t at = 0;
  auto size = sizes.end();
  for (const auto& [number, level, window] : starters) {
    if (size == sizes.end() || size->first != level) size = sizes.try_emplace(level).first;
    ++size->second;
    const int level_there = level_to_start(level);
    const auto suits = [&, tier = window.tier, end = window.end](const Opening& opening) {
      const Member& member = layers_[opening.layer];
      return member.tier == tier && member.level == level_there && member.end == end;
    };
    if (at == openings.size() || !suits(openings[at])) {
      const auto found = std::find_if(openings.begin(), openings.end(), suits);
      at = static_cast<std::size_t>(found - openings.begin());
      if (found == openings.end()) {
        openings.push_back({layer_for(window, level_there), number, 0});
        layers_[openings.back().layer].fresh = true;
      }
    }
    if (number >= registrations_.size()) registrations_.resize(number + std::size_t{1});
    registrations_[number] = {window.end, openings[at].layer,
                              static_cast<std::uint32_t>(openings[at].bodies++)};
  }
  return openings;
}

void Windows::tidy(Shift& shift) {
  for (std::uint32_t k = 0; k < layers_.size(); ++k)
    if (layers_[k].layer.is_untidy()) sort(k, shift);
}

/// Of the layers that bodies start in, which are empty, the capsules are given.
void Windows::finish_start(const std::vector<Layer::Unsorted>& unsorted, Shift& shift) {
  std::size_t layers = 0;
  for (std::uint32_t k = 0; k < layers_.size(); ++k) {
    Member& member = layers_[k];
    if (member.fresh) {
      sort_to_start(k, [&] {
        member.layer.fill(unsorted[k], shift, [&](std::uint32_t number, std::uint32_t place) {
          registrations_[number].place = place;
        });
      });
    } else if (member.changes > least_changes + member.layer.size() / 2) {
      sort_to_start(k, [&] { sort(k, shift); });
    }
    if (member.layer.size() > 0) ++layers;
  }
  needs_bounds_ = layers > 1 || space_.repeats();
}

/// What is known of the layer from now on is the same, whatever has been changed in which order.
template <class Sort>
void Windows::sort_to_start(std::uint32_t layer, Sort sort_layer) {
  Member& member = layers_[layer];
  const float before = coarseness_of(member);
  member.layer.set_coarseness(before);
  sort_layer();
  member.changes = 0;
  const float after = member.layer.coarseness();
  if (after == before) return;
  std::erase_if(coarse_, [&](const Coarseness& known) {
    return known.tier == member.tier && known.level == member.level;
  });
  if (after != 1.0f) coarse_.push_back({member.tier, member.level, after});
}

std::size_t Windows::started() const {
  std::size_t all = 0;
  for (const Member& member : layers_)
    if (member.fresh) all += member.layer.places();
  return all;
}

/// From the k-th on, no more than so many.
Windows::Started Windows::started_at(std::size_t k, std::size_t most) const {
  for (std::uint32_t layer = 0; layer < layers_.size(); ++layer) {
    if (!layers_[layer].fresh) continue;
    const std::size_t places = layers_[layer].layer.places();
    if (k < places)
      return {layer, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(std::min(places - k, most))};
    k -= places;
  }
  assert(false);
  return {none, 0, 0};
}

/// Those behind them in their own layer.
void Windows::search_behind(const Started& some, Scratch& scratch) const {
  const Layer& layer = layers_[some.layer].layer;
  scratch.layer.clear();
  for (std::uint32_t k = 0; k < some.count; ++k) layer.add_search_behind(some.place + k, scratch.layer);
  layer.make(scratch.layer);
  scratch.layer.for_each_found([&](std::uint32_t k, std::uint32_t place) {
    scratch.pairs.push_back({layer.number_at(some.place + k), layer.number_at(place)});
  });
}

/// Those in other layers and, of their own, other images.
void Windows::search_other_layers(const Started& some, double now, Scratch& scratch) const {
  const Member& own = layers_[some.layer];
  for (std::uint32_t other = 0; other < layers_.size(); ++other) {
    const Member& member = layers_[other];
    if (member.layer.size() == 0 || (member.fresh && member.is_before(own)) ||
        (other == some.layer && !space_.repeats()))
      continue;
    const auto note = [&](const ImageSearch& image, std::uint32_t place) {
      if (other == some.layer && (!image.shifted || place <= some.place + image.k)) return;
      const std::uint32_t number = member.layer.number_at(place);
      if (number != Layer::nobody)
        scratch.pairs.push_back({own.layer.number_at(some.place + image.k), number});
    };
    scratch.layer.clear();
    scratch.images.clear();
    for (std::uint32_t k = 0; k < some.count; ++k) {
      if (add_searches(member, k, scratch.bounds[k], now, own.end, scratch)) continue;
      for (std::uint32_t place = 0; place < member.layer.places(); ++place) note({k, true}, place);
    }
    member.layer.make(scratch.layer);
    scratch.layer.for_each_found(
        [&](std::uint32_t query, std::uint32_t place) { note(scratch.images[query], place); });
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
  for (const std::vector<Merged>* levels : {&merged_, &next_merged_})
    for (const Merged& merged : *levels)
      if (!is_level(merged.level) || !is_level(merged.into)) return false;
  for (const Coarseness& known : coarse_)
    if (!(known.coarseness >= 1.0f && known.coarseness <= Layer::coarsest)) return false;
  if (!is_finite(base_)) return false;
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
           return member.layer.is_sound() && ((possible && member.has_frame) || member.layer.size() == 0) &&
                  std::abs(member.level) <= largest_level;
         });
}

std::size_t Windows::bytes() const {
  std::size_t all = registrations_.capacity() * sizeof(Registration) + layers_.capacity() * sizeof(Member);
  for (const Member& member : layers_) all += member.layer.bytes();
  return all;
}

}  // namespace kinesphere
