// The truth about all bodies of a world, kept apart from the world: who may meet whom, and whether a gap
// stays on one side of a limit, by subdivision of time.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinesphere/sensor.hpp"
#include "stream/scenario.hpp"
#include "stream/true_gap.hpp"

namespace kinesphere::stream {

/// The world contradicts the truth.
struct Disagreement : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw Disagreement(what);
}

/// Thrown in scenarios that would take too long.
struct CutShort {};

/// Two bodies, or a body and a wall; or two bodies and a sensor distance.
struct Contact {
  BodyId first;
  BodyId second = no_body;
  Wall wall = Wall::none;
  std::optional<double> sensed{};

  friend auto operator<=>(const Contact&, const Contact&) = default;
  bool has(BodyId body) const { return first == body || second == body; }
  double distance() const { return sensed.value_or(0.0); }
};
std::string text_of(const Contact& contact);

/// On which side of a level a gap is expected.
enum class Side { above, below };

class Truth {
 public:
  explicit Truth(const Scenario& scenario);

  const Scenario& scenario() const { return scenario_; }
  const WorldDefinition& definition() const { return definition_; }
  double tolerance() const { return definition_.contact_tolerance; }
  double separation_distance() const;

  Thing& at(BodyId id) { return things[id.index]; }
  const Thing& at(BodyId id) const { return things[id.index]; }
  void put(const Thing& thing);
  std::vector<BodyId> present() const;

  /// Returns what a body reports of itself.
  State report(const Thing& thing, double time) const;

  /// The caller's own filter: haunted bodies touch only each other.
  bool passes_pair_filter(BodyId a, BodyId b) const { return haunted.contains(a) == haunted.contains(b); }
  /// Returns true if filters and shapes let the two meet.
  bool meet(const Thing& a, const Thing& b) const;
  /// Returns true if events may report this contact.
  bool may_be_told(const Contact& contact) const;
  /// Calls visit(contact) for all contacts that events may report.
  template <class Visit>
  void for_each_contact(Visit visit) const;
  /// Returns the events that the two report; sensor overlaps begin and end.
  ContactEvents wanted(const Contact& contact) const;

  Real gap(const Contact& contact, Real time, const Measure& how = {}) const;
  /// Returns the gap that events tell: 0 if hulls of rigid bodies overlap, however deep.
  Real told_gap(const Contact& contact, Real time) const;
  bool is_of_balls(const Contact& contact) const;
  /// Returns how much two reports may err in the gap (length).
  double report_errors(const Contact& contact) const;
  /// Returns an upper limit of the speed of any point of the body from one time to another.
  Real speed(const Thing& thing, Real from, Real until) const;
  /// Returns a length well below the tolerance, but above all rounding, of times too.
  double slack() const;
  /// Throws unless the gap stays on that side of the level, up to `slack`.
  void require_side(const Contact& contact, Real from, Real until, Side side, Real level, double slack,
                    const std::string& what) const;
  [[noreturn]] void fail(const std::string& what, const Contact& contact, Real gap, Real time) const;

  double now;
  double last_change;           ///< time of the last change by the caller
  std::vector<Thing> things{};  ///< by index
  std::array<Sensor, 256> sensors{};
  bool has_pair_filter = false;
  std::set<BodyId> haunted{};
  TrueGaps gaps;

 private:
  bool has_wall(Wall wall) const;
  bool senses(const Thing& a, const Thing& b, double distance) const;
  Real closing_speed(const Contact& contact, Real from, Real until) const;
  void require_side(const Contact& contact, Real from, Real until, Side side, Real level, double slack,
                    const std::string& what, int depth) const;

  Scenario scenario_;
  WorldDefinition definition_;
};

template <class Visit>
void Truth::for_each_contact(Visit visit) const {
  const auto tell = [&](const Contact& contact) {
    if (may_be_told(contact)) visit(contact);
  };
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Thing& a = things[i];
    if (!a.present()) continue;
    for (std::size_t j = i + 1; j < things.size(); ++j) {
      const Thing& b = things[j];
      if (!meet(a, b)) continue;
      tell({a.id, b.id});
      std::vector<double> distances = sensors[a.definition.sensor_class].distances;
      const auto& others = sensors[b.definition.sensor_class].distances;
      distances.insert(distances.end(), others.begin(), others.end());
      std::ranges::sort(distances);
      distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
      for (const double distance : distances) tell({a.id, b.id, Wall::none, distance});
    }
    for (int wall = 1; wall <= wall_count; ++wall) tell({a.id, no_body, static_cast<Wall>(wall)});
  }
}

}  // namespace kinesphere::stream
