// Images of points and boxes, and the search across the border of a periodic box.
#include "space/space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::space_test {
namespace {

const Box box{{-3, 10, 0}, {1, 17, 2}};

Space space_of(const Axes& periodic, int dimensions = 3) {
  return Space({.box = box, .periodic = periodic, .dimensions = dimensions});
}

TEST(Space, WithoutPeriodsPointsStayWhereTheyAre) {
  const Space space;
  EXPECT_FALSE(space.repeats());
  const Vec3 far{1e300, -1e300, 5};
  EXPECT_EQ(space.shift_to_nearest(far, -far, 0.0), Vec3{});
  EXPECT_EQ(space.wrapped(far, 0.0).position, far);
  EXPECT_EQ(space.wrapped(far, 0.0).images, Vec3{});
  EXPECT_TRUE(space.is_narrow({-far, far}));
}

TEST(Space, WrapsIntoTheBoxAlsoWhereRoundingWouldNot) {
  const Space space = space_of({true, true, false});
  Random random(1);
  std::vector<Vec3> points{{1, 17, 2},
                           {-3, 10, 0},
                           {std::nextafter(-3.0, -4.0), std::nextafter(10.0, 9.0), -5},
                           {std::nextafter(1.0, 0.0), 1e6, 99}};
  for (int k = 0; k < 1000; ++k) points.push_back(1000.0 * random.point_in_ball());
  for (const Vec3& point : points) {
    const auto [position, images] = space.wrapped(point, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GE(position[axis], box.lower[axis]);
      EXPECT_LT(position[axis], box.upper[axis]);
      EXPECT_EQ(images[axis], std::floor(images[axis]));
    }
    EXPECT_EQ(position.z, point.z);
    EXPECT_NEAR(norm(position + space.shift_of(images, 0.0) - point), 0.0, 1e-9);
  }
}

TEST(Space, TheNearestImageIsWithinHalfAPeriod) {
  const Space space = space_of({true, false, true});
  Random random(2);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from = 50.0 * random.point_in_ball();
    const Vec3 to = 50.0 * random.point_in_ball();
    const Vec3 shift = space.shift_to_nearest(from, to, 0.0);
    EXPECT_EQ(shift.y, 0.0);
    EXPECT_LE(std::abs(from.x + shift.x - to.x), 2.0 + 1e-9);
    EXPECT_LE(std::abs(from.z + shift.z - to.z), 1.0 + 1e-9);
  }
}

bool overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.upper[axis] < b.lower[axis] || b.upper[axis] < a.lower[axis]) return false;
  return true;
}

/// Returns true if any image of the box overlaps the other.
bool overlap_somewhere(const Space& space, const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const double period = space.period()[axis];
    bool overlap = false;
    for (int n = -40; n <= 40; ++n)
      if (n == 0 || period > 0.0)
        overlap |= a.lower[axis] + n * period <= b.upper[axis] && b.lower[axis] <= a.upper[axis] + n * period;
    if (!overlap) return false;
  }
  return true;
}

TEST(Space, ASearchFindsEachBoxOnceInWhicheverImage) {
  for (const Axes& periodic : {Axes{true, true, true}, Axes{true, false, false}, Axes{false, true, true}}) {
    const Space space = space_of(periodic);
    Random random(3);
    const auto box_of = [&](double most) {
      const Vec3 middle = 20.0 * random.point_in_ball();
      Vec3 half;
      for (int axis = 0; axis < 3; ++axis) {
        const double period = space.period()[axis];
        half[axis] = 0.249 * most * (period > 0.0 ? period : 4.0) * random.uniform();
      }
      return Box{middle - half, middle + half};
    };
    std::vector<Box> boxes, images;
    double largest_extent = 0.0;
    for (std::uint32_t k = 0; k < 200; ++k) {
      boxes.push_back(box_of(k % 10 == 0 ? 1.0 : 0.1));
      const Vec3 shift =
          space.shift_of(space.wrapped(0.5 * (boxes[k].lower + boxes[k].upper), 0.0).images, 0.0);
      const Box image{boxes[k].lower - shift, boxes[k].upper - shift};
      for (int axis = 0; axis < 3; ++axis) {
        if (!periodic[axis]) continue;
        EXPECT_GE(0.5 * (image.lower[axis] + image.upper[axis]), box.lower[axis] - 1e-9);
        EXPECT_LE(0.5 * (image.lower[axis] + image.upper[axis]), box.upper[axis] + 1e-9);
      }
      EXPECT_TRUE(space.is_narrow(image));
      images.push_back(image);
      for (int axis = 0; axis < 3; ++axis)
        largest_extent = std::max(largest_extent, image.upper[axis] - image.lower[axis]);
    }
    std::size_t hits = 0;
    for (int query = 0; query < 400; ++query) {
      // Wide queries find some boxes several times, but miss none.
      const bool wide = query % 4 == 0;
      const Box asked = box_of(wide ? 8.0 : 1.0);
      std::vector<std::uint32_t> found;
      space.for_each_image(asked, largest_extent, 0.0, [&](const Box& image, const Vec3&) {
        for (std::uint32_t k = 0; k < images.size(); ++k)
          if (overlap(image, images[k])) found.push_back(k);
      });
      std::sort(found.begin(), found.end());
      const auto repeated = std::adjacent_find(found.begin(), found.end());
      if (!wide) {
        EXPECT_EQ(repeated, found.end());
      }
      for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        const bool seen = std::binary_search(found.begin(), found.end(), k);
        if (overlap_somewhere(space, asked, boxes[k])) {
          EXPECT_TRUE(seen);
          ++hits;
        } else {
          const Vec3 margin = Vec3{1, 1, 1} * 1e-9;
          EXPECT_TRUE(!seen ||
                      overlap_somewhere(space, {asked.lower - margin, asked.upper + margin}, boxes[k]));
        }
      }
    }
    EXPECT_GT(hits, 500u);
  }
}

TEST(Space, ASearchFarAwayOrWithoutEndComesToAnEnd) {
  const Space space = space_of({true, true, true});
  const Box image{{-1, 12, 1}, {-0.5, 12.5, 1.5}};
  for (const double far : {1e6, 1e17, 1e100}) {
    std::size_t found = 0;
    const auto look = [&](const Box& repeated, const Vec3&) { found += overlap(repeated, image) ? 1 : 0; };
    space.for_each_image({{-far, -far, -far}, {far, far, far}}, 0.5, 0.0, look);
    EXPECT_EQ(found, 1u);
    space.for_each_image({{far, far, far}, {far, far, far}}, 0.5, 0.0, look);
  }
}

TEST(Space, APlaneHasNoThirdAxis) {
  const Space space = space_of({true, true, false}, 2);
  EXPECT_TRUE(space.is_flat());
  EXPECT_FALSE(space.repeats(2));
  const Box flat = space.within({{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(flat, (Box{{0, 1, 0}, {3, 4, 0}}));
}

}  // namespace
}  // namespace kinesphere::space_test
