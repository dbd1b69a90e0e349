// The hash grid finds what a plain list of boxes finds, each once, for boxes of any kind.
#include "research/grid/hash_grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "kinesphere/random.hpp"
#include "research/tests/grid/mirrored_grid.hpp"

namespace kinesphere::hash_grid_test {
namespace {

constexpr std::uint64_t seed = 3001;

Box box_at(const Vec3& centre, const Vec3& half) { return {centre - half, centre + half}; }
Box cube_at(const Vec3& centre, double half) { return box_at(centre, {half, half, half}); }

/// A kind of boxes, `progress` in [0, 1) of the way through a stream.
struct Crowd {
  const char* name;
  Box (*draw)(Random&, double progress);

  friend std::ostream& operator<<(std::ostream& out, const Crowd& crowd) { return out << crowd.name; }
};

Vec3 half_sizes(Random& random, double largest) {
  return largest * Vec3{random.uniform(), random.uniform(), random.uniform()};
}

/// From 1 down to 2^-lowest, each octave equally often.
double octaves(Random& random, int lowest) {
  return std::ldexp(1.0 + random.uniform(),
                    -1 - static_cast<int>(random.bits() % static_cast<std::uint64_t>(lowest)));
}

const std::vector<Crowd> crowds{
    {"alike",
     [](Random& random, double) { return box_at(20.0 * random.point_in_ball(), half_sizes(random, 2.0)); }},
    {"one_to_a_thousand",
     [](Random& random, double) {
       return cube_at(100.0 * random.point_in_ball(), 20.0 * octaves(random, 10));
     }},
    {"one_to_a_million",
     [](Random& random, double) { return cube_at(1e3 * random.point_in_ball(), 1e3 * octaves(random, 20)); }},
    {"clustered",
     [](Random& random, double) {
       const Vec3 centre{1000.0 * static_cast<double>(random.bits() % 3), 0.0, -500.0};
       return box_at(centre + random.point_in_ball(), half_sizes(random, 0.3));
     }},
    {"all_negative",
     [](Random& random, double) {
       return cube_at(Vec3{-500, -600, -700} + 30.0 * random.point_in_ball(), 2.0);
     }},
    {"on_cell_borders",
     [](Random& random, double) {
       const auto whole = [&random] { return static_cast<double>(random.bits() % 17) - 8.0; };
       const Vec3 lower{whole(), whole(), whole()};
       const double edge = std::ldexp(1.0, static_cast<int>(random.bits() % 4) - 1);
       return Box{lower, lower + Vec3{edge, edge, edge}};
     }},
    {"beside_cell_borders",
     [](Random& random, double) {
       const auto nearly_whole = [&random] {
         const auto whole = static_cast<float>(random.bits() % 9) - 4.0f;
         return static_cast<double>(std::nextafter(whole, random.bits() % 2 == 0 ? 100.0f : -100.0f));
       };
       const Vec3 lower{nearly_whole(), nearly_whole(), nearly_whole()};
       return Box{lower, lower + Vec3{1.0, 1.0, 1.0}};
     }},
    {"points",
     [](Random& random, double) {
       return cube_at(std::floor(4.0 * random.uniform()) * random.unit_vector(), 0.0);
     }},
    {"points_without_width",
     [](Random& random, double) {
       const auto whole = [&random] { return static_cast<double>(random.bits() % 4) - 2.0; };
       return random.uniform() < 0.2 ? cube_at({whole(), whole(), whole()}, 1.0)
                                     : cube_at({whole(), whole(), whole()}, 0.0);
     }},
    {"equal_points",
     [](Random& random, double) {
       return cube_at({1.0 * static_cast<double>(random.bits() % 3), 0.1, -7}, 0.0);
     }},
    {"rods_and_plates",
     [](Random& random, double) {
       Vec3 half{0.01, 0.01, 0.01};
       half[static_cast<int>(random.bits() % 3)] = 10.0;
       if (random.bits() % 2 == 0) half[static_cast<int>(random.bits() % 3)] = 10.0;
       return box_at(15.0 * random.point_in_ball(), half);
     }},
    {"far_away",
     [](Random& random, double) {
       return cube_at(Vec3{1e7, -1e7, 1e7} + 10.0 * random.point_in_ball(), 1e-3);
     }},
    {"far_and_near",
     [](Random& random, double) {
       const double far = std::ldexp(1.0, 4 * static_cast<int>(random.bits() % 20) - 20);
       return cube_at(far * random.point_in_ball(), 0.5 * far * random.uniform() * random.uniform());
     }},
    {"a_few_huge_ones_over_dust",
     [](Random& random, double) {
       return random.uniform() < 0.02 ? cube_at(random.point_in_ball(), 1e6)
                                      : cube_at(10.0 * random.point_in_ball(), 0.05);
     }},
    {"travelling",
     [](Random& random, double progress) {
       return cube_at(Vec3{1e5 * progress, 0, 0} + 5.0 * random.point_in_ball(), 0.5);
     }},
    {"growing",
     [](Random& random, double progress) {
       const double scale = std::ldexp(1.0, static_cast<int>(40.0 * progress) - 20);
       return cube_at(10.0 * scale * random.point_in_ball(), scale * (0.5 + random.uniform()));
     }},
    {"shrinking",
     [](Random& random, double progress) {
       const double scale = std::ldexp(1.0, 20 - static_cast<int>(40.0 * progress));
       return cube_at(10.0 * scale * random.point_in_ball(), scale * (0.5 + random.uniform()));
     }},
};

class HashGridOf : public testing::TestWithParam<Crowd> {};

TEST_P(HashGridOf, a_random_stream_answers_like_a_plain_list) {
  for (const std::uint32_t bodies : {5u, 150u}) {
    constexpr int actions = 6000;
    Random random = Random::at(seed, bodies, 0);
    MirroredGrid mirrored;
    for (int action = 0; action < actions; ++action) {
      const double progress = static_cast<double>(action) / actions;
      const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
      if (random.uniform() < 0.15) {
        mirrored.remove(body);
      } else {
        mirrored.set(body, GetParam().draw(random, progress));
      }
      if (action % 4 == 0) {
        ASSERT_TRUE(mirrored.same_overlaps(GetParam().draw(random, progress)))
            << "seed " << seed << ", " << bodies << " bodies, action " << action;
      }
    }
    for (const auto& [body, box] : mirrored.boxes()) {
      ASSERT_TRUE(mirrored.same_overlaps(box)) << "seed " << seed << ", the box of body " << body;
      const Vec3 size = box.upper - box.lower;
      ASSERT_TRUE(mirrored.same_overlaps({box.upper, box.upper + size}))
          << "seed " << seed << ", beside body " << body;
    }
    ASSERT_TRUE(mirrored.same_overlaps(cube_at({}, 1e30)));
    for (std::uint32_t body = 0; body < bodies; ++body) mirrored.remove(body);
    ASSERT_TRUE(mirrored.same_overlaps(cube_at({}, 1e30)));
    ASSERT_EQ(mirrored.grid().size(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Crowds, HashGridOf, testing::ValuesIn(crowds),
                         [](const auto& crowd) { return std::string(crowd.param.name); });

TEST(HashGridTouching, counts_as_overlap_and_apart_does_not) {
  HashGrid grid;
  grid.set(0, {{0, 0, 0}, {1, 1, 1}});
  const auto found = [&grid](const Box& query) {
    int visits = 0;
    grid.for_each_overlap(query, [&](std::uint32_t) { ++visits; });
    return visits;
  };
  EXPECT_EQ(found({{1, 1, 1}, {2, 2, 2}}), 1);
  EXPECT_EQ(found({{-1, 0, 0}, {0, 0, 0}}), 1);
  const double two_steps = 2.0 * grid.finest_edge() / 4096.0;
  EXPECT_EQ(found({{1.0 + two_steps, 0, 0}, {2, 1, 1}}), 0);
  EXPECT_EQ(found({{0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}}), 1);
}

TEST(HashGridBodies, may_be_removed_when_absent_and_set_twice) {
  HashGrid grid;
  grid.remove(5);
  grid.set(5, cube_at({}, 1.0));
  grid.set(5, cube_at({}, 1.0));
  EXPECT_EQ(grid.size(), 1u);
  EXPECT_TRUE(grid.contains(5));
  EXPECT_FALSE(grid.contains(4));
  EXPECT_FALSE(grid.contains(6));
  grid.remove(5);
  grid.remove(5);
  EXPECT_EQ(grid.size(), 0u);
}

/// Finishes at once when a level counts its cells, and never when it walks all cells that the box could meet.
TEST(HashGridQuery, of_the_whole_world_costs_no_more_than_the_bodies) {
  HashGrid grid;
  for (std::uint32_t body = 0; body < 1000; ++body) grid.set(body, cube_at({0.01 * body, 0, 0}, 1e-3));
  int visits = 0;
  grid.for_each_overlap(cube_at({}, 1e35), [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 1000);
}

/// Longer than the low bits of positions can tell, and yet in fewer cells than there are.
TEST(HashGridQuery, of_a_crowded_place_finds_everyone_there_once) {
  HashGrid grid;
  constexpr std::uint32_t bodies = 3000;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    const double at = body % 3;  // of which two are met
    grid.set(body, cube_at({4.0 * at, 0.0, 0.0}, 1.0));
  }
  std::vector<int> times(bodies, 0);
  grid.for_each_overlap(cube_at({2.0, 0.0, 0.0}, 1.5), [&](std::uint32_t body) { ++times[body]; });
  for (std::uint32_t body = 0; body < bodies; ++body) EXPECT_EQ(times[body], body % 3 < 2 ? 1 : 0) << body;
}

TEST(HashGridQuery, of_a_long_thin_box_finds_what_it_meets_and_no_more) {
  MirroredGrid mirrored;
  for (std::uint32_t body = 0; body < 400; ++body) mirrored.set(body, cube_at({1.0 * body, 0, 0}, 0.1));
  for (const double half : {1.0, 3.0, 10.0, 30.0, 100.0})
    EXPECT_TRUE(mirrored.same_overlaps(box_at({200, 0, 0}, {half, 0.05, 0.05}))) << half;
}

TEST(FloatBoxOf, a_box_contains_it_and_is_hardly_larger) {
  for (std::uint64_t k = 0; k < 100000; ++k) {
    Random random = Random::at(seed, k, 1);
    const double scale = std::ldexp(1.0, static_cast<int>(random.bits() % 200) - 100);
    const Box box = box_at(scale * random.point_in_ball(), half_sizes(random, scale));
    const FloatBox rounded(box);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      ASSERT_LE(static_cast<double>(rounded.lower[i]), box.lower[axis]) << "seed " << seed << ", case " << k;
      ASSERT_GE(static_cast<double>(rounded.upper[i]), box.upper[axis]) << "seed " << seed << ", case " << k;
      ASSERT_GT(static_cast<double>(std::nextafter(rounded.lower[i], HUGE_VALF)), box.lower[axis]);
      ASSERT_LT(static_cast<double>(std::nextafter(rounded.upper[i], -HUGE_VALF)), box.upper[axis]);
    }
  }
}

TEST(FloatBoxOf, numbers_beyond_single_precision_still_contains_them) {
  const FloatBox box(Box{{-1e200, -1e39, 1e-300}, {-1e39, 1e39, 1e-200}});
  EXPECT_EQ(box.lower[0], -HUGE_VALF);
  EXPECT_EQ(box.upper[0], -std::numeric_limits<float>::max());
  EXPECT_EQ(box.lower[1], -HUGE_VALF);
  EXPECT_EQ(box.upper[1], HUGE_VALF);
  EXPECT_EQ(box.lower[2], 0.0f);
  EXPECT_EQ(box.upper[2], std::numeric_limits<float>::denorm_min());
}

TEST(HashGridOfEndlessBoxes, takes_them_among_others) {
  MirroredGrid mirrored;
  for (std::uint32_t body = 0; body < 20; ++body) mirrored.set(body, cube_at({1.0 * body, 0, 0}, 0.7));
  mirrored.set(20, {{-1e39, -1, -1}, {1e39, 1, 1}});
  mirrored.set(21, cube_at({}, 1e300));
  mirrored.set(22, cube_at({1e200, 0, 0}, 1.0));
  mirrored.set(23, cube_at({}, 3e38));
  for (const double half : {1.0, 1e10, 1e38, 1e39, 1e300})
    EXPECT_TRUE(mirrored.same_overlaps(cube_at({}, half))) << half;
  for (std::uint32_t body = 0; body < 24; ++body) mirrored.remove(body);
  EXPECT_TRUE(mirrored.same_overlaps(cube_at({}, 1e300)));
}

/// Body, two coordinates, size; the largest sizes remove the body.
using Actions = std::vector<std::tuple<std::uint8_t, std::int8_t, std::int8_t, std::uint8_t>>;

RC_GTEST_PROP(HashGridProperty, answers_like_a_plain_list, (const Actions& actions)) {
  MirroredGrid mirrored;
  for (const auto& [body, x, y, size] : actions) {
    const Box box = cube_at({0.25 * x, 0.5 * y, 0.25 * (x + y)}, std::ldexp(1.0, size % 16 - 8));
    if (size >= 200) {
      mirrored.remove(body % 16);
    } else {
      mirrored.set(body % 16, box);
    }
    RC_ASSERT(mirrored.same_overlaps(box));
  }
}

}  // namespace
}  // namespace kinesphere::hash_grid_test
