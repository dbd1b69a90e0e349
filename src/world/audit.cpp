// The audit: everything that should be true now, rebuilt from scratch.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>

#include "bound/encounter.hpp"
#include "input/input_check.hpp"
#include "number/infinity.hpp"
#include "world/engine.hpp"

namespace kinesphere {

namespace {

/// A recorded time may pass the one computed now by this part of the way there: both are lower bounds of the
/// same truth, and each stops its iteration a little early.
constexpr double slack = 1e-3;

bool too_late(double recorded, double computed, double now) {
  return recorded > computed + slack * (computed - now) + 1e-12 * (1.0 + std::abs(computed));
}

std::string times(double recorded, double computed) {
  return ": recorded " + std::to_string(recorded) + ", must not be later than " + std::to_string(computed);
}

}  // namespace

class World::Engine::Audit {
 public:
  explicit Audit(const Engine& engine) : engine_(engine), now_(engine.time_) {}

  std::optional<AuditFinding> run() {
    const auto count = static_cast<std::uint32_t>(engine_.bodies_.size());
    for (std::uint32_t a = 0; a < count && !finding_; ++a) {
      if (!body(a).present()) {
        check_absence(a);
        continue;
      }
      check_registration(a);
      check_schedule(a);
      check_walls(a);
      for (std::uint32_t b = a + 1; b < count && !finding_; ++b)
        if (body(b).present()) check_pair(a, b);
    }
    check_earliest();
    return finding_;
  }

 private:
  const Body& body(std::uint32_t number) const { return engine_.bodies_[number]; }
  std::string name(std::uint32_t number) const { return text_of(engine_.id_of(number)); }

  void find(std::string where, std::string what) {
    if (!finding_) finding_ = AuditFinding{std::move(where), std::move(what)};
  }

  /// A noisy report may lie outside what an earlier one promised, though the body does not.
  static bool exact(const Body& body) { return body.position_error == 0.0 && body.bound.growth_speed == 0.0; }

  void check_absence(std::uint32_t number) {
    if (engine_.grid_.contains(number)) find("registration", name(number) + " is not here but registered");
    if (engine_.schedule_.time_of(number) < infinity)
      find("queue", name(number) + " is not here but scheduled");
    if (!engine_.book_.partners_of(number).empty() || engine_.book_.walls_of(number) != 0)
      find("contact", name(number) + " is not here but touches something");
    if (!engine_.book_.crossings_of(number).empty())
      find("sensor", name(number) + " is not here but within a sensor distance");
  }

  void check_registration(std::uint32_t number) {
    const Body& b = body(number);
    if (const auto wrong = engine_.grid_.check(number, engine_.box(number)))
      find("registration", name(number) + " " + *wrong);
    if (b.is_fixed()) return check_fixed(number);
    if (engine_.marks_[number].dirty) return;
    if (!engine_.space_.is_narrow(engine_.box(number)))
      find("registration", name(number) + " has too wide a box");
    if (!(engine_.sketches_[number] == engine_.sketch_of(b)))
      find("registration", name(number) + " is not where others see it at a glance");
    if (!exact(b)) return;
    const Vec3 room = Vec3{1.0, 1.0, 1.0} * (0.25 * engine_.definition_.contact_tolerance);
    Box box{engine_.box(number).lower - room, engine_.box(number).upper + room};
    if (engine_.space_.is_flat()) std::tie(box.lower.z, box.upper.z) = std::pair(-infinity, infinity);
    const double exit = earliest_exit(engine_.reach(b), box, now_, b.box_end);
    if (too_late(b.box_end, exit, now_))
      find("registration", name(number) + " leaves its box" + times(b.box_end, exit));
  }

  void check_fixed(std::uint32_t number) {
    const Body& b = body(number);
    if (FloatBox(engine_.box(number)) != FloatBox(engine_.box_of_fixed(number)) || b.box_end != infinity)
      find("registration", name(number) + " is fixed but not registered where its shape is");
    for (const Neighbour& one : engine_.neighbours_.of(number))
      if (one.watches()) find("certificate", name(number) + " is fixed but watches another");
  }

  void check_schedule(std::uint32_t number) {
    const Body& b = body(number);
    if (engine_.marks_[number].dirty) return;
    double wanted = std::min({b.box_end, b.wall_time, b.look_time});
    for (const Neighbour& one : engine_.neighbours_.of(number))
      if (one.watches()) wanted = std::min(wanted, one.watch);
    const double found = engine_.schedule_.time_of(number);
    if (found > wanted) find("queue", name(number) + " is scheduled too late" + times(found, wanted));
    if (found < now_) find("queue", name(number) + " is scheduled in the past" + times(now_, found));
  }

  void check_earliest() {
    double first = infinity;
    for (std::uint32_t number = 0; number < engine_.bodies_.size(); ++number)
      if (body(number).present()) first = std::min(first, engine_.schedule_.time_of(number));
    if (engine_.schedule_.next_time() != first)
      find("queue", "its next time is not the least" + times(engine_.schedule_.next_time(), first));
  }

  void check_walls(std::uint32_t number) {
    const Body& b = body(number);
    if (!engine_.walls_ || b.is_fixed() || !settled(number, number) || engine_.book_.walls_of(number) != 0 ||
        !exact(b))
      return;
    // As for pairs: within the tolerance bouncing bodies follow the contact rule.
    if (impacts() &&
        until_reports_of_walls(engine_.book_.rule(), b.bound, *engine_.walls_, now_, infinity) <= now_)
      return;
    const double within = impacts() ? engine_.definition_.contact_tolerance : 0.0;
    const Vec3 room = Vec3{1.0, 1.0, 1.0} * within;
    const Box box{engine_.walls_->lower - room, engine_.walls_->upper + room};
    const double reached = earliest_exit(b.bound, box, now_, b.box_end);
    if (too_late(b.wall_time, reached, now_) && reached > now_)
      find("wall", name(number) + " may reach a wall unseen" + times(b.wall_time, reached));
  }

  void check_pair(std::uint32_t a, std::uint32_t b) {
    if (engine_.book_.touch(a, b) != engine_.book_.touch(b, a))
      return find("contact", pair(a, b) + " touch on one side only");
    if (engine_.may_meet(a, b) != engine_.may_meet(b, a))
      return find("filter", "the pair filter is not symmetric for " + pair(a, b));
    if (engine_.book_.touch(a, b) && !engine_.may_touch(a, b))
      return find("filter", pair(a, b) + " touch though they may not");
    check_crossings(a, b);
    check_crossings(b, a);
    if (!engine_.may_meet(a, b) || !settled(a, b)) return;
    engine_.for_each_threshold(a, b, [&](const Threshold& threshold) { check_threshold(a, b, threshold); });
  }

  void check_crossings(std::uint32_t a, std::uint32_t b) {
    for (const Crossing& crossing : engine_.book_.crossings_of(a)) {
      if (crossing.partner != b) continue;
      const bool senses =
          engine_.may_meet(a, b) &&
          engine_.sensors_.senses(engine_.sensing_of(a), engine_.sensing_of(b), crossing.distance);
      if (!engine_.book_.is_within(b, a, crossing.distance))
        find("sensor", pair(a, b) + " sense each other on one side only");
      if (!senses) find("sensor", pair(a, b) + " are within a distance that neither senses");
    }
  }

  void check_threshold(std::uint32_t a, std::uint32_t b, const Threshold& threshold) {
    if (!checkable(a, b, threshold)) return;
    const double change = earliest_change(a, b, threshold);
    const auto place = engine_.neighbours_.find(a, b);
    const double watched = place ? engine_.neighbours_.watched_until(a, *place) : infinity;
    if (watched < infinity) {
      // Else the two may meet in another image.
      if (engine_.space_.repeats() && watched > std::min(body(a).box_end, body(b).box_end))
        find("certificate", pair(a, b) + " are watched beyond the end of a box");
      if (too_late(watched, change, now_))
        find("certificate", pair(a, b) + " may change unseen" + times(watched, change));
      return;
    }
    const bool for_ever = threshold.within && !engine_.facts_end_with_boxes();
    const double until = for_ever ? infinity : engine_.unwatched_until(a, b);
    if (!threshold.within && !boxes_overlap(a, b)) return;
    if (too_late(until, change, now_))
      find("certificate", pair(a, b) + " are not watched" + times(until, change));
  }

  bool boxes_overlap(std::uint32_t a, std::uint32_t b) const {
    const Vec3 shift = engine_.shift_to_meet(a, b);
    const Box other{engine_.box(b).lower + shift, engine_.box(b).upper + shift};
    return FloatBox(engine_.box(a)).overlaps(FloatBox(other));
  }

  double earliest_change(std::uint32_t a, std::uint32_t b, const Threshold& threshold) const {
    const ContactRule& rule = engine_.book_.rule_of(threshold);
    const double inside = rule.impacts_only() ? rule.tolerance() : 0.0;
    return engine_.visit_pair(a, b, [&]<class Partner>(const Bound& bound, const Partner& partner) {
      if (threshold.within)
        return earliest_separation(bound, partner, now_, infinity, rule.release_gap() + threshold.distance);
      const double distance = threshold.distance - inside;
      double meeting = earliest_meeting(bound, partner, now_, infinity, distance);
      if constexpr (std::is_same_v<Partner, Bound>) {
        // Far out, the engine has the better eye for those that nearly touch.
        const Encounter encounter(MovedBound(bound, now_), MovedBound(partner, now_));
        meeting = std::max(meeting, now_ + encounter.meeting(infinity, distance + engine_.rounding_room()));
      }
      return meeting;
    });
  }

  /// Bouncing bodies within the tolerance follow the contact rule, not the bare distance.
  bool checkable(std::uint32_t a, std::uint32_t b, const Threshold& threshold) const {
    if (!exact(body(a)) || !exact(body(b))) return false;
    const ContactRule& rule = engine_.book_.rule_of(threshold);
    return !rule.impacts_only() ||
           engine_.gap_now(engine_.extent(a), engine_.extent(b)).lower > rule.tolerance();
  }

  /// True when the engine owes a fact about the pair (a body and itself: its walls) now.
  bool settled(std::uint32_t a, std::uint32_t b) const {
    const auto concerns = [=](const Event& event) {
      return event.first.index == a && (a == b ? event.wall != Wall::none : event.second.index == b);
    };
    const auto& changed = engine_.book_.changed();
    return !engine_.marks_[a].dirty && !engine_.marks_[b].dirty &&
           std::find(changed.begin(), changed.end(), std::pair(a, b)) == changed.end() &&
           engine_.book_.pending().none_of(concerns);
  }

  bool impacts() const { return engine_.definition_.contacts == ContactMode::impacts; }
  std::string pair(std::uint32_t a, std::uint32_t b) const { return name(a) + " and " + name(b); }

  const Engine& engine_;
  double now_;
  std::optional<AuditFinding> finding_;
};

std::optional<AuditFinding> World::Engine::audit() const { return Audit(*this).run(); }

}  // namespace kinesphere
