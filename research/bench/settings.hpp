// The extent of the benchmark: every number of it that no option gives.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace kinesphere::program {

enum class Effort {
  quick,  ///< seconds: shows that everything works, no more
  usual,  ///< minutes
  full,   ///< an hour or more: the paper's own lengths and repetitions
};

/// Returns the settings that belong to an effort.
template <class Settings>
const Settings& chosen(Effort effort, const Settings& quick, const Settings& usual, const Settings& full) {
  switch (effort) {
    case Effort::quick:
      return quick;
    case Effort::full:
      return full;
    case Effort::usual:
      break;
  }
  return usual;
}

/// A number of bodies, simulated for a number of seconds from each of the seeds 1, 2, ... `seeds`.
struct Trial {
  std::uint32_t bodies;
  double seconds;
  std::uint64_t seeds;
};

struct BenchSettings {
  std::string_view name;
  int repetitions;  ///< repetitions of every run; medians are shown

  std::vector<std::uint32_t> figure_bodies;  ///< for figures 5 and 6
  double figure_seconds;

  std::vector<Trial> table1;
  double miss_seconds;  ///< time for which fixed steps are compared with the oracle

  std::uint32_t circulation_bodies;  ///< for section 4.3
  double circulation_seconds;
  double snapshot_time;      ///< time of figure 7 (b) and (c)
  double sequence_interval;  ///< time between the pictures of figure 8

  std::vector<std::uint32_t> growth_scales;  ///< k: 1000 k^3 bodies in a box of edge 200 k
  double growth_seconds;
  std::uint32_t growth_bodies;  ///< total of bodies; small scenes are run from several seeds to reach it

  std::vector<Trial> trimming;  ///< for section 3.3

  std::vector<std::uint32_t> cell_bodies;  ///< densities in the test of the cost model
  std::vector<double> cell_speeds;         ///< factors of the paper's speeds
  std::vector<double> cell_factors;        ///< cell edges tried, as factors of the model's choice
  double cell_body_seconds;
};

/// Time steps: one as a game would take it, and a longer one (time).
constexpr double game_step = 1.0 / 60.0;
constexpr double long_step = 0.1;

const BenchSettings& bench_settings(Effort effort);

}  // namespace kinesphere::program
