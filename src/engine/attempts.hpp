// Islands that run: each thread has one, which runs for one group after the other, and the lists of what came
// of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/answerer.hpp"
#include "engine/beside.hpp"
#include "engine/groups.hpp"
#include "engine/island.hpp"

namespace kinesphere {

class Attempts {
 public:
  /// One island for each worker. `answerer` may be null: then events get no answer.
  Attempts(Tables& tables, const Island& everybody, std::size_t workers, const Probe& probe,
           Answerer* answerer);

  /// A part begins.
  void clear();
  /// Runs the group's island from where the part begins, as far as islands go, or to where it claims a body
  /// that is not its own. Throws what a callback throws. Several threads may do that at the same time, each
  /// as another worker, for different groups.
  void run(Group& group, std::span<const HotPair> due, Sea& sea, std::uint32_t worker);
  /// Of a group whose last attempt failed: none, where it had to stop.
  const std::optional<Error>& failure_of(const Group& group) const { return lists_of(group).failure; }

  // What came of a group in the last attempt; nothing, if it has been taken back.
  std::span<const Told> told_by(const Group& group) const { return of(group, &Beside::told, &Outcome::told); }
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
  /// Also of one that has been taken back.
  std::span<const std::uint32_t> claims_of(const Group& group) const {
    return group.outcome.claims.of(lists_of(group).claims.all());
  }
  /// Of one that has been attempted.
  const Work& work_of(const Group& group) const { return lists_of(group).works[group.outcome.work]; }

  /// Lists forget what groups have done that were taken back since, when that is most of what they have.
  void forget_taken_back(Groups& groups, Sea& sea);

 private:
  struct Runner {
    Island island;
    Beside beside{};
  };

  static Outcome end(Runner& runner, std::uint32_t worker);
  Result<void> go_on(Runner& runner);
  Result<void> answer(Runner& runner, const Event& event);
  const Beside& lists_of(const Group& group) const { return runners_[group.outcome.worker].beside; }
  template <class T>
  std::span<const T> of(const Group& group, Listing<T> Beside::*list, Stretch Outcome::*stretch) const {
    if (!group.attempted) return {};
    return (group.outcome.*stretch).of((lists_of(group).*list).all());
  }

  Answerer* answerer_;
  std::vector<Runner> runners_;  ///< by worker
  std::size_t kicks_kept_ = 0;   ///< in the lists, when these were looked through
};

}  // namespace kinesphere
