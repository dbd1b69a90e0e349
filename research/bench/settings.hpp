// How much the benchmark does: every number of it that no option gives.
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

/// The one of three that belongs to an effort.
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

/// n bodies, simulated for so many seconds from so many seeds (1, 2, ...).
struct Trial {
  std::uint32_t bodies;
  double seconds;
  std::uint64_t seeds;
};

struct BenchSettings {
  std::string_view name;
  int repetitions;  ///< of every run; medians are shown

  std::vector<std::uint32_t> figure_bodies;  ///< figures 5 and 6
  double figure_seconds;

  std::vector<Trial> table1;
  double miss_seconds;  ///< how long fixed steps are held against the oracle

  std::uint32_t circulation_bodies;  ///< section 4.3
  double circulation_seconds;
  double snapshot_time;      ///< of figure 7 (b) and (c)
  double sequence_interval;  ///< between the pictures of figure 8

  std::vector<std::uint32_t> growth_scales;  ///< k: 1000 k^3 bodies in a box of edge 200 k
  double growth_seconds;
  std::uint32_t growth_bodies;  ///< small scenes are run from several seeds, to have as many in all

  std::vector<Trial> trimming;  ///< section 3.3

  std::vector<std::uint32_t> cell_bodies;  ///< densities of the cost model's test
  std::vector<double> cell_speeds;         ///< factors of the paper's speeds
  std::vector<double> cell_factors;        ///< cell edges tried, as factors of the model's choice
  double cell_body_seconds;
};

/// Fixed steps as a game would take them, and longer ones (time).
constexpr double game_step = 1.0 / 60.0;
constexpr double long_step = 0.1;

const BenchSettings& bench_settings(Effort effort);

}  // namespace kinesphere::program
