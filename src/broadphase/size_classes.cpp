#include "broadphase/size_classes.hpp"

#include <algorithm>
#include <cmath>

#include "broadphase/swept_sphere_grid.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Successive size classes differ by this many powers of two in the width of swept spheres.
constexpr int powers_in_a_size_class = 3;
constexpr int largest_size_class = 300;

double largest_part(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

int SizeClasses::size_class_of(const InflatedBound& bound, const Window& window) {
  const double duration = window.end < infinity ? power_of_two(window.rung) : 0.0;
  const double width = 2.0 * (bound.moved.radius_after(duration) + bound.margin) +
                       largest_part(bound.moved.velocity) * duration;
  const int power = std::clamp(exponent_of(width), -largest_size_class, largest_size_class);
  return power >= 0 ? power / powers_in_a_size_class
                    : -((powers_in_a_size_class - 1 - power) / powers_in_a_size_class);
}

double SizeClasses::unit_of(int size_class) { return power_of_two(powers_in_a_size_class * size_class); }

bool SizeClasses::is_size_class(int size_class) {
  return -largest_size_class <= size_class && size_class <= largest_size_class;
}

int SizeClasses::size_class_to_start(int size_class) const {
  for (const Merged& merged : merged_)
    if (merged.size_class == size_class) return merged.into;
  return size_class;
}

int SizeClasses::size_class_to_enter(int size_class) const {
  for (const Merged& merged : merged_)
    if (merged.size_class >= size_class) return merged.into;
  return size_class;
}

/// Joins a size class to the next larger one if a search there would find few of its bodies.
void SizeClasses::merge(const std::map<int, std::size_t>& bodies, double volume, bool flat) {
  // Size classes are joined while a search of the joined level would find fewer bodies than this.
  constexpr double few_found = 48.0;
  // Width of the space that a search covers, in least widths of the next larger size class.
  constexpr double units_searched = 10.0;
  next_merged_.clear();
  std::vector<int> together;
  double density = 0.0;
  for (auto at = bodies.begin(); at != bodies.end(); ++at) {
    together.push_back(at->first);
    density += static_cast<double>(at->second) / volume;
    const auto next = std::next(at);
    const double width = units_searched * unit_of(next == bodies.end() ? 0 : next->first);
    const double found = density * (flat ? width * width : width * width * width);
    if (next != bodies.end() && found < few_found) continue;
    for (const int size_class : together) next_merged_.push_back({size_class, at->first});
    together.clear();
    density = 0.0;
  }
}

float SizeClasses::coarseness(int rung, int size_class) const {
  for (const Coarseness& known : coarse_)
    if (known.rung == rung && known.size_class == size_class) return known.coarseness;
  return 1.0f;
}

void SizeClasses::set_coarseness(int rung, int size_class, float coarseness) {
  std::erase_if(
      coarse_, [=](const Coarseness& known) { return known.rung == rung && known.size_class == size_class; });
  if (coarseness != 1.0f) coarse_.push_back({rung, size_class, coarseness});
}

bool SizeClasses::is_valid() const {
  for (const std::vector<Merged>* levels : {&merged_, &next_merged_})
    for (const Merged& merged : *levels)
      if (!is_size_class(merged.size_class) || !is_size_class(merged.into)) return false;
  return std::all_of(coarse_.begin(), coarse_.end(), [](const Coarseness& known) {
    return known.coarseness >= 1.0f && known.coarseness <= SweptSphereGrid::coarsest;
  });
}

}  // namespace kinesphere
