#include "watch/monitor/latest_places.hpp"

namespace kinesphere::program {

void LatestPlaces::enter(std::uint32_t number) {
  Entry& entry = entries_[number];
  entry.cell = cell_of(entry.state.position);
  std::vector<std::uint32_t>& cell = cells_[entry.cell];
  entry.slot = static_cast<std::uint32_t>(cell.size());
  cell.push_back(number);
}

void LatestPlaces::leave(std::uint32_t number) {
  const Entry& entry = entries_[number];
  const auto at = cells_.find(entry.cell);
  std::vector<std::uint32_t>& cell = at->second;
  cell[entry.slot] = cell.back();
  entries_[cell[entry.slot]].slot = entry.slot;
  cell.pop_back();
  if (cell.empty()) cells_.erase(at);
}

void LatestPlaces::widen(double edge) {
  std::vector<std::uint32_t> numbers;
  for (const auto& [cell, entries] : cells_) numbers.insert(numbers.end(), entries.begin(), entries.end());
  cells_.clear();
  edge_ = edge;
  for (const std::uint32_t number : numbers) enter(number);
}

std::uint32_t LatestPlaces::add(TrackId track, const State& state, double stamp) {
  auto number = static_cast<std::uint32_t>(entries_.size());
  if (free_.empty()) {
    entries_.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  entries_[number] = {.track = track, .state = state, .stamp = stamp};
  enter(number);
  return number;
}

void LatestPlaces::set(std::uint32_t number, const State& state, double stamp) {
  Entry& entry = entries_[number];
  entry.state = state;
  entry.stamp = stamp;
  if (cell_of(state.position) == entry.cell) return;
  leave(number);
  enter(number);
}

void LatestPlaces::remove(std::uint32_t number) {
  leave(number);
  free_.push_back(number);
}

}  // namespace kinesphere::program
