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

#include "engine/groups.hpp"
#include "engine/island.hpp"
#include "engine/meetings.hpp"
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
  std::span<const BodyKick> kicks_of(const Group& group) const {
    return of(group, &Beside::kicks, &Outcome::kicks);
  }
  std::span<const HotPair> left_of(const Group& group) const {
    return of(group, &Beside::left, &Outcome::left);
  }
  std::span<const CountedOn> counted_on_of(const Group& group) const {
    return of(group, &Beside::counted_on, &Outcome::counted_on);
  }
  std::span<const Turn> turned_of(const Group& group) const {
    return of(group, &Beside::turned, &Outcome::turned);
  }
  /// These bodies have to be in one island.
  void join_bodies(std::span<const std::uint32_t> numbers);
  /// Bodies have become known meanwhile, and may bring these along.
  void add(const Beginning& more);
  /// A body that another process kicks: take_meetings() tells which islands here may meet it.
  void add_foreign_kick(const BodyKick& kick) { foreign_kicks_.push_back(kick); }
  /// Groups, and kicked bodies of others that they may meet.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_meetings() {
    return std::exchange(meetings_, {});
  }
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
    sea_.most_kicks = no_limit;
    least_due_ = 8;
  }

 private:
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

  /// A pair of which two groups have one body each, which is due when the part is over: as these attempts
  /// have it.
  struct Late {
    std::uint32_t one;
    std::uint32_t attempt_of_one;
    std::uint32_t other;
    std::uint32_t attempt_of_other;
    HotPair pair;
  };

  /// Not after leave_nothing().
  bool may_leave_some() const { return sea_.most_kicks < no_limit; }
  template <class T>
  std::span<const T> of(const Group& group, Listing<T> Beside::*list, Stretch Outcome::*stretch) const {
    if (!group.attempted) return {};
    return (group.outcome.*stretch).of((crew_[group.outcome.worker].beside().*list).all());
  }
  bool are_worth_it() const;
  template <class FindAgain>
  bool go_through(FindAgain find_again);
  bool attempt_found();
  void forget_taken_back();
  void choose_part();
  void pause(bool done);
  void attempt(std::uint32_t own, std::uint32_t worker);
  void keep(const Group& group);
  void take_back(Group& group);
  void set_out_again(const Turn& turn);
  void add_member(Group& group, std::uint32_t number);
  void join(Group& one, Group& other);
  bool join_claims();
  bool join_counted_on();
  bool join_kicks();
  void finish(const Group& group, bool is_counted, std::vector<const Told*>& told);
  void note_late(const Group& one, const BodyKick& kick, const Group& other, const BodyKick& other_kick,
                 double until);
  void finish_late();
  void finish(std::vector<const Told*>& told);
  void register_kicks();

  Tables& tables_;
  Island& everybody_;
  Shift& shift_;
  Answerer* answerer_;
  std::vector<Island> crew_;  ///< by worker
  Sea sea_;
  double begin_ = 0.0;
  std::size_t least_due_ = 128;  ///< in a part: fewer are not worth the while
  std::size_t most_due_ = 0;     ///< in a part
  std::size_t first_runs_ = 0;   ///< pairs that were due in groups when these first ran in this part
  std::size_t repeats_ = 0;      ///< the same when they ran again
  int pause_ = 0;                ///< so many phases without islands
  int paused_ = 0;               ///< that are still to come
  Groups groups_;
  std::vector<std::uint32_t> again_;
  // Groups whose kicks have been held against all others, and those that have run since.
  std::vector<std::uint32_t> compared_;
  std::vector<std::uint32_t> uncompared_;
  std::vector<HotPair> due_;
  std::vector<HotPair> left_;
  std::size_t kicks_kept_ = 0;  ///< in the lists, when these were looked through
  std::optional<Error> failure_;
  std::exception_ptr thrown_;  ///< by a mover that was to go back
  std::vector<BodyKick> foreign_kicks_;
  std::size_t compared_foreign_kicks_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings_;
  std::vector<Late> late_;
};

template <class FindAgain>
bool Islands::go_through(FindAgain find_again) {
  for (;;) {
    again_.clear();
    find_again();
    if (again_.empty() && compared_foreign_kicks_ == foreign_kicks_.size()) return true;
    if (!attempt_found()) return false;
    if (!join_claims()) join_kicks();
  }
}

}  // namespace kinesphere
