// Hand-tuned fixed-step detectors, and Bullet's, against all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "research/bench/speed/bullet_kernel.hpp"
#include "research/bench/speed/step_kernel.hpp"
#include "research/bench/speed/tuned_kernels.hpp"
#include "research/bench/speed/tuning.hpp"

namespace kinesphere::program::step_kernels_test {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Swarm moves spheres between walls. They may overlap.
class Swarm {
 public:
  Swarm(std::size_t size, float largest_radius, double speed, std::uint64_t seed) : random_(seed) {
    for (std::size_t at = 0; at < size; ++at) {
      // Every tenth sphere has the largest radius: pairs of equal ones must not be lost.
      const double part = at % 10 == 0 ? 1.0 : random_.uniform(0.02, 1.0);
      radii.push_back(largest_radius * static_cast<float>(part));
      positions_.push_back(50.0 * random_.point_in_ball());
      velocities_.push_back(speed * random_.unit_vector());
    }
    move();
    before_ = now_;
  }

  void move() {
    before_ = now_;
    for (auto& axis : now_) axis.assign(radii.size(), 0.0f);
    for (std::size_t at = 0; at < radii.size(); ++at) {
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(positions_[at][axis]) > 50.0) velocities_[at][axis] *= -1.0;
        now_[static_cast<std::size_t>(axis)][at] = static_cast<float>(positions_[at][axis]);
      }
      positions_[at] += velocities_[at];
    }
  }

  Frame before() const { return {before_[0].data(), before_[1].data(), before_[2].data()}; }
  Frame now() const { return {now_[0].data(), now_[1].data(), now_[2].data()}; }

  Pairs all_pairs(SphereTest test) const {
    Pairs pairs;
    for (std::uint32_t b = 0; b < radii.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a) {
        const float reach = radii[a] + radii[b];
        if (test == SphereTest::swept ? touch_between(before(), now(), reach, a, b)
                                      : touch_at(now(), reach, a, b))
          pairs.emplace_back(a, b);
      }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  std::vector<float> radii;

 private:
  Random random_;
  std::vector<Vec3> positions_, velocities_;
  std::array<std::vector<float>, 3> before_, now_;
};

Pairs found_by(StepKernel& kernel, const Swarm& swarm) {
  std::vector<SpherePair> touching;
  kernel.look(swarm.before(), swarm.now(), touching);
  Pairs pairs;
  for (const SpherePair& pair : touching)
    pairs.emplace_back(std::min(pair.first, pair.second), std::max(pair.first, pair.second));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::unique_ptr<StepKernel>> kernels_for(const std::vector<float>& radii, SphereTest test) {
  std::vector<std::unique_ptr<StepKernel>> kernels;
  for (const float edge : {0.5f, 5.0f, 40.0f, 500.0f}) {
    for (const StripOrder order : {StripOrder::forward, StripOrder::smaller}) {
      const StripSettings strips{edge, 0.3f * edge, order};
      kernels.push_back(make_grid_kernel(radii, strips, test));
      for (const float skin : {0.01f, 1.0f, 10.0f})
        for (const float steps : {0.0f, 4.0f})
          kernels.push_back(make_verlet_kernel(radii, {strips, skin, steps}, test));
    }
  }
  if (test == SphereTest::at_steps) {
    kernels.push_back(make_bullet_kernel(radii));
    kernels.push_back(make_bullet_kernel(radii, 2.0f));
  }
  std::erase(kernels, nullptr);
  return kernels;
}

using Case = std::tuple<SphereTest, std::size_t, float, double>;
class StepKernels : public ::testing::TestWithParam<Case> {};

TEST_P(StepKernels, FindWhatAllPairsFind) {
  const auto [test, size, largest_radius, speed] = GetParam();
  Swarm swarm(size, largest_radius, speed, 7);
  const auto kernels = kernels_for(swarm.radii, test);
  std::size_t found = 0;
  for (int step = 0; step < 12; ++step) {
    const Pairs truth = swarm.all_pairs(test);
    found += truth.size();
    for (const auto& kernel : kernels)
      ASSERT_EQ(found_by(*kernel, swarm), truth) << kernel->name() << ", " << step;
    swarm.move();
  }
  if (size > 2) {
    EXPECT_GT(found, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Swarms, StepKernels,
                         ::testing::Combine(::testing::Values(SphereTest::at_steps, SphereTest::swept),
                                            ::testing::Values(1u, 2u, 17u, 200u),
                                            ::testing::Values(8.0f, 25.0f), ::testing::Values(0.3, 20.0)));

TEST(WallCheck, FindsThoseThatReachOut) {
  Swarm swarm(300, 6.0f, 1.0, 3);
  const Box box{{-40, -45, -50}, {45, 40, 35}};
  std::vector<std::uint32_t> expected, found;
  const Frame now = swarm.now();
  for (std::uint32_t at = 0; at < swarm.radii.size(); ++at) {
    const Vec3 centre{now.x[at], now.y[at], now.z[at]};
    bool out = false;
    for (int axis = 0; axis < 3; ++axis)
      out = out || centre[axis] - swarm.radii[at] < box.lower[axis] ||
            centre[axis] + swarm.radii[at] > box.upper[axis];
    if (out) expected.push_back(at);
  }
  find_at_walls(now, swarm.radii, box, found);
  EXPECT_GT(expected.size(), 20u);
  EXPECT_LT(expected.size(), 280u);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace kinesphere::program::step_kernels_test
