// The library's own sources, compiled once more with numbers that record their operations. The traced text is
// the text of the library.
#pragma once

// All other headers of the sources below must be included before names are replaced.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// These headers compute nothing.
#include "kinesphere/body_id.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/sensor.hpp"

#include "proof/traced_number.hpp"

namespace traced_kinesphere {
using namespace kinesphere;  // NOLINT
}

#if defined(__clang__)
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
#define double traced::Double
#define std traced_std
#define kinesphere traced_kinesphere

#include "bound/rounding.hpp"

// From here on, the functions of rounding.hpp and safe_steps.hpp are terms of their own, which others call.
namespace kinesphere::rounding {
inline double called_widened(double size) { return traced::call("widened", size); }
inline double called_capped(double size) { return traced::call("capped", size); }
inline double called_sum_down(double a, double b) { return traced::call("sum_down", a, b); }
inline double called_sum_up(double a, double b) { return traced::call("sum_up", a, b); }
inline double called_first_crossing(double c, double b, double a) {
  return traced::call("first_crossing", c, b, a);
}
}  // namespace kinesphere::rounding
#define widened called_widened
#define capped called_capped
#define sum_down called_sum_down
#define sum_up called_sum_up
#define first_crossing called_first_crossing

#include "bound/safe_steps.hpp"

namespace kinesphere {
/// The step that advance_by_safe_steps() gets: the step that a round takes, d after the beginning; or, if the
/// step is a term of its own, of this name, its times of begin and end.
inline std::string name_of_step;
template <class SafeStep>
double advance_by_a_step(double from, double until, SafeStep step) {
  if (name_of_step.empty()) return step(traced::variable("d"));
  return traced::call("advance_by_safe_steps", traced::variable(name_of_step), from, until);
}
}  // namespace kinesphere
#define advance_by_safe_steps advance_by_a_step

#include "bound/bound.cpp"
#include "bound/certificates.cpp"
#include "bound/quick_reject.hpp"
#include "bound/rigid_extent.hpp"

#undef advance_by_safe_steps
#undef first_crossing
#undef sum_up
#undef sum_down
#undef capped
#undef widened
#undef kinesphere
#undef std
#undef double
