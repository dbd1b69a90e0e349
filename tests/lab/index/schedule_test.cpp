// Every schedule answers as the plain reference does, whatever is asked of it.
#include "lab/index/schedule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "archive/archive.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::schedule_test {
namespace {

constexpr std::uint64_t seed = 1001;

static_assert(Schedule<LinearSchedule>);
static_assert(Schedule<TreeSchedule>);
static_assert(!Schedule<std::vector<double>>);

/// Does the same to a schedule and to the reference, and compares what can be seen.
template <Schedule S>
class Mirrored {
 public:
  void set(std::uint32_t body, double time) {
    schedule_.set(body, time);
    reference_.set(body, time);
  }
  void remove(std::uint32_t body) {
    schedule_.remove(body);
    reference_.remove(body);
  }

  testing::AssertionResult same_front() const {
    if (schedule_.next_time() != reference_.next_time())
      return testing::AssertionFailure()
             << "next is " << schedule_.next_time() << " instead of " << reference_.next_time();
    if (reference_.next_time() < infinity && schedule_.next_body() != reference_.next_body())
      return testing::AssertionFailure()
             << "body " << schedule_.next_body() << " is next instead of " << reference_.next_body();
    return testing::AssertionSuccess();
  }

  testing::AssertionResult same_bodies(std::uint32_t count) const {
    for (std::uint32_t body = 0; body < count; ++body)
      if (schedule_.time_of(body) != reference_.time_of(body))
        return testing::AssertionFailure()
               << "body " << body << " is scheduled at " << schedule_.time_of(body) << " instead of "
               << reference_.time_of(body);
    return testing::AssertionSuccess();
  }

  /// Removes the next until nobody is left.
  testing::AssertionResult drains_alike() {
    std::pair<double, std::uint32_t> last{-infinity, 0};
    while (reference_.next_time() < infinity) {
      if (auto same = same_front(); !same) return same;
      const std::pair next(reference_.next_time(), reference_.next_body());
      if (next < last) return testing::AssertionFailure() << "body " << next.second << " is out of order";
      last = next;
      remove(next.second);
    }
    return same_front();
  }

  const S& schedule() const { return schedule_; }
  const LinearSchedule& reference() const { return reference_; }

 private:
  S schedule_;
  LinearSchedule reference_;
};

template <class S>
class EverySchedule : public testing::Test {};

using Schedules = testing::Types<LinearSchedule, TreeSchedule>;
TYPED_TEST_SUITE(EverySchedule, Schedules);

TYPED_TEST(EverySchedule, is_empty_at_first_and_knows_nobody) {
  TypeParam schedule;
  EXPECT_EQ(schedule.next_time(), infinity);
  EXPECT_EQ(schedule.time_of(0), infinity);
  EXPECT_EQ(schedule.time_of(4294967295u), infinity);
  schedule.remove(0);
  schedule.remove(4294967295u);
  schedule.set(4294967295u, infinity);
  EXPECT_EQ(schedule.next_time(), infinity);
}

TYPED_TEST(EverySchedule, holds_one_time_per_body) {
  TypeParam schedule;
  schedule.set(7, 3.0);
  schedule.set(7, 5.0);
  schedule.set(7, 4.0);
  EXPECT_EQ(schedule.next_time(), 4.0);
  EXPECT_EQ(schedule.next_body(), 7u);
  EXPECT_EQ(schedule.time_of(7), 4.0);
  EXPECT_EQ(schedule.time_of(6), infinity);
  schedule.remove(7);
  EXPECT_EQ(schedule.next_time(), infinity);
  EXPECT_EQ(schedule.time_of(7), infinity);
}

TYPED_TEST(EverySchedule, orders_equal_times_by_body_whatever_came_before) {
  TypeParam schedule;
  for (const std::uint32_t body : {5u, 1000u, 1u, 9u, 3u, 0u, 8u, 64u, 63u}) schedule.set(body, 2.0);
  schedule.set(0, 1.0);
  schedule.set(0, 2.0);
  for (const std::uint32_t body : {0u, 1u, 3u, 5u, 8u, 9u, 63u, 64u, 1000u}) {
    EXPECT_EQ(schedule.next_time(), 2.0);
    EXPECT_EQ(schedule.next_body(), body);
    schedule.remove(body);
  }
  EXPECT_EQ(schedule.next_time(), infinity);
}

TYPED_TEST(EverySchedule, takes_both_zeros_for_the_same_time) {
  TypeParam schedule;
  schedule.set(2, -0.0);
  schedule.set(20, 0.0);
  EXPECT_EQ(schedule.next_body(), 2u);
  schedule.set(1, 0.0);
  EXPECT_EQ(schedule.next_body(), 1u);
  schedule.set(0, -0.0);
  EXPECT_EQ(schedule.next_body(), 0u);
  EXPECT_EQ(schedule.next_time(), 0.0);
}

TYPED_TEST(EverySchedule, removes_a_body_that_is_set_to_infinity) {
  TypeParam schedule;
  schedule.set(2, 1e300);
  schedule.set(3, 1.0);
  schedule.set(3, infinity);
  EXPECT_EQ(schedule.next_time(), 1e300);
  EXPECT_EQ(schedule.next_body(), 2u);
  schedule.set(2, infinity);
  EXPECT_EQ(schedule.next_time(), infinity);
  EXPECT_EQ(schedule.time_of(2), infinity);
}

TYPED_TEST(EverySchedule, drains_like_the_reference) {
  for (std::uint64_t stream = 0; stream < 60; ++stream) {
    Random random = Random::at(seed, stream, 0);
    const auto bodies = static_cast<std::uint32_t>(1 + random.bits() % (stream % 3 == 0 ? 8 : 400));
    const std::uint64_t distinct_times = stream % 2 == 0 ? 10 : 1000000;
    Mirrored<TypeParam> mirrored;
    for (int action = 0; action < 3000; ++action) {
      const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
      const double choice = random.uniform();
      if (choice < 0.25) {
        mirrored.remove(body);
      } else if (choice < 0.3) {
        mirrored.set(body, infinity);
      } else if (choice < 0.4) {
        mirrored.set(body, mirrored.reference().time_of(body));
      } else {
        mirrored.set(body, static_cast<double>(random.bits() % distinct_times) - 3.0);
      }
      ASSERT_TRUE(mirrored.same_front()) << "seed " << seed << ", stream " << stream << ", action " << action;
      if (action % 100 == 0) {
        ASSERT_TRUE(mirrored.same_bodies(bodies + 1)) << "seed " << seed << ", stream " << stream;
      }
    }
    ASSERT_TRUE(mirrored.drains_alike()) << "seed " << seed << ", stream " << stream;
  }
}

/// As the engine uses it: the next is due, is handled, and gets a later time.
TYPED_TEST(EverySchedule, runs_as_a_calendar_like_the_reference) {
  Random random(seed);
  constexpr std::uint32_t bodies = 300;
  Mirrored<TypeParam> mirrored;
  for (std::uint32_t body = 0; body < bodies; ++body) mirrored.set(body, random.uniform());
  double now = 0.0;
  for (int event = 0; event < 30000; ++event) {
    ASSERT_TRUE(mirrored.same_front()) << "seed " << seed << ", event " << event;
    const std::uint32_t next = mirrored.reference().next_body();
    ASSERT_GE(mirrored.reference().next_time(), now);
    now = mirrored.reference().next_time();
    mirrored.set(next, now + (random.uniform() < 0.1 ? 0.0 : random.uniform()));
    mirrored.set(static_cast<std::uint32_t>(random.bits() % bodies), now + random.uniform());
  }
  EXPECT_TRUE(mirrored.same_bodies(bodies));
}

/// Beyond every power of the width, where a level is added, and far beyond.
TYPED_TEST(EverySchedule, grows_like_the_reference) {
  Random random(seed);
  Mirrored<TypeParam> mirrored;
  for (std::uint32_t body = 0; body < 4200; ++body) {
    mirrored.set(body, static_cast<double>(random.bits() % 1000000) - static_cast<double>(body));
    ASSERT_TRUE(mirrored.same_front()) << "seed " << seed << ", body " << body;
    if (body % 4 == 0) mirrored.remove(mirrored.reference().next_body());
  }
  EXPECT_TRUE(mirrored.same_bodies(4300));
  EXPECT_TRUE(mirrored.drains_alike());
  for (const std::uint32_t body : {4250u, 32767u, 32768u, 300000u}) {
    mirrored.set(body, 1.0);
    EXPECT_TRUE(mirrored.same_front()) << body;
    mirrored.set(body - 1, 2.0);
    EXPECT_TRUE(mirrored.same_front()) << body;
  }
  EXPECT_TRUE(mirrored.drains_alike());
}

TEST(TreeSchedule, mostly_knows_who_comes_after_the_next) {
  Random random(seed);
  TreeSchedule schedule;
  EXPECT_EQ(schedule.soon(), std::nullopt);
  schedule.set(3, 1.0);
  EXPECT_EQ(schedule.soon(), std::nullopt);
  for (std::uint32_t body = 0; body < 512; ++body) schedule.set(body, random.uniform());
  int right = 0;
  constexpr int events = 2000;
  for (int event = 0; event < events; ++event) {
    const std::uint32_t next = schedule.next_body();
    const auto soon = schedule.soon();
    ASSERT_TRUE(soon);
    ASSERT_NE(*soon, next);
    ASSERT_LT(schedule.time_of(*soon), infinity);
    schedule.set(next, schedule.next_time() + random.uniform());
    right += schedule.next_body() == *soon;
  }
  EXPECT_GT(right, events * 3 / 4);
}

/// Body and time; every fourth time removes the body.
using Actions = std::vector<std::tuple<std::uint16_t, std::uint8_t>>;

RC_GTEST_PROP(TreeScheduleProperty, does_what_the_reference_does, (const Actions& actions)) {
  Mirrored<TreeSchedule> mirrored;
  // Often the same few bodies, and now and then others.
  const auto number = [](std::uint16_t body) { return std::uint32_t{body} % (body % 8 == 0 ? 700 : 32); };
  for (const auto& [body, time] : actions) {
    if (time % 4 == 0) {
      mirrored.remove(number(body));
    } else {
      mirrored.set(number(body), time);
    }
    RC_ASSERT(mirrored.same_front());
  }
  RC_ASSERT(mirrored.same_bodies(701));
  RC_ASSERT(mirrored.drains_alike());
}

TEST(TreeSchedule, keeps_no_sign_of_zero) {
  TreeSchedule schedule;
  schedule.set(0, -0.0);
  EXPECT_FALSE(std::signbit(schedule.time_of(0)));
  EXPECT_FALSE(std::signbit(schedule.next_time()));
}

/// 4096 times, and 512, 64 and 8 of their groups.
TEST(TreeSchedule, counts_the_memory_of_all_levels) {
  TreeSchedule schedule;
  EXPECT_EQ(heap_bytes(schedule), 0u);
  schedule.set(4095, 1.0);
  constexpr std::size_t least = 64 * (512 + 64 + 8 + 1);
  EXPECT_GE(heap_bytes(schedule), least);
  EXPECT_LE(heap_bytes(schedule), least + 4 * 16);
}

/// Of memory, and so of time to move it.
TEST(TreeSchedule, grows_body_by_body_at_little_cost) {
  constexpr std::uint32_t bodies = 1000000;
  TreeSchedule schedule;
  std::size_t moved = 0;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    const std::size_t before = heap_bytes(schedule);
    schedule.set(body, bodies - body);
    if (heap_bytes(schedule) != before) moved += before;
  }
  EXPECT_EQ(schedule.next_body(), bodies - 1);
  EXPECT_LT(heap_bytes(schedule), std::size_t{bodies} * 20);
  EXPECT_LT(moved, std::size_t{bodies} * 100);
}

std::vector<std::byte> bytes_of(const TreeSchedule& schedule) {
  ByteWriter writer;
  writer(schedule);
  return writer.take();
}

TreeSchedule read_back(const std::vector<std::byte>& bytes) {
  TreeSchedule schedule;
  schedule.set(5, 0.25);  // what was there before is forgotten
  schedule.set(9, 0.25);
  ByteReader reader(bytes);
  reader(schedule);
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ(reader.remaining(), 0u);
  return schedule;
}

TEST(TreeSchedule, comes_back_from_bytes) {
  for (const std::uint32_t bodies : {0u, 1u, 8u, 9u, 64u, 65u, 512u, 513u, 1000u}) {
    Random random = Random::at(seed, bodies, 1);
    Mirrored<TreeSchedule> mirrored;
    for (std::uint32_t body = 0; body < bodies; ++body) mirrored.set(body, random.uniform());
    mirrored.remove(bodies / 2);
    const std::vector<std::byte> bytes = bytes_of(mirrored.schedule());
    EXPECT_EQ(bytes.size(), 8 + 8 * ((bodies + 7) / 8 * 8));  // the times alone
    TreeSchedule copy = read_back(bytes);
    ASSERT_TRUE(copy.is_valid(bodies));
    EXPECT_EQ(bytes_of(copy), bytes);
    for (std::uint32_t body = 0; body < bodies + 20; ++body)
      ASSERT_EQ(copy.time_of(body), mirrored.schedule().time_of(body));
    while (mirrored.schedule().next_time() < infinity) {
      ASSERT_EQ(copy.next_time(), mirrored.schedule().next_time());
      ASSERT_EQ(copy.next_body(), mirrored.schedule().next_body());
      copy.remove(copy.next_body());
      mirrored.remove(mirrored.schedule().next_body());
    }
    EXPECT_EQ(copy.next_time(), infinity);
  }
}

TEST(TreeSchedule, that_cannot_have_come_about_is_not_sound) {
  TreeSchedule schedule;
  schedule.set(9, 3.0);
  const std::vector<std::byte> bytes = bytes_of(schedule);
  EXPECT_TRUE(read_back(bytes).is_valid(10));
  EXPECT_TRUE(read_back(bytes).is_valid(100));
  EXPECT_FALSE(read_back(bytes).is_valid(9)) << "a body that there is not";
  EXPECT_FALSE(read_back(bytes).is_valid(8)) << "more times than bodies";
  EXPECT_FALSE(read_back(bytes).is_valid(0));
  schedule.remove(9);
  EXPECT_TRUE(read_back(bytes_of(schedule)).is_valid(9));
  EXPECT_FALSE(read_back(bytes_of(schedule)).is_valid(8));
  const auto with_time = [&bytes](double time) {
    std::vector<std::byte> changed = bytes;
    ByteWriter writer;
    writer(time);
    std::copy(writer.bytes().begin(), writer.bytes().end(), changed.begin() + 8 + 3 * 8);
    return read_back(changed);
  };
  EXPECT_TRUE(with_time(0.0).is_valid(10));
  EXPECT_FALSE(with_time(-0.0).is_valid(10));
  EXPECT_FALSE(with_time(std::numeric_limits<double>::quiet_NaN()).is_valid(10));
  EXPECT_FALSE(with_time(-std::numeric_limits<double>::quiet_NaN()).is_valid(10));
}

}  // namespace
}  // namespace kinesphere::schedule_test
