// A glance at four sketches: whom it finds apart does not meet, and it is not blind; four lanes at once give
// the bits of one by one.
#include "bound/glance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "bound/encounter.hpp"
#include "support/exact_certificates.hpp"
#include "support/family_test.hpp"

namespace kinesphere {
namespace {

using exact::Wide;

constexpr std::uint64_t seed = 2211;

/// One who looks, and four who are looked at.
struct Scene {
  Bound own;
  std::array<Bound, lane_count> others;
  std::array<double, lane_count> ends;  ///< of what is known of the others
  double own_end, until;
  double now, room;

  double end_of(std::size_t lane) const { return std::min({until, own_end, ends[lane]}); }
  /// The pair of a lane, for as long as a glance looks at it.
  PairCase pair(std::size_t lane) const {
    PairCase c;
    c.a = own;
    c.b = others[lane];
    c.from = now;
    c.horizon = end_of(lane);
    c.distance = room;
    return c;
  }
};

/// As the pairs that it consists of.
std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    out << "lane " << lane << "\n" << scene.pair(lane) << "\n";
  return out << std::hexfloat << "until " << scene.until << ", own end " << scene.own_end
             << std::defaultfloat;
}

/// The second body of a pair, and others like it.
Scene scene_of(const PairCase& c, Random& random) {
  Scene scene{.own = c.a, .own_end = c.horizon, .until = c.horizon, .now = c.from};
  if (random.bits() % 2 == 0) scene.until = c.from + random.uniform(1.0, 2.0) * (c.horizon - c.from);
  scene.room = std::max(c.distance, 0.0);
  const double length = norm(c.b.position - c.a.position);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    scene.others[lane] = c.b;
    const double part = lane == 0 ? 1.0 : random.uniform(0.0, 2.0);
    scene.ends[lane] = c.from + part * (c.horizon - c.from);
    if (lane > 0) scene.others[lane].position += length * random.uniform() * random.unit_vector();
    if (lane > 1) scene.others[lane].velocity = c.a.velocity + norm(c.b.velocity) * random.point_in_ball();
  }
  return scene;
}

template <class Number>
Lanes glance_at(const Scene& scene, double beside = 0.0,
                const typename Glance<Number>::Images* images = nullptr,
                const typename Glance<Number>::HomeRow& homes = {}) {
  const Sketch own(scene.own, scene.own_end, beside);
  std::array<Sketch, lane_count> others;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    others[lane] = Sketch(scene.others[lane], scene.ends[lane], beside);
  const Glance<Number> glance(own, scene.now, scene.room);
  const typename Glance<Number>::Row row{&others[0], &others[1], &others[2], &others[3]};
  return images ? glance.apart(row, scene.until, *images, homes) : glance.apart(row, scene.until);
}

Lanes glance_at(const Scene& scene) {
  const Lanes apart = glance_at<Four>(scene);
  EXPECT_EQ(apart, glance_at<FourPlain>(scene));
  return apart;
}

bool is_apart(Lanes lanes, std::size_t lane) { return (lanes >> lane) % 2 == 1; }

PairCase scaled(PairCase c, double scale) {
  for (Bound* bound : {&c.a, &c.b}) {
    bound->position *= scale;
    bound->velocity *= scale;
    bound->planned_acceleration *= scale;
    bound->radius *= scale;
    bound->growth_speed *= scale;
    bound->growth_acceleration *= scale;
  }
  c.distance *= scale;
  return c;
}

PairCase tiny(Random& random) {
  const PairCase c = families::everyday(random);
  return scaled(c, std::ldexp(1.0, -30 - static_cast<int>(random.bits() % 120)));
}

/// They overlap by a part of their distance, the square of which is a few of the least numbers that there
/// are.
PairCase minute(Random& random) {
  PairCase c = families::ballistic(random);
  const double depth = 0.1 * random.uniform() * (c.a.radius + c.b.radius);
  set_gap(c, random.unit_vector(), -depth);
  c.distance = 0.0;
  return scaled(c, std::ldexp(1.0, -75 + static_cast<int>(random.bits() % 3)));
}

/// Straight ways so small, and up to 2^most so slow, that the squares of some products underflow, over times
/// that are long enough to meet.
PairCase small_and_slow(Random& random, std::uint64_t most) {
  PairCase c = families::everyday(random);
  const double length = std::ldexp(1.0, -26 - static_cast<int>(random.bits() % 6));
  const double slowness = std::ldexp(1.0, static_cast<int>(random.bits() % most));
  const double duration = c.horizon - c.from;
  for (Bound* bound : {&c.a, &c.b}) {
    bound->time = c.from;
    bound->position *= length;
    bound->velocity *= length / slowness;
    bound->planned_acceleration = {};
    bound->radius *= length;
    bound->growth_speed = bound->growth_acceleration = 0.0;
  }
  c.horizon = c.from + duration * slowness;
  c.distance *= length;
  return c;
}
PairCase slow(Random& random) { return small_and_slow(random, 20); }
PairCase hardly_moving(Random& random) { return small_and_slow(random, 110); }

/// Neither moves at first, and one turns towards the other.
PairCase falling(Random& random) {
  const Vec3 down = random.unit_vector();
  const double way = random.uniform(1.0, 3.0);
  PairCase c;
  c.a = {.position = 5.0 * random.point_in_ball(), .radius = 0.25};
  c.b = {.position = c.a.position - (0.5 + way) * down, .planned_acceleration = down, .radius = 0.25};
  c.horizon = std::sqrt(2.0 * way) * random.uniform(0.95, 1.05);
  return c;
}

/// Straight ways that miss or meet by about what single precision can tell.
PairCase marginal(Random& random) {
  PairCase c;
  c.a = {.position = 100.0 * random.unit_vector(), .velocity = random.unit_vector(), .radius = 0.5};
  c.b = {.position = c.a.position + random.uniform(2.0, 5.0) * random.unit_vector(),
         .velocity = random.unit_vector(),
         .radius = 0.5};
  c.horizon = random.uniform(0.5, 5.0);
  const Vec3 offset = c.b.position - c.a.position;
  const Vec3 velocity = c.b.velocity - c.a.velocity;
  const double nearest = std::clamp(-dot(offset, velocity) / norm_squared(velocity), 0.0, c.horizon);
  const double error = std::ldexp(100.0, -20 - static_cast<int>(random.bits() % 6));
  c.distance = std::max(0.0, norm(offset + velocity * nearest) - 1.0 + random.uniform(-1.0, 1.0) * error);
  return c;
}

/// Small bodies that meet or miss each other by less than their size, far from where they are now: squares
/// that differ by little are subtracted.
PairCase small_and_far(Random& random) {
  const Vec3 ahead = random.unit_vector();
  const double distance = random.uniform(1.0, 5.0);
  const double radius = std::ldexp(distance, -7 - static_cast<int>(random.bits() % 6));
  const double miss = random.uniform(0.0, 3.0) * radius;
  const Vec3 sideways = cross(ahead, random.unit_vector());
  const Vec3 velocity = distance * ahead - miss / norm(sideways) * sideways;
  PairCase c;
  c.a = {.velocity = velocity, .radius = radius};
  c.b = {.position = distance * ahead, .radius = radius};
  c.horizon = random.uniform(0.9, 2.0);
  return c;
}

/// So large that the square of their distance is more than single precision holds, and not all other squares.
PairCase enormous(Random& random) {
  const Vec3 ahead = random.unit_vector();
  const double distance = std::ldexp(random.uniform(1.0, 2.0), 64);
  PairCase c;
  c.horizon = std::ldexp(1.0, 19) * random.uniform();
  c.a = {.velocity = random.uniform(0.0, 1.0) * distance / c.horizon * ahead, .radius = 0.2 * distance};
  c.b = {.position = distance * ahead, .radius = 0.2 * distance};
  return c;
}

/// So fast that squares of their speeds are more than single precision holds, or the speeds themselves.
PairCase swift(Random& random) {
  PairCase c = families::ballistic(random);
  const int exponent = 50 + static_cast<int>(random.bits() % 90);
  const double faster = std::ldexp(1.0, exponent);
  for (Bound* bound : {&c.a, &c.b}) {
    bound->time = c.from;
    bound->velocity *= faster;
  }
  c.horizon = c.from + (c.horizon - c.from) / faster;
  return c;
}

/// The like of bodies that have gone far together since their reports.
PairCase far_gone(Random& random) {
  PairCase c = marginal(random);
  const Vec3 origin = c.a.position;
  const Vec3 far = 1000.0 * random.unit_vector();
  const bool turned = random.bits() % 2 == 0;
  for (Bound* bound : {&c.a, &c.b}) {
    bound->time = c.from - 1.0;
    bound->position = bound->position - origin - bound->velocity;
    if (turned) {
      bound->planned_acceleration = 2.0 * far;
    } else {
      bound->velocity += far;
    }
  }
  return c;
}

std::vector<Family> families_here() {
  std::vector<Family> families = all_families;
  families.push_back({"tiny", tiny});
  families.push_back({"minute", minute});
  families.push_back({"slow", slow});
  families.push_back({"hardly_moving", hardly_moving});
  families.push_back({"falling", falling});
  families.push_back({"marginal", marginal});
  families.push_back({"far_gone", far_gone});
  families.push_back({"small_and_far", small_and_far});
  families.push_back({"enormous", enormous});
  families.push_back({"swift", swift});
  return families;
}

class Glances : public FamilyTest<seed, scene_of> {};

TEST_P(Glances, find_nobody_apart_who_may_meet) {
  for_each_case(0, [](const Scene& scene, Random&) {
    const Lanes apart = glance_at(scene);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if (!is_apart(apart, lane)) continue;
      const PairCase c = scene.pair(lane);
      EXPECT_GT(exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance, 0), Wide(c.horizon))
          << "lane " << lane;
    }
  });
}

/// What is clear to double precision with some room is clear at a glance. Small bodies that are far apart
/// need more room, as squares of distances are subtracted.
TEST_P(Glances, find_those_apart_who_are_by_more_than_single_precision_can_tell) {
  for_each_case(1, [](const Scene& scene, Random&) {
    const Lanes apart = glance_at(scene);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const PairCase c = scene.pair(lane);
      const double end = std::max({scene.own_end, scene.ends[lane], c.from});
      const double size = length_scale(c.a, end) + length_scale(c.b, end) + c.distance;
      const double duration = c.horizon - c.from;
      const MovedBound a(c.a, c.from), b(c.b, c.from);
      const double speed = norm(a.velocity - b.velocity);
      // Where squares of single-precision numbers exist, also of products of places and velocities.
      if (!(size < 0x1p40 && size * speed < 0x1p60 && duration < 0x1p19)) continue;
      if (!(norm(a.centre - b.centre) > 0x1p-20 && speed * duration > 0x1p-20 && speed > 0x1p-20)) continue;
      const double radii = a.radius + b.radius + c.distance;
      const double cancelled = std::sqrt(radii * radii + 0x1p-17 * norm_squared(a.centre - b.centre)) - radii;
      if (Encounter(a, b).stay_apart(duration, c.distance + 0x1p-14 * size + cancelled)) {
        EXPECT_TRUE(is_apart(apart, lane)) << "lane " << lane;
      }
    }
  });
}

TEST_P(Glances, see_the_image_whose_home_is_nearest) {
  for_each_case(2, [](const Scene& scene, Random& random) {
    const double size = norm_one(scene.own.position) + norm_one(scene.others[0].position);
    const Vec3 period{2.0 * size, random.bits() % 2 == 0 ? 0.0 : 3.0 * size, size};
    std::array<Home, lane_count + 1> homes;
    std::array<Vec3, lane_count + 1> centres;
    for (std::size_t k = 0; k < homes.size(); ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        centres[k][axis] = random.uniform() * period[axis];
        homes[k].centre[static_cast<std::size_t>(axis)] = static_cast<float>(centres[k][axis]);
      }
    }
    Scene seen = scene;
    Lanes clear = all_lanes;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      for (int axis = 0; axis < 3; ++axis) {
        if (period[axis] == 0.0) continue;
        const double way = (centres[lane][axis] - centres[lane_count][axis]) / period[axis];
        seen.others[lane].position[axis] -= std::floor(way + 0.5) * period[axis];
        if (std::abs(std::abs(way) - 0.5) < 1e-6) clear &= ~(1u << lane);
      }
    }
    const auto look = [&](auto number) {
      using Number = decltype(number);
      const typename Glance<Number>::Images images(homes[lane_count], period);
      return glance_at<Number>(scene, norm_one(period), &images,
                               {&homes[0], &homes[1], &homes[2], &homes[3]});
    };
    const Lanes apart = look(Four(0.0f));
    EXPECT_EQ(apart, look(FourPlain(0.0f)));
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if (!is_apart(apart & clear, lane)) continue;
      const PairCase c = seen.pair(lane);
      EXPECT_GT(exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance, 0), Wide(c.horizon))
          << "lane " << lane << "\n"
          << c;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, Glances, testing::ValuesIn(families_here()),
                         [](const auto& family) { return std::string(family.param.name); });

TEST(Sketch, of_nothing_is_apart_from_nothing) {
  Random random = Random::at(seed, 0, 9);
  Scene scene = scene_of(families::everyday(random), random);
  const Sketch own(scene.own, scene.own_end, 0.0);
  const Sketch nothing;
  EXPECT_EQ(Glance<>(own, scene.now, 0.0).apart({&nothing, &nothing, &nothing, &nothing}, scene.until), 0u);
  EXPECT_EQ(Glance<>(nothing, scene.now, 0.0).apart({&own, &own, &own, &own}, scene.until), 0u);
}

/// Numbers of all kinds.
float any_number(Random& random) {
  const auto bits = static_cast<std::uint32_t>(random.bits());
  switch (random.bits() % 4) {
    case 0:
      return std::bit_cast<float>(bits);
    case 1:
      return static_cast<float>(random.uniform(-2.0, 2.0));
    default:
      return static_cast<float>(static_cast<int>(bits % 7) - 3);
  }
}

TEST(Four, do_what_one_by_one_does) {
  using Numbers = std::array<float, lane_count>;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random = Random::at(seed, k, 10);
    std::array<Numbers, 4> rows;
    for (Numbers& row : rows)
      for (float& number : row) number = any_number(random);
    const auto results = [&](auto zero) {
      using Number = decltype(zero);
      const auto columns = Number::columns({rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()});
      const auto& [a, b, c, d] = columns;
      return std::array<Lanes, 14>{a + b > zero,
                                   a >= b,
                                   (a > b) & (c >= d),
                                   (a > b) | (c >= d),
                                   a - b > c,
                                   a * b > d,
                                   abs(a) > abs(b),
                                   zero > a * c,
                                   a > b,
                                   (a + b) * c > d,
                                   if_greater(a, b, c) > d,
                                   a - a > zero,
                                   zero > a - a,
                                   d > if_greater(a, b, c)};
    };
    ASSERT_EQ(results(Four(0.0f)), results(FourPlain(0.0f))) << "seed " << seed << ", case " << k;
  }
}

}  // namespace
}  // namespace kinesphere
