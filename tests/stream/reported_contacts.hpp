// Compares the events of a world with the truth: the guarantee of docs/guarantee.md, checked with exact
// polynomials between all stops.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "contact/contact_rule.hpp"
#include "kinesphere/event_hash.hpp"
#include "kinesphere/world.hpp"
#include "simulation/oracle/pair_table.hpp"
#include "stream/truth.hpp"

namespace kinesphere::stream {

/// A reported contact that a change of one of its bodies may end, in its state before the change.
struct Before {
  Contact contact;
  Event end;     ///< the event that must come if the change ends it
  bool is_over;  ///< the true gap is at the separation distance, so an end may be pending
  bool turns;    ///< one of the two is rigid
};

class ReportedContacts {
 public:
  ReportedContacts(const WorldDefinition& definition, Truth& truth);

  /// Moves the truth on. Precondition: no event comes before `time`.
  void move_on_to(double time);
  /// Checks an event that the world reports at the time of the truth.
  void hear(const Event& event);
  /// Checks that no end is missing: all ends that changes have caused were reported.
  void settle_ends();

  // Changes by the caller. before() must be called before the change, the others after it.
  std::vector<Before> before(const World& world, BodyId id) const;
  /// The body was removed or disabled.
  void gone(const std::vector<Before>& before);
  /// The body was teleported, or has another radius or other limits.
  void replaced(const World& world, BodyId id, const std::vector<Before>& before);
  void refiltered(BodyId id, const std::vector<Before>& before);
  void redirected(BodyId id);
  void appeared(BodyId id);

  /// Returns the events that the two report. Sensor overlaps begin and end.
  ContactEvents wanted(const Contact& contact) const;
  /// Far below the tolerance, above rounding.
  double slack() const { return slack_; }

  /// Checks that the contacts and overlaps of the body in the world are those of its events.
  void check_account(const World& world, BodyId id) const;

 private:
  struct ReportedState {
    bool touching = false;    ///< with ends: a begin was reported, and its end was not
    bool approached = false;  ///< an approach was reported, and the bodies have not certainly parted since
    bool opened = false;      ///< since that report the two may have parted for a while
    bool turned = false;      ///< approached, and one of the two has got another velocity at this instant
    bool guarded = false;     ///< the Zeno guard has told that the two may overlap until they have separated
    bool due = false;         ///< an approach now must be reported before time moves on
    double floor = 0.0;       ///< no lower gap may come unreported; 0 stands for minus the tolerance

    friend bool operator==(const ReportedState&, const ReportedState&) = default;
  };
  /// An end that a change has caused, not yet delivered.
  struct End {
    Contact contact;
    std::vector<Event> candidates;  ///< an end for each possible change
    bool certain;
    bool turns;  ///< one of the two was rigid
  };

  /// True if the begin of the two was reported and, as far as reports tell, they touch or may touch.
  bool is_open(const Contact& contact) const {
    return reported(contact).touching || reported(contact).approached;
  }
  Event end_now(const World& world, const Contact& contact) const;
  GapLimits limits(const World& world, const Contact& contact) const;
  bool same(const Event& a, const Event& b, bool turns) const;
  double slack(const Contact& contact) const { return truth_.turns(contact) ? slack_ + 1e-10 : slack_; }
  bool same_state(const State& reported, BodyId id) const;
  bool same_spin(const Vec3& reported, BodyId id) const;
  ReportedState& reported(const Contact& contact);
  const ReportedState& reported(const Contact& contact) const;
  template <class Action>
  void for_each(BodyId id, Action action) const;
  void expect_end(const Before& before, bool certain);
  bool take_end(const Event& event, const Contact& contact);
  void begin(const Event& event, const Contact& contact);
  void end(const Event& event, const Contact& contact);
  /// What the last contacts of two bodies say, if they were within the Zeno intervals of these.
  struct Followed {
    double passed = std::numeric_limits<double>::infinity();  ///< time since the later one
    double pressure = 0.0;  ///< acceleration that pressed one of them upon its partner
  };
  /// Returns what certainly holds of the last contacts of the two, or what may hold.
  Followed followed_by(const Contact& contact, bool certainly) const;
  /// Returns true if the begin must be marked as repeated, or if it may.
  bool is_repeated(const Event& begin, const Contact& contact, bool certainly) const;
  /// Returns limits of the acceleration that presses the two upon each other, as the world may know it.
  Range relative_accelerations(const Contact& contact) const;
  void note_begin(const Contact& contact);
  std::vector<Ball> ways_until(double time) const;
  bool may_meet(const Ball& a, const Ball& b) const;
  bool any_reported(const Contact& contact) const;
  void check_pair(Contact contact, double until);
  void check_contact(const Contact& contact, double until);
  void check_approaches(const Contact& contact, ReportedState& state, double until);
  void check_parted(const Contact& contact, ReportedState& state, double until);
  void check_free(const Contact& contact, ReportedState& state, double from, double until) const;
  std::optional<double> reaches(const Contact& contact, LevelCrossing overlap, double level, double from,
                                double until) const;
  bool is_watched(const Contact& contact, const ReportedState& state) const;
  void look_again(const Contact& contact);

  ContactRule rule_;
  Truth& truth_;
  double rounding_;  ///< rounding error of a position or a gap
  double slack_;
  Space space_;
  PairTable<ReportedState> pairs_;
  std::array<PairTable<ReportedState>, sensor_distances.size()> sensed_;
  std::vector<std::array<ReportedState, wall_count>> walls_;
  std::vector<End> ends_;
};

}  // namespace kinesphere::stream
