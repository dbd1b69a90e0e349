// BodyDirectory lists the bodies that a rank holds, own bodies and ghosts: number by name, owner of each, and
// which other ranks hold ghosts of own bodies.
//
// A body has one name on all ranks (BodyTable) and a separate number on each rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace kinesphere {

class BodyDirectory {
 public:
  struct Entry {
    int owner = 0;                ///< rank that owns the body
    std::uint32_t in_motion = 0;  ///< number in this rank's motion
    /// Work since the last partition, counted in pair rechecks and window starts.
    float cost = 0.0f;
    std::uint32_t place = 0;     ///< ghosts only: position in ghosts()
    std::vector<int> holders{};  ///< own bodies only: other ranks that hold a ghost
  };

  explicit BodyDirectory(int rank) : rank_(rank) {}

  /// Returns the number of the body of this name, or nullopt if this rank does not hold it.
  std::optional<std::uint32_t> find(std::uint32_t name) const;
  bool empty() const { return numbers_.empty(); }
  std::size_t own_count() const { return numbers_.size() - ghosts_.size(); }
  /// Numbers of all ghosts, unordered. Invalidated by add() and remove().
  std::span<const std::uint32_t> ghosts() const { return ghosts_; }
  /// By number: 1 for a ghost, 0 otherwise.
  const std::vector<std::uint8_t>& are_ghosts() const { return are_ghosts_; }

  // Precondition of the following functions: this rank holds the body of this number.
  Entry& operator[](std::uint32_t number) { return entries_[number]; }
  const Entry& operator[](std::uint32_t number) const { return entries_[number]; }
  bool is_own(std::uint32_t number) const { return are_ghosts_[number] == 0; }
  bool is_held(std::uint32_t number, int by) const;
  /// Records that `rank` holds a ghost. Returns false if it does already.
  bool add_holder(std::uint32_t number, int rank);

  /// Adds an entry for a body that this rank now holds.
  void add(std::uint32_t name, std::uint32_t number, int owner);
  /// Removes the entry of a body that this rank no longer holds.
  void remove(std::uint32_t name, std::uint32_t number);

 private:
  int rank_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;  ///< by name
  std::vector<Entry> entries_;                                ///< by number
  std::vector<std::uint8_t> are_ghosts_;                      ///< by number
  std::vector<std::uint32_t> ghosts_;
};

}  // namespace kinesphere
