// The kernel finds what its plain twin finds, to the bit, with vectors of every width that this machine has:
// all swept spheres that touch, and none that are clearly apart.
#include "broadphase/swept_sphere_search.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::swept_sphere_search_test {
namespace {

constexpr std::uint64_t seed = 4101;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Seven columns that begin anywhere in memory. Values behind the last slot are near everything.
class Table {
 public:
  explicit Table(std::size_t places, std::size_t misalignment = 0)
      : places_(places), misalignment_(misalignment) {
    for (std::vector<float>& column : columns_)
      column.assign(misalignment + places + search_lanes, not_a_number);
  }
  std::size_t places() const { return places_; }
  void set(std::size_t place, const SweptSphere& sphere) {
    const std::size_t at = misalignment_ + place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns_[axis][at] = sphere.centre[axis];
      columns_[axis + 3][at] = sphere.velocity[axis];
    }
    columns_[6][at] = sphere.radius;
  }
  SweptSphereColumns columns() const {
    SweptSphereColumns pointers{};
    for (std::size_t k = 0; k < pointers.size(); ++k) pointers[k] = columns_[k].data() + misalignment_;
    return pointers;
  }

 private:
  std::size_t places_;
  std::size_t misalignment_;
  std::array<std::vector<float>, 7> columns_;
};

/// Draws a number of a swept sphere.
using Numbers = float (*)(Random&);

float everyday(Random& random) { return static_cast<float>(random.uniform(-4.0, 4.0)); }
float whole(Random& random) { return static_cast<float>(random.bits() % 5) - 2.0f; }
float of_any_size(Random& random) {
  const float sign = random.bits() % 2 == 0 ? 1.0f : -1.0f;
  return sign * static_cast<float>(log_uniform(random, -149, 127));
}
float special(Random& random) {
  constexpr std::array values{not_a_number, infinite,  -infinite,  0.0f,
                              -0.0f,        0x1p-149f, -0x1p-126f, std::numeric_limits<float>::max(),
                              0x1p64f,      -0x1p64f,  0x1p63f,    0x1p-50f,
                              0x1p-64f,     1.0f,      -1.0f,      0x1p55f};
  return values[random.bits() % values.size()];
}
float rarely_special(Random& random) { return random.bits() % 16 == 0 ? special(random) : everyday(random); }
/// Returns a number near those that overflow or underflow when squared once or twice.
float on_the_edge(Random& random) {
  constexpr std::array exponents{-75, -63, -50, -37, -25, 31, 42, 62, 64};
  const float sign = random.bits() % 2 == 0 ? 1.0f : -1.0f;
  const int exponent = exponents[random.bits() % exponents.size()];
  return sign * std::ldexp(static_cast<float>(0.5 + random.uniform()), exponent);
}

constexpr std::array<Numbers, 6> all_numbers{everyday,       whole,   of_any_size,
                                             rarely_special, special, on_the_edge};

SweptSphere draw(Random& random, Numbers numbers) {
  SweptSphere sphere;
  for (float& part : sphere.centre) part = numbers(random);
  for (float& part : sphere.velocity) part = numbers(random);
  sphere.radius = numbers(random);
  if (random.bits() % 2 == 0) sphere.radius = std::abs(sphere.radius);
  return sphere;
}

/// The first query is that of all runs by default.
struct Question {
  Table table{0};
  std::vector<SlotRange> runs;
  SweptSphereQuery query{};
  SweptSphereQuery second_query{};
};

Question draw_question(std::uint64_t k) {
  constexpr SweptSphere free_slot{{0x1p55f, 0x1p55f, 0x1p55f}, {}, 0.0f};
  Random random = Random::at(seed, k, 0);
  const Numbers numbers = all_numbers[k % all_numbers.size()];
  Question question;
  const std::size_t places = random.bits() % 300;
  question.table = Table(places, random.bits() % 16);
  for (std::size_t place = 0; place < places; ++place)
    question.table.set(place, chance(random, 0.1) ? free_slot : draw(random, numbers));
  for (std::uint64_t left = random.bits() % 6; left > 0; --left) {
    const std::uint64_t length = random.bits() % (std::min<std::uint64_t>(places, 100) + 1);
    const auto begin = static_cast<std::uint32_t>(random.bits() % (places - length + 1));
    question.runs.push_back({begin, begin + static_cast<std::uint32_t>(length), left % 2 == 0 ? 1u : 0u});
  }
  for (SweptSphereQuery* query : {&question.query, &question.second_query}) {
    query->sphere = draw(random, numbers);
    const auto first = static_cast<float>(random.uniform()), second = static_cast<float>(random.uniform());
    query->from = chance(random, 0.3) ? 0.0f : std::min(first, second);
    query->to = chance(random, 0.3) ? 1.0f : std::max(first, second);
    if (chance(random, 0.05)) query->from = -infinite;
    if (chance(random, 0.05)) query->to = infinite;
  }
  return question;
}

std::size_t places_in(const std::vector<SlotRange>& runs) {
  std::size_t all = 0;
  for (const SlotRange& run : runs) all += run.end - run.begin;
  return all;
}

/// Returns the words that a search writes.
std::vector<std::uint64_t> words(decltype(near_swept_spheres)& search, const Question& question) {
  std::size_t count = 0;
  for (const SlotRange& run : question.runs) count += words_for(run);
  constexpr std::uint64_t untouched = 0xabcdabcdabcdabcd;
  std::vector<std::uint64_t> all(count + 1, untouched);
  search(question.table.columns(), std::array{question.query, question.second_query}, question.runs,
         all.data());
  EXPECT_EQ(all.back(), untouched) << "written beyond the words of all runs";
  all.pop_back();
  return all;
}
/// Returns the slots that a search finds.
std::vector<std::uint32_t> near(const Question& question) {
  std::vector<std::uint32_t> places;
  for_each_near(question.runs, words(near_swept_spheres, question).data(),
                [&](std::uint32_t, std::uint32_t place) { places.push_back(place); });
  return places;
}

/// Restricts Highway to these vectors until destruction.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
  ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
};

TEST(SweptSphereSearch, IsThatOfItsPlainTwinOnEveryTarget) {
  std::vector<Question> questions;
  std::vector<std::vector<std::uint64_t>> expected;
  std::size_t all = 0, near = 0;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    questions.push_back(draw_question(k));
    expected.push_back(words(near_swept_spheres_plain, questions.back()));
    all += places_in(questions.back().runs);
    for (const std::uint64_t word : expected.back()) near += static_cast<std::size_t>(std::popcount(word));
  }
  EXPECT_GT(near, all / 20);
  EXPECT_LT(near, all - all / 20);
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  EXPECT_FALSE(targets.empty());
  for (const std::int64_t target : targets) {
    const OnlyTarget only(target);
    for (std::size_t k = 0; k < questions.size(); ++k)
      ASSERT_EQ(words(near_swept_spheres, questions[k]), expected[k])
          << "seed " << seed << ", question " << k << ", " << hwy::TargetName(target);
  }
}

TEST(SweptSphereSearch, EveryLengthOfARunIsReadToItsEndAndNoFurther) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OnlyTarget only(target);
    for (std::uint32_t length = 0; length <= 200; ++length) {
      for (const std::uint32_t begin : {0u, 1u, 7u, 16u}) {
        // All swept spheres are near, also those outside of the run.
        Question question{.table = Table(begin + length)};
        for (std::size_t place = 0; place < begin; ++place) question.table.set(place, {});
        for (std::uint32_t place = begin; place < begin + length; ++place) question.table.set(place, {});
        question.runs = {{begin, begin + length}};
        question.query = {{}, 0.0f, 1.0f};
        std::vector<std::uint32_t> expected;
        for (std::uint32_t place = begin; place < begin + length; ++place) expected.push_back(place);
        ASSERT_EQ(near(question), expected)
            << hwy::TargetName(target) << ", from " << begin << ", " << length << " places";
      }
    }
  }
}

/// Compares with the truth in a crowd in which some touch: `spread` of the positions, `fastest` speed.
void expect_truth(std::uint64_t stream, double error, double fastest, double radius) {
  constexpr std::size_t places = 100;
  std::size_t touching = 0, apart = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    Random random = Random::at(seed, k, stream);
    const SweptSphereFrame frame{.base = 1e3 * random.point_in_ball(), .origin = 8.0};
    const Scales scales{.length = error, .speed = fastest, .plan = 0.0, .radius = radius, .age = 0.0};
    const double now = 8.0 + 0.5 * random.uniform();
    const auto draw_bound = [&] {
      Bound bound = random_bound(random, scales, now);
      bound.position += frame.base;
      bound.growth_speed = bound.acceleration_limit = 0.0;
      return bound;
    };
    const auto sphere = [&](const Bound& bound) {
      return swept_sphere_of(BoundAt(bound, now), now, 9.0 - now, 0.0, frame);
    };
    std::vector<Bound> bounds;
    Question question{.table = Table(places)};
    for (std::size_t place = 0; place < places; ++place) {
      bounds.push_back(draw_bound());
      question.table.set(place, sphere(bounds.back()));
    }
    const Bound bound = draw_bound();
    question.runs = {{0, places}};
    question.query = {sphere(bound), frame.time(now), 1.0f};
    const std::vector<std::uint32_t> places_near = near(question);
    const double size = error + fastest + radius;
    for (std::uint32_t place = 0; place < places; ++place) {
      const Extended gap = least_true_gap(bound, bounds[place], now, 9.0);
      const bool is_near = std::binary_search(places_near.begin(), places_near.end(), place);
      if (gap <= 0) {
        ASSERT_TRUE(is_near) << "seed " << seed << ", case " << k << "/" << stream << "\n"
                             << bound << "\n"
                             << bounds[place];
      }
      if (gap > Extended{0x1p-13 * size}) {
        ASSERT_FALSE(is_near) << "seed " << seed << ", case " << k << "/" << stream;
      }
      touching += gap <= 0 ? 1 : 0;
      apart += gap > Extended{0x1p-13 * size} ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 20u) << stream;
  EXPECT_GT(apart, 20u) << stream;
}

TEST(SweptSphereSearch, FindsAllThatTouchAndNoneThatAreClearlyApart) {
  expect_truth(1, 10.0, 1.0, 2.0);
  expect_truth(2, 10.0, 20.0, 1.0);
  expect_truth(3, 1e3, 3e3, 90.0);
  expect_truth(4, 0x1p50, 0x1p50, 0x1p48);
  expect_truth(5, 0x1p-20, 0x1p-20, 0x1p-22);
  expect_truth(6, 1.0, 0.0, 0.3);
  expect_truth(7, 1e9, 1e9, 1e8);
}

/// Includes a table with a frame for slow bodies, and a window far longer than the query's.
TEST(SweptSphereSearch, FindsThoseThatAFastOneMeets) {
  for (int power = 0; power <= 200; ++power) {
    const double speed = std::ldexp(1.0, power);
    const Bound slow{.position = {0.5, 0, 0}, .radius = 0.1};
    const Bound fast{.velocity = {speed, 0, 0}, .radius = 0.1};
    const double end = 1.0 / speed;
    Question question{.table = Table(1)};
    question.table.set(0, swept_sphere_of(BoundAt(slow, 0.0), 0.0, 1.0, 0.0, {}));
    question.runs = {{0, 1}};
    question.query = {swept_sphere_of(BoundAt(fast, 0.0), 0.0, end, 0.0, {}), 0.0f,
                      SweptSphereFrame{}.time(end)};
    EXPECT_EQ(near(question).size(), 1u) << "2^" << power;
  }
}

}  // namespace
}  // namespace kinesphere::swept_sphere_search_test
