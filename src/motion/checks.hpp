// What motions say to wrong questions and wrong changes.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// For how long the state of a body is known.
struct KnownTimes {
  double from;
  double to;
};

// `call` is the function that the caller used, for the message.

/// unknown_body or stale_body, by Motion::size() and contains().
std::optional<Error> wrong_body(std::string_view call, const Motion& motion, std::uint32_t body);
/// As the description of Motion says, for a body that the motion has (or no_body: one that is to be added).
std::optional<Error> wrong_time(std::string_view call, BodyId body, std::string_view argument, double time,
                                const KnownTimes& known);
std::optional<Error> wrong_state(std::string_view call, BodyId body, const State& state);
/// Finite in all parts.
std::optional<Error> wrong_departure(std::string_view call, BodyId body, const MotionOrigin& origin);
/// The error of a change that this kind of motion does not have.
Error cannot_change(std::string_view call, const Motion& motion, std::uint32_t body, std::string_view what);
/// The error of a question about a body at some time, of which something is known to be wrong.
[[noreturn, gnu::cold]] void refuse_question(std::string_view call, const Motion& motion, std::uint32_t body,
                                             std::string_view argument, double time, const KnownTimes& known);
/// Of a trajectory. Needs wrong_time() to be asked about both.
[[noreturn, gnu::cold]] void refuse_order(std::string_view call, std::uint32_t body, double begin,
                                          double end);

}  // namespace kinesphere
