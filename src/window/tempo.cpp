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
/// Those that are much faster than most change what they do after so many starts.
constexpr std::uint64_t enough_starts = 64;

double length_of(int tier) { return power_of_two(tier); }

}  // namespace

void Tempo::choose(double way, const Pace& typical) {
  way = std::min(way, longest_way_);
  const double squared_speed = typical.speed * typical.speed;
  const double time =
      2.0 * way / (typical.speed + std::sqrt(squared_speed + 2.0 * typical.acceleration * way));
  main_tier_ = time < infinity ? std::clamp(exponent_of(time), -most_powers, most_powers) : most_powers;
  typical_way_ = way;
  fast_way_ = std::min(much_farther * way, longest_way_);
}

int Tempo::tier_for(const Pace& pace) const {
  int tier = main_tier_;
  if (pace.way(length_of(tier)) <= much_farther * typical_way_) return tier;
  do tier -= powers_between_tiers;
  while (tier > -most_powers && !(pace.way(length_of(tier)) <= fast_way_));
  return tier;
}

double Tempo::Starts::rate(double times_longer, int dimensions, double others) const {
  // Ways make this part of the capsules.
  const double moving = ways / (ways + widths);
  double larger = 1.0 + moving * (times_longer - 1.0);
  larger = dimensions == 2 ? larger * larger : larger * larger * larger;
  return (static_cast<double>(bodies) * start_cost + cost.units() * larger) / times_longer + others * larger;
}

void Tempo::start_main(double now, const SearchCost& others) {
  if (now > main_start_ && main_.bodies > 0)
    adapt_main(others.units() / (now - main_start_) * length_of(main_tier_));
  main_ = {};
  magnitudes_.fill(0);
  main_starts_ = true;
  main_start_ = now;
}

void Tempo::note_start(const Pace& pace, double width, int tier) {
  Starts& starts = main_starts_ ? main_ : fast_;
  ++starts.bodies;
  starts.widths += width;
  if (tier == main_tier_) ++starts.in_main;
  if (!main_starts_) {
    starts.ways += std::min(pace.way(length_of(tier)), longest_way_);
    return;
  }
  const double way = pace.way(length_of(main_tier_));
  starts.ways += std::min(way, much_farther * typical_way_);
  const int magnitude = way > 0.0 ? exponent_of(way / typical_way_) : -least_magnitude;
  const int last = static_cast<int>(magnitudes_.size()) - 1;
  ++magnitudes_[static_cast<std::size_t>(std::clamp(magnitude + least_magnitude, 0, last))];
}

void Tempo::finish_start(const SearchCost& cost) {
  if (main_starts_) {
    main_.cost = cost;
  } else {
    fast_.cost += cost;
    if (fast_.bodies >= enough_starts) adapt_fast();
  }
  main_starts_ = false;
}

/// Others: what their searches cost in the time of a main window.
void Tempo::adapt_main(double others) {
  int change = 0;
  double least = enough_cheaper * main_.rate(1.0, dimensions_, others);
  // Longer ones have to be tried: what searches find in them is not known well.
  const bool may_grow = 2 * main_.in_main > main_.bodies && 2.0 * typical_way_ <= longest_way_;
  for (int powers = may_grow ? 1 : -1; powers >= -most_change; --powers) {
    const double changed = main_.rate(power_of_two(powers), dimensions_, others);
    if (powers == 0 || !(changed < least)) continue;
    least = changed;
    change = powers;
  }
  change = std::clamp(change, -most_powers - main_tier_, most_powers - main_tier_);
  main_tier_ += change;
  // An eighth of the bodies may be faster than most.
  std::size_t magnitude = magnitudes_.size() - 1;
  for (std::uint64_t faster = magnitudes_[magnitude]; 8 * faster <= main_.bodies && magnitude > 0;)
    faster += magnitudes_[--magnitude];
  const double way = typical_way_ * power_of_two(static_cast<int>(magnitude) - least_magnitude + change);
  const double before = typical_way_;
  typical_way_ = std::clamp(way, power_of_two(-most_powers), longest_way_);
  const double fast_way = before > 0.0 ? fast_way_ * (typical_way_ / before) : much_farther * typical_way_;
  fast_way_ = std::clamp(fast_way, typical_way_, longest_way_);
}

/// Their windows differ by factors.
void Tempo::adapt_fast() {
  const double factor = power_of_two(powers_between_tiers);
  const double least = enough_cheaper * fast_.rate(1.0, dimensions_);
  if (2 * fast_.in_main > fast_.bodies) {
    // Most bodies are in windows that are longer than the main one, which must be far too short.
    main_tier_ = std::min(main_tier_ + powers_between_tiers, most_powers);
    typical_way_ = std::min(typical_way_ * factor, longest_way_);
  } else if (fast_.rate(factor, dimensions_) < least) {
    fast_way_ = std::min(fast_way_ * factor, longest_way_);
  } else if (fast_.rate(1.0 / factor, dimensions_) < least) {
    fast_way_ = std::max(fast_way_ / factor, typical_way_);
  }
  fast_ = {};
}

bool Tempo::is_sound() const {
  const auto is_way = [this](double way) { return way >= 0.0 && way <= longest_way_; };
  const auto are_sound = [](const Starts& starts) { return starts.ways >= 0.0 && starts.widths >= 0.0; };
  return std::abs(main_tier_) <= most_powers && is_way(typical_way_) && is_way(fast_way_) &&
         are_sound(main_) && are_sound(fast_) && !main_starts_ && std::isfinite(main_start_);
}

}  // namespace kinesphere
