#include "broadphase/swept_sphere_table.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// Swept sphere of a free slot: only what comes near everything comes near it.
constexpr SweptSphere empty_slot{{0x1p55f, 0x1p55f, 0x1p55f}, {}, 0.0f};

}  // namespace

SweptSphere SweptSphereTable::swept_sphere_at(std::uint32_t place) const {
  const auto& [x, y, z, u, v, w, r] = columns_;
  return {{x[place], y[place], z[place]}, {u[place], v[place], w[place]}, r[place]};
}

SweptSphereColumns SweptSphereTable::columns() const {
  SweptSphereColumns pointers;
  for (std::size_t k = 0; k < columns_.size(); ++k) pointers[k] = columns_[k].data();
  return pointers;
}

UnsortedSweptSpheres SweptSphereTable::all() const {
  UnsortedSweptSpheres all(bodies());
  std::size_t next = 0;
  for (std::uint32_t place = 0; place < slots(); ++place) {
    if (numbers_[place] == nobody) continue;
    all.numbers[next] = numbers_[place];
    all.spheres[next++] = swept_sphere_at(place);
  }
  return all;
}

void SweptSphereTable::clear() {
  for (std::vector<float>& column : columns_) column.clear();
  numbers_.clear();
  free_slots_ = 0;
}

std::uint32_t SweptSphereTable::add(std::uint32_t number, const SweptSphere& sphere) {
  const std::uint32_t place = slots();
  for (std::vector<float>& column : columns_) {
    if (column.size() < place + search_lanes + 1) column.resize(place + search_lanes + 1);
  }
  numbers_.push_back(number);
  store(place, sphere);
  return place;
}

void SweptSphereTable::replace(std::uint32_t place, const SweptSphere& sphere) {
  assert(numbers_[place] != nobody);
  store(place, sphere);
}

void SweptSphereTable::remove(std::uint32_t place) {
  assert(numbers_[place] != nobody);
  numbers_[place] = nobody;
  ++free_slots_;
  store(place, empty_slot);
}

void SweptSphereTable::resize(std::uint32_t places, std::uint32_t more) {
  // Without reserve(), the first addition would double the vectors.
  for (std::vector<float>& column : columns_) {
    column.reserve(places + more + search_lanes);
    column.resize(places + search_lanes);
  }
  numbers_.reserve(places + more);
  numbers_.resize(places);
  free_slots_ = 0;
}

bool SweptSphereTable::is_valid() const {
  const std::size_t filled = numbers_.empty() ? 0 : numbers_.size() + search_lanes;
  return std::all_of(columns_.begin(), columns_.end(),
                     [=](const std::vector<float>& column) { return column.size() >= filled; }) &&
         static_cast<std::size_t>(std::count(numbers_.begin(), numbers_.end(), nobody)) == free_slots_;
}

}  // namespace kinesphere
