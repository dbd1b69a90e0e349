#include "window/tempo.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// What it costs to start a body, apart from its search, in looks at a capsule.
constexpr double start_cost = 120.0;
/// Another length has to be so much cheaper.
constexpr double enough_cheaper = 0.9;
/// A body is much faster than most if it goes so many times as far.
constexpr double much_farther = 4.0;
constexpr int most_powers = 300;
/// At once, to shorter windows.
constexpr int most_change = 6;

double length_of(int tier) { return power_of_two(tier); }

}  // namespace

void Tempo::choose(double way, const Pace& typical) {
  way = std::min(way, longest_way_);
  const double squared_speed = typical.speed * typical.speed;
  const double time =
      2.0 * way / (typical.speed + std::sqrt(squared_speed + 2.0 * typical.acceleration * way));
  main_tier_ = time < infinity ? std::clamp(exponent_of(time), -most_powers, most_powers) : most_powers;
  typical_way_ = way;
}

int Tempo::tier_for(const Pace& pace) const {
  int tier = main_tier_;
  while (tier > -most_powers && !(pace.way(length_of(tier)) <= much_farther * typical_way_))
    tier -= powers_between_tiers;
  return tier;
}

void Tempo::note_start(const Pace& pace, double width, int tier) {
  const double way = pace.way(length_of(main_tier_));
  ++bodies_;
  if (tier == main_tier_) ++in_main_;
  widths_ += width;
  ways_ += std::min(way, much_farther * typical_way_);
  const int magnitude = way > 0.0 ? exponent_of(way / typical_way_) : -least_magnitude;
  const int last = static_cast<int>(magnitudes_.size()) - 1;
  ++magnitudes_[static_cast<std::size_t>(std::clamp(magnitude + least_magnitude, 0, last))];
}

void Tempo::adapt(const SearchCost& starts, const SearchCost& later, double elapsed, int dimensions) {
  if (bodies_ == 0) return;
  const auto count = static_cast<double>(bodies_);
  // Ways make this part of the capsules.
  const double moving = ways_ / (ways_ + widths_);
  const auto rate = [&](double times_longer) {
    double larger = 1.0 + moving * (times_longer - 1.0);
    larger = dimensions == 2 ? larger * larger : larger * larger * larger;
    return (count * start_cost + starts.units() * larger) / (length_of(main_tier_) * times_longer) +
           later.units() * larger / elapsed;
  };
  int change = 0;
  double least = enough_cheaper * rate(1.0);
  // Longer ones have to be tried: what searches find in them is not known well.
  const bool may_grow = 2 * in_main_ > bodies_ && 2.0 * typical_way_ <= longest_way_;
  for (int powers = may_grow ? 1 : -1; powers >= -most_change; --powers) {
    const double changed = rate(power_of_two(powers));
    if (powers == 0 || !(changed < least)) continue;
    least = changed;
    change = powers;
  }
  change = std::max(change, -most_powers - main_tier_);
  main_tier_ += change;
  // An eighth of the bodies may be faster than most.
  std::size_t magnitude = magnitudes_.size() - 1;
  for (std::uint64_t faster = magnitudes_[magnitude]; 8 * faster <= bodies_ && magnitude > 0;)
    faster += magnitudes_[--magnitude];
  const double way = typical_way_ * power_of_two(static_cast<int>(magnitude) - least_magnitude + change);
  typical_way_ = std::clamp(way, power_of_two(-most_powers), longest_way_);
  bodies_ = in_main_ = 0;
  ways_ = widths_ = 0.0;
  magnitudes_.fill(0);
}

bool Tempo::is_sound() const {
  return std::abs(main_tier_) <= most_powers && typical_way_ >= 0.0 && typical_way_ <= longest_way_ &&
         ways_ >= 0.0 && widths_ >= 0.0;
}

}  // namespace kinesphere
