#include "broadphase/window_policy.hpp"

#include <cmath>
#include <functional>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

// Costs, in units of one test of a swept sphere; fitted to measured times.
/// Cost of starting a body, without its search.
constexpr double start_cost = 120.0;
/// Number of swept spheres that a search which finds nothing tests.
constexpr double search_spheres = 24.0;
/// Cost of such a search, with the reading of the rows that it tests.
constexpr double search_cost = 36.0;
/// Cost of finding a near pair in a search; most near pairs become certificates.
constexpr double cost_of_near_pair = 100.0;
/// Cost of a near pair with the rechecks and reports that follow from it.
constexpr double price_of_near_pair = 260.0;
/// A search tests bodies up to this factor farther apart than those it has to find, since cells are cubes and
/// swept spheres are not.
constexpr double farther_in_cells = 5.0;
// Costs of a search whose swept sphere is large compared with the cells.
constexpr double cost_of_row = 4.0;
constexpr double spheres_in_cell = 2.0;

/// Another window length is chosen only if it costs less than this part of the present cost.
constexpr double enough_cheaper = 0.9;
/// A body is much faster than most if it travels more than this many typical ways in a main window.
constexpr double much_farther = 4.0;
constexpr int most_powers = 300;
constexpr double shortest_way = power_of_two(-most_powers);
/// Greatest step to shorter windows at one start, in powers of two.
constexpr int most_change = 6;
/// Starts of much faster bodies after which the length of their windows is adapted.
constexpr std::uint64_t enough_starts = 64;

double length_of(int rung) { return power_of_two(rung); }

double power(double base, int exponent) {
  double product = 1.0;
  for (int k = 0; k < exponent; ++k) product *= base;
  return product;
}

}  // namespace

void MotionStatistics::Magnitudes::note(double value) {
  const int last = static_cast<int>(counts_.size()) - 1;
  ++counts_[static_cast<std::size_t>(std::clamp(exponent_of(value) - least, 0, last))];
  ++all_;
}

/// Returns the value that stands for the k-th power of two: 0 for the smallest, infinity for the largest.
double MotionStatistics::Magnitudes::value_of(std::size_t k) const {
  if (k == 0) return 0.0;
  return k + 1 == counts_.size() ? infinity : 1.5 * power_of_two(static_cast<int>(k) + least);
}

double MotionStatistics::Magnitudes::median() const {
  std::size_t k = 0;
  for (std::uint64_t below = counts_[0]; 2 * below < all_;) below += counts_[++k];
  return value_of(k);
}

double MotionStatistics::Magnitudes::mean() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < counts_.size(); ++k)
    if (counts_[k] > 0) sum += static_cast<double>(counts_[k]) / static_cast<double>(all_) * value_of(k);
  return sum;
}

void MotionStatistics::note(const Vec3& centre, const SpeedBound& speed_bound) {
  ++bodies_;
  for (int axis = 0; axis < 3; ++axis) {
    lower_[axis] = std::min(lower_[axis], centre[axis]);
    upper_[axis] = std::max(upper_[axis], centre[axis]);
  }
  speeds_.note(speed_bound.speed);
  accelerations_.note(speed_bound.acceleration);
}

double MotionStatistics::spacing() const {
  const Vec3 size = upper_ - lower_;
  std::array<double, 3> sides{size.x, size.y, size.z};
  std::sort(sides.begin(), sides.end(), std::greater<>());
  const double on_line = sides[0] / static_cast<double>(bodies_);
  if (!(sides[1] > on_line)) return on_line;
  const double in_layer = std::sqrt(sides[1] * on_line);
  if (!(sides[2] > in_layer)) return in_layer;
  // The math library has no cube root that is equal on all machines; the root is rounded to a power of two.
  return sides[0] * power_of_two(-exponent_of(static_cast<double>(bodies_)) / 3);
}

SpeedBound MotionStatistics::typical() const { return {speeds_.median(), accelerations_.mean()}; }

void WindowPolicy::choose(double way, const SpeedBound& typical) {
  way = std::min(way, longest_way_);
  const double squared_speed = typical.speed * typical.speed;
  const double time =
      2.0 * way / (typical.speed + std::sqrt(squared_speed + 2.0 * typical.acceleration * way));
  main_rung_ = time < infinity ? std::clamp(exponent_of(time), -most_powers, most_powers) : most_powers;
  typical_way_ = way;
  fast_way_ = std::min(much_farther * way, longest_way_);
}

int WindowPolicy::rung_for(const SpeedBound& speed_bound) const {
  int rung = main_rung_;
  if (speed_bound.way(length_of(rung)) <= much_farther * typical_way_) return rung;
  do rung -= powers_between_rungs;
  while (rung > -most_powers && !(speed_bound.way(length_of(rung)) <= fast_way_));
  return rung;
}

double WindowPolicy::Starts::times_larger(double factor, int dimensions) const {
  return power(short_side(factor) / short_side(1.0), dimensions - 1) * (long_side(factor) / long_side(1.0));
}

double WindowPolicy::Starts::cost_of_finding(double factor, int dimensions) const {
  const double slenderness = long_side(factor) / short_side(factor);
  return power(farther_in_cells * slenderness, dimensions - 1);
}

/// Returns the number of swept-sphere tests in `searches` searches that find `found` near pairs, if main
/// windows were `times_longer` times as long; at most one test per search and body.
double WindowPolicy::cost_of_searches(std::uint64_t searches, double found, double times_longer) const {
  return std::min(found * main_.cost_of_finding(times_longer, dimensions_),
                  static_cast<double>(searches) * static_cast<double>(bodies_));
}

/// Returns the cost of a time as long as a present main window, if main windows were `times_longer` times as
/// long and `updates` occurred in `windows` windows. Cells grow with the swept spheres, so searches that find
/// nothing cost the same. Bodies that start together find each pair once; individual updates do not.
double WindowPolicy::main_rate(double times_longer, const RenewalCounts& updates, double windows) const {
  const auto pairs = [&](std::uint64_t searches, std::uint64_t near) {
    const double found = static_cast<double>(near) * main_.times_larger(times_longer, dimensions_);
    return found * cost_of_near_pair + cost_of_searches(searches, found, times_longer);
  };
  const double starts =
      static_cast<double>(main_.bodies) * (start_cost + search_cost) + pairs(main_.bodies, main_.near);
  const double of_updates =
      static_cast<double>(updates.bodies) * 2.0 * search_cost + pairs(updates.bodies, updates.near);
  return starts / times_longer + of_updates / windows;
}

/// Returns the cost that main_rate() returns, for the bodies that are much faster than most. They search the
/// cells of the other bodies.
double WindowPolicy::fast_rate(double times_longer) const {
  const double width = fast_.long_side(times_longer) / static_cast<double>(fast_.bodies);
  const double cells = 1.0 + width / std::max(price_.long_side, typical_way_);
  const double rows = power(cells, dimensions_ - 1);
  const double search = std::min(rows * (cost_of_row + cells * spheres_in_cell),
                                 (cost_of_row + 1.0) * static_cast<double>(bodies_));
  const double pairs = static_cast<double>(fast_.near) * fast_.times_larger(times_longer, dimensions_);
  return (static_cast<double>(fast_.bodies) * (start_cost + search) + pairs * cost_of_near_pair) /
         times_longer;
}

void WindowPolicy::start_main(double now, const RenewalCounts& updates) {
  if (now > main_start_ && main_.bodies > 0) adapt_main(updates, (now - main_start_) / length_of(main_rung_));
  main_ = {};
  main_start_ = now;
}

/// Takes about 2^-12 of the typical way as the quantum.
WindowPolicy::Sample::Sample(const WindowPolicy& policy, bool most)
    : policy_(&policy),
      most_(most),
      quantum_(power_of_two(exponent_of(std::max(policy.typical_way_, shortest_way)) - 12)),
      per_quantum_(1.0 / quantum_) {}

/// Returns a length in quanta, rounded up and at most 2^33. Lengths far beyond the typical way are cut to
/// that, and those far below it count as one quantum; a sum of 2^30 of the longest still fits 64 bits.
std::uint64_t WindowPolicy::Sample::quanta_in(double length) const {
  constexpr std::uint64_t most = std::uint64_t{1} << 33;
  const double quanta = length * per_quantum_;
  if (!(quanta < static_cast<double>(most))) return most;
  const auto whole = static_cast<std::uint64_t>(quanta);
  return whole + (static_cast<double>(whole) < quanta ? 1 : 0);
}

void WindowPolicy::Sample::add(double width, const SpeedBound& speed_bound, double time, double most) {
  widths_ += quanta_in(width);
  const double part = std::min(1.0, most / speed_bound.way(time));
  if (!(part > 0.0)) {
    ways_ += quanta_in(most);
    return;
  }
  ways_ += quanta_in(part * speed_bound.speed * time);
  growths_ += quanta_in(part * speed_bound.acceleration * time * time);
}

void WindowPolicy::Sample::note(const SpeedBound& speed_bound, double width, int rung) {
  ++bodies_;
  // Windows are longer than requested where double precision cannot distinguish their ends.
  if (rung >= policy_->main_rung_) ++in_main_;
  if (!most_) return add(width, speed_bound, length_of(rung), policy_->longest_way_);
  const double time = length_of(policy_->main_rung_);
  add(width, speed_bound, time, much_farther * policy_->typical_way_);
  const double way = speed_bound.way(time);
  const int magnitude = way > 0.0 ? exponent_of(way / policy_->typical_way_) : -least_magnitude;
  const int last = static_cast<int>(magnitudes) - 1;
  ++ways_gone_[static_cast<std::size_t>(std::clamp(magnitude + least_magnitude, 0, last))];
}

WindowPolicy::Sample& WindowPolicy::Sample::operator+=(const Sample& more) {
  bodies_ += more.bodies_;
  in_main_ += more.in_main_;
  for (std::size_t k = 0; k < magnitudes; ++k) ways_gone_[k] += more.ways_gone_[k];
  widths_ += more.widths_;
  ways_ += more.ways_;
  growths_ += more.growths_;
  return *this;
}

/// Adds a sample to the bodies that have started.
WindowPolicy::Starts& WindowPolicy::Starts::operator+=(const Sample& round) {
  bodies += round.bodies_;
  in_main += round.in_main_;
  for (std::size_t k = 0; k < magnitudes; ++k) ways_gone[k] += round.ways_gone_[k];
  widths += round.quantum_ * static_cast<double>(round.widths_);
  ways += round.quantum_ * static_cast<double>(round.ways_);
  growths += round.quantum_ * static_cast<double>(round.growths_);
  return *this;
}

void WindowPolicy::finish_start(const Sample& round, std::uint64_t near, std::uint64_t bodies) {
  bodies_ = bodies;
  Starts& starts = round.most_ ? main_ : fast_;
  starts += round;
  starts.near += near;
  if (round.most_) {
    note_price();
  } else if (fast_.bodies >= enough_starts) {
    adapt_fast();
  }
}

void WindowPolicy::add_starters(const Sample& round) {
  bodies_ += round.bodies_;
  (round.most_ ? main_ : fast_) += round;
}

void WindowPolicy::keep_fast(const WindowPolicy& present) {
  fast_ = present.fast_;
  fast_way_ =
      std::clamp(present.fast_way_ * (typical_way_ / present.typical_way_), typical_way_, longest_way_);
}

void WindowPolicy::note_price() {
  const auto count = static_cast<double>(main_.bodies);
  const auto near = static_cast<double>(main_.near);
  const double pairs = near * price_of_near_pair + cost_of_searches(main_.bodies, near, 1.0);
  const double across = main_.short_side(1.0) / count;
  const double along = main_.long_side(1.0) / count;
  price_ = {};
  if (along < infinity && across > 0.0) price_ = {across, along, pairs / count};
}

/// Swept spheres grow as in times_larger(), but the cells stay as they are.
double WindowPolicy::cost_of_width(double more) const {
  const auto& [across, along, pairs] = price_;
  if (!(across > 0.0)) return 0.0;
  const double longer = 1.0 + more / along;
  const double larger = power(1.0 + more / across, dimensions_ - 1) * longer;
  const double cost = search_spheres * (power(longer, dimensions_) - 1.0) + pairs * (larger - 1.0);
  return std::isnan(cost) ? infinity : cost;
}

void WindowPolicy::adapt_main(const RenewalCounts& updates, double windows) {
  int change = 0;
  double least = enough_cheaper * main_rate(1.0, updates, windows);
  // Only one longer length is tried, because what searches will find in longer windows is not known well.
  const bool may_grow = 2 * main_.in_main > main_.bodies && 2.0 * typical_way_ <= longest_way_;
  for (int powers = may_grow ? 1 : -1; powers >= -most_change; --powers) {
    const double changed = main_rate(power_of_two(powers), updates, windows);
    if (powers == 0 || !(changed < least)) continue;
    least = changed;
    change = powers;
  }
  change = std::clamp(change, -most_powers - main_rung_, most_powers - main_rung_);
  main_rung_ += change;
  // At most an eighth of the bodies may exceed the typical way.
  std::size_t magnitude = magnitudes - 1;
  for (std::uint64_t faster = main_.ways_gone[magnitude]; 8 * faster <= main_.bodies && magnitude > 0;)
    faster += main_.ways_gone[--magnitude];
  const double way = typical_way_ * power_of_two(static_cast<int>(magnitude) - least_magnitude + change);
  const double before = typical_way_;
  typical_way_ = std::clamp(way, shortest_way, longest_way_);
  const double fast_way = before > 0.0 ? fast_way_ * (typical_way_ / before) : much_farther * typical_way_;
  fast_way_ = std::clamp(fast_way, typical_way_, longest_way_);
}

/// Adapts the windows of the fast bodies by a factor of 2^powers_between_rungs.
void WindowPolicy::adapt_fast() {
  const double factor = power_of_two(powers_between_rungs);
  const double least = enough_cheaper * fast_rate(1.0);
  if (2 * fast_.in_main > fast_.bodies) {
    // Most fast bodies are in windows no shorter than the main one, which must be far too short.
    main_rung_ = std::min(main_rung_ + powers_between_rungs, most_powers);
    typical_way_ = std::min(typical_way_ * factor, longest_way_);
  } else if (fast_rate(factor) < least) {
    fast_way_ = std::min(fast_way_ * factor, longest_way_);
  } else if (fast_rate(1.0 / factor) < least) {
    fast_way_ = std::max(fast_way_ / factor, typical_way_);
  }
  fast_ = {};
}

bool WindowPolicy::is_valid() const {
  const auto is_way = [this](double way) { return way >= 0.0 && way <= longest_way_; };
  const auto are_sound = [](const Starts& starts) {
    return starts.widths >= 0.0 && starts.ways >= 0.0 && starts.growths >= 0.0;
  };
  const bool is_price =
      price_.short_side >= 0.0 && price_.long_side >= price_.short_side && price_.pairs >= 0.0;
  return is_price && std::abs(main_rung_) <= most_powers && is_way(typical_way_) && is_way(fast_way_) &&
         are_sound(main_) && are_sound(fast_) && std::isfinite(main_start_);
}

}  // namespace kinesphere
