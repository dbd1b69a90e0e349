#include "broadphase/swept_sphere_table.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// Swept sphere of a free slot: only what comes near everything comes near it.
constexpr SweptSphere empty_slot{{0x1p55f, 0x1p55f, 0x1p55f}, {}, 0.0f};

}  // namespace

SweptSphere SweptSphereTable::swept_sphere_at(std::uint32_t slot) const {
  const auto& [x, y, z, u, v, w, r] = columns_;
  return {{x[slot], y[slot], z[slot]}, {u[slot], v[slot], w[slot]}, r[slot]};
}

SweptSphereColumns SweptSphereTable::columns() const {
  SweptSphereColumns pointers;
  for (std::size_t k = 0; k < columns_.size(); ++k) pointers[k] = columns_[k].data();
  return pointers;
}

UnsortedSweptSpheres SweptSphereTable::all() const {
  UnsortedSweptSpheres all{std::vector<std::uint32_t>(bodies()), std::vector<SweptSphere>(bodies())};
  std::size_t next = 0;
  for (std::uint32_t slot = 0; slot < slots(); ++slot) {
    if (numbers_[slot] == free_slot) continue;
    all.numbers[next] = numbers_[slot];
    all.spheres[next++] = swept_sphere_at(slot);
  }
  return all;
}

void SweptSphereTable::clear() {
  for (std::vector<float>& column : columns_) column.clear();
  numbers_.clear();
  free_slots_ = 0;
}

std::uint32_t SweptSphereTable::add(std::uint32_t number, const SweptSphere& sphere) {
  const std::uint32_t slot = slots();
  for (std::vector<float>& column : columns_) {
    if (column.size() < slot + search_lanes + 1) column.resize(slot + search_lanes + 1);
  }
  numbers_.push_back(number);
  store(slot, sphere);
  return slot;
}

void SweptSphereTable::replace(std::uint32_t slot, const SweptSphere& sphere) {
  assert(numbers_[slot] != free_slot);
  store(slot, sphere);
}

void SweptSphereTable::remove(std::uint32_t slot) {
  assert(numbers_[slot] != free_slot);
  leave_free(slot);
}

void SweptSphereTable::leave_free(std::uint32_t slot) {
  numbers_[slot] = free_slot;
  ++free_slots_;
  store(slot, empty_slot);
}

void SweptSphereTable::occupy(std::uint32_t slot, std::uint32_t number, const SweptSphere& sphere) {
  assert(numbers_[slot] == free_slot && free_slots_ > 0);
  --free_slots_;
  fill(slot, number, sphere);
}

void SweptSphereTable::resize(std::uint32_t count, std::uint32_t more) {
  // Without reserve(), the first addition would double the vectors.
  for (std::vector<float>& column : columns_) {
    column.reserve(count + more + search_lanes);
    column.resize(count + search_lanes);
  }
  numbers_.reserve(count + more);
  numbers_.resize(count);
  free_slots_ = 0;
}

bool SweptSphereTable::is_valid() const {
  const std::size_t filled = numbers_.empty() ? 0 : numbers_.size() + search_lanes;
  return std::all_of(columns_.begin(), columns_.end(),
                     [=](const std::vector<float>& column) { return column.size() >= filled; }) &&
         static_cast<std::size_t>(std::count(numbers_.begin(), numbers_.end(), free_slot)) == free_slots_;
}

}  // namespace kinesphere
