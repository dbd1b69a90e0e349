// Checkpoints of a distributed run: a folder with a numbered folder for each, which contains
//   part-<rank>   the bytes of DistributedWorld::save() on that rank
//   run.json      the rest of the run's state, with a checksum
// An incomplete checkpoint is called <number>.tmp, and one that could not be restored <number>.refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "contact_files.hpp"
#include "ranks.hpp"

namespace kinesphere::program {

/// State of a run besides its world, for a later run to continue.
struct RunState {
  std::string scene;  ///< all that the world depends on
  double time = 0.0;
  std::uint64_t parts = 0;              ///< number of parts of the world
  std::array<std::uint64_t, 2> hash{};  ///< EventHash::parts(): the second is the number of events
  ContactOutput contacts = ContactOutput::none;
  ContactFiles::Lengths contact_lengths{};

  friend bool operator==(const RunState&, const RunState&) = default;
};

/// Precondition: all ranks see the same folder. All functions but path() are collective. They throw
/// SharedErrors with exit code 1, which name a file and the system's reason.
class CheckpointFolder {
 public:
  using Part = std::vector<std::byte>;

  /// Throws with exit_wrong_input if another run uses the folder.
  CheckpointFolder(const Ranks& ranks, std::string folder);

  /// Writes a checkpoint: this rank's part, and `state`, equal on all ranks. It appears under its number once
  /// it is complete and on the disk; then all but it and the one before are deleted.
  void write(const Part& part, const RunState& state);
  /// Returns the numbers of the complete checkpoints, the newest first.
  std::vector<std::uint64_t> latest() const;
  /// Throws if the data are damaged.
  RunState read_state(std::uint64_t number) const;
  /// Reads each part on one of the ranks. An unreadable part is left out; restoring will detect that.
  std::vector<Part> read_parts(std::uint64_t number, const RunState& state) const;
  /// Renames a checkpoint that cannot be restored, so that its number is free.
  void set_aside(std::uint64_t number);

  std::string path(std::uint64_t number) const;

 private:
  void write_unfinished(const std::string& folder, const Part& part, const RunState& state) const;

  const Ranks& ranks_;
  std::string folder_;
  std::uint64_t next_ = 1;      ///< the number of the next one
  std::shared_ptr<void> lock_;  ///< of the first rank
};

}  // namespace kinesphere::program
