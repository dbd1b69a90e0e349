// Clusters have the bodies and the certificates of a plain list of sets, in whatever order they are joined.
#include "speculation/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::clusters_test {
namespace {

constexpr std::uint64_t seed = 4811;
constexpr std::uint32_t count = 60;

Bodies some_bodies() {
  Bodies bodies{WorldDefinition{}};
  for (std::uint32_t number = 0; number < count; ++number) bodies.add({.radius = 0.1}, 0.0);
  return bodies;
}

std::uint32_t draw(Random& random, std::uint32_t below) {
  return static_cast<std::uint32_t>(random.uniform() * below);
}

/// Sets of bodies, each with its due certificates in order of time.
class PlainGroups {
 public:
  void add(const PairCertificate& pair) {
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
    for (const PairCertificate& pair : pairs_)
      if (bodies.contains(pair.first)) times.insert(pair.failure_time);
    return times;
  }

 private:
  std::vector<std::set<std::uint32_t>> sets_;
  std::vector<PairCertificate> pairs_;
};

void expect_same(Clusters& groups, const PlainGroups& plain,
                 const std::vector<BatchState::BodySlot>& places) {
  std::size_t roots = 0;
  std::size_t bodies = 0;
  std::set<std::uint32_t> checkpoint;
  for (const Cluster& group : groups.all()) {
    ASSERT_EQ(group.is_merged(), groups.root_of(group.index).index != group.index);
    if (group.is_merged()) continue;
    ++roots;
    const auto members = groups.members_of(group);
    const std::set<std::uint32_t> set(members.begin(), members.end());
    ASSERT_EQ(set.size(), members.size()) << "each of them once";
    ASSERT_EQ(std::count(plain.sets().begin(), plain.sets().end(), set), 1);
    std::multiset<double> times;
    for (const PairCertificate& pair : groups.due_of(group)) times.insert(pair.failure_time);
    ASSERT_EQ(times, plain.times_in(set));
    for (const std::uint32_t number : members) {
      ASSERT_EQ(places[number].cluster, group.index);
      ASSERT_EQ(groups.cluster_of(number), &group);
      ASSERT_LT(places[number].checkpoint, groups.checkpoint_count());
      checkpoint.insert(places[number].checkpoint);
    }
    bodies += members.size();
  }
  ASSERT_EQ(roots, plain.sets().size());
  ASSERT_EQ(checkpoint.size(), bodies) << "each is kept in a place of its own";
  ASSERT_EQ(groups.checkpoint_count(), bodies);
}

TEST(Clusters, AreThoseOfAPlainListOfSets) {
  SCOPED_TRACE(seed);
  const Bodies bodies = some_bodies();
  Clusters groups;
  std::vector<BatchState::BodySlot> places;
  for (std::uint64_t part = 0; part < 400; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    PlainGroups plain;
    std::vector<PairCertificate> due;
    const auto pair = [&] {
      const std::uint32_t first = draw(random, count);
      const std::uint32_t second = draw(random, count);
      return PairCertificate{random.uniform(), first, second == first ? PairCertificate::walls : second, 0,
                             0};
    };
    for (std::uint32_t k = draw(random, count); k > 0; --k) {
      due.push_back(pair());
      plain.add(due.back());
    }
    groups.form(due, bodies, places);
    ASSERT_NO_FATAL_FAILURE(expect_same(groups, plain, places));
    for (std::uint32_t k = draw(random, 20); k > 0; --k) {
      const std::uint32_t number = draw(random, count);
      Cluster* const theirs = groups.cluster_of(number);
      Cluster& ours = groups.size() > 0
                          ? groups.root_of(draw(random, static_cast<std::uint32_t>(groups.size())))
                          : groups.add();
      if (ours.members.size() == 0) {
        // The cluster has just been made.
        if (theirs == nullptr) groups.add_member(ours, number);
        plain.join({number});
      } else {
        const std::uint32_t member = groups.members_of(ours).front();
        plain.join({member, number});
        if (theirs == nullptr) {
          groups.add_member(ours, number);
        } else if (theirs != &ours) {
          Cluster& both = groups.merge(ours, *theirs);
          ASSERT_EQ(both.index, std::min(ours.index, theirs->index));
        }
        PairCertificate more = pair();
        more.first = member;
        more.second = PairCertificate::walls;
        groups.add_due(groups.root_of(ours.index), more);
        plain.add(more);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same(groups, plain, places));
    }
    groups.clear();
    ASSERT_EQ(groups.size(), 0u);
    for (const BatchState::BodySlot& place : places) {
      ASSERT_EQ(place.cluster, BatchState::unassigned);
      ASSERT_EQ(place.checkpoint, BatchState::none);
    }
  }
}

TEST(Clusters, AFixedBodyJoinsNobody) {
  Bodies bodies = some_bodies();
  bodies.give_shape(7, Ball{{}, 1.0}, false);
  Clusters groups;
  std::vector<BatchState::BodySlot> places;
  groups.form(
      std::vector<PairCertificate>{
          {0.5, 3, 7, 0, 0}, {0.6, 7, 9, 0, 0}, {0.7, 3, PairCertificate::walls, 0, 0}},
      bodies, places);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.cluster_of(7), nullptr);
  EXPECT_NE(groups.cluster_of(3), groups.cluster_of(9));
  EXPECT_EQ(groups.due_of(*groups.cluster_of(3)).size(), 2u);
  EXPECT_EQ(groups.due_of(*groups.cluster_of(9)).size(), 1u);
}

}  // namespace
}  // namespace kinesphere::clusters_test
