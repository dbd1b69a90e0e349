// The queue returns certificates in the order of a sorted list, for all additions, and when some become stale
// on the way.
#include "broadphase/certificate_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"
#include "support/read_back.hpp"

namespace kinesphere::certificate_queue_test {
namespace {

constexpr std::uint64_t seed = 4201;
constexpr std::uint32_t bodies = 40;

auto key(const PairCertificate& pair) {
  return std::tie(pair.failure_time, pair.first, pair.second, pair.first_revision, pair.second_revision);
}
/// Orders by time, then by number.
bool comes_before(const PairCertificate& a, const PairCertificate& b) {
  return std::tie(a.failure_time, a.first, a.second) < std::tie(b.failure_time, b.first, b.second);
}
bool same(const PairCertificate& a, const PairCertificate& b) { return key(a) == key(b); }

/// Distribution of times after `now`.
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

/// The queue, and a plain list with equal content. A certificate is stale once one of its bodies has a new
/// revision.
class Mirrored {
 public:
  CertificateQueue agenda;
  std::vector<std::uint32_t> stamps = std::vector<std::uint32_t>(bodies);

  bool is_stale(const PairCertificate& pair) const {
    return pair.first_revision != stamps[pair.first] ||
           (pair.second != PairCertificate::walls && pair.second_revision != stamps[pair.second]);
  }
  PairCertificate pair(Random& random, double time) {
    PairCertificate pair{.failure_time = time, .first = static_cast<std::uint32_t>(random.bits() % bodies)};
    pair.first_revision = stamps[pair.first];
    const auto second = static_cast<std::uint32_t>(random.bits() % (bodies + 1));
    if (second < bodies) {
      pair.second = second;
      pair.second_revision = stamps[second];
    }
    return pair;
  }
  void add(const PairCertificate& pair) {
    agenda.add(pair);
    plain_.push_back(pair);
  }
  void add_all(std::vector<PairCertificate> pairs) {
    plain_.insert(plain_.end(), pairs.begin(), pairs.end());
    agenda.add_all(pairs);
    EXPECT_TRUE(pairs.empty());
  }
  void open() {
    agenda.open([this](const PairCertificate& pair) { return is_stale(pair); });
  }
  /// Takes the first certificate that is not stale from both; returns whether they are equal.
  testing::AssertionResult same_next() {
    for (;;) {
      open();
      if (agenda.next_time() == infinity && agenda.size() == 0) break;
      if (!is_stale(agenda.first())) break;
      agenda.drop_first();
    }
    std::erase_if(plain_, [this](const PairCertificate& pair) { return is_stale(pair); });
    const auto expected = std::min_element(plain_.begin(), plain_.end(), comes_before);
    if (agenda.size() == 0) {
      if (expected == plain_.end()) return testing::AssertionSuccess();
      return testing::AssertionFailure() << "empty, but a pair is due at " << expected->failure_time;
    }
    if (expected == plain_.end()) return testing::AssertionFailure() << "a pair too many";
    const PairCertificate first = agenda.first();
    if (agenda.next_time() != first.failure_time) return testing::AssertionFailure() << "next time";
    if (comes_before(first, *expected) || comes_before(*expected, first))
      return testing::AssertionFailure() << first.failure_time << " came before " << expected->failure_time;
    agenda.drop_first();
    if (!forget(first)) return testing::AssertionFailure() << "a pair that was not added";
    now_ = first.failure_time;
    return testing::AssertionSuccess();
  }
  /// Expects that all current certificates are present, and no other.
  testing::AssertionResult same_pairs() const {
    std::vector<PairCertificate> there;
    std::size_t count = 0;
    agenda.for_each([&](const PairCertificate& pair) {
      ++count;
      if (!is_stale(pair)) there.push_back(pair);
    });
    if (count != agenda.size()) return testing::AssertionFailure() << count << " of " << agenda.size();
    std::vector<PairCertificate> expected;
    for (const PairCertificate& pair : plain_)
      if (!is_stale(pair)) expected.push_back(pair);
    const auto by_key = [](const PairCertificate& a, const PairCertificate& b) { return key(a) < key(b); };
    std::sort(there.begin(), there.end(), by_key);
    std::sort(expected.begin(), expected.end(), by_key);
    if (!std::equal(there.begin(), there.end(), expected.begin(), expected.end(), same))
      return testing::AssertionFailure() << there.size() << " pairs, expected " << expected.size();
    return testing::AssertionSuccess();
  }
  double now() const { return now_ < infinity ? now_ : 0.0; }

 private:
  bool forget(const PairCertificate& pair) {
    const auto at = std::find_if(plain_.begin(), plain_.end(),
                                 [&](const PairCertificate& other) { return same(other, pair); });
    if (at == plain_.end()) return false;
    plain_.erase(at);
    return true;
  }

  std::vector<PairCertificate> plain_;
  double now_ = -3.0;
};

void act(Mirrored& mirrored, Random& random, const Times& times) {
  const std::uint64_t choice = random.bits() % 100;
  if (choice < 40) {
    const double time = times.draw(random, mirrored.now());
    mirrored.add(mirrored.pair(random, time));
  } else if (choice < 50) {
    std::vector<PairCertificate> pairs;
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

class QueueOrder : public testing::TestWithParam<Times> {};

TEST_P(QueueOrder, IsThatOfASortedList) {
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
INSTANTIATE_TEST_SUITE_P(CertificateQueue, QueueOrder, testing::ValuesIn(all_times), times_name);

/// Returns the certificates as a snapshot has them.
std::vector<PairCertificate> pairs_that_hold(const Mirrored& mirrored) {
  std::vector<PairCertificate> pairs;
  mirrored.agenda.for_each([&](const PairCertificate& pair) {
    if (!mirrored.is_stale(pair)) pairs.push_back(pair);
  });
  return pairs;
}

TEST(CertificateQueue, GoesOnAsBeforeFromThePairsThatHold) {
  for (std::uint64_t stream = 0; stream < 15; ++stream) {
    Random random = Random::at(seed, stream, 1);
    Mirrored mirrored;
    for (int action = 0; action < 60; ++action) act(mirrored, random, all_times[0]);
    std::vector<PairCertificate> pairs;
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

/// Certificates that become stale before they are due cost no sorting.
TEST(CertificateQueue, ForgetsVoidPairsOfASliceWhenItBegins) {
  Random random(seed);
  CertificateQueue queue;
  std::vector<PairCertificate> pairs;
  for (int k = 0; k < 10000; ++k) pairs.push_back({.failure_time = random.uniform()});
  queue.add_all(pairs);
  std::size_t asked = 0;
  const auto is_stale = [&](const PairCertificate&) {
    ++asked;
    return true;
  };
  queue.open(is_stale);
  while (queue.size() > 0) {
    queue.drop_first();
    queue.open(is_stale);
  }
  EXPECT_GT(asked, 9900u) << "few were in the first slice";
  EXPECT_EQ(queue.next_time(), infinity);
}

/// Certificates that come little by little are looked at once, whenever times were divided.
TEST(CertificateQueue, LooksOnceAtPairsThatComeLittleByLittle) {
  Random random(seed);
  CertificateQueue queue;
  std::vector<PairCertificate> pairs;
  for (int k = 0; k < 1000; ++k) pairs.push_back({.failure_time = random.uniform()});
  queue.add_all(pairs);
  std::size_t asked = 0;
  const auto is_stale = [&](const PairCertificate&) {
    ++asked;
    return false;
  };
  constexpr std::size_t steps = 20000;
  double before = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    queue.open(is_stale);
    ASSERT_GE(queue.next_time(), before);
    before = queue.take_first().failure_time;
    queue.add({.failure_time = before + 2.0 * random.uniform()});
  }
  EXPECT_EQ(queue.size(), 1000u);
  EXPECT_LE(asked, steps + 1000u);
  EXPECT_GT(before, 15.0);
}

/// Those that fail after all that were there when times were divided share the last slice, until it begins.
TEST(CertificateQueue, KeepsTheOrderOfThoseBeyondTheLastSlice) {
  Random random(seed);
  CertificateQueue queue;
  std::vector<PairCertificate> pairs;
  for (int k = 0; k < 1000; ++k) pairs.push_back({.failure_time = random.uniform()});
  queue.add_all(pairs);
  for (int k = 0; k < 3000; ++k) queue.add({.failure_time = k % 3 == 0 ? 7.0 : random.uniform(2.0, 9.0)});
  double before = 0.0;
  std::size_t added = 0;
  for (std::size_t left = 4000; left > 0; --left) {
    queue.open([](const PairCertificate&) { return false; });
    ASSERT_EQ(queue.size(), left);
    ASSERT_GE(queue.next_time(), before);
    before = queue.next_time();
    ASSERT_EQ(queue.take_first().failure_time, before);
    // Some come to be due soon, others beyond the last again.
    if (++added % 100 == 0 && added < 4000) {
      queue.add({.failure_time = before + random.uniform(0.0, 9.0)});
      ++left;
    }
  }
}

TEST(CertificateQueue, KeepsNoMoreMemoryThanItsPairsNeed) {
  Random random(seed);
  CertificateQueue queue;
  std::vector<PairCertificate> pairs;
  for (int k = 0; k < 1000; ++k) pairs.push_back({.failure_time = random.uniform(0.0, 1000.0)});
  queue.add_all(pairs);
  int due = 0;
  for (double now = 0.0; now < 900.0; ++due) {
    queue.open([](const PairCertificate&) { return false; });
    now = queue.next_time();
    queue.drop_first();
    queue.add({.failure_time = now + random.uniform(0.0, 20.0)});
  }
  EXPECT_GT(due, 20000);
  EXPECT_EQ(queue.size(), 1000u);
  EXPECT_LT(queue.bytes(), 1000 * 10 * sizeof(PairCertificate));
}

TEST(CertificateTimes, FindTheFirstTimeOfAPair) {
  for (std::uint64_t k = 0; k < 50; ++k) {
    Random random = Random::at(seed, k, 2);
    std::vector<PairCertificate> pairs;
    for (std::uint64_t left = random.bits() % 200; left > 0; --left) {
      auto a = static_cast<std::uint32_t>(random.bits() % 12);
      auto b = static_cast<std::uint32_t>(random.bits() % 12);
      if (a > b) std::swap(a, b);
      const double time = random.uniform();
      pairs.push_back(
          {.failure_time = time, .first = a, .second = random.bits() % 4 == 0 ? PairCertificate::walls : b});
    }
    const CertificateTimes times(pairs);
    EXPECT_EQ(times.pairs().size(), pairs.size());
    for (std::uint32_t a = 0; a < 13; ++a) {
      for (std::uint32_t b = 0; b < 14; ++b) {
        const std::uint32_t other = b < 13 ? b : PairCertificate::walls;
        double expected = infinity;
        for (const PairCertificate& pair : pairs)
          if ((pair.first == a && pair.second == other) || (pair.first == other && pair.second == a))
            expected = std::min(expected, pair.failure_time);
        ASSERT_EQ(times.of(a, other), expected) << "seed " << seed << ", case " << k;
        ASSERT_EQ(times.of(other, a), expected) << "seed " << seed << ", case " << k;
      }
    }
  }
}

}  // namespace
}  // namespace kinesphere::certificate_queue_test
