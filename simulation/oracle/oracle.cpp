// The oracle: brute force over exact trajectories, with no grid and no bounds.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "number/infinity.hpp"
#include "simulation/detector/checked_detector.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/oracle/oracle.hpp"
#include "simulation/oracle/pair_table.hpp"

namespace kinesphere {
namespace {

/// The state of a pair, or of a body and a wall: touching or not, and the time at which that changes next.
struct Contact {
  double change = infinity;  ///< time; infinite if there is no change before searched_until
  double searched_until = -infinity;
  bool touching = false;
};

class Oracle final : public Detector {
 public:
  Oracle(const WorldDefinition& definition, const Motion& motion)
      : definition_(definition), rule_(definition), motion_(motion), time_(definition.start_time) {
    bodies_.resize(motion.size());
    first_changes_.resize(motion.size(), infinity);
    pairs_.resize(static_cast<std::uint32_t>(motion.size()));
  }

  std::string_view name() const override { return "oracle"; }

  Result<void> add(std::uint32_t number, const BodyDefinition& definition) override {
    Body& body = bodies_[number];
    body = Body{};
    body.active = true;
    body.radius = definition.radius + definition.position_error;
    forget(number, true);
    return {};
  }

  Result<void> remove(std::uint32_t number) override {
    for (const Key& key : contacts_of(number)) {
      if (at(key).touching && !impacts()) departures_.push_back(event_of(key));
      replace(key, Contact{});
    }
    bodies_[number].active = false;
    first_changes_[number] = infinity;
    std::sort(departures_.begin(), departures_.end(), delivered_before);
    return {};
  }

  Result<void> set_velocity(std::uint32_t number, const Vec3&) override {
    forget(number, impacts());
    return {};
  }

  Result<std::optional<Event>> advance(double until) override {
    if (departures_.empty()) {
      search_until(until);
      const double next = next_change();
      if (next > until) {
        time_ = until;
        return std::optional<Event>();
      }
      time_ = next;
      departures_.push_back(take_first());
    }
    const Event event = departures_.front();
    departures_.erase(departures_.begin());
    ++counters_.events[static_cast<std::size_t>(event.kind)];
    return std::optional(event);
  }

  double time() const override { return time_; }
  DetectorCounters counters() const override { return counters_; }
  Result<Bound> bound(std::uint32_t number) const override {
    const Sphere now = sphere(number);
    return Bound{
        .time = time_, .position = now.state.position, .velocity = now.state.velocity, .radius = now.radius};
  }

 private:
  bool impacts() const { return !wants_ends(definition_.contacts); }

  struct Body {
    bool active = false;
    double radius = 0.0;
    Trajectory trajectory;
    double known_until = -infinity;  ///< time up to which the trajectory was computed
    std::array<Contact, wall_count> walls{};
  };

  /// Names a contact: of body `row` with a body of smaller number, or with a wall.
  struct Key {
    std::uint32_t row;
    std::uint32_t other;
    Wall wall;
  };

  Contact& at(const Key& key) {
    if (key.wall != Wall::none) return bodies_[key.row].walls[static_cast<std::size_t>(key.wall) - 1];
    return pairs_(key.row, key.other);
  }

  Sphere sphere(std::uint32_t number) const {
    return {{number, 0}, bodies_[number].radius, motion_.state(number, time_)};
  }

  GapCourse course(const Key& key) const {
    const Body& body = bodies_[key.row];
    if (key.wall != Wall::none) return {body.trajectory, half_space(*definition_.box, key.wall), body.radius};
    return {body.trajectory, bodies_[key.other].trajectory, body.radius + bodies_[key.other].radius};
  }

  /// Returns the event of a contact that changes at time_.
  Event event_of(const Key& key) {
    const bool ends = at(key).touching;
    if (key.wall != Wall::none)
      return wall_event(ends ? EventKind::wall_end : EventKind::wall_begin, time_, sphere(key.row),
                        *definition_.box, key.wall);
    return contact_event(ends ? EventKind::contact_end : EventKind::contact_begin, time_, sphere(key.row),
                         sphere(key.other));
  }

  std::vector<Key> contacts_in_row(std::uint32_t row) const {
    std::vector<Key> keys;
    for (std::uint32_t other = 0; other < row; ++other)
      if (bodies_[other].active) keys.push_back({row, other, Wall::none});
    if (definition_.box)
      for (const Wall wall : walls) keys.push_back({row, row, wall});
    return keys;
  }

  std::vector<Key> contacts_of(std::uint32_t number) const {
    std::vector<Key> keys = contacts_in_row(number);
    for (std::uint32_t row = number + 1; row < bodies_.size(); ++row)
      if (bodies_[row].active) keys.push_back({row, number, Wall::none});
    return keys;
  }

  /// Sets a contact and updates the first change of its row.
  void replace(const Key& key, const Contact& contact) {
    const double before = std::exchange(at(key), contact).change;
    double& first = first_changes_[key.row];
    if (contact.change < first) {
      first = contact.change;
    } else if (before == first && before < contact.change) {
      first = infinity;
      for (const Key& other : contacts_in_row(key.row)) first = std::min(first, at(other).change);
    }
  }

  /// Returns the time of the next change. Cost: O(n), like each event.
  double next_change() const {
    return first_changes_.empty() ? infinity
                                  : *std::min_element(first_changes_.begin(), first_changes_.end());
  }

  /// Discards what is known of the body's future. With `apart`, its contacts count as not touching.
  void forget(std::uint32_t number, bool apart) {
    bodies_[number].known_until = -infinity;
    for (const Key& key : contacts_of(number)) {
      replace(key, Contact{.touching = at(key).touching && !apart});
      unsearched_.push_back(key);
    }
  }

  void search_until(double until) {
    if (until > searched_until_) {
      for (std::uint32_t row = 0; row < bodies_.size(); ++row) {
        bodies_[row].known_until = -infinity;
        if (!bodies_[row].active) continue;
        for (const Key& key : contacts_in_row(row))
          if (at(key).change == infinity) unsearched_.push_back(key);
      }
      searched_until_ = until;
    }
    for (const Key& key : unsearched_) {
      const bool known = at(key).searched_until >= searched_until_;
      if (known || !bodies_[key.row].active || !bodies_[key.other].active) continue;
      learn_trajectory(key.row);
      learn_trajectory(key.other);
      replace(key, searched(key));
    }
    unsearched_.clear();
  }

  void learn_trajectory(std::uint32_t number) {
    Body& body = bodies_[number];
    if (body.known_until >= searched_until_) return;
    body.trajectory = motion_.trajectory(number, time_, searched_until_);
    body.known_until = searched_until_;
  }

  /// Returns the contact with its next change, searched from time_ or from the end of the last search.
  Contact searched(const Key& key) {
    ++counters_.certificates;
    const GapCourse gap = course(key);
    const double until = searched_until_;
    Contact contact = at(key);
    double from = std::max(contact.searched_until, time_);
    contact.searched_until = until;
    if (contact.touching) {
      const auto end = gap.first_time(LevelCrossing::rises_to, rule_.separation_distance(), from, until);
      if (!impacts() || !end) {
        contact.change = end.value_or(infinity);
        return contact;
      }
      contact.touching = false;
      from = *end;
    }
    contact.change = impacts() && from == time_
                         ? next_impact(key, gap)
                         : gap.first_time(LevelCrossing::falls_to, 0.0, from, until).value_or(infinity);
    return contact;
  }

  /// Returns the next impact of a pair at time_. Bodies that were turned apart while in contact have to open
  /// before they can close again.
  double next_impact(const Key& key, const GapCourse& gap) {
    const Event now = event_of(key);
    std::optional<double> opens = time_;
    if (now.gap <= 0.0 && now.approach_speed <= 0.0) {
      opens = gap.first_time(LevelCrossing::rises_to, hair(), time_, searched_until_);
      const double end = opens.value_or(searched_until_);
      const auto closes = gap.first_time(LevelCrossing::falls_to, gap.gap_at(time_) - hair(), time_, end);
      if (closes) return *closes;
    }
    if (!opens) return infinity;
    return gap.first_time(LevelCrossing::falls_to, 0.0, *opens, searched_until_).value_or(infinity);
  }

  /// Returns a length far below the tolerance and far above rounding.
  double hair() const { return 1e-3 * definition_.contact_tolerance; }

  /// Applies the first event of this instant, in order of delivery, and returns it.
  Event take_first() {
    std::optional<Event> first;
    Key changed{};
    for (std::uint32_t row = 0; row < bodies_.size(); ++row) {
      if (!bodies_[row].active || first_changes_[row] != time_) continue;
      for (const Key& key : contacts_in_row(row)) {
        if (at(key).change != time_) continue;
        const Event event = event_of(key);
        if (first && !delivered_before(event, *first)) continue;
        first = event;
        changed = key;
      }
    }
    replace(changed, Contact{.touching = !at(changed).touching});
    unsearched_.push_back(changed);
    return *first;
  }

  WorldDefinition definition_;
  ContactRule rule_;
  const Motion& motion_;
  double time_;
  std::vector<Body> bodies_;
  PairTable<Contact> pairs_;
  std::vector<double> first_changes_;  ///< by row: the earliest change among its contacts
  double searched_until_ = -infinity;
  std::vector<Key> unsearched_;  ///< contacts without a next change known up to searched_until_
  std::vector<Event> departures_;
  DetectorCounters counters_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_oracle(const WorldDefinition& definition, const Motion& motion) {
  return make_checked<Oracle>(definition, motion);
}

}  // namespace kinesphere
