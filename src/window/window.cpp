#include "window/window.hpp"

#include <algorithm>
#include <cmath>

#include "number/powers.hpp"
#include "window/tempo.hpp"

namespace kinesphere {
namespace {

/// The shortest window at a time may not be shorter than what its multiples can tell.
constexpr int digits = 50;

}  // namespace

Window Window::at(double now, int tier) {
  const int tellable = std::clamp(exponent_of(now) - digits, -longest_tier, longest_tier);
  const int possible = std::clamp(tier, tellable, longest_tier);
  return {possible, (std::floor(now * power_of_two(-possible)) + 1.0) * power_of_two(possible)};
}

Window Window::free_at(double now, int tier, std::span<const int> held) {
  Window window = at(now, tier);
  while (std::find(held.begin(), held.end(), window.tier) != held.end()) {
    const Window shorter = at(now, window.tier - Tempo::powers_between_tiers);
    if (shorter.tier == window.tier) return {window.tier, now};
    window = shorter;
  }
  return window;
}

double Window::begin() const { return end - power_of_two(tier); }

bool Window::is_sound() const {
  return tier == endless().tier ? end == infinity
                                : std::abs(tier) <= longest_tier && std::abs(end) <= latest_end;
}

}  // namespace kinesphere
