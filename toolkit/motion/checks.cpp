#include "motion/checks.hpp"

#include <cmath>
#include <string>

#include "input/input_check.hpp"

namespace kinesphere {

std::optional<Error> wrong_body(std::string_view call, const Motion& motion, std::uint32_t body) {
  if (motion.contains(body)) return std::nullopt;
  const BodyId id{body, 0};
  // Formatted as a plain number: as an id, the largest number would read as no_body.
  const std::string start = std::string(call) + ": body: body " + text_of(std::size_t{body});
  if (body < motion.size()) return Error{ErrorCode::stale_body, "body", id, start + " has been removed"};
  return Error{ErrorCode::unknown_body, "body", id,
               start + " is none of this motion, whose numbers are less than " + text_of(motion.size())};
}

std::optional<Error> wrong_time(std::string_view call, BodyId body, std::string_view argument, double time,
                                const KnownTimes& known) {
  if (known.from <= time && time <= known.to && std::isfinite(time)) return std::nullopt;
  const Subject subject{argument, body};
  return InputCheck(call)
      .finite(subject, time)
      .require(time >= known.from, ErrorCode::time_backwards, subject,
               "must not lie before its last change or frame at", known.from, time)
      .require(time <= known.to, ErrorCode::out_of_range, subject,
               "must not lie after the latest time that is known,", known.to, time)
      .error();
}

std::optional<Error> wrong_state(std::string_view call, BodyId body, const State& state) {
  return InputCheck(call)
      .finite({"state", body, "position"}, state.position)
      .finite({"state", body, "velocity"}, state.velocity)
      .error();
}

std::optional<Error> wrong_origin(std::string_view call, BodyId body, const MotionOrigin& origin) {
  if (std::isfinite(origin.time) && is_finite(origin.state.position) && is_finite(origin.state.velocity))
    return std::nullopt;
  return InputCheck(call)
      .finite({"origin", body, "time"}, origin.time)
      .finite({"origin", body, "position"}, origin.state.position)
      .finite({"origin", body, "velocity"}, origin.state.velocity)
      .error();
}

Error cannot_change(std::string_view call, const Motion& motion, std::uint32_t body, std::string_view what) {
  if (const auto wrong = wrong_body(call, motion, body)) return *wrong;
  const BodyId id{body, 0};
  return {ErrorCode::unsupported, "body", id,
          std::string(call) + ": body: " + text_of(id) + " belongs to a motion whose bodies cannot be " +
              std::string(what)};
}

void refuse_question(std::string_view call, const Motion& motion, std::uint32_t body,
                     std::string_view argument, double time, const KnownTimes& known) {
  if (const auto error = wrong_body(call, motion, body)) detail::bad_result(*error);
  detail::bad_result(wrong_time(call, {body, 0}, argument, time, known).value());
}

void refuse_order(std::string_view call, std::uint32_t body, double begin, double end) {
  detail::bad_result(InputCheck(call)
                         .require(begin <= end, ErrorCode::out_of_range, {"end", {body, 0}},
                                  "must not lie before begin,", begin, end)
                         .error()
                         .value());
}

}  // namespace kinesphere
