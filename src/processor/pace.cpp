#include "processor/pace.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

/// A number that a body promised, and the way (length) that it lets the body go in a step.
struct PromisedWay {
  double way = -1.0;
  double promised = 0.0;
  std::string_view argument{};
  BodyId body = no_body;
};

/// Returns what lets a body go farthest in a step of this length (time).
PromisedWay longest_way(const Bodies& bodies, double step) {
  PromisedWay longest;
  for (std::uint32_t number = 0; number < bodies.numbers(); ++number) {
    if (!bodies[number].present()) continue;
    const Bound& bound = bodies[number].bound;
    const double by_acceleration = 0.5 * step * step;
    const std::array<std::pair<std::string_view, double>, 4> promises{
        {{"acceleration_limit", bound.acceleration_limit},
         {"planned_acceleration", norm(bound.planned_acceleration)},
         {"velocity_error", bodies.velocity_error(number)},
         {"velocity", norm(bound.velocity)}}};
    const auto consider = [&](double way, double promised, std::string_view argument) {
      if (way > longest.way) longest = {way, promised, argument, bodies.id_of(number)};
    };
    for (std::size_t k = 0; k < promises.size(); ++k) {
      const auto& [argument, promised] = promises[k];
      consider(promised * (k < 2 ? by_acceleration : step), promised, argument);
    }
    if (const RigidRecord* const turning = bodies.rigid.find(bodies[number]);
        turning != nullptr && bodies[number].has_parts())
      consider(turning->surface_acceleration(bodies[number].radius) * by_acceleration, turning->spin(),
               turning->keeps_spin() ? "angular_velocity" : "largest_angular_speed");
  }
  return longest;
}

/// Returns the number with few digits, which suffice to see what is wrong.
std::string about(double number) { return text_of(number, 3); }

}  // namespace

Result<void> Pace::check(const Bodies& bodies, double time) {
  const double step = (time - begin_) / block;
  restart(time);
  const double share = 1.0 + static_cast<double>(bodies.table().live_count()) / 1024.0;
  const double left = until_ - time;
  if (left > longest_call || left <= most_instants * share * step) return {};
  // Where time stands still, any step tells which acceleration is the largest.
  const PromisedWay longest = longest_way(bodies, step > 0.0 ? step : 0x1p-300);
  return Error{ErrorCode::out_of_range, std::string(longest.argument), longest.body,
               "advance: " + std::string(longest.argument) + " of " + text_of(longest.body) +
                   " must let time reach " + about(until_) + ", but is " + about(longest.promised) +
                   ", for which it goes on in steps of " + about(step) + " (at a contact tolerance of " +
                   about(bodies.definition().contact_tolerance) + ")"};
}

}  // namespace kinesphere
