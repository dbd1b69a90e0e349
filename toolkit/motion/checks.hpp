// Argument checks of motions and their errors, and factors that keep |acceleration| <= limit true despite
// rounding.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// Scales a limit down so that an acceleration of that length obeys it. The product of a vector and a
/// quotient, and two norms, have a relative error of at most 9 roundings of 2^-53 together.
inline constexpr double slightly_less = 1.0 - 1e-15;

/// Scales a limit that was computed from accelerations up so that it contains them, including rounding in the
/// states.
inline constexpr double slightly_more = 1.0 + 1e-12;

/// Time range in which the state of a body is known.
struct KnownTimes {
  double from;
  double to;
};

// In all functions below, `call` is the name of the public function, for the message.

/// Returns unknown_body or stale_body if the motion does not contain the body, by Motion::size() and
/// contains().
std::optional<Error> wrong_body(std::string_view call, const Motion& motion, std::uint32_t body);
/// Returns the error that Motion documents for a time outside of `known`, if any. The body has to exist, or
/// is no_body for one that is to be added.
std::optional<Error> wrong_time(std::string_view call, BodyId body, std::string_view argument, double time,
                                const KnownTimes& known);
std::optional<Error> wrong_state(std::string_view call, BodyId body, const State& state);
/// Returns not_finite for an origin with a component that is not finite.
std::optional<Error> wrong_origin(std::string_view call, BodyId body, const MotionOrigin& origin);
/// Returns the error of a change that this kind of motion does not support.
Error cannot_change(std::string_view call, const Motion& motion, std::uint32_t body, std::string_view what);
/// Throws the error of an invalid query of a body at a time. Precondition: the body or the time is invalid.
[[noreturn, gnu::cold]] void refuse_question(std::string_view call, const Motion& motion, std::uint32_t body,
                                             std::string_view argument, double time, const KnownTimes& known);
/// Throws the error of a trajectory whose end is before its begin. Precondition: wrong_time() has accepted
/// both.
[[noreturn, gnu::cold]] void refuse_order(std::string_view call, std::uint32_t body, double begin,
                                          double end);

}  // namespace kinesphere
