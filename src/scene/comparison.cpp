// Comparing the contacts of a detector with the truth.
#include "kinesphere/comparison.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "detector/gap_course.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Two bodies, or a body (twice) and a wall.
using Key = std::tuple<std::uint32_t, std::uint32_t, Wall>;

struct Interval {
  double begin;
  double end;
};
using Contacts = std::map<Key, std::vector<Interval>>;

/// The contacts of an event list; one that does not end lasts for ever.
Contacts contacts_of(const std::vector<Event>& events) {
  Contacts contacts;
  for (const Event& event : events) {
    const bool pair = event.second != no_body;
    auto& intervals =
        contacts[{event.first.index, pair ? event.second.index : event.first.index, event.wall}];
    switch (event.kind) {
      case EventKind::contact_begin:
      case EventKind::wall_begin:
        intervals.push_back({event.time, infinity});
        break;
      case EventKind::contact_end:
      case EventKind::wall_end:
        // An end without a begin shows as a contact since the beginning of time.
        if (intervals.empty() || intervals.back().end != infinity) intervals.push_back({-infinity, infinity});
        intervals.back().end = event.time;
        break;
      default:
        break;
    }
  }
  return contacts;
}

class Comparison {
 public:
  explicit Comparison(const Scene& scene)
      : scene_(scene), rule_(scene.world), tolerance_(scene.world.contact_tolerance) {
    trajectories_.resize(scene.bodies.size());
    for (std::uint32_t number = 0; number < scene.bodies.size(); ++number) {
      const double from = appears(number);
      const double to = std::min(scene.bodies[number].vanishes, scene.end_time);
      if (from <= to) trajectories_[number] = scene.motion->trajectory(number, from, to);
    }
  }

  ContactComparison run(const Contacts& found, const Contacts& truth) {
    static const std::vector<Interval> none;
    for (const auto& [key, intervals] : truth) {
      const auto same = found.find(key);
      compare(key, same == found.end() ? none : same->second, intervals);
    }
    for (const auto& [key, intervals] : found)
      if (!truth.contains(key)) compare(key, intervals, none);
    return std::move(result_);
  }

 private:
  double appears(std::uint32_t number) const {
    return std::max(scene_.bodies[number].appears, scene_.world.start_time);
  }

  double last_time(const Key& key) const {
    const auto& [a, b, wall] = key;
    return std::min({scene_.bodies[a].vanishes, scene_.bodies[b].vanishes, scene_.end_time});
  }

  GapCourse course(const Key& key) const {
    const auto& [a, b, wall] = key;
    const auto radius = [this](std::uint32_t number) {
      return scene_.bodies[number].radius + scene_.motion->definition(number, appears(number)).position_error;
    };
    if (wall != Wall::none) return {trajectories_[a], half_space(*scene_.world.box, wall), radius(a)};
    return {trajectories_[a], trajectories_[b], radius(a) + radius(b)};
  }

  /// Walks through the two lists of one pair side by side. Between and within the contacts that were found,
  /// the true gap has to obey the promise; where it does, every other difference only grazes the tolerance.
  void compare(const Key& key, const std::vector<Interval>& found, const std::vector<Interval>& truth) {
    const GapCourse gap = course(key);
    const auto& [a, b, wall] = key;
    const double first = std::max(appears(a), appears(b));
    const double last = last_time(key);
    double apart_since = first;
    for (const Interval& contact : found) {
      check_apart(key, gap, apart_since, std::min(contact.begin, last), found, truth);
      if (contact.begin < apart_since)
        differ(result_.invented, key, "begins before the last contact ends", contact.begin);
      if (gap.gap_at(contact.begin) > tolerance_ + hair())
        differ(result_.invented, key, "begins without being near", contact.begin);
      check_touching(key, gap, contact.begin, std::min(contact.end, last));
      if (contact.end < last && gap.gap_at(contact.end) < rule_.separation_distance() - hair())
        differ(result_.invented, key, "ends without being apart", contact.end);
      if (contact.end < infinity && contact.end > last)
        differ(result_.invented, key, "ends too late", contact.end);
      apart_since = contact.end;
    }
    check_apart(key, gap, apart_since, last, found, truth);
    check_truth(key, gap, truth, first, last);
    match(found, truth);
  }

  /// The oracle's own times, held against the bare distance at them.
  void check_truth(const Key& key, const GapCourse& gap, const std::vector<Interval>& truth, double first,
                   double last) {
    for (const Interval& contact : truth) {
      const bool at_once = contact.begin == first && gap.gap_at(first) <= 0.0;
      if (!at_once && std::abs(gap.gap_at(contact.begin)) > hair())
        differ(result_.oracle_faults, key, "begin (oracle) where the gap is not zero", contact.begin);
      if (contact.end < last && std::abs(gap.gap_at(contact.end) - rule_.separation_distance()) > hair())
        differ(result_.oracle_faults, key, "end (oracle) where the gap is not the separation distance",
               contact.end);
    }
  }

  /// While apart the gap never falls below -tolerance. Where it does, the contact is a late one if it has
  /// been noticed before it ended.
  void check_apart(const Key& key, const GapCourse& gap, double from, double to,
                   const std::vector<Interval>& found, const std::vector<Interval>& truth) {
    while (from < to) {
      const auto deep = gap.first_time(LevelCrossing::falls_to, -tolerance_ - hair(), from, to);
      if (!deep) return;
      const auto contact = std::find_if(truth.begin(), truth.end(), [&](const Interval& interval) {
        return interval.begin <= *deep && *deep <= interval.end;
      });
      const double end = contact == truth.end() ? infinity : contact->end;
      const bool noticed = std::any_of(found.begin(), found.end(), [&](const Interval& interval) {
        return *deep <= interval.begin && interval.begin <= end;
      });
      if (noticed) {
        differ(result_.late, key, "begins late", *deep);
      } else {
        differ(result_.missed, key, "touch unreported", *deep);
      }
      from = end;
    }
  }

  /// While touching it never grows beyond the separation distance and the tolerance.
  void check_touching(const Key& key, const GapCourse& gap, double from, double to) {
    if (!(from < to)) return;
    if (const auto wide = gap.first_time(LevelCrossing::rises_to, rule_.release_gap() + hair(), from, to))
      differ(to < last_time(key) ? result_.late : result_.missed, key, "end unreported", *wide);
  }

  /// Counts how many begins and ends stand in both lists; contacts that overlap in time are the same one.
  void match(const std::vector<Interval>& found, const std::vector<Interval>& truth) {
    std::size_t i = 0;
    std::size_t k = 0;
    std::uint64_t common = 0;
    while (i < found.size() && k < truth.size()) {
      const Interval& a = found[i];
      const Interval& b = truth[k];
      if (a.begin <= b.end && b.begin <= a.end) {
        note_match(a.begin, b.begin);
        note_match(a.end, b.end);
        ++common;
        ++i;
        ++k;
      } else {
        ++(a.begin < b.begin ? i : k);
      }
    }
    result_.grazing += 2 * (found.size() + truth.size() - 2 * common);
  }

  /// A time that is infinite lies behind the end of the scene.
  void note_match(double found, double truth) {
    if (found == infinity && truth == infinity) return;
    if (found == infinity || truth == infinity) {
      ++result_.grazing;
      return;
    }
    ++result_.matched;
    result_.largest_time_difference = std::max(result_.largest_time_difference, std::abs(found - truth));
  }

  void differ(std::uint64_t& count, const Key& key, const char* what, double time) {
    ++count;
    if (result_.first_difference) return;
    const auto& [a, b, wall] = key;
    const std::string partner =
        wall == Wall::none ? "body " + std::to_string(b) : "wall " + std::string(name_of(wall));
    result_.first_difference =
        "body " + std::to_string(a) + " and " + partner + ": " + what + " at time " + std::to_string(time);
  }

  /// Room for rounding in the truth itself.
  double hair() const { return tolerance_ / 16.0; }

  const Scene& scene_;
  ContactRule rule_;
  double tolerance_;
  std::vector<Trajectory> trajectories_;
  ContactComparison result_;
};

Result<std::vector<Event>> events_of(const Scene& scene, const DetectorMaker& make) {
  std::vector<Event> events;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  if (auto result = simulate(scene, make, observer); !result) return result.error();
  return events;
}

}  // namespace

Result<ContactComparison> compare_with_oracle(const Scene& scene, const std::vector<Event>& events) {
  if (scene.response != Response::pass_through || scene.world.contacts != ContactMode::begin_and_end) {
    return Error{ErrorCode::unsupported, "scene", no_body,
                 "compare_with_oracle: scene must pass through and report begins and ends"};
  }
  // The oracle knows no planes, but contacts of discs are those of the balls around the same centres.
  const auto make_spatial_oracle = [](WorldDefinition definition, const Motion& motion) {
    definition.dimensions = 3;
    return make_oracle(definition, motion);
  };
  const auto truth = events_of(scene, make_spatial_oracle);
  if (!truth) return truth.error();
  return Comparison(scene).run(contacts_of(events), contacts_of(*truth));
}

Result<ContactComparison> verify(const Scene& scene, const DetectorMaker& make) {
  const auto events = events_of(scene, make);
  if (!events) return events.error();
  return compare_with_oracle(scene, *events);
}

}  // namespace kinesphere
