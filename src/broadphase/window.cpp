#include "broadphase/window.hpp"

#include <algorithm>
#include <cmath>

#include "broadphase/window_policy.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Windows at time t are no shorter than 2^-binary_digits times the power of two of t; double precision could
/// not represent multiples of shorter lengths.
constexpr int binary_digits = 50;

}  // namespace

Window Window::at(double now, int rung) {
  const int resolvable = std::clamp(exponent_of(now) - binary_digits, -longest_rung, longest_rung);
  const int possible = std::clamp(rung, resolvable, longest_rung);
  return {possible, (std::floor(now * power_of_two(-possible)) + 1.0) * power_of_two(possible)};
}

Window Window::free_at(double now, int rung, std::span<const int> held) {
  Window window = at(now, rung);
  while (std::find(held.begin(), held.end(), window.rung) != held.end()) {
    const Window shorter = at(now, window.rung - WindowPolicy::powers_between_rungs);
    if (shorter.rung == window.rung) return {window.rung, now};
    window = shorter;
  }
  return window;
}

double Window::begin() const { return end - power_of_two(rung); }

bool Window::is_valid() const {
  return rung == endless().rung ? end == infinity
                                : std::abs(rung) <= longest_rung && std::abs(end) <= latest_end;
}

}  // namespace kinesphere
