// Work and memory of a distributed run, rank by rank.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "kinesphere/distributed/distributed_world.hpp"

namespace kinesphere::program {

struct RankUse {
  RankFigures figures{};
  double processor_seconds = 0.0;    ///< sum over all threads, including those in MPI
  std::uint64_t largest_memory = 0;  ///< resident, in bytes
};

/// Returns the processor time of this process so far.
double processor_seconds();
/// Returns the peak memory of this process so far, in bytes.
std::uint64_t largest_memory();

/// Returns one line for each rank and, if there are several, one for all: the sums, also of memory, and the
/// maxima of parts and rounds.
std::string rank_table(std::span<const RankUse> ranks);

}  // namespace kinesphere::program
