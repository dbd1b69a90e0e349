// HomeBalls finds exactly the balls that touch, of all sizes, after additions and removals.
#include "monitor/home_balls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::home_balls_test {
namespace {

HomeBall random_ball(Random& random, double box, double octaves) {
  return {{random.uniform(-box, box), random.uniform(-box, box), random.uniform(-box, box)},
          std::exp2(random.uniform(-octaves, octaves))};
}

TEST(HomeBalls, FindWhatABruteForceSearchFinds) {
  for (const double octaves : {0.0, 3.0, 12.0})
    for (const double box : {0.0, 8.0, 1e4}) {
      SCOPED_TRACE(testing::Message() << "sizes of 2^+-" << octaves << " in a box of " << box);
      Random random(43);
      HomeBalls balls;
      std::map<std::uint32_t, HomeBall> all;
      for (int step = 0; step < 2'000; ++step) {
        const HomeBall ball = random_ball(random, box, octaves);
        const auto number = static_cast<std::uint32_t>(random.bits() % 500);
        if (const auto [at, is_new] = all.try_emplace(number, ball); is_new) {
          balls.add(number, ball);
        } else {
          balls.remove(number);
          all.erase(at);
        }
        std::vector<std::uint32_t> touching;
        for (const auto& [other, its_ball] : all)
          if (touch(its_ball, ball)) touching.push_back(other);
        ASSERT_EQ(balls.touching(ball), touching) << "step " << step;
      }
    }
}

}  // namespace
}  // namespace kinesphere::home_balls_test
