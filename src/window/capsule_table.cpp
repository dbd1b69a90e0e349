#include "window/capsule_table.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// A capsule of nobody: nothing comes near it but what comes near everything.
constexpr Capsule hole{{0x1p55f, 0x1p55f, 0x1p55f}, {}, 0.0f};

}  // namespace

Capsule CapsuleTable::capsule_at(std::uint32_t place) const {
  const auto& [x, y, z, u, v, w, r] = columns_;
  return {{x[place], y[place], z[place]}, {u[place], v[place], w[place]}, r[place]};
}

CapsuleColumns CapsuleTable::columns() const {
  CapsuleColumns pointers;
  for (std::size_t k = 0; k < columns_.size(); ++k) pointers[k] = columns_[k].data();
  return pointers;
}

UnsortedCapsules CapsuleTable::all() const {
  UnsortedCapsules all(bodies());
  std::size_t next = 0;
  for (std::uint32_t place = 0; place < places(); ++place) {
    if (numbers_[place] == nobody) continue;
    all.numbers[next] = numbers_[place];
    all.capsules[next++] = capsule_at(place);
  }
  return all;
}

void CapsuleTable::clear() {
  for (std::vector<float>& column : columns_) column.clear();
  numbers_.clear();
  holes_ = 0;
}

std::uint32_t CapsuleTable::add(std::uint32_t number, const Capsule& capsule) {
  const std::uint32_t place = places();
  for (std::vector<float>& column : columns_) {
    if (column.size() < place + capsule_lanes + 1) column.resize(place + capsule_lanes + 1);
  }
  numbers_.push_back(number);
  store(place, capsule);
  return place;
}

void CapsuleTable::replace(std::uint32_t place, const Capsule& capsule) {
  assert(numbers_[place] != nobody);
  store(place, capsule);
}

void CapsuleTable::remove(std::uint32_t place) {
  assert(numbers_[place] != nobody);
  numbers_[place] = nobody;
  ++holes_;
  store(place, hole);
}

void CapsuleTable::resize(std::uint32_t places, std::uint32_t more) {
  // Without reserving, one that is added would make vectors twice as large.
  for (std::vector<float>& column : columns_) {
    column.reserve(places + more + capsule_lanes);
    column.resize(places + capsule_lanes);
  }
  numbers_.reserve(places + more);
  numbers_.resize(places);
  holes_ = 0;
}

bool CapsuleTable::is_sound() const {
  const std::size_t filled = numbers_.empty() ? 0 : numbers_.size() + capsule_lanes;
  return std::all_of(columns_.begin(), columns_.end(),
                     [=](const std::vector<float>& column) { return column.size() >= filled; }) &&
         static_cast<std::size_t>(std::count(numbers_.begin(), numbers_.end(), nobody)) == holes_;
}

}  // namespace kinesphere
