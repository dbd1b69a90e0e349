// The events of a distributed world in files: one for all ranks, or one for each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact_log.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "ranks.hpp"

namespace kinesphere::program {

enum class ContactOutput {
  none,
  one_file,       ///< in the order in which one World tells the events
  file_per_rank,  ///< <path>.<rank>, each with the events whose first body was that rank's
};

struct ContactOptions {
  std::string path;
  ContactOutput output = ContactOutput::none;
};

/// Errors of collective functions are SharedErrors with exit code 1: a file that cannot be written. What a
/// write meets is told by sync() and commit().
class ContactFiles {
 public:
  /// How long each file is: one for one_file, one for each rank for file_per_rank.
  using Lengths = std::vector<std::uint64_t>;

  /// Collective. `is_resumable`: see OutputPlace. `kept`: what an earlier run has written, by any number of
  /// ranks; empty for none.
  ContactFiles(const Ranks& ranks, const ContactOptions& options, bool is_resumable, const Lengths& kept);

  /// Not collective: an event of this rank.
  void note(const OrderedEvent& event);
  /// Collective. Writes the events that have been noted, after all that was written before.
  void write_noted();
  /// Collective. Whether, and how many at most on one rank, noted events wait for write_noted().
  bool waits() const { return output_ == ContactOutput::one_file; }
  std::uint64_t most_waiting() const { return ranks_.largest(noted_.size()); }

  /// Collective. All that was noted is written, and on the disk.
  Lengths sync();
  /// Collective. The files appear under their names.
  void commit();

 private:
  /// A rank that goes on after more ranks than there are now has several.
  struct File {
    std::size_t place;  ///< in Lengths
    std::unique_ptr<ContactLog> log;
  };

  const Ranks& ranks_;
  ContactOutput output_;
  std::size_t file_count_ = 0;  ///< of all ranks
  std::vector<File> files_;     ///< of this rank, which writes to the first
  std::vector<OrderedEvent> noted_;
};

}  // namespace kinesphere::program
