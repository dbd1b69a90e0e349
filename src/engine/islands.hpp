// The islands of a part of a phase: which they are, that they are run, by several threads, and what comes of
// it.
//
// A phase begins when windows have started, and ends when the next ones do; a part of it ends when so many
// pairs have been due. Bodies joined by hot pairs that are due in a part are an island. Islands run side by
// side, each as if there was nobody else (island.hpp). That is right as long as no kicked body of one may
// meet a body of another: so
//   - an island that claims a body stops; it is joined with the island that has the body, if there is one,
//     and they run again, from where the part began;
//   - when none claims any more, the capsules of all kicked bodies are held against each other; islands of
//     two that may meet are joined, and run again.
// What is left is what one island with all bodies would have done, in another order: a body's reports, facts
// and events depend on its own island alone. So what comes out depends neither on threads, nor on who ran
// what, nor on where parts end. Events are told in the order of their times, rounds and kinds, when the part
// is over.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "engine/island.hpp"
#include "parallel/crew.hpp"

namespace kinesphere {

class Islands {
 public:
  /// `answerer` may be null: then events get no answer.
  Islands(Tables& tables, Island& everybody, Shift& shift, const Probe& probe, Answerer* answerer);

  /// From now to `until` or, if that comes first, to the end of a part of the phase, where all has happened
  /// but what is due then. Appends the events. False, and nothing has happened, if there are no islands worth
  /// it, or if something has failed in one of them: that comes again when events are answered one by one.
  /// Needs a world in which nothing is left to be settled.
  bool run(double until, std::deque<Event>& events);

 private:
  /// Some bodies, and what came of them in the last attempt.
  struct Group {
    std::vector<std::uint32_t> members;  ///< their places in kept_
    std::vector<HotPair> due;
    std::uint32_t own = 0;        ///< its place
    std::uint32_t joined_to = 0;  ///< the same, unless it has been joined to another one
    bool again = true;            ///< it has to run, or run again
    bool attempted = false;
    bool failed = false;
    Counters counters{};
    Kicks settled{};
    std::vector<HotPair> left{};
    std::vector<Told> told{};
    std::vector<BodyKick> kicks{};
    std::vector<std::uint32_t> claims{};
    std::vector<std::uint32_t> counted_on{};
    std::vector<std::pair<BodyId, Departure>> turned{};

    bool joined() const { return joined_to != own; }
  };
  struct OwnKick {
    std::uint32_t own;  ///< the group whose it is
    const BodyKick* kick;
  };
  /// A body as it was when the part began.
  struct Kept {
    std::uint32_t number = 0;
    bool is_kept = false;
    Bodies::Kept body{};
    ContactBook::Kept contacts{};
  };

  void form(std::span<const HotPair> due);
  Group& new_group();
  bool are_worth_it() const;
  bool attempt_all();
  void choose_part();
  void attempt(std::uint32_t own, Island& island);
  void take_back(Group& group);
  bool join_claims();
  bool join_kicks();
  std::vector<OwnKick> kicks() const;
  RoomyBound bound_of(const BodyKick& kick) const;
  bool may_meet(const BodyKick& a, const BodyKick& b) const;
  std::uint32_t root_of(std::uint32_t own) const;
  void join(std::uint32_t one, std::uint32_t other);
  void finish(std::deque<Event>& events);
  void register_kicks();
  void leave();

  Tables& tables_;
  Island& everybody_;
  Shift& shift_;
  Answerer* answerer_;
  std::vector<Island> crew_;  ///< by worker
  Sea sea_;
  double begin_ = 0.0;
  std::size_t most_due_ = 0;   ///< in a part
  std::size_t attempts_ = 0;   ///< of groups in this part
  std::vector<Group> groups_;  ///< more than there are in this part, perhaps
  std::size_t count_ = 0;      ///< of those that there are
  std::vector<std::uint32_t> again_;
  std::vector<Kept> kept_;
};

}  // namespace kinesphere
