// Groups have the bodies and the pairs that a plain list of sets has, however they are joined.
#include "engine/groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::groups_test {
namespace {

constexpr std::uint64_t seed = 4811;
constexpr std::uint32_t count = 60;

Bodies some_bodies() {
  Bodies bodies{WorldDefinition{}};
  for (std::uint32_t number = 0; number < count; ++number) bodies.add({.radius = 0.1});
  return bodies;
}

std::uint32_t draw(Random& random, std::uint32_t below) {
  return static_cast<std::uint32_t>(random.uniform() * below);
}

/// Sets of bodies, each with the pairs that are due in it, by the time of each.
class PlainGroups {
 public:
  void add(const HotPair& pair) {
    std::set<std::uint32_t> bodies{pair.first};
    if (pair.has_second()) bodies.insert(pair.second);
    join(bodies);
    pairs_.push_back(pair);
  }
  void join(const std::set<std::uint32_t>& bodies) {
    std::set<std::uint32_t> all = bodies;
    std::erase_if(sets_, [&](const std::set<std::uint32_t>& one) {
      const bool meets =
          std::any_of(one.begin(), one.end(), [&](std::uint32_t number) { return bodies.contains(number); });
      if (meets) all.insert(one.begin(), one.end());
      return meets;
    });
    sets_.push_back(all);
  }

  const std::vector<std::set<std::uint32_t>>& sets() const { return sets_; }
  std::multiset<double> times_in(const std::set<std::uint32_t>& bodies) const {
    std::multiset<double> times;
    for (const HotPair& pair : pairs_)
      if (bodies.contains(pair.first)) times.insert(pair.time);
    return times;
  }

 private:
  std::vector<std::set<std::uint32_t>> sets_;
  std::vector<HotPair> pairs_;
};

void expect_same(Groups& groups, const PlainGroups& plain, const std::vector<Sea::Place>& places) {
  std::size_t roots = 0;
  std::size_t bodies = 0;
  std::set<std::uint32_t> kept;
  for (const Group& group : groups.all()) {
    ASSERT_EQ(group.joined(), groups.root_of(group.own).own != group.own);
    if (group.joined()) continue;
    ++roots;
    const auto members = groups.members_of(group);
    const std::set<std::uint32_t> set(members.begin(), members.end());
    ASSERT_EQ(set.size(), members.size()) << "each of them once";
    ASSERT_EQ(std::count(plain.sets().begin(), plain.sets().end(), set), 1);
    std::multiset<double> times;
    for (const HotPair& pair : groups.due_of(group)) times.insert(pair.time);
    ASSERT_EQ(times, plain.times_in(set));
    for (const std::uint32_t number : members) {
      ASSERT_EQ(places[number].island, group.own);
      ASSERT_EQ(groups.group_of(number), &group);
      ASSERT_LT(places[number].kept, groups.kept());
      kept.insert(places[number].kept);
    }
    bodies += members.size();
  }
  ASSERT_EQ(roots, plain.sets().size());
  ASSERT_EQ(kept.size(), bodies) << "each is kept in a place of its own";
  ASSERT_EQ(groups.kept(), bodies);
}

TEST(Groups, AreThoseOfAPlainListOfSets) {
  SCOPED_TRACE(seed);
  const Bodies bodies = some_bodies();
  Groups groups;
  std::vector<Sea::Place> places;
  for (std::uint64_t part = 0; part < 400; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    PlainGroups plain;
    std::vector<HotPair> due;
    const auto pair = [&] {
      const std::uint32_t first = draw(random, count);
      const std::uint32_t second = draw(random, count);
      return HotPair{random.uniform(), first, second == first ? HotPair::walls : second, 0, 0};
    };
    for (std::uint32_t k = draw(random, count); k > 0; --k) {
      due.push_back(pair());
      plain.add(due.back());
    }
    groups.form(due, bodies, places);
    ASSERT_NO_FATAL_FAILURE(expect_same(groups, plain, places));
    for (std::uint32_t k = draw(random, 20); k > 0; --k) {
      const std::uint32_t number = draw(random, count);
      Group* const theirs = groups.group_of(number);
      Group& ours = groups.size() > 0
                        ? groups.root_of(draw(random, static_cast<std::uint32_t>(groups.size())))
                        : groups.add();
      if (ours.members.size() == 0) {
        // Of a group that has just been made.
        if (theirs == nullptr) groups.add_member(ours, number);
        plain.join({number});
      } else {
        const std::uint32_t member = groups.members_of(ours).front();
        plain.join({member, number});
        if (theirs == nullptr) {
          groups.add_member(ours, number);
        } else if (theirs != &ours) {
          Group& both = groups.join(ours, *theirs);
          ASSERT_EQ(both.own, std::min(ours.own, theirs->own));
        }
        HotPair more = pair();
        more.first = member;
        more.second = HotPair::walls;
        groups.add_due(groups.root_of(ours.own), more);
        plain.add(more);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same(groups, plain, places));
    }
    groups.clear();
    ASSERT_EQ(groups.size(), 0u);
    for (const Sea::Place& place : places) {
      ASSERT_EQ(place.island, Sea::nobody);
      ASSERT_EQ(place.kept, Sea::none);
    }
  }
}

TEST(Groups, AFixedBodyJoinsNobody) {
  Bodies bodies = some_bodies();
  bodies.fix(7, Ball{{}, 1.0});
  Groups groups;
  std::vector<Sea::Place> places;
  groups.form(std::vector<HotPair>{{0.5, 3, 7, 0, 0}, {0.6, 7, 9, 0, 0}, {0.7, 3, HotPair::walls, 0, 0}},
              bodies, places);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.group_of(7), nullptr);
  EXPECT_NE(groups.group_of(3), groups.group_of(9));
  EXPECT_EQ(groups.due_of(*groups.group_of(3)).size(), 2u);
  EXPECT_EQ(groups.due_of(*groups.group_of(9)).size(), 1u);
}

}  // namespace
}  // namespace kinesphere::groups_test
