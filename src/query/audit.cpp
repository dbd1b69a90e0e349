// Audit: recomputes the invariants of the engine from scratch and compares them with the stored state.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/engine.hpp"
#include "input/input_check.hpp"
#include "number/infinity.hpp"
#include "query/plain_gap.hpp"

namespace kinesphere {

namespace {

/// Relative slack for a recorded time over one computed now. The two are lower bounds of the same true time,
/// and each iteration stops a little early. A larger slack hides late certificates; a smaller one reports
/// false findings.
constexpr double most_slack = 1e-3;

bool too_late(double recorded, double computed, double now) {
  return recorded > computed + most_slack * (computed - now) + 1e-12 * (1.0 + std::abs(computed));
}

std::string times(double recorded, double computed) {
  return ": recorded " + std::to_string(recorded) + ", must not be later than " + std::to_string(computed);
}

}  // namespace

class World::Engine::Audit {
 public:
  explicit Audit(const Engine& engine) : engine_(engine), now_(engine.time()) {}

  std::optional<AuditFinding> run() {
    const auto count = static_cast<std::uint32_t>(engine_.bodies().numbers());
    boxes_.resize(count);
    for (std::uint32_t a = 0; a < count && !finding_; ++a) {
      if (!body(a).present()) {
        check_absence(a);
        continue;
      }
      check_registration(a);
      check_walls(a);
      for (std::uint32_t b = a + 1; b < count && !finding_; ++b)
        if (body(b).present()) check_pair(a, b);
    }
    check_core();
    return finding_;
  }

 private:
  void check_core() {
    if (finding_) return;
    const char* const broken = engine_.core().audit([this](std::uint32_t a, std::uint32_t b) {
      using Claim = core::Core::Claim;
      if (a == b && body(a).dirty) return Claim::nothing;
      // The truth, not a bound with errors, stays in its safe region. check_pair() looks at when two meet.
      if (a == b)
        return exact(a) && engine_.bodies().radii.find(a) == nullptr ? Claim::meet_as_balls
                                                                     : Claim::neighbours;
      return body(a).dirty || body(b).dirty || !engine_.bodies().may_meet(a, b) ? Claim::nothing
                                                                                : Claim::neighbours;
    });
    if (broken) find("core", std::string("invariant ") + broken + " of src/core/core.hpp does not hold");
  }

  const Body& body(std::uint32_t number) const { return engine_.bodies()[number]; }
  std::string name(std::uint32_t number) const { return text_of(engine_.bodies().id_of(number)); }

  void find(std::string where, std::string what) {
    if (!finding_) finding_ = AuditFinding{std::move(where), std::move(what)};
  }

  /// True if reports of the body are exact. A noisy report may violate an earlier bound although the true
  /// body does not.
  bool exact(std::uint32_t number) const {
    return body(number).position_error == 0.0 && engine_.bodies().velocity_error(number) == 0.0;
  }

  /// Returns the bound of an exact body as it is from now on. Certificates of meetings can know how a ball
  /// shrinks, and so does this bound, until the ball is a point.
  Bound shrinking_bound(std::uint32_t number, Bound bound) const {
    const ChangingRadius* const changing = engine_.bodies().radii.find(number);
    if (!changing || changing->rate >= 0.0) return bound;
    bound.growth_speed = changing->rate_at(now_);
    bound.radius = changing->at(now_) - bound.growth_speed * (now_ - bound.time);
    return bound;
  }

  void check_absence(std::uint32_t number) {
    if (engine_.is_registered(number)) find("registration", name(number) + " is not here but registered");
    if (!engine_.contacts().partners_of(number).empty() || engine_.contacts().walls_of(number) != 0)
      find("contact", name(number) + " is not here but touches something");
    if (!engine_.contacts().overlaps_of(number).empty())
      find("sensor", name(number) + " is not here but within a sensor distance");
  }

  void check_registration(std::uint32_t number) {
    const Body& b = body(number);
    if (b.dirty) return;
    if (!engine_.is_registered(number)) return find("registration", name(number) + " is not registered");
    const double end = engine_.box_end(number);
    if (end < now_) find("queue", name(number) + " may have left its safe region" + times(now_, end));
    if (b.is_sleeping() && !(b.is_at_rest() && b.bound.velocity == Vec3{} && b.largest_acceleration() == 0.0))
      find("registration", name(number) + " rests, but its bound does not stand still");
    if (b.is_static()) return check_static(number, end);
    if (!exact(number)) return;
    const Vec3 margin = Vec3{1.0, 1.0, 1.0} * (0.25 * engine_.definition().contact_tolerance);
    Box box{engine_.box(number).lower - margin, engine_.box(number).upper + margin};
    if (engine_.bodies().space().is_flat())
      std::tie(box.lower.z, box.upper.z) = std::pair(-infinity, infinity);
    Bound reach = b.bound;
    reach.radius += engine_.bodies().sensors.reach(b.sensor_class);
    const double exit = earliest_exit(reach, box, now_, end);
    if (too_late(end, exit, now_)) find("registration", name(number) + " leaves its box" + times(end, exit));
    // A safe region that is left now is not replaced yet, but queries still search the body in its box.
    if (end <= now_ && earliest_exit(reach, box, now_, infinity) <= now_)
      find("registration", name(number) + " is not in its box");
  }

  void check_static(std::uint32_t number, double end) {
    const Box box = engine_.box(number);
    const Box shape = box_of_static(engine_.bodies(), number);
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.lower[axis] <= shape.lower[axis] && shape.upper[axis] <= box.upper[axis]) || end != infinity)
        return find("registration", name(number) + " is static but not registered where its shape is");
  }

  void check_walls(std::uint32_t number) {
    const Body& b = body(number);
    if (!engine_.bodies().meets_walls(number) || b.is_shaped() || !is_certified(number, number) ||
        engine_.contacts().walls_of(number) != 0 || !exact(number))
      return;
    // Bodies without ends follow the contact rule within the tolerance instead, as in checkable().
    const bool has_ends = wants_ends(b.contact_events);
    if (!has_ends && until_reports_of_walls(engine_.contacts().rule(), b.bound, *engine_.bodies().walls(),
                                            now_, infinity) <= now_)
      return;
    const double end = engine_.core().balls()[number].own;
    const double within = has_ends ? 0.0 : engine_.definition().contact_tolerance;
    const Vec3 margin = Vec3{1.0, 1.0, 1.0} * within;
    const Box box{engine_.bodies().walls()->lower - margin, engine_.bodies().walls()->upper + margin};
    const double reached = earliest_exit(shrinking_bound(number, b.bound), box, now_, end);
    if (reached < end && too_late(end, reached, now_) && reached > now_)
      find("wall", name(number) + " may reach a wall, which is not due" + times(end, reached));
  }

  void check_pair(std::uint32_t a, std::uint32_t b) {
    if (engine_.contacts().touch(a, b) != engine_.contacts().touch(b, a))
      return find("contact", pair(a, b) + " touch on one side only");
    if (engine_.bodies().may_meet(a, b) != engine_.bodies().may_meet(b, a))
      return find("filter", "the pair filter is not symmetric for " + pair(a, b));
    if (engine_.contacts().touch(a, b) && !engine_.bodies().may_touch(a, b))
      return find("filter", pair(a, b) + " touch though they may not");
    check_overlaps(a, b);
    check_overlaps(b, a);
    if (!engine_.bodies().may_meet(a, b) || !is_certified(a, b)) return;
    const PairLinks links = engine_.contacts().links_of(a, b);
    engine_.main().certifier().for_each_threshold(a, b, links, [&](const Threshold& threshold) {
      if (!threshold.is_turned) check_threshold(a, b, threshold);
      if (threshold.is_watched()) check_threshold(a, b, next_approach(threshold));
    });
  }

  /// Returns the threshold that two bodies in touch cross when they approach again.
  static Threshold next_approach(const Threshold& threshold) {
    return {.within = false, .wanted = ContactEvents::impacts, .state = threshold.state};
  }

  void check_overlaps(std::uint32_t a, std::uint32_t b) {
    for (const OverlapRecord& overlap : engine_.contacts().overlaps_of(a, b)) {
      const bool senses = engine_.bodies().may_meet(a, b) &&
                          engine_.bodies().sensors.senses(sensing_of(engine_.bodies(), a),
                                                          sensing_of(engine_.bodies(), b), overlap.distance);
      const OverlapRecords::List back = engine_.contacts().overlaps_of(b);
      if (!std::binary_search(back.begin(), back.end(), OverlapRecord{a, overlap.distance}))
        find("sensor", pair(a, b) + " sense each other on one side only");
      if (!senses) find("sensor", pair(a, b) + " are within a distance that neither senses");
    }
  }

  void check_threshold(std::uint32_t a, std::uint32_t b, const Threshold& threshold) {
    // A pair whose certificate fails now is rechecked before time advances.
    if (!checkable(a, b, threshold) || engine_.claimed_until(a, b) <= now_) return;
    const CollisionShape first = collision_shape_of(engine_.bodies(), a);
    const CollisionShape second = collision_shape_of(engine_.bodies(), b);
    const WorldDefinition& world = engine_.definition();
    const Vec3 period = engine_.bodies().space().period();
    check_state(a, b, threshold, PlainGap(first, second, period, world.shear_rate, world.start_time));
    const Bound one = threshold.within ? first.bound : shrinking_bound(a, first.bound);
    const Bound other = threshold.within ? second.bound : shrinking_bound(b, second.bound);
    const PlainGap gap({one, first.is_static, first.shape, first.carried_radius},
                       {other, second.is_static, second.shape, second.carried_radius}, period,
                       world.shear_rate, world.start_time);
    const double end = engine_.claimed_until(a, b);
    if (!threshold.within && !boxes_overlap(a, b)) return;
    if (const auto change = certain_change(a, b, threshold, gap, end))
      find("certificate", pair(a, b) + " may change unseen" + times(end, *change));
  }

  /// Checks the contact state that the delivered events imply against the state that the bounds imply,
  /// wherever within its bound each body is.
  void check_state(std::uint32_t a, std::uint32_t b, const Threshold& threshold, const PlainGap& gap) {
    const ContactRule& rule = engine_.contacts().rule();
    const PlainGap::Limits limits = gap.of_bodies(now_);
    const double margin = slack_of_gaps() + gap.uncertainty(now_);
    const bool end_missing =
        threshold.within && limits.lower > threshold.distance + rule.release_gap() + margin;
    const bool begin_missing =
        !threshold.within && limits.upper < threshold.distance - rule.tolerance() - margin;
    if (!end_missing && !begin_missing) return;
    const std::string distance = threshold.sensed ? " of " + std::to_string(threshold.distance) : "";
    find(threshold.sensed ? "sensor" : "contact",
         pair(a, b) + (end_missing ? " are apart, and no end" : " are too near, and no begin") + distance +
             " has been told: their gap is at " +
             (end_missing ? "least " + text_of(limits.lower) : "most " + text_of(limits.upper)));
  }

  /// Slack for gaps (length): a quarter of the tolerance, well below what the contact rule distinguishes, and
  /// four times the error allowed to a faithful report.
  double slack_of_gaps() const { return 0.25 * engine_.definition().contact_tolerance; }

  /// Returns the box in which a body is registered, cached per body because every pair needs it.
  const Box& box(std::uint32_t number) {
    std::optional<Box>& known = boxes_[number];
    if (!known) known = engine_.box(number);
    return *known;
  }

  bool boxes_overlap(std::uint32_t a, std::uint32_t b) {
    const Vec3 shift =
        engine_.bodies().space().repeats() ? shift_to_meet(engine_.bodies(), a, b, now_) : Vec3{};
    const Box& one = box(a);
    const Box& other = box(b);
    for (int axis = 0; axis < 3; ++axis)
      if (one.upper[axis] < other.lower[axis] + shift[axis] ||
          other.upper[axis] + shift[axis] < one.lower[axis])
        return false;
    return true;
  }

  /// Searches for a time before a recorded certificate's failure time at which its claim is certainly false.
  /// A certificate made earlier, or by another iteration, may correctly be later than one made now, so it is
  /// wrong only if there is such a time. Steps follow from the largest speed of the gap, with a minimum step
  /// to bound the cost.
  std::optional<double> certain_change(std::uint32_t a, std::uint32_t b, const Threshold& threshold,
                                       const PlainGap& gap, double recorded) const {
    const ContactRule& rule = engine_.contacts().rule();
    const double level = threshold.distance + (threshold.within               ? rule.release_gap()
                                               : wants_ends(threshold.wanted) ? 0.0
                                                                              : -rule.tolerance());
    const double computed = earliest_change(a, b, threshold, level);
    const bool doubtful = recorded > computed;
    double end = recorded;
    if (end == infinity && doubtful) end = now_ + 8.0 * (computed - now_);
    if (end == infinity) end = engine_.main().certifier().earlier_own_time(a, b);
    const double least_step = (end - now_) / (doubtful ? 512.0 : 16.0);
    const double last = end - 0x1p-20 * (end - now_);
    for (double time = now_; time < end;) {
      const double margin =
          threshold.within ? level - gap.at_farthest(time).lower : gap.of_bounds(time).upper - level;
      if (margin < -(slack_of_gaps() + gap.uncertainty(time))) return time;
      if (time >= last) break;
      const double speed = gap.largest_speed(time, end);
      const double next = std::min(last, time + std::max(least_step, margin > 0.0 ? margin / speed : 0.0));
      // The spacing of doubles is too coarse for another step.
      if (!(next > time)) break;
      time = next;
    }
    return std::nullopt;
  }

  double earliest_change(std::uint32_t a, std::uint32_t b, const Threshold& threshold, double level) const {
    return visit_pair(engine_.bodies(), a, b, now_, [&](const Bound& bound, const auto& partner) {
      return threshold.within ? earliest_separation(bound, partner, now_, infinity, level)
                              : earliest_meeting(bound, partner, now_, infinity, level);
    });
  }

  /// True for a body with a shape that is not a ball.
  bool has_faces(std::uint32_t number) const {
    return collision_shape_of(engine_.bodies(), number).shape != nullptr;
  }

  /// True if the bare distance determines the state of the threshold. Within the tolerance, an approach of
  /// bodies without ends, or in touch, follows the contact rule instead.
  bool checkable(std::uint32_t a, std::uint32_t b, const Threshold& threshold) const {
    // PlainGap knows the gaps of balls alone, to each other and to shapes.
    if (!exact(a) || !exact(b) || body(a).has_parts() || body(b).has_parts()) return false;
    if (has_faces(a) && has_faces(b)) return false;
    const ContactRule& rule = engine_.contacts().rule();
    return threshold.within || wants_ends(threshold.wanted) ||
           gap_at(engine_.bodies(), now_, collision_shape_of(engine_.bodies(), a),
                  collision_shape_of(engine_.bodies(), b))
                   .lower > rule.tolerance();
  }

  /// True if the engine must hold a valid certificate of the pair now. A pair of a body with itself stands
  /// for its walls.
  bool is_certified(std::uint32_t a, std::uint32_t b) const {
    const auto concerns = [=](const Event& event) {
      return event.first.index == a && (a == b ? event.wall != Wall::none : event.second.index == b);
    };
    const auto& changed = engine_.main().events().changed();
    return !body(a).dirty && !body(b).dirty &&
           std::find(changed.begin(), changed.end(), std::pair(a, b)) == changed.end() &&
           engine_.main().events().pending().none_of(concerns);
  }

  std::string pair(std::uint32_t a, std::uint32_t b) const { return name(a) + " and " + name(b); }

  const Engine& engine_;
  double now_;
  std::vector<std::optional<Box>> boxes_;
  std::optional<AuditFinding> finding_;
};

std::optional<AuditFinding> World::Engine::audit() const { return Audit(*this).run(); }

}  // namespace kinesphere
