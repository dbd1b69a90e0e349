// Random worlds with all features mixed, compared with the true motion in long double. Another range of
// seeds:
//   KINESPHERE_SEEDS=1000-1999 build/ci/tests/test_mixed_worlds
#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "mixed_worlds/player.hpp"

namespace kinesphere::mixed_worlds_test {
namespace {

using namespace mixed;

struct Range {
  std::uint64_t first, last;
};

/// Returns the wanted seeds, FIRST-LAST or one.
Range seeds() {
  const char* const wanted = std::getenv("KINESPHERE_SEEDS");
  if (wanted == nullptr) return {1, 96};
  const std::string text = wanted;
  const std::size_t dash = text.find('-');
  const std::uint64_t first = std::stoull(text);
  return {first, dash == std::string::npos ? first : std::stoull(text.substr(dash + 1))};
}

struct Played {
  Tally tally;
  std::optional<std::string> failure;
  std::string story;
};

Played play(const Scenario& scenario) {
  Played played;
  std::optional<Player> player;
  try {
    player.emplace(scenario);
    player->play();
  } catch (const std::exception& exception) {
    played.failure = exception.what();
  }
  if (player) {
    played.tally = player->tally();
    played.story = player->story();
  }
  return played;
}

/// Returns a scenario that fails, too, with as few features, bodies and stops as leaving out one after
/// another finds.
Scenario shrunk(Scenario scenario) {
  const auto try_change = [&](auto change) {
    Scenario smaller = scenario;
    change(smaller);
    if (smaller.text() != scenario.text() && play(smaller).failure) scenario = smaller;
  };
  for (int round = 0; round < 2; ++round) {
    for (const Feature& feature : features())
      try_change([&](Scenario& smaller) { smaller.*feature.is_on = false; });
    for (const int count : {1, 2, 3, 5, 8, 12}) {
      try_change([&](Scenario& smaller) { smaller.stops = std::min(smaller.stops, count); });
      try_change([&](Scenario& smaller) { smaller.bodies = std::min(smaller.bodies, count); });
    }
  }
  return scenario;
}

TEST(MixedWorlds, AgreeWithTheTruth) {
  const auto [first, last] = seeds();
  Tally total;
  std::size_t cut_short = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const Scenario scenario = draw_scenario(seed);
    const Played played = play(scenario);
    total.events += played.tally.events;
    total.begins += played.tally.begins;
    total.answers += played.tally.answers;
    cut_short += played.tally.cut_short;
    if (!played.failure) continue;
    const Scenario smaller = shrunk(scenario);
    const Played again = play(smaller);
    ADD_FAILURE() << "seed " << seed << ": " << *played.failure << "\n"
                  << scenario.text() << "\nshrunk to " << smaller.text() << ": " << *again.failure
                  << again.story;
  }
  const std::size_t count = last - first + 1;
  std::cout << count << " worlds: " << total.events << " events, " << total.begins << " begins, "
            << total.answers << " answers, " << cut_short << " worlds cut short\n";
  if (count < 96) return;
  EXPECT_GT(total.begins, 20 * count) << "too little happens";
  EXPECT_GT(total.answers, 100 * count);
  EXPECT_LT(cut_short, count / 4);
}

}  // namespace
}  // namespace kinesphere::mixed_worlds_test
