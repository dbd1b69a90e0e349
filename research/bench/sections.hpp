// The sections of `kinesphere-bench paper`, each about one claim of the paper, and their extent.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "research/bench/benchmark.hpp"

namespace kinesphere::program {

struct PublishedTimes {
  std::uint32_t bodies;
  double proposed;  ///< seconds
  double hubbard;   ///< seconds
  double ratio;     ///< as printed in the paper
};

/// Table 1 of the paper.
constexpr PublishedTimes published_table1[] = {
    {30, 0.00576, 0.94064, 163.3056},
    {100, 0.02776, 13.36050, 481.2860},
    {300, 0.15844, 150.28884, 948.5537},
    {1000, 1.37200, 2767.82990, 2017.3687},
};

/// Section 4.3 of the paper: 1000 circulating particles (seconds).
constexpr double published_circulation = 2.846;

inline std::optional<PublishedTimes> published_times(std::uint32_t bodies) {
  for (const PublishedTimes& row : published_table1)
    if (row.bodies == bodies) return row;
  return std::nullopt;
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

void bench_figure5(const Report& report, const BenchSettings& settings);
void bench_figure6(const Report& report, const BenchSettings& settings);
void bench_table1(const Report& report, const BenchSettings& settings);
void bench_circulation(const Report& report, const BenchSettings& settings);
void bench_growth(const Report& report, const BenchSettings& settings);
void bench_trimming(const Report& report, const BenchSettings& settings);
void bench_cells(const Report& report, const BenchSettings& settings);

}  // namespace kinesphere::program
