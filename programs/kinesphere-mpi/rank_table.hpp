// Where the work and the memory of a distributed run went, rank by rank.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "kinesphere/distributed/distributed_world.hpp"

namespace kinesphere::program {

struct RankUse {
  RankFigures figures{};
  double processor_seconds = 0.0;    ///< of all threads, with those in MPI
  std::uint64_t largest_memory = 0;  ///< resident, in bytes
};

/// Processor time of this process so far.
double processor_seconds();
/// The most memory that this process has had so far, in bytes.
std::uint64_t largest_memory();

/// One line for each rank, and one for all where there are several: their sum, of the memory too, but the
/// most parts and rounds.
std::string rank_table(std::span<const RankUse> ranks);

}  // namespace kinesphere::program
