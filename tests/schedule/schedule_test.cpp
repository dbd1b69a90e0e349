// Every schedule answers as the plain reference does, whatever is asked of it.
#include "schedule/schedule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <tuple>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 1001;
constexpr double infinity = std::numeric_limits<double>::infinity();

static_assert(Schedule<LinearSchedule>);
static_assert(Schedule<HeapSchedule>);
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
    if (schedule_.empty() != reference_.empty()) return testing::AssertionFailure() << "only one is empty";
    if (reference_.empty()) return testing::AssertionSuccess();
    const Due got = schedule_.earliest();
    const Due expected = reference_.earliest();
    if (got == expected) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "body " << got.body << " at " << got.time << " instead of "
                                       << expected.body << " at " << expected.time;
  }

  testing::AssertionResult same_bodies(std::uint32_t count) const {
    for (std::uint32_t body = 0; body < count; ++body) {
      if (schedule_.contains(body) != reference_.contains(body))
        return testing::AssertionFailure() << "only one contains body " << body;
      if (reference_.contains(body) && schedule_.time_of(body) != reference_.time_of(body))
        return testing::AssertionFailure() << "body " << body << " is due at " << schedule_.time_of(body);
    }
    return testing::AssertionSuccess();
  }

  /// Removes the earliest until nothing is left.
  testing::AssertionResult drains_alike() {
    Due last{-infinity, 0};
    while (!reference_.empty()) {
      if (auto same = same_front(); !same) return same;
      const Due due = reference_.earliest();
      if (due < last) return testing::AssertionFailure() << "body " << due.body << " is out of order";
      last = due;
      remove(due.body);
    }
    return same_front();
  }

  const LinearSchedule& reference() const { return reference_; }

 private:
  S schedule_;
  LinearSchedule reference_;
};

template <class S>
class EverySchedule : public testing::Test {};

using Schedules = testing::Types<LinearSchedule, HeapSchedule>;
TYPED_TEST_SUITE(EverySchedule, Schedules);

TYPED_TEST(EverySchedule, is_empty_at_first_and_knows_nobody) {
  TypeParam schedule;
  EXPECT_TRUE(schedule.empty());
  EXPECT_FALSE(schedule.contains(0));
  EXPECT_FALSE(schedule.contains(4000000000u));
  schedule.remove(0);
  schedule.remove(4000000000u);
  EXPECT_TRUE(schedule.empty());
}

TYPED_TEST(EverySchedule, holds_one_time_per_body) {
  TypeParam schedule;
  schedule.set(7, 3.0);
  schedule.set(7, 5.0);
  schedule.set(7, 4.0);
  EXPECT_EQ(schedule.earliest(), (Due{4.0, 7}));
  EXPECT_EQ(schedule.time_of(7), 4.0);
  EXPECT_FALSE(schedule.contains(6));
  schedule.remove(7);
  EXPECT_TRUE(schedule.empty());
  EXPECT_FALSE(schedule.contains(7));
}

TYPED_TEST(EverySchedule, orders_equal_times_by_body_whatever_came_before) {
  TypeParam schedule;
  for (const std::uint32_t body : {5u, 1u, 9u, 3u, 0u, 8u}) schedule.set(body, 2.0);
  schedule.set(0, 1.0);
  schedule.set(0, 2.0);
  for (const std::uint32_t body : {0u, 1u, 3u, 5u, 8u, 9u}) {
    EXPECT_EQ(schedule.earliest(), (Due{2.0, body}));
    schedule.remove(body);
  }
}

TYPED_TEST(EverySchedule, takes_infinity_for_a_time_like_any_other) {
  TypeParam schedule;
  schedule.set(2, infinity);
  schedule.set(1, infinity);
  EXPECT_EQ(schedule.earliest(), (Due{infinity, 1}));
  schedule.set(3, 1e300);
  EXPECT_EQ(schedule.earliest(), (Due{1e300, 3}));
  schedule.set(3, infinity);
  EXPECT_EQ(schedule.earliest(), (Due{infinity, 1}));
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
      } else if (choice < 0.4 && mirrored.reference().contains(body)) {
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

/// As the engine uses it: the earliest is due, is handled, and gets a later time.
TYPED_TEST(EverySchedule, runs_as_a_calendar_like_the_reference) {
  Random random(seed);
  constexpr std::uint32_t bodies = 300;
  Mirrored<TypeParam> mirrored;
  for (std::uint32_t body = 0; body < bodies; ++body) mirrored.set(body, random.uniform());
  double now = 0.0;
  for (int event = 0; event < 30000; ++event) {
    ASSERT_TRUE(mirrored.same_front()) << "seed " << seed << ", event " << event;
    const Due due = mirrored.reference().earliest();
    ASSERT_GE(due.time, now);
    now = due.time;
    mirrored.set(due.body, now + (random.uniform() < 0.1 ? 0.0 : random.uniform()));
    mirrored.set(static_cast<std::uint32_t>(random.bits() % bodies), now + random.uniform());
  }
  EXPECT_TRUE(mirrored.same_bodies(bodies));
}

/// Body and time; every fourth time removes the body.
using Actions = std::vector<std::tuple<std::uint8_t, std::uint8_t>>;

RC_GTEST_PROP(HeapScheduleProperty, does_what_the_reference_does, (const Actions& actions)) {
  Mirrored<HeapSchedule> mirrored;
  for (const auto& [body, time] : actions) {
    if (time % 4 == 0) {
      mirrored.remove(body % 32);
    } else {
      mirrored.set(body % 32, time);
    }
    RC_ASSERT(mirrored.same_front());
  }
  RC_ASSERT(mirrored.same_bodies(33));
  RC_ASSERT(mirrored.drains_alike());
}

}  // namespace
}  // namespace kinesphere
