// Compares the contacts of a detector with the truth, pair by pair, and each pair only while its bodies may
// be near.
#include "simulation/oracle/comparison.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "contact/contact_event.hpp"
#include "simulation/oracle/true_contacts.hpp"
#include "simulation/scene/scene_check.hpp"

namespace kinesphere {
namespace {

/// Key of a contact: two bodies, or a body twice and a wall.
using Key = std::tuple<std::uint32_t, std::uint32_t, Wall>;

using Interval = ContactInterval;
using Contacts = std::map<Key, std::vector<Interval>>;
using Spans = std::vector<NearSpan>;

/// Returns the contacts of an event list. A contact without an end event has the end infinity.
Contacts contacts_of(const std::vector<Event>& events) {
  Contacts contacts;
  for (const Event& event : events) {
    const bool pair = event.second != no_body;
    auto& intervals =
        contacts[{event.first.index, pair ? event.second.index : event.first.index, event.wall}];
    switch (event.kind) {
      case EventKind::contact_begin:
      case EventKind::wall_begin:
        if (!event.already_touching) intervals.push_back({event.time, infinity});
        break;
      case EventKind::contact_end:
      case EventKind::wall_end:
        // An end without a begin shows as a contact that began at -infinity.
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
      : scene_(scene), motion_(scene), tolerance_(scene.world.contact_tolerance) {}

  ContactComparison run(const Contacts& found, const ComparisonProgress& on_progress) {
    // Finding the spans takes about half of the time.
    const auto spans_progress = [&](double part) { on_progress(0.5 * part); };
    const Spans all = near_spans(motion_.bodies(), 0.0, on_progress ? spans_progress : ComparisonProgress());
    const auto report_progress = [&](std::size_t k) {
      if (on_progress) on_progress(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(all.size()));
    };
    if (scene_.world.box) compare_walls(found);
    auto next = found.begin();
    for (std::size_t k = 0; k < all.size();) {
      report_progress(k);
      const Key key{all[k].first, all[k].second, Wall::none};
      Spans spans;
      for (; k < all.size() && Key{all[k].first, all[k].second, Wall::none} == key; ++k)
        spans.push_back(all[k]);
      for (; next != found.end() && next->first < key; ++next) compare_far(*next);
      const bool is_found = next != found.end() && next->first == key;
      compare(key, is_found ? next->second : std::vector<Interval>(), spans);
      if (is_found) ++next;
    }
    for (; next != found.end(); ++next) compare_far(*next);
    return std::move(result_);
  }

 private:
  void compare_walls(const Contacts& found) {
    for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body) {
      if (motion_.bodies()[body].trajectory == nullptr) continue;
      for (const Wall wall : walls) {
        const Key key{body, body, wall};
        const auto same = found.find(key);
        compare(key, same == found.end() ? std::vector<Interval>() : same->second,
                {motion_.whole_span(body, body)});
      }
    }
  }

  /// Compares the contacts of a pair without a near span. Walls of a world with a box were compared before.
  void compare_far(const Contacts::value_type& contacts) {
    const auto& [a, b, wall] = contacts.first;
    if (wall != Wall::none && scene_.world.box) return;
    const auto is_there = [&](std::uint32_t body) {
      return body < scene_.bodies.size() && motion_.bodies()[body].trajectory != nullptr;
    };
    if (wall == Wall::none && is_there(a) && is_there(b)) {
      compare(contacts.first, contacts.second, {});
    } else {
      for (const Interval& contact : contacts.second)
        differ(result_.invented, contacts.first, "begins where there is nothing", contact.begin);
    }
  }

  /// Walks through the found and the true contacts of one pair side by side. Between and within the found
  /// contacts, the true gap has to keep within the limits of the contact rule; where it does, every other
  /// difference only grazes the tolerance.
  void compare(const Key& key, const std::vector<Interval>& found, const Spans& spans) {
    const auto& [a, b, wall] = key;
    const GapCourse gap = wall == Wall::none ? motion_.pair(a, b) : motion_.wall(a, wall);
    const double first = motion_.first_time(a, b);
    const double last = motion_.last_time(a, b);
    const std::vector<Interval> truth = motion_.contacts(gap, a, b, spans);
    double apart_since = first;
    for (const Interval& contact : found) {
      check_apart(key, gap, apart_since, std::min(contact.begin, last), spans, found, truth);
      if (contact.begin < apart_since)
        differ(result_.invented, key, "begins before the last contact ends", contact.begin);
      if (gap.gap_at(contact.begin) > tolerance_ + hair())
        differ(result_.invented, key, "begins without being near", contact.begin);
      check_touching(key, gap, contact.begin, contact.end, last);
      if (contact.end < last && gap.gap_at(contact.end) < rule().separation_distance() - hair())
        differ(result_.invented, key, "ends without being apart", contact.end);
      if (contact.end < infinity && contact.end > last)
        differ(result_.invented, key, "ends too late", contact.end);
      apart_since = contact.end;
    }
    check_apart(key, gap, apart_since, last, spans, found, truth);
    check_truth(key, gap, truth, first, last);
    match(found, truth);
  }

  /// Checks the oracle's own times: the distance at each must be that of a begin or an end.
  void check_truth(const Key& key, const GapCourse& gap, const std::vector<Interval>& truth, double first,
                   double last) {
    for (const Interval& contact : truth) {
      const bool at_once = contact.begin == first && gap.gap_at(first) <= 0.0;
      if (!at_once && std::abs(gap.gap_at(contact.begin)) > hair())
        differ(result_.oracle_faults, key, "begin (oracle) where the gap is not zero", contact.begin);
      if (contact.end < last && std::abs(gap.gap_at(contact.end) - rule().separation_distance()) > hair())
        differ(result_.oracle_faults, key, "end (oracle) where the gap is not the separation distance",
               contact.end);
    }
  }

  /// Checks that the gap never falls below -tolerance between contacts. It can do so only in a span. Such a
  /// contact counts as late if the detector reported it before it ended, else as missed.
  void check_apart(const Key& key, const GapCourse& gap, double from, double to, const Spans& spans,
                   const std::vector<Interval>& found, const std::vector<Interval>& truth) {
    for (const NearSpan& span : spans) {
      from = std::max(from, span.begin);
      from = check_apart(key, gap, from, std::min(to, span.end), found, truth);
    }
  }
  /// Checks one span and returns the time until which all has been checked.
  double check_apart(const Key& key, const GapCourse& gap, double from, double to,
                     const std::vector<Interval>& found, const std::vector<Interval>& truth) {
    while (from < to) {
      const auto deep = gap.first_time(LevelCrossing::falls_to, -tolerance_ - hair(), from, to);
      if (!deep) break;
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
    return from;
  }

  /// Checks that the gap never grows beyond the separation distance and the tolerance during a contact.
  void check_touching(const Key& key, const GapCourse& gap, double from, double end, double last) {
    const double to = std::min(end, last);
    if (!(from < to)) return;
    if (const auto wide = gap.first_time(LevelCrossing::rises_to, rule().release_gap() + hair(), from, to))
      differ(to < last ? result_.late : result_.missed, key, "end unreported", *wide);
  }

  /// Counts begins and ends that are in both lists; contacts that overlap in time count as the same contact.
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

  /// Counts a begin or an end of two matching contacts. An infinite time lies beyond the end of the scene.
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

  /// Returns the allowance for rounding in the truth itself (length).
  double hair() const { return tolerance_ / 16.0; }
  const ContactRule& rule() const { return motion_.rule(); }

  const Scene& scene_;
  TrueMotion motion_;
  double tolerance_;
  ContactComparison result_;
};

}  // namespace

Result<ContactComparison> compare_with_oracle(const Scene& scene, const std::vector<Event>& events,
                                              const ComparisonProgress& on_progress) {
  if (scene.response != SceneResponse::pass_through || !wants_ends(scene.world.contacts)) {
    return Error{ErrorCode::unsupported, "scene", no_body,
                 "compare_with_oracle: scene must pass through and report ends"};
  }
  if (scene.world.periodic.any()) {
    return Error{ErrorCode::unsupported, "periodic", no_body,
                 "compare_with_oracle: periodic must be false on all axes"};
  }
  // check_scene() accepts the plane too: contacts of discs in a plane are contacts of the balls around their
  // centres.
  if (auto valid = check_scene(scene, "compare_with_oracle"); !valid) return valid.error();
  return Comparison(scene).run(contacts_of(events), on_progress);
}

Result<ContactComparison> verify(const Scene& scene, const DetectorMaker& make) {
  std::vector<Event> events;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  if (auto result = run_scene(scene, make, observer); !result) return result.error();
  return compare_with_oracle(scene, events);
}

}  // namespace kinesphere
