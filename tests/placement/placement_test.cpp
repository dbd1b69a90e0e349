// Spheres are placed inside their box, apart from each other, as dense at periodic faces as anywhere, up to
// packings that leave little room.
#include "kinesphere/placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/world.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::placement_test {
namespace {

constexpr Axes everywhere{true, true, true};
constexpr Axes plane{true, true, false};

double volume(double radius, int dimensions) {
  return dimensions == 2 ? std::numbers::pi * radius * radius
                         : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// Returns radii from `least` to 1, evenly distributed.
std::vector<double> random_radii(std::size_t count, double least) {
  Random random(count);
  std::vector<double> radii(count);
  for (double& radius : radii) radius = random.uniform(least, 1.0);
  return radii;
}

/// Returns a box, longer than wide and away from the origin, of which spheres of these radii fill that part.
Box box_for(const std::vector<double>& radii, double packing, int dimensions = 3) {
  double filled = 0.0;
  for (const double radius : radii) filled += volume(radius, dimensions);
  const double edge = std::pow(filled / packing / 1.5, 1.0 / dimensions);
  return {{-7, 11, -13}, Vec3{-7, 11, -13} + Vec3{1.5 * edge, edge, edge}};
}

/// Compares all pairs, in more than double precision.
void expect_apart(const std::vector<Vec3>& centres, const std::vector<double>& radii, const Box& box,
                  const PlacementOptions& options) {
  ASSERT_EQ(centres.size(), radii.size());
  const Vec3 size = box.upper - box.lower;
  const double rounding = options.gap > 0.0 ? 1e-14 : 0.0;  // spheres may touch a gap, but never each other
  for (std::size_t a = 0; a < radii.size(); ++a) {
    for (int axis = 0; axis < options.dimensions; ++axis) {
      const double margin = options.periodic[axis] ? 0.0 : radii[a] + options.gap - rounding;
      ASSERT_GE(centres[a][axis] - margin, box.lower[axis]) << "sphere " << a;
      ASSERT_LE(centres[a][axis] + margin, box.upper[axis]) << "sphere " << a;
    }
    ASSERT_TRUE(options.dimensions == 3 || centres[a].z == 0.0);
    for (std::size_t b = 0; b < a; ++b) {
      long double squared = 0.0L;
      for (int axis = 0; axis < options.dimensions; ++axis) {
        long double along = std::abs(static_cast<long double>(centres[a][axis]) - centres[b][axis]);
        if (options.periodic[axis]) along = std::min(along, size[axis] - along);
        squared += along * along;
      }
      ASSERT_GT(std::sqrt(squared), static_cast<long double>(radii[a]) + radii[b] + options.gap - rounding)
          << "spheres " << a << " and " << b;
    }
  }
}

struct Packing {
  double least_radius, packing;
  int dimensions;
};
void PrintTo(const Packing& p, std::ostream* out) {
  *out << p.packing << " in " << p.dimensions << "D, radii from " << p.least_radius;
}

class Packings : public ::testing::TestWithParam<Packing> {};

TEST_P(Packings, leave_no_overlap) {
  const auto [least, packing, dimensions] = GetParam();
  const auto radii = random_radii(700, least);
  const Box box = box_for(radii, packing, dimensions);
  for (const Axes& periodic : {Axes{}, Axes{true, false, false}, dimensions == 2 ? plane : everywhere}) {
    for (const double gap : {0.0, 0.003}) {
      const PlacementOptions options{.periodic = periodic, .dimensions = dimensions, .gap = gap, .seed = 5};
      const auto centres = place_spheres(radii, box, options);
      // Walls take room from the last.
      if (!centres && !periodic.y && packing >= 0.58) continue;
      ASSERT_TRUE(centres) << centres.error().message << ", gap " << gap;
      expect_apart(*centres, radii, box, options);
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Equal, Packings,
                         ::testing::Values(Packing{1.0, 0.05, 3}, Packing{1.0, 0.27, 3}, Packing{1.0, 0.3, 3},
                                           Packing{1.0, 0.49, 3}, Packing{1.0, 0.6, 3}, Packing{1.0, 0.3, 2},
                                           Packing{1.0, 0.7, 2}, Packing{1.0, 0.8, 2}));
INSTANTIATE_TEST_SUITE_P(Mixed, Packings,
                         ::testing::Values(Packing{0.8, 0.3, 3}, Packing{0.8, 0.58, 3}, Packing{0.1, 0.05, 3},
                                           Packing{0.01, 0.4, 3}, Packing{0.01, 0.6, 3}, Packing{0.1, 0.4, 2},
                                           Packing{0.7, 0.78, 2}));

constexpr double edge_of_many = 70.0;
constexpr Box box_of_many{{0, 0, 0}, {edge_of_many, edge_of_many, edge_of_many}};

/// Chi-square of coordinates, each in 50 bins. Spheres that keep apart are spread more evenly than points, so
/// that it is no larger than that of points: 49 with a standard deviation of 10.
TEST(Placement, of_many_is_uniform_and_free_and_isotropic) {
  for (const double packing : {0.1, 0.49}) {
    SCOPED_TRACE(packing);
    const std::array<double, 1> radius{0.9};
    const auto centres =
        place_spheres(radius, box_of_many, {.periodic = everywhere, .packing = packing}).value();
    const auto count = static_cast<double>(centres.size());
    EXPECT_NEAR(count * volume(0.9, 3) / std::pow(edge_of_many, 3), packing, 1e-5);
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 50> bins{};
      for (const Vec3& centre : centres)
        ++bins[std::min(static_cast<std::size_t>(centre[axis] * 50.0 / edge_of_many), bins.size() - 1)];
      double chi_squared = 0.0;
      for (const double bin : bins)
        chi_squared += (bin - count / 50.0) * (bin - count / 50.0) / (count / 50.0);
      EXPECT_LT(chi_squared, 90.0) << "axis " << axis;
      const auto at_face = std::count_if(centres.begin(), centres.end(), [&](const Vec3& centre) {
        return std::min(centre[axis], edge_of_many - centre[axis]) < 0.35;
      });
      EXPECT_NEAR(static_cast<double>(at_face), 0.01 * count, 4.0 * std::sqrt(0.01 * count))
          << "axis " << axis;
    }
    // A world that allows no overlap takes them all.
    World world = World::create({.box = box_of_many, .periodic = everywhere, .allow_overlap = false}).value();
    std::vector<BodyDefinition> bodies;
    for (const Vec3& centre : centres) bodies.push_back({.radius = 0.9, .position = centre});
    const auto added = world.add_all(bodies);
    ASSERT_TRUE(added) << added.error().message;
    // Those near a sphere lie in all directions.
    Vec3 squares;
    double pairs = 0.0;
    for (std::size_t a = 0; a < 1000; ++a) {
      for (const Vec3& other : centres) {
        const Vec3 apart = other - centres[a];
        if (norm_squared(apart) > 4.0 || norm_squared(apart) == 0.0) continue;
        for (int axis = 0; axis < 3; ++axis) squares[axis] += apart[axis] * apart[axis] / norm_squared(apart);
        pairs += 1.0;
      }
    }
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(squares[axis] / pairs, 1.0 / 3.0, 4.0 * 0.3 / std::sqrt(pairs)) << "axis " << axis;
  }
}

/// Returns collisions of each sphere in a unit of time (diameter, mass and temperature are 1).
double collision_rate(double packing, double duration) {
  std::vector<double> radii(2000, 0.5);
  const double edge = std::cbrt(2000.0 * volume(0.5, 3) / packing);
  const Box box{{0, 0, 0}, {edge, edge, edge}};
  const auto centres = place_spheres(radii, box, {.periodic = everywhere, .gap = 1e-5, .seed = 3}).value();
  std::vector<State> start;
  Random random(9);
  for (const Vec3& centre : centres) {
    Vec3 velocity;  // nearly normal: the sum of twelve numbers
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 12; ++k) velocity[axis] += random.uniform(-0.5, 0.5);
    start.push_back({centre, velocity});
  }
  Ballistic spheres = Ballistic::create({.start = start}).value();
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  for (std::uint32_t k = 0; k < spheres.size(); ++k) {
    BodyDefinition sphere = spheres.definition(k, 0.0);
    sphere.radius = 0.5;
    world.add(sphere).value();
  }
  SingleMotionSource mover(spheres);
  const auto respond = [](const Event& event) { return response_of(event, bounce(event, 1.0)); };
  world.run(duration, mover, respond, [](const Event&) {}).value();
  return 2.0 * static_cast<double>(world.counters().count(EventKind::contact_begin)) / 2000.0 / duration;
}

/// The rates are those of hardsphere_Z_and_collision_rate.csv of the project's data.
TEST(Placement, of_a_gas_has_the_collision_rate_of_theory_from_the_start) {
  EXPECT_NEAR(collision_rate(0.10, 1.0) / 1.765845, 1.0, 0.05);
  EXPECT_NEAR(collision_rate(0.25, 1.0) / 7.041703, 1.0, 0.05);
  EXPECT_NEAR(collision_rate(0.40, 1.0) / 20.126198, 1.05, 0.07);
  EXPECT_NEAR(collision_rate(0.49, 1.0) / 37.813199, 1.08, 0.1);
}

std::uint64_t hash_of(const std::vector<Vec3>& centres) {
  std::uint64_t hash = 0;
  for (const Vec3& centre : centres)
    for (int axis = 0; axis < 3; ++axis)
      hash = hash * 0x100000001b3u + std::bit_cast<std::uint64_t>(centre[axis]);
  return hash;
}

TEST(Placement, is_the_same_under_every_compiler) {
  const Box box{{0, 0, 0}, {20, 20, 20}};
  const auto hash = [&](double packing, std::uint64_t seed) {
    return hash_of(place_spheres(random_radii(200, 0.2), box, {.packing = packing, .seed = seed}).value());
  };
  EXPECT_EQ(hash(0.3, 1), 0x4c8be97d14119a5au) << std::hex << hash(0.3, 1);
  EXPECT_EQ(hash(0.5, 1), 0xd4f2305c560d3b3fu) << std::hex << hash(0.5, 1);
  EXPECT_NE(hash(0.3, 1), hash(0.3, 2));
  EXPECT_NE(hash(0.5, 1), hash(0.5, 2));
}

TEST(Placement, to_a_packing_uses_the_radii_in_turn) {
  const Box box{{0, 0, 0}, {10, 10, 10}};
  const std::vector<double> radii{1.0, 0.5, 0.25};
  const PlacementOptions options{.packing = 0.35};
  const auto centres = place_spheres(radii, box, options).value();
  std::vector<double> all;
  double filled = 0.0;
  for (std::size_t k = 0; k < centres.size(); ++k)
    all.push_back(radii[k % 3]), filled += volume(all.back(), 3);
  EXPECT_LE(filled, 350.0);
  EXPECT_GT(filled + volume(radii[centres.size() % 3], 3), 350.0);
  expect_apart(centres, all, box, options);
}

TEST(Placement, takes_points_none_at_all_and_a_sphere_that_just_fits) {
  const Box box{{0, 0, 0}, {4, 4, 4}};
  EXPECT_TRUE(place_spheres({}, box).value().empty());
  EXPECT_TRUE(place_spheres(std::vector{1.0}, box, {.packing = 0.01}).value().empty());
  for (const double radius : {0.0, 1.9999, 2.0 - 1e-13}) {
    const std::vector<double> radii(radius > 0.0 ? 1 : 500, radius);
    for (const Axes& periodic : {Axes{}, everywhere}) {
      const auto centres = place_spheres(radii, box, {.periodic = periodic});
      ASSERT_TRUE(centres) << centres.error().message;
      expect_apart(*centres, radii, box, {.periodic = periodic});
    }
  }
}

TEST(Placement, knows_no_unit_of_length) {
  for (const double unit : {1e-20, 1e20}) {
    const Box box{{-3 * unit, 0, 0}, {4 * unit, 5 * unit, 6 * unit}};
    for (const double packing : {0.2, 0.42}) {
      for (const int dimensions : {2, 3}) {
        const PlacementOptions options{.dimensions = dimensions, .packing = packing};
        const auto centres = place_spheres(std::vector{0.5 * unit}, box, options).value();
        EXPECT_GE(centres.size(), 8u);
        expect_apart(centres, std::vector(centres.size(), 0.5 * unit), box, options);
      }
    }
  }
}

TEST(Placement, refuses_wrong_arguments_by_name) {
  const Box box{{0, 0, 0}, {10, 10, 10}};
  const auto refused = [](const std::string& argument, const std::vector<double>& radii, const Box& where,
                          const PlacementOptions& options = {}, BodyId body = no_body,
                          ErrorCode code = ErrorCode::out_of_range) {
    expect_error(place_spheres(radii, where, options), code, argument, "place_spheres:", body);
  };
  const double nan = std::nan("");
  refused("radii", {1.0, -1.0}, box, {}, {1, 0});
  refused("radii", {1.0, nan}, box, {}, {1, 0}, ErrorCode::not_finite);
  refused("radii", {1.0, 4.9, 5.0}, box, {.periodic = everywhere}, {2, 0});
  refused("radii", {4.0, 4.5}, box, {.gap = 0.75}, {1, 0});
  refused("radii", {5.0}, {{0, 0, 0}, {10, 9, 10}}, {}, {0, 0});
  refused("box", {1.0}, {{0, 0, 0}, {10, 0, 10}});
  refused("box", {1.0}, {{0, 0, 0}, {10, nan, 10}}, {}, no_body, ErrorCode::not_finite);
  refused("box", {1.0}, {{0, 0, 0}, {1e200, 1, 1}});
  refused("dimensions", {1.0}, box, {.dimensions = 1});
  refused("periodic", {1.0}, box, {.periodic = everywhere, .dimensions = 2});
  refused("packing", {1.0}, box, {.packing = 1.0});
  refused("packing", {1.0}, box, {.packing = nan});
  refused("packing", {0.0}, box, {.packing = 0.1});
  refused("radii", {}, box, {.packing = 0.1});
  refused("packing", {1e-5}, box, {.packing = 0.1});
  refused("gap", {1.0}, box, {.gap = -1.0});
  refused("gap", {1.0}, box, {.gap = nan}, no_body, ErrorCode::not_finite);
}

TEST(Placement, says_no_where_there_is_no_room) {
  const Box box{{0, 0, 0}, {10, 10, 10}};
  const auto refused = [&](const std::vector<double>& radii, const PlacementOptions& options) {
    const auto centres = place_spheres(radii, box, options);
    expect_error(centres, ErrorCode::out_of_range, "radii", "place_spheres:");
    return centres ? "" : centres.error().message;
  };
  refused({4.0, 4.0}, {});
  EXPECT_NE(refused({0.5}, {.periodic = everywhere, .packing = 0.72}).find("1375 spheres"),
            std::string::npos);
  refused({0.5}, {.periodic = plane, .dimensions = 2, .packing = 0.93});
  refused(std::vector(3000, 0.5), {});
}

}  // namespace
}  // namespace kinesphere::placement_test
