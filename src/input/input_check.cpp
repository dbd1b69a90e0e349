#include "input/input_check.hpp"

#include <cstdint>
#include <cstdio>
#include <utility>

namespace kinesphere {

// WebAssembly's standard library has no std::to_chars for numbers with a point.
std::string text_of(double number, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

std::string text_of(std::string_view text) { return std::string(text); }

std::string text_of(const Vec3& vector) {
  return "(" + text_of(vector.x) + ", " + text_of(vector.y) + ", " + text_of(vector.z) + ")";
}

std::string text_of(const Box& box) { return text_of(box.lower) + " to " + text_of(box.upper); }

std::string text_of(const State& state) {
  return text_of(state.position) + " moving " + text_of(state.velocity);
}

std::string text_of(BodyId body) { return body == no_body ? to_string(body) : "body " + to_string(body); }

InputCheck& InputCheck::box(const Subject& subject, const Box& box) {
  finite(subject, box.lower).finite(subject, box.upper);
  for (int axis = 0; axis < 3; ++axis)
    require(box.lower[axis] < box.upper[axis], ErrorCode::out_of_range, subject,
            "must have lower < upper on each axis", box);
  return *this;
}

InputCheck& InputCheck::start(const std::vector<State>& states, double start_time) {
  finite({"start_time"}, start_time);
  for (std::uint32_t body = 0; body < states.size(); ++body) {
    finite({"start", {body, 0}, "position"}, states[body].position);
    finite({"start", {body, 0}, "velocity"}, states[body].velocity);
  }
  return *this;
}

InputCheck& InputCheck::acceleration_limits(const std::vector<double>& limits, std::size_t bodies) {
  constexpr std::string_view argument = "acceleration_limits";
  require(limits.size() == bodies, ErrorCode::out_of_range, {argument}, "must have one entry per body,",
          bodies, limits.size());
  for (std::uint32_t body = 0; body < limits.size(); ++body)
    not_negative({argument, {body, 0}}, limits[body]);
  return *this;
}

void InputCheck::fail(ErrorCode code, const Subject& subject, std::string_view expectation,
                      const std::string& came) {
  const std::string argument(subject.argument);
  std::string message = std::string(call_) + ": " + argument;
  if (subject.body != no_body) message += " of " + text_of(subject.body);
  if (!subject.part.empty()) message += ", " + std::string(subject.part);
  if (subject.part_number) message += " " + std::to_string(*subject.part_number);
  if (!subject.part.empty()) message += ",";
  message += " " + std::string(expectation) + ", but is " + came;
  error_ = Error{code, argument, subject.body, std::move(message)};
}

}  // namespace kinesphere
