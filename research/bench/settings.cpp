// The extent of the benchmark: every number of it that no option gives.
#include "research/bench/settings.hpp"

namespace kinesphere::program {

const BenchSettings& bench_settings(Effort effort) {
  static const std::vector<std::uint32_t> paper_bodies{500, 1000, 1500, 2000, 2500, 3000, 3500};
  static const std::vector<double> edges{0.35, 0.5, 0.7, 0.85, 1.0, 1.2, 1.4, 2.0, 2.8};
  static const BenchSettings quick{
      .name = "quick",
      .repetitions = 1,
      .figure_bodies = {20, 40},
      .figure_seconds = 0.2,
      .table1 = {{10, 0.2, 2}, {20, 0.1, 1}},
      .miss_seconds = 0.2,
      .circulation_bodies = 50,
      .circulation_seconds = 0.4,
      .snapshot_time = 0.2,
      .sequence_interval = 0.2,
      .growth_scales = {1, 2},
      .growth_seconds = 0.02,
      .growth_bodies = 2000,
      .trimming = {{40, 0.2, 1}},
      .cell_bodies = {40},
      .cell_speeds = {1.0},
      .cell_factors = {0.7, 1.0, 1.4},
      .cell_body_seconds = 4,
  };
  static const BenchSettings usual{
      .name = "usual",
      .repetitions = 3,
      .figure_bodies = paper_bodies,
      .figure_seconds = 4,
      .table1 = {{30, 15, 20}, {100, 15, 20}, {300, 15, 5}, {1000, 2, 5}},
      .miss_seconds = 15,
      .circulation_bodies = 1000,
      .circulation_seconds = 7,
      .snapshot_time = 2,
      .sequence_interval = 1,
      .growth_scales = {1, 2, 3, 5, 7, 10},
      .growth_seconds = 0.1,
      .growth_bodies = 27000,
      .trimming = {{500, 2, 1}, {1000, 1, 1}, {2000, 0.5, 1}},
      .cell_bodies = {250, 1000, 2000},
      .cell_speeds = {0.2, 1.0},
      .cell_factors = edges,
      .cell_body_seconds = 500,
  };
  static const BenchSettings full{
      .name = "full",
      .repetitions = 5,
      .figure_bodies = paper_bodies,
      .figure_seconds = 15,
      .table1 = {{30, 15, 50}, {100, 15, 50}, {300, 15, 50}, {1000, 15, 50}},
      .miss_seconds = 15,
      .circulation_bodies = 1000,
      .circulation_seconds = 7,
      .snapshot_time = 2,
      .sequence_interval = 1,
      .growth_scales = {1, 2, 3, 5, 7, 10},
      .growth_seconds = 0.25,
      .growth_bodies = 125000,
      .trimming = {{500, 15, 1}, {1000, 15, 1}, {2000, 5, 1}, {3500, 2, 1}},
      .cell_bodies = {250, 1000, 2000},
      .cell_speeds = {0.2, 1.0},
      .cell_factors = edges,
      .cell_body_seconds = 5000,
  };
  return chosen(effort, quick, usual, full);
}

}  // namespace kinesphere::program
