#include "distributed/answering.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "engine/validation.hpp"

namespace kinesphere {

void RankSource::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k)
    states[k] = motion_.state(directory_[ids[k].world].in_motion, time);
}

MotionOrigin RankSource::origin(BodyId body) const {
  return motion_.origin(directory_[body.world].in_motion);
}

void RankSource::set_origin(BodyId body, const MotionOrigin& origin) {
  motion_.set_origin(directory_[body.world].in_motion, origin).value();
}

Result<Response> RankResponder::respond(const Event& event) {
  const Response answer = respond_(event);
  const auto check = [&](BodyId body, const std::optional<Vec3>& velocity,
                         std::string_view argument) -> Result<void> {
    if (!velocity) return {};
    const std::string call =
        "run: respond: " + std::string(argument) + " at " + std::string(name_of(event.kind));
    if (body == no_body)
      return Error{ErrorCode::unknown_body, std::string(argument), no_body,
                   call + ": there is no such body in this event"};
    auto valid = check_velocity(*velocity, body, definition_, call);
    if (valid) return valid;
    Error error = valid.error();
    error.argument = argument;
    return error;
  };
  auto valid = check(event.first, answer.first_velocity, "first_velocity");
  if (valid) valid = check(event.second, answer.second_velocity, "second_velocity");
  if (valid &&
      (answer.first_action != BodyAction::none || answer.second_action != BodyAction::none || answer.stop)) {
    valid = Error{ErrorCode::unsupported, "respond", event.first,
                  "run: respond: a distributed world accepts velocities, but no actions and no stops"};
  }
  if (!valid) return valid.error();
  return answer;
}

}  // namespace kinesphere
