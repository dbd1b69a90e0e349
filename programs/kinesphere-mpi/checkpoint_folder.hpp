// Checkpoints of a distributed run: a folder with a numbered folder for each, in which there are
//   part-<rank>   what DistributedWorld::save() has given on that rank
//   run.json      what else is needed to go on, with a checksum
// One that is being written is called <number>.tmp, and one from which no world could be restored
// <number>.refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contact_files.hpp"
#include "ranks.hpp"

namespace kinesphere::program {

/// What a run needs to go on, besides its world.
struct RunState {
  std::string scene;  ///< all that the world depends on
  double time = 0.0;
  std::uint64_t parts = 0;              ///< of the world
  std::array<std::uint64_t, 2> hash{};  ///< EventHash::parts(): the second is the number of events
  ContactOutput contacts = ContactOutput::none;
  ContactFiles::Lengths contact_lengths{};

  friend bool operator==(const RunState&, const RunState&) = default;
};

/// The folder has to be the same one on all ranks. All functions but path() are collective. They throw
/// SharedErrors with exit code 1, which name a file and the system's reason.
class CheckpointFolder {
 public:
  using Part = std::vector<std::byte>;

  CheckpointFolder(const Ranks& ranks, std::string folder);

  /// Writes a checkpoint: this rank's part, and `state`, the same on all ranks. When it is complete and on
  /// the disk, it appears under its number, and all but it and the one before are deleted.
  void write(const Part& part, const RunState& state);
  /// The numbers of the complete checkpoints, the newest first.
  std::vector<std::uint64_t> latest() const;
  /// Throws where what is read is damaged.
  RunState read_state(std::uint64_t number) const;
  /// Each part on one of the ranks. One that cannot be read is left out, as restoring will notice.
  std::vector<Part> read_parts(std::uint64_t number, const RunState& state) const;
  /// A checkpoint that cannot be gone on from gets out of the way of those to come.
  void set_aside(std::uint64_t number);

  std::string path(std::uint64_t number) const;

 private:
  void write_unfinished(const std::string& folder, const Part& part, const RunState& state) const;

  const Ranks& ranks_;
  std::string folder_;
  std::uint64_t next_ = 1;  ///< the number of the next one
};

}  // namespace kinesphere::program
