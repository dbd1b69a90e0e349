// The event tree, compared with a plain list of candidates that gets equal calls.
#include "research/rivals/event_driven/event_tree.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::event_tree_test {
namespace {

constexpr std::uint64_t seed = 3104;
constexpr std::uint32_t bodies = 12;

bool concerns(const Candidate& candidate, std::uint32_t body) {
  return candidate.first == body || candidate.second == body;
}

class MirroredTree {
 public:
  MirroredTree() { tree_.resize(bodies); }

  void insert(const Candidate& candidate) {
    if (std::find(list_.begin(), list_.end(), candidate) != list_.end()) return;
    tree_.insert(candidate);
    list_.push_back(candidate);
    ++insertions_;
    largest_ = std::max(largest_, list_.size());
  }
  void pop() {
    if (list_.empty()) return;
    const auto least = std::min_element(list_.begin(), list_.end());
    ASSERT_EQ(tree_.earliest(), *least);
    ASSERT_EQ(tree_.pop(), *least);
    list_.erase(least);
  }
  template <class Unwanted>
  void remove_if(std::uint32_t body, Unwanted unwanted) {
    tree_.remove_if(body, unwanted);
    removals_ += std::erase_if(
        list_, [&](const Candidate& candidate) { return concerns(candidate, body) && unwanted(candidate); });
  }

  void expect_same() const {
    ASSERT_EQ(tree_.size(), list_.size());
    ASSERT_EQ(tree_.empty(), list_.empty());
    ASSERT_EQ(tree_.insertions(), insertions_);
    ASSERT_EQ(tree_.removals(), removals_);
    ASSERT_EQ(tree_.largest_size(), largest_);
    for (std::uint32_t body = 0; body < bodies; ++body) {
      std::vector<Candidate> found;
      tree_.for_each(body, [&](const Candidate& candidate) { found.push_back(candidate); });
      std::vector<Candidate> expected;
      for (const Candidate& candidate : list_)
        if (concerns(candidate, body)) expected.push_back(candidate);
      std::sort(found.begin(), found.end());
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(found, expected) << "body " << body;
    }
  }

 private:
  EventTree tree_;
  std::vector<Candidate> list_;
  std::uint64_t insertions_ = 0;
  std::uint64_t removals_ = 0;
  std::size_t largest_ = 0;
};

/// Returns a candidate with one of a few times, so that many are equal.
Candidate random_candidate(Random& random) {
  const auto kind = static_cast<CandidateKind>(random.bits() % 4);
  const auto first = static_cast<std::uint32_t>(random.bits() % bodies);
  auto second = first;
  if (kind == CandidateKind::colliding)
    second += static_cast<std::uint32_t>(random.bits() % (bodies - first));
  const bool overlap = kind == CandidateKind::entering || kind == CandidateKind::leaving;
  return {static_cast<double>(random.bits() % 8), kind, first, second,
          static_cast<std::uint8_t>(overlap ? random.bits() % 6 : 0)};
}

TEST(EventTree, answers_like_a_plain_list) {
  Random random = Random::at(seed, 0, 0);
  MirroredTree tree;
  for (int action = 0; action < 20000; ++action) {
    const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
    switch (random.bits() % 16) {
      case 0:
        tree.remove_if(body, [](const Candidate&) { return true; });
        break;
      case 1:
        tree.remove_if(body, [](const Candidate& c) { return c.kind == CandidateKind::colliding; });
        break;
      case 2:
      case 3:
        tree.pop();
        break;
      default:
        tree.insert(random_candidate(random));
    }
    tree.expect_same();
    if (HasFatalFailure()) FAIL() << "seed " << seed << ", action " << action;
  }
}

RC_GTEST_PROP(EventTreeProperty, gives_candidates_in_order_of_time_kind_and_bodies,
              (const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>>& drawn)) {
  std::vector<Candidate> list;
  EventTree tree;
  tree.resize(bodies);
  for (const auto& [time, kind, body] : drawn) {
    const std::uint32_t number = body % bodies;
    const Candidate candidate{static_cast<double>(time % 3), static_cast<CandidateKind>(kind % 3), number,
                              number};
    if (std::find(list.begin(), list.end(), candidate) != list.end()) continue;
    list.push_back(candidate);
    tree.insert(candidate);
  }
  std::sort(list.begin(), list.end());
  for (const Candidate& expected : list) RC_ASSERT(tree.pop() == expected);
  RC_ASSERT(tree.empty());
}

TEST(EventTree, holds_a_pair_under_both_bodies) {
  EventTree tree;
  tree.resize(3);
  tree.insert({1.0, CandidateKind::colliding, 0, 2});
  tree.insert({2.0, CandidateKind::resetting, 2, 2});
  tree.remove_all(0);
  ASSERT_EQ(tree.size(), 1u);
  EXPECT_EQ(tree.earliest().kind, CandidateKind::resetting);
  tree.remove_all(2);
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.removals(), 2u);
}

}  // namespace
}  // namespace kinesphere::event_tree_test
