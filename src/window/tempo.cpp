#include "window/tempo.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// What it costs to start a body, apart from its search, in looks at a capsule.
constexpr double start_cost = 120.0;
/// What a hot pair costs in all, in looks at a capsule, with the looks and reports that come of it.
constexpr double price_of_hot_pair = 240.0;
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

double power(double base, int exponent) {
  double product = 1.0;
  for (int k = 0; k < exponent; ++k) product *= base;
  return product;
}

/// In looks at a capsule.
double units_of(double capsules, double rows, double found, double hot) {
  return capsules + 4.0 * rows + 12.0 * found + 60.0 * hot;
}

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

void Tempo::Starts::add(double width, const Pace& pace, double time, double most) {
  ++bodies;
  widths += width;
  const double part = std::min(1.0, most / pace.way(time));
  if (!(part > 0.0)) {
    ways += most;
    return;
  }
  ways += part * pace.speed * time;
  growths += part * pace.acceleration * time * time;
}

double Tempo::Starts::times_larger(double factor, int dimensions) const {
  return power(short_side(factor) / short_side(1.0), dimensions - 1) * times_longer(factor);
}

Tempo::Starts& Tempo::Starts::operator+=(const Starts& more) {
  bodies += more.bodies;
  in_main += more.in_main;
  for (std::size_t k = 0; k < magnitudes.size(); ++k) magnitudes[k] += more.magnitudes[k];
  widths += more.widths;
  ways += more.ways;
  growths += more.growths;
  cost += more.cost;
  return *this;
}

/// Searches go through cubes, in which there are no more than all bodies, and find what lies along a way.
double Tempo::Starts::units(double factor, int dimensions, double among, double rows) const {
  const auto count = static_cast<double>(bodies);
  const double capsules = static_cast<double>(cost.capsules) * power(times_longer(factor), dimensions);
  const double larger = times_larger(factor, dimensions);
  return count * start_cost + units_of(std::min(capsules, count * among), rows,
                                       static_cast<double>(cost.found) * larger,
                                       static_cast<double>(cost.hot) * larger);
}

/// The cost of a time as long as a main window, if these were so many times as long and there were so many
/// kicks in so many windows. Cells become larger with the capsules, so that rows do not become more.
double Tempo::main_rate(double times_longer, const Kicks& kicks, double windows) const {
  const auto rows = static_cast<double>(main_.cost.rows);
  const double starts = main_.units(times_longer, dimensions_, static_cast<double>(bodies_), rows);
  // As the searches of those that started, which found each pair once.
  const double searches = 2.0 * static_cast<double>(kicks.bodies) / static_cast<double>(main_.bodies);
  const double larger = main_.times_larger(times_longer, dimensions_);
  const double capsules =
      static_cast<double>(main_.cost.capsules) * power(main_.times_longer(times_longer), dimensions_);
  const double of_kicks = units_of(searches * capsules, searches * rows,
                                   searches * static_cast<double>(main_.cost.found) * larger,
                                   static_cast<double>(kicks.hot) * larger);
  return starts / times_longer + of_kicks / windows;
}

/// The same for those that are much faster than most, whose cells are those of others.
double Tempo::fast_rate(double times_longer) const {
  const auto among = static_cast<double>(bodies_);
  const double rows =
      static_cast<double>(fast_.cost.rows) * power(fast_.times_longer(times_longer), dimensions_ - 1);
  const double most = static_cast<double>(fast_.bodies) * among;
  return fast_.units(times_longer, dimensions_, among, std::min(rows, most)) / times_longer;
}

void Tempo::start_main(double now, const Kicks& kicks) {
  if (now > main_start_ && main_.bodies > 0) adapt_main(kicks, (now - main_start_) / length_of(main_tier_));
  main_ = {};
  main_start_ = now;
}

void Tempo::Round::note(const Pace& pace, double width, int tier) {
  if (tier == tempo_->main_tier_) ++starts_.in_main;
  if (!most_) return starts_.add(width, pace, length_of(tier), tempo_->longest_way_);
  const double time = length_of(tempo_->main_tier_);
  starts_.add(width, pace, time, much_farther * tempo_->typical_way_);
  const double way = pace.way(time);
  const int magnitude = way > 0.0 ? exponent_of(way / tempo_->typical_way_) : -least_magnitude;
  const int last = static_cast<int>(starts_.magnitudes.size()) - 1;
  ++starts_.magnitudes[static_cast<std::size_t>(std::clamp(magnitude + least_magnitude, 0, last))];
}

void Tempo::finish_start(const Round& round, const SearchCost& cost, std::size_t bodies) {
  bodies_ = bodies;
  Starts& starts = round.most_ ? main_ : fast_;
  starts += round.starts_;
  starts.cost += cost;
  if (round.most_) {
    note_price();
  } else if (fast_.bodies >= enough_starts) {
    adapt_fast();
  }
}

void Tempo::note_price() {
  const auto count = static_cast<double>(main_.bodies);
  const double pairs = units_of(0.0, 0.0, static_cast<double>(main_.cost.found), 0.0) +
                       price_of_hot_pair * static_cast<double>(main_.cost.hot);
  const double across = (main_.widths + main_.growths) / count;
  const double along = across + main_.ways / count;
  price_ = {};
  if (along < infinity && across > 0.0)
    price_ = {across, along, static_cast<double>(main_.cost.capsules) / count, pairs / count};
}

/// As Starts::units() has it.
double Tempo::cost_of_width(double more) const {
  const auto& [across, along, capsules, pairs] = price_;
  if (!(across > 0.0)) return 0.0;
  const double longer = 1.0 + more / along;
  const double larger = power(1.0 + more / across, dimensions_ - 1) * longer;
  const double cost = capsules * (power(longer, dimensions_) - 1.0) + pairs * (larger - 1.0);
  return std::isnan(cost) ? infinity : cost;
}

void Tempo::adapt_main(const Kicks& kicks, double windows) {
  int change = 0;
  double least = enough_cheaper * main_rate(1.0, kicks, windows);
  // Longer ones have to be tried: what searches find in them is not known well.
  const bool may_grow = 2 * main_.in_main > main_.bodies && 2.0 * typical_way_ <= longest_way_;
  for (int powers = may_grow ? 1 : -1; powers >= -most_change; --powers) {
    const double changed = main_rate(power_of_two(powers), kicks, windows);
    if (powers == 0 || !(changed < least)) continue;
    least = changed;
    change = powers;
  }
  change = std::clamp(change, -most_powers - main_tier_, most_powers - main_tier_);
  main_tier_ += change;
  // An eighth of the bodies may be faster than most.
  const auto& magnitudes = main_.magnitudes;
  std::size_t magnitude = magnitudes.size() - 1;
  for (std::uint64_t faster = magnitudes[magnitude]; 8 * faster <= main_.bodies && magnitude > 0;)
    faster += magnitudes[--magnitude];
  const double way = typical_way_ * power_of_two(static_cast<int>(magnitude) - least_magnitude + change);
  const double before = typical_way_;
  typical_way_ = std::clamp(way, power_of_two(-most_powers), longest_way_);
  const double fast_way = before > 0.0 ? fast_way_ * (typical_way_ / before) : much_farther * typical_way_;
  fast_way_ = std::clamp(fast_way, typical_way_, longest_way_);
}

/// Their windows differ by factors.
void Tempo::adapt_fast() {
  const double factor = power_of_two(powers_between_tiers);
  const double least = enough_cheaper * fast_rate(1.0);
  if (2 * fast_.in_main > fast_.bodies) {
    // Most bodies are in windows that are longer than the main one, which must be far too short.
    main_tier_ = std::min(main_tier_ + powers_between_tiers, most_powers);
    typical_way_ = std::min(typical_way_ * factor, longest_way_);
  } else if (fast_rate(factor) < least) {
    fast_way_ = std::min(fast_way_ * factor, longest_way_);
  } else if (fast_rate(1.0 / factor) < least) {
    fast_way_ = std::max(fast_way_ / factor, typical_way_);
  }
  fast_ = {};
}

bool Tempo::is_sound() const {
  const auto is_way = [this](double way) { return way >= 0.0 && way <= longest_way_; };
  const auto are_sound = [](const Starts& starts) {
    return starts.widths >= 0.0 && starts.ways >= 0.0 && starts.growths >= 0.0;
  };
  const bool is_price = price_.short_side >= 0.0 && price_.long_side >= price_.short_side &&
                        price_.capsules >= 0.0 && price_.pairs >= 0.0;
  return is_price && std::abs(main_tier_) <= most_powers && is_way(typical_way_) && is_way(fast_way_) &&
         are_sound(main_) && are_sound(fast_) && std::isfinite(main_start_);
}

}  // namespace kinesphere
