#include "world/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

std::optional<Neighbours::Place> Neighbours::find(std::uint32_t body, std::uint32_t partner) const {
  const auto& list = lists_[body];
  const auto found = std::find_if(list.begin(), list.end(),
                                  [partner](const Neighbour& other) { return other.partner == partner; });
  if (found == list.end()) return std::nullopt;
  return static_cast<Place>(found - list.begin());
}

void Neighbours::replace(std::uint32_t body, std::span<const std::uint32_t> found) {
  constexpr std::uint32_t seen = 0;
  if (++stamp_ == seen) {
    stamps_.assign(stamps_.size(), seen);
    ++stamp_;
  }
  for (const std::uint32_t partner : found) stamps_[partner] = stamp_;
  for (auto place = static_cast<Place>(lists_[body].size()); place-- > 0;) {
    const std::uint32_t partner = lists_[body][place].partner;
    if (stamps_[partner] == stamp_) {
      stamps_[partner] = seen;
    } else {
      unlink(body, place);
    }
  }
  for (const std::uint32_t partner : found) {
    if (stamps_[partner] == seen) continue;
    stamps_[partner] = seen;
    link(body, partner);
  }
}

/// Room for one more. Lists are many and short: doubling them would leave a third of their memory empty.
void Neighbours::make_room_for_one(std::vector<Neighbour>& list) {
  if (list.size() == list.capacity()) list.reserve(list.size() + std::max<std::size_t>(4, list.size() / 4));
}

void Neighbours::link(std::uint32_t a, std::uint32_t b) {
  make_room_for_one(lists_[a]);
  make_room_for_one(lists_[b]);
  const auto place_a = static_cast<Place>(lists_[a].size());
  const auto place_b = static_cast<Place>(lists_[b].size());
  lists_[a].push_back({.partner = b, .mirror = place_b});
  lists_[b].push_back({.partner = a, .mirror = place_a});
}

void Neighbours::unlink(std::uint32_t body, Place place) {
  const Neighbour gone = lists_[body][place];
  take_out(gone.partner, gone.mirror);
  take_out(body, place);
}

/// The last one takes its place.
void Neighbours::take_out(std::uint32_t body, Place place) {
  auto& list = lists_[body];
  const Neighbour last = list.back();
  list.pop_back();
  if (place == list.size()) return;
  list[place] = last;
  lists_[last.partner][last.mirror].mirror = place;
}

void Neighbours::remove_all(std::uint32_t body) {
  while (!lists_[body].empty()) unlink(body, static_cast<Place>(lists_[body].size() - 1));
}

bool Neighbours::is_sound(std::size_t bodies) const {
  if (lists_.size() != bodies) return false;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    std::vector<std::uint32_t> partners;
    for (Place place = 0; place < lists_[body].size(); ++place) {
      const auto& [watch, partner, mirror] = lists_[body][place];
      if (std::isnan(watch) || partner >= bodies || partner == body || mirror >= lists_[partner].size())
        return false;
      const Neighbour& there = lists_[partner][mirror];
      if (there.partner != body || there.mirror != place) return false;
      const bool partner_does = there.watch < Neighbour::partner_does;
      if (partner_does != (watch == Neighbour::partner_does)) return false;
      partners.push_back(partner);
    }
    std::sort(partners.begin(), partners.end());
    if (std::adjacent_find(partners.begin(), partners.end()) != partners.end()) return false;
  }
  return true;
}

}  // namespace kinesphere
