#include "number/roots.hpp"

#include <gtest/gtest.h>

namespace kinesphere::roots_test {
namespace {

TEST(CubeRoot, IsRightToTheLastBits) {
  for (const double root : {1e-30, 0.001, 0.5, 1.0, 3.0, 1e20}) {
    EXPECT_NEAR(cube_root(root * root * root), root, 4e-16 * root);
  }
}

}  // namespace
}  // namespace kinesphere::roots_test
