// The islands of a part of a phase: which they are, that they are run, by several threads, and what comes of
// it.
//
// A phase begins when windows have started, and ends when the next ones do; a part of it ends when so many
// pairs have been due. Bodies joined by hot pairs that are due in a part are an island. Islands run side by
// side, each as if there was nobody else (island.hpp). That is right as long as no kicked body of one may
// meet a body of another: so
//   - an island that claims a body stops; it is joined with the island that has the body, if there is one,
//     and they run again, from where the part began;
//   - an island that counts on a body is joined with the one that has reported it too early, if there is one;
//   - when none claims any more, the capsules of all kicked bodies are held against each other; islands of
//     two that may meet in the part are joined, and run again; two that may meet later become a hot pair, as
//     if one had found the other.
// What is left is what one island with all bodies would have done, in another order: a body's reports, facts
// and events depend on its own island alone. So what comes out depends neither on threads, nor on who ran
// what, nor on where parts end. Events are told in the order of their times, rounds and kinds, when the part
// is over.
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/attempts.hpp"
#include "engine/groups.hpp"
#include "engine/island.hpp"
#include "engine/kick_comparison.hpp"
#include "engine/late_pairs.hpp"
#include "engine/part_size.hpp"
#include "parallel/crew.hpp"

namespace kinesphere {

/// What islands begin with: pairs that are due, bodies that have to be settled before anything else, and
/// events that are known already.
struct Beginning {
  std::vector<HotPair> due{};
  std::vector<std::uint32_t> unsettled{};
  std::vector<Event> pending{};
};

class Islands {
 public:
  /// `answerer` may be null: then events get no answer.
  Islands(Tables& tables, Island& everybody, Shift& shift, const Probe& probe, Answerer* answerer);

  /// From now to `until` or, if that comes first, to the end of a part of the phase, where all has happened
  /// but what is due then. Appends the events. False, and nothing has happened, if there are no islands worth
  /// it, if they run again too often or have done so before, or if something has failed in one of them: that
  /// comes again when events are answered one by one. Needs a world in which nothing is left to be settled.
  /// Throws what a mover threw that was to set a body back, when all others have been set back.
  bool run(double until, std::deque<Event>& events);

  // The same in steps, for a process that has a part of the bodies and learns from others in between which
  // islands are to be joined. The part begins with what everybody() has not settled, too, and what is to be
  // told.

  /// Takes what is due from now to `until`, or to the end of a part of the phase, or to `latest`: where that
  /// is.
  double take_due(double until, double latest);
  /// The part ends at `stop`, no later than take_due() said. Forms islands.
  void open(double stop);
  /// Runs those islands that have to run and of which is_ready(group) is true; joins those that claim bodies
  /// or meet, and runs them again, until no more have to. False when one has failed.
  template <class IsReady>
  bool attempt_all(IsReady is_ready) {
    return go_through([&] {
      for (const Group& group : groups_.all())
        if (group.again && is_ready(group)) again_.push_back(group.own);
    });
  }
  /// Of the attempt that has failed.
  const std::optional<Error>& failure() const { return failure_; }
  /// Groups are joined only to others with smaller places.
  std::span<Group> groups() { return groups_.all(); }
  /// Nobody's bodies have none.
  Group* group_of(std::uint32_t number) { return groups_.group_of(number); }
  std::span<const std::uint32_t> members_of(const Group& group) const { return groups_.members_of(group); }
  std::span<const HotPair> due_of(const Group& group) const { return groups_.due_of(group); }
  // What came of a group in the last attempt; nothing, if it has been taken back.
  std::span<const BodyKick> kicks_of(const Group& group) const { return attempts_.kicks_of(group); }
  std::span<const HotPair> left_of(const Group& group) const { return attempts_.left_of(group); }
  std::span<const CountedOn> counted_on_of(const Group& group) const {
    return attempts_.counted_on_of(group);
  }
  std::span<const Turn> turned_of(const Group& group) const { return attempts_.turned_of(group); }
  /// These bodies have to be in one island.
  void join_bodies(std::span<const std::uint32_t> numbers);
  /// Bodies have become known meanwhile, and may bring these along.
  void add(const Beginning& more);
  /// A body that another process kicks: take_meetings() tells which islands here may meet it.
  void add_foreign_kick(const BodyKick& kick) { comparison_.add_foreign(kick); }
  /// Groups, and kicked bodies of others that they may meet.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_meetings() { return comparison_.take_meetings(); }
  /// The island has to run again, from where the part began.
  void run_again(std::uint32_t own) {
    take_back(groups_[own]);
    groups_[own].again = true;
  }
  /// Whether that is before the part ends.
  bool comes(double time) const { return sea_.comes(time); }
  /// Null for a body that is as it was when the part began.
  const Kept* kept(std::uint32_t number) const { return sea_.kept_of(number); }
  /// All islands have run: what came of the groups becomes what came of everybody. Of those of which
  /// is_counted(group) is true, events are returned, in their order, and work is counted.
  template <class IsCounted>
  std::vector<const Told*> finish(IsCounted is_counted) {
    std::vector<const Told*> told;
    for (const Group& group : groups_.all())
      if (!group.joined() && group.attempted) finish(group, is_counted(group), told);
    finish(told);
    return told;
  }
  /// Nothing has happened.
  void take_back();
  /// Ends the part.
  void close();
  /// All is done by islands, however long they take and however few pairs are due.
  void leave_nothing() {
    sea_.most_kicks = std::numeric_limits<std::size_t>::max();
    size_.leave_nothing();
  }

 private:
  bool are_worth_it() const;
  template <class FindAgain>
  bool go_through(FindAgain find_again);
  bool attempt_found();
  void keep(const Group& group);
  void take_back(Group& group);
  void set_out_again(const Turn& turn);
  void add_member(Group& group, std::uint32_t number);
  void join(Group& one, Group& other);
  bool join_claims();
  bool join_counted_on();
  HotPair pair_of(const BodyKick& kick, const BodyKick& other, double until) const;
  bool join_kicks();
  void finish(const Group& group, bool is_counted, std::vector<const Told*>& told);
  void finish(std::vector<const Told*>& told);
  void register_kicks();

  Tables& tables_;
  Island& everybody_;
  Shift& shift_;
  Answerer* answerer_;
  PartSize size_;
  // Of the part.
  Sea sea_;
  Groups groups_;
  Attempts attempts_;
  KickComparison comparison_;
  LatePairs late_;
  std::vector<HotPair> due_;
  std::vector<HotPair> left_;         ///< that go back into everybody's agenda
  std::vector<std::uint32_t> again_;  ///< groups that run next
  std::optional<Error> failure_;
  std::exception_ptr thrown_;  ///< by a mover that was to go back
};

template <class FindAgain>
bool Islands::go_through(FindAgain find_again) {
  for (;;) {
    again_.clear();
    find_again();
    if (again_.empty() && !comparison_.has_new_foreign()) return true;
    if (!attempt_found()) return false;
    if (!join_claims()) join_kicks();
  }
}

}  // namespace kinesphere
