// The algorithm of Kim, Guibas and Shin (1998) for spheres with known trajectories: only a common gravity
// acts on them between velocity changes, so all events have exact times and no bound grows.
#include <optional>

#include "bound/relative_motion.hpp"
#include "bound/rounding.hpp"
#include "input/input_check.hpp"
#include "research/rivals/event_driven/event_driven_detector.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/checked_detector.hpp"

namespace kinesphere {
namespace {

/// Computes earliest_meeting() in one step. Under a common acceleration the two move along a line relative to
/// each other, and |X + V d| = R is a quadratic.
double ballistic_meeting(const Bound& a, const Bound& b, double from, double horizon, double distance) {
  constexpr double margin = rounding::margin;
  const RelativeMotion motion(a, b, from);
  const double length = norm(motion.offset);
  const double reach = motion.radii + distance;
  const double size = motion.offset_size + distance;
  const double room = (length - reach) - margin * size;
  const double speed = dot(motion.offset, motion.velocity) -
                       margin * (size * norm_one(motion.velocity) + length * motion.velocity_size);
  const double acceleration =
      norm_squared(motion.velocity) - 4.0 * margin * norm_one(motion.velocity) * motion.velocity_size;
  const double time = rounding::sum_down(
      from, rounding::first_crossing(room * (length + reach), 2.0 * speed, 2.0 * acceleration));
  if (time > horizon) return std::numeric_limits<double>::infinity();
  return time > from ? time : from;
}

class BallisticDetector final : public EventDrivenDetector {
 public:
  BallisticDetector(const WorldDefinition& definition, const Motion& motion)
      : EventDrivenDetector(definition, motion,
                            {.cell_edge = 0.0, .trimming = true, .meeting_time = ballistic_meeting}) {}

  std::string_view name() const override { return "ballistic"; }

  Result<void> add(std::uint32_t number, const BodyDefinition& definition) override {
    const BodyId id{number, 0};
    InputCheck check("add");
    const auto none = [&](std::string_view part, double value) {
      check.require(value == 0.0, ErrorCode::unsupported, {"body", id, part},
                    "must be 0 for the ballistic detector", value);
    };
    none("acceleration_limit", definition.acceleration_limit);
    none("position_error", definition.position_error);
    none("velocity_error", definition.velocity_error);
    const Vec3& gravity = gravity_.value_or(definition.planned_acceleration);
    check.require(definition.planned_acceleration == gravity, ErrorCode::unsupported,
                  {"body", id, "planned_acceleration"}, "must be that of all others,", gravity,
                  definition.planned_acceleration);
    if (check.error()) return *check.error();
    gravity_ = gravity;
    return EventDrivenDetector::add(number, definition);
  }

 private:
  /// Trajectories are known, so the state is computed without a probe.
  State report(std::uint32_t number) override {
    const Bound& bound = body(number).bound;
    return {bound.centre_at(time()), body(number).kicked_to.value_or(bound.velocity_at(time()))};
  }

  /// No bound grows, so resets are never due.
  void on_outgrown(std::uint32_t) override {}

  /// All other predictions about the two bodies stay valid.
  void on_meeting(std::uint32_t a, std::uint32_t b) override {
    ++counters_.colliding;
    for (const std::uint32_t number : {a, b})
      if (!fresh(number)) probe(number);
    predict_pair(a, b);
  }

  std::optional<Vec3> gravity_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_ballistic_detector(const WorldDefinition& definition,
                                                          const Motion& motion) {
  return make_checked<BallisticDetector>(definition, motion);
}

}  // namespace kinesphere
