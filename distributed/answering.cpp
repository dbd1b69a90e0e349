#include "distributed/answering.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "bodies/validation.hpp"

namespace kinesphere {

void RankSource::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_.state(in_motion_[ids[k].world], time);
}

MotionOrigin RankSource::origin(BodyId body) const { return motion_.origin(in_motion_[body.world]); }

void RankSource::set_origin(BodyId body, const MotionOrigin& origin) {
  motion_.set_origin(in_motion_[body.world], origin).value();
}

Result<Response> RankResponder::respond(const Event& event) const {
  const Response answer = respond_(event);
  if (auto valid = check(event, answer); !valid) return valid.error();
  return answer;
}

Result<void> RankResponder::check(const Event& event, const Response& answer) const {
  const auto check_change = [&](BodyId body, const std::optional<Vec3>& change, std::string_view argument,
                                auto check_given) -> Result<void> {
    if (!change || (body != no_body && check_given(*change, body, "run"))) return {};
    const std::string call =
        "run: respond: " + std::string(argument) + " at " + std::string(name_of(event.kind));
    if (body == no_body)
      return Error{ErrorCode::unknown_body, std::string(argument), no_body,
                   call + ": there is no such body in this event"};
    Error error = check_given(*change, body, call).error();
    error.argument = argument;
    return error;
  };
  const auto velocity = [this](const Vec3& given, BodyId body, std::string_view call) {
    return check_velocity(given, body, bodies_.definition(), call);
  };
  const auto spin = [this](const Vec3& given, BodyId body, std::string_view call) {
    const RigidRecord* const turning = bodies_.rigid.find(bodies_[bodies_.table().number_of(body)]);
    return check_spin(given, turning, body, bodies_.definition(), call);
  };
  auto valid = check_change(event.first, answer.first_velocity, "first_velocity", velocity);
  if (valid) valid = check_change(event.second, answer.second_velocity, "second_velocity", velocity);
  if (valid) valid = check_change(event.first, answer.first_angular_velocity, "first_angular_velocity", spin);
  if (valid)
    valid = check_change(event.second, answer.second_angular_velocity, "second_angular_velocity", spin);
  if (valid &&
      (answer.first_action != BodyAction::none || answer.second_action != BodyAction::none || answer.stop)) {
    valid = Error{ErrorCode::unsupported, "respond", event.first,
                  "run: respond: a distributed world accepts velocities, states of pairs and bodies that are "
                  "turned back, but no actions and no stops"};
  }
  return valid ? check_pair_response(event, answer) : valid;
}

}  // namespace kinesphere
