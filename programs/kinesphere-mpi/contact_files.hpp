// Writes the events of a distributed world to one file for all ranks, or one for each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/distributed/distributed_world.hpp"
#include "ranks.hpp"
#include "scenes/contact_log.hpp"

namespace kinesphere::program {

enum class ContactOutput {
  none,
  one_file,       ///< in the order of the events of one World
  file_per_rank,  ///< <path>.<rank>, each with the events with a first body of that rank
};

struct ContactOptions {
  std::string path;
  ContactOutput output = ContactOutput::none;
};

/// Collective functions throw SharedErrors with exit code 1 for a file that cannot be written. Errors of
/// writes appear in sync() and commit().
class ContactFiles {
 public:
  /// Length of each file: one for one_file, one for each rank for file_per_rank.
  using Lengths = std::vector<std::uint64_t>;

  /// Collective. `is_resumable`: see OutputPlace. `kept`: bytes that an earlier run has written, with any
  /// number of ranks; empty if there is none.
  ContactFiles(const Ranks& ranks, const ContactOptions& options, bool is_resumable, const Lengths& kept);

  /// Adds an event of this rank. Not collective.
  void note(const OrderedEvent& event);
  /// Collective. Appends the noted events to the file.
  void write_noted();
  /// Collective. Returns true if noted events wait for write_noted(), and the largest number of them on a
  /// rank.
  bool waits() const { return output_ == ContactOutput::one_file; }
  std::uint64_t most_waiting() const { return ranks_.largest(noted_.size()); }

  /// Collective. Writes all noted events, and flushes them to the disk.
  Lengths sync();
  /// Collective. Gives the files their final names.
  void commit();

 private:
  /// A rank has several files if it continues a run of more ranks.
  struct File {
    std::size_t place;  ///< in Lengths
    std::unique_ptr<ContactLog> log;
  };

  const Ranks& ranks_;
  ContactOutput output_;
  std::size_t file_count_ = 0;  ///< files of all ranks
  std::vector<File> files_;     ///< files of this rank, which writes to the first
  std::vector<OrderedEvent> noted_;
};

}  // namespace kinesphere::program
