// The agenda gives pairs in the order of a sorted list, whatever is added and becomes void on the way.
#include "window/agenda.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"
#include "support/read_back.hpp"

namespace kinesphere::agenda_test {
namespace {

constexpr std::uint64_t seed = 4201;
constexpr std::uint32_t bodies = 40;

auto key(const HotPair& pair) {
  return std::tie(pair.time, pair.first, pair.second, pair.first_stamp, pair.second_stamp);
}
/// By their times, then their numbers.
bool comes_before(const HotPair& a, const HotPair& b) {
  return std::tie(a.time, a.first, a.second) < std::tie(b.time, b.first, b.second);
}
bool same(const HotPair& a, const HotPair& b) { return key(a) == key(b); }

/// Times from `now` on.
struct Times {
  const char* name;
  double (*draw)(Random&, double now);

  friend std::ostream& operator<<(std::ostream& out, const Times& times) { return out << times.name; }
};

const std::vector<Times> all_times{
    {"even", [](Random& random, double now) { return now + random.uniform(); }},
    {"all_now", [](Random&, double now) { return now; }},
    {"few_times",
     [](Random& random, double now) { return std::floor(now) + static_cast<double>(random.bits() % 4); }},
    {"of_all_sizes", [](Random& random, double now) { return now + log_uniform(random, -60, 60); }},
    {"one_far_ahead",
     [](Random& random, double now) { return random.bits() % 50 == 0 ? 1e300 : now + random.uniform(); }},
    {"never_for_some",
     [](Random& random, double now) { return random.bits() % 4 == 0 ? infinity : now + random.uniform(); }},
    {"span_overflows",
     [](Random& random, double now) { return random.bits() % 2 == 0 ? std::max(now, -1e308) : 1.7e308; }},
    {"one_after_the_other",
     [](Random& random, double now) { return now + 0x1p-52 * static_cast<double>(random.bits() % 3); }},
    {"below_zero", [](Random& random, double now) { return now < -1.0 ? now + random.uniform() : now; }},
    {"sooner_than_the_slice", [](Random& random, double now) { return now - random.uniform(); }},
};

/// The agenda, and the same pairs in a plain list. A pair is void once one of its bodies has a new stamp.
class Mirrored {
 public:
  Agenda agenda;
  std::vector<std::uint32_t> stamps = std::vector<std::uint32_t>(bodies);

  bool is_void(const HotPair& pair) const {
    return pair.first_stamp != stamps[pair.first] ||
           (pair.second != HotPair::walls && pair.second_stamp != stamps[pair.second]);
  }
  HotPair pair(Random& random, double time) {
    HotPair pair{.time = time, .first = static_cast<std::uint32_t>(random.bits() % bodies)};
    pair.first_stamp = stamps[pair.first];
    const auto second = static_cast<std::uint32_t>(random.bits() % (bodies + 1));
    if (second < bodies) {
      pair.second = second;
      pair.second_stamp = stamps[second];
    }
    return pair;
  }
  void add(const HotPair& pair) {
    agenda.add(pair);
    plain_.push_back(pair);
  }
  void add_all(std::vector<HotPair> pairs) {
    plain_.insert(plain_.end(), pairs.begin(), pairs.end());
    agenda.add_all(pairs);
    EXPECT_TRUE(pairs.empty());
  }
  void open() {
    agenda.open([this](const HotPair& pair) { return is_void(pair); });
  }
  /// Takes the first pair that is not void from both; whether it is the same, or there is none in both.
  testing::AssertionResult same_next() {
    for (;;) {
      open();
      if (agenda.next_time() == infinity && agenda.size() == 0) break;
      if (!is_void(agenda.first())) break;
      agenda.drop_first();
    }
    std::erase_if(plain_, [this](const HotPair& pair) { return is_void(pair); });
    const auto expected = std::min_element(plain_.begin(), plain_.end(), comes_before);
    if (agenda.size() == 0) {
      if (expected == plain_.end()) return testing::AssertionSuccess();
      return testing::AssertionFailure() << "empty, but a pair is due at " << expected->time;
    }
    if (expected == plain_.end()) return testing::AssertionFailure() << "a pair too many";
    const HotPair first = agenda.first();
    if (agenda.next_time() != first.time) return testing::AssertionFailure() << "next time";
    if (comes_before(first, *expected) || comes_before(*expected, first))
      return testing::AssertionFailure() << first.time << " came before " << expected->time;
    agenda.drop_first();
    if (!forget(first)) return testing::AssertionFailure() << "a pair that was not added";
    now_ = first.time;
    return testing::AssertionSuccess();
  }
  /// All that are not void are there, and none that was never added.
  testing::AssertionResult same_pairs() const {
    std::vector<HotPair> there;
    std::size_t count = 0;
    agenda.for_each([&](const HotPair& pair) {
      ++count;
      if (!is_void(pair)) there.push_back(pair);
    });
    if (count != agenda.size()) return testing::AssertionFailure() << count << " of " << agenda.size();
    std::vector<HotPair> expected;
    for (const HotPair& pair : plain_)
      if (!is_void(pair)) expected.push_back(pair);
    const auto by_key = [](const HotPair& a, const HotPair& b) { return key(a) < key(b); };
    std::sort(there.begin(), there.end(), by_key);
    std::sort(expected.begin(), expected.end(), by_key);
    if (!std::equal(there.begin(), there.end(), expected.begin(), expected.end(), same))
      return testing::AssertionFailure() << there.size() << " pairs, expected " << expected.size();
    return testing::AssertionSuccess();
  }
  double now() const { return now_ < infinity ? now_ : 0.0; }

 private:
  bool forget(const HotPair& pair) {
    const auto at =
        std::find_if(plain_.begin(), plain_.end(), [&](const HotPair& other) { return same(other, pair); });
    if (at == plain_.end()) return false;
    plain_.erase(at);
    return true;
  }

  std::vector<HotPair> plain_;
  double now_ = -3.0;
};

void act(Mirrored& mirrored, Random& random, const Times& times) {
  const std::uint64_t choice = random.bits() % 100;
  if (choice < 40) {
    const double time = times.draw(random, mirrored.now());
    mirrored.add(mirrored.pair(random, time));
  } else if (choice < 50) {
    std::vector<HotPair> pairs;
    for (std::uint64_t left = random.bits() % (choice < 43 ? 1200 : 90); left > 0; --left) {
      const double time = times.draw(random, mirrored.now());
      pairs.push_back(mirrored.pair(random, time));
    }
    mirrored.add_all(std::move(pairs));
  } else if (choice < 60) {
    ++mirrored.stamps[random.bits() % bodies];
  } else {
    for (std::uint64_t left = 1 + random.bits() % 30; left > 0; --left) ASSERT_TRUE(mirrored.same_next());
  }
}

class AgendaOrder : public testing::TestWithParam<Times> {};

TEST_P(AgendaOrder, IsThatOfASortedList) {
  for (std::uint64_t stream = 0; stream < 3; ++stream) {
    Random random = Random::at(seed, stream, 0);
    Mirrored mirrored;
    for (int action = 0; action < 200; ++action) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", stream " << stream << ", action " << action);
      ASSERT_NO_FATAL_FAILURE(act(mirrored, random, GetParam()));
      if (action % 10 == 0) {
        ASSERT_TRUE(mirrored.same_pairs());
      }
    }
    while (mirrored.agenda.size() > 0) ASSERT_TRUE(mirrored.same_next()) << "stream " << stream;
    ASSERT_TRUE(mirrored.same_next()) << "nothing is left of the list either";
    EXPECT_EQ(mirrored.agenda.next_time(), infinity);
  }
}

std::string times_name(const testing::TestParamInfo<Times>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Agenda, AgendaOrder, testing::ValuesIn(all_times), times_name);

/// As a snapshot has it.
std::vector<HotPair> pairs_that_hold(const Mirrored& mirrored) {
  std::vector<HotPair> pairs;
  mirrored.agenda.for_each([&](const HotPair& pair) {
    if (!mirrored.is_void(pair)) pairs.push_back(pair);
  });
  return pairs;
}

TEST(Agenda, GoesOnAsBeforeFromThePairsThatHold) {
  for (std::uint64_t stream = 0; stream < 15; ++stream) {
    Random random = Random::at(seed, stream, 1);
    Mirrored mirrored;
    for (int action = 0; action < 60; ++action) act(mirrored, random, all_times[0]);
    std::vector<HotPair> pairs;
    ASSERT_TRUE(read_back(pairs_that_hold(mirrored), pairs));
    Mirrored back = mirrored;
    back.agenda = {};
    back.agenda.add_all(pairs);
    EXPECT_TRUE(back.same_pairs());
    Random same_random = random;
    for (int action = 0; action < 60; ++action) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", stream " << stream << ", action " << action);
      ASSERT_NO_FATAL_FAILURE(act(mirrored, random, all_times[0]));
      ASSERT_NO_FATAL_FAILURE(act(back, same_random, all_times[0]));
      ASSERT_EQ(mirrored.now(), back.now());
    }
  }
}

/// So that pairs which become void before they are due cost no sorting.
TEST(Agenda, ForgetsVoidPairsOfASliceWhenItBegins) {
  Random random(seed);
  Agenda agenda;
  std::vector<HotPair> pairs;
  for (int k = 0; k < 10000; ++k) pairs.push_back({.time = random.uniform()});
  agenda.add_all(pairs);
  std::size_t asked = 0;
  const auto is_void = [&](const HotPair&) {
    ++asked;
    return true;
  };
  agenda.open(is_void);
  while (agenda.size() > 0) {
    agenda.drop_first();
    agenda.open(is_void);
  }
  EXPECT_GT(asked, 9900u) << "few were in the first slice";
  EXPECT_EQ(agenda.next_time(), infinity);
}

TEST(Agenda, KeepsNoMoreMemoryThanItsPairsNeed) {
  Random random(seed);
  Agenda agenda;
  std::vector<HotPair> pairs;
  for (int k = 0; k < 1000; ++k) pairs.push_back({.time = random.uniform(0.0, 1000.0)});
  agenda.add_all(pairs);
  int due = 0;
  for (double now = 0.0; now < 900.0; ++due) {
    agenda.open([](const HotPair&) { return false; });
    now = agenda.next_time();
    agenda.drop_first();
    agenda.add({.time = now + random.uniform(0.0, 20.0)});
  }
  EXPECT_GT(due, 20000);
  EXPECT_EQ(agenda.size(), 1000u);
  EXPECT_LT(agenda.bytes(), 1000 * 10 * sizeof(HotPair));
}

TEST(PairTimes, FindTheFirstTimeOfAPair) {
  for (std::uint64_t k = 0; k < 50; ++k) {
    Random random = Random::at(seed, k, 2);
    std::vector<HotPair> pairs;
    for (std::uint64_t left = random.bits() % 200; left > 0; --left) {
      auto a = static_cast<std::uint32_t>(random.bits() % 12);
      auto b = static_cast<std::uint32_t>(random.bits() % 12);
      if (a > b) std::swap(a, b);
      const double time = random.uniform();
      pairs.push_back({.time = time, .first = a, .second = random.bits() % 4 == 0 ? HotPair::walls : b});
    }
    const PairTimes times(pairs);
    EXPECT_EQ(times.pairs().size(), pairs.size());
    for (std::uint32_t a = 0; a < 13; ++a) {
      for (std::uint32_t b = 0; b < 14; ++b) {
        const std::uint32_t other = b < 13 ? b : HotPair::walls;
        double expected = infinity;
        for (const HotPair& pair : pairs)
          if ((pair.first == a && pair.second == other) || (pair.first == other && pair.second == a))
            expected = std::min(expected, pair.time);
        ASSERT_EQ(times.of(a, other), expected) << "seed " << seed << ", case " << k;
        ASSERT_EQ(times.of(other, a), expected) << "seed " << seed << ", case " << k;
      }
    }
  }
}

}  // namespace
}  // namespace kinesphere::agenda_test
