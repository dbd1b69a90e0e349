// No two bodies of a distributed world have the same name, wherever they are added.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "distributed/communicator.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// Each rank compares a share of all names: those that leave the same remainder.
class UniqueNames {
 public:
  /// A body of this name has been added on this rank, or has been restored there.
  void add(std::uint32_t name) { new_.push_back(name); }
  /// Collective. Compares the names that have been added since the last call with all others. Of two that are
  /// the same, the rank that compares them returns an error, and the other ranks do not.
  Result<void> check(Communicator& communicator);

 private:
  std::vector<std::uint32_t> new_;              ///< of this rank, not compared yet
  std::unordered_set<std::uint32_t> compared_;  ///< of all ranks, this rank's share
};

}  // namespace kinesphere
