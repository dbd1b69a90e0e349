// Which bodies are in an island together, in a part of a phase, and what each island begins with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/beside.hpp"
#include "engine/bodies.hpp"
#include "kinesphere/event.hpp"
#include "window/agenda.hpp"

namespace kinesphere {

/// The bodies of an island, and what came of them in the last attempt.
struct Group {
  std::uint32_t own = 0;        ///< its place
  std::uint32_t joined_to = 0;  ///< the same, unless it has been joined to another one
  bool again = true;            ///< it has to run, or run again
  bool attempted = false;       ///< and not taken back
  bool has_run = false;
  bool kicks_are_compared = false;
  bool failed = false;
  bool is_news = true;  ///< until whoever tells other processes of groups sets it to false
  std::uint32_t attempts = 0;
  /// Of the bodies that it has counted on, those that others had kicked before.
  std::uint32_t superseded = 0;
  Stretch members{};  ///< of the lists of Groups
  Stretch due{};
  Outcome outcome{};
  std::vector<std::uint32_t> unsettled{};
  std::vector<Event> pending{};

  bool joined() const { return joined_to != own; }
};

/// Lists of bodies and of due pairs, in which each group has a stretch. A group that grows moves to the end
/// of them.
class Groups {
 public:
  /// A part begins: bodies joined by due pairs are in a group.
  void form(std::span<const HotPair> due, const Bodies& bodies, std::vector<Sea::Place>& places);
  /// It ends.
  void clear();

  /// Those that have been joined to others, too. A group is joined only to one with a smaller place.
  std::span<Group> all() { return std::span(groups_).first(count_); }
  std::span<const Group> all() const { return std::span(groups_).first(count_); }
  Group& operator[](std::uint32_t own) { return groups_[own]; }
  const Group& operator[](std::uint32_t own) const { return groups_[own]; }
  std::size_t size() const { return count_; }
  std::span<const std::uint32_t> members_of(const Group& group) const { return group.members.of(members_); }
  std::span<const HotPair> due_of(const Group& group) const { return group.due.of(due_); }
  /// That it is joined to, in the end.
  Group& root_of(std::uint32_t own);
  /// Nobody's bodies have none.
  Group* group_of(std::uint32_t number);
  /// How many bodies are in groups: the places where they are kept are less than this.
  std::size_t kept() const { return kept_; }

  // Needs a group that is not joined to another one.
  Group& add();
  void add_member(Group& group, std::uint32_t number);
  void add_due(Group& group, const HotPair& pair);
  /// Two different ones become one, which is returned.
  Group& join(Group& one, Group& other);

 private:
  void join_bodies(std::span<const HotPair> due);
  void deal_out(std::span<const HotPair> due);
  std::uint32_t place_of(std::uint32_t number);
  std::uint32_t top_of(std::uint32_t place);
  std::uint32_t mover_of(const HotPair& pair) const;

  std::vector<Sea::Place>* places_ = nullptr;  ///< by body
  const Bodies* bodies_ = nullptr;
  std::vector<Group> groups_;  ///< more than there are in this part, perhaps
  std::size_t count_ = 0;      ///< of those that there are
  std::size_t kept_ = 0;
  std::vector<std::uint32_t> members_;
  std::vector<HotPair> due_;
  // While groups are formed: by place.
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> up_;  ///< one of the same group, or itself
};

}  // namespace kinesphere
