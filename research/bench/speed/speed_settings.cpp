#include "research/bench/speed/speed_settings.hpp"

namespace kinesphere::program {

const SpeedSettings& speed_settings(Effort effort) {
  static constexpr SpeedSettings quick{.name = "quick",
                                       .repetitions = 1,
                                       .least_turn = 0.0,
                                       .divide = 100,
                                       .shorten = 0.1,
                                       .most_bodies = 2000,
                                       .most_with_rivals = 2000,
                                       .most_recorded = 50'000,
                                       .most_looked = 200'000};
  static constexpr SpeedSettings usual{.name = "usual",
                                       .repetitions = 3,
                                       .least_turn = 0.05,
                                       .divide = 1,
                                       .shorten = 1.0,
                                       .most_bodies = 1'000'000,
                                       .most_with_rivals = 108'000,
                                       .most_recorded = 15'000'000,
                                       .most_looked = 130'000'000};
  static constexpr SpeedSettings full{.name = "full",
                                      .repetitions = 5,
                                      .least_turn = 0.1,
                                      .divide = 1,
                                      .shorten = 1.0,
                                      .most_bodies = 1'000'000,
                                      .most_with_rivals = 1'000'000,
                                      .most_recorded = 60'000'000,
                                      .most_looked = 400'000'000};
  return chosen(effort, quick, usual, full);
}

}  // namespace kinesphere::program
