// The bodies that a rank knows, which are its own and copies of others: their numbers here, by name; who owns
// each of them; which other ranks have copies of own ones.
//
// A body has the same name on all ranks (BodyTable), and a number of each rank's own.
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
    int owner = 0;                ///< the rank whose body it is
    std::uint32_t in_motion = 0;  ///< its number in this rank's motion
    /// What it has taken since space was divided last, in looks at pairs and windows' starts.
    float cost = 0.0f;
    std::uint32_t place = 0;     ///< of a copy: where it stands in copies()
    std::vector<int> holders{};  ///< of an own body: the other ranks that have a copy
  };

  explicit BodyDirectory(int rank) : rank_(rank) {}

  /// The number of the body of this name, if it is known.
  std::optional<std::uint32_t> find(std::uint32_t name) const;
  bool empty() const { return numbers_.empty(); }
  std::size_t own_count() const { return numbers_.size() - ghosts_.size(); }
  /// The numbers of all copies, in no order.
  std::span<const std::uint32_t> ghosts() const { return ghosts_; }
  /// By number: 1 for a copy, 0 for all others.
  const std::vector<std::uint8_t>& are_ghosts() const { return are_ghosts_; }

  // By a number that is that of a known body.
  Entry& operator[](std::uint32_t number) { return entries_[number]; }
  const Entry& operator[](std::uint32_t number) const { return entries_[number]; }
  bool is_own(std::uint32_t number) const { return are_ghosts_[number] == 0; }
  bool is_held(std::uint32_t number, int by) const;
  /// False if that rank has a copy already.
  bool add_holder(std::uint32_t number, int rank);

  /// A body has become known.
  void add(std::uint32_t name, std::uint32_t number, int owner);
  /// It is known no longer.
  void remove(std::uint32_t name, std::uint32_t number);

 private:
  int rank_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;  ///< by name
  std::vector<Entry> entries_;                                ///< by number
  std::vector<std::uint8_t> are_ghosts_;                      ///< by number
  std::vector<std::uint32_t> ghosts_;
};

}  // namespace kinesphere
