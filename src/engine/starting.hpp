// The steps by which windows start: who is asked before, which windows suit, and what searches find.
//
// An engine takes them in this order. One that has a part of the bodies learns in between what the others
// have (distributed/).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/island.hpp"
#include "engine/tables.hpp"
#include "parallel/crew.hpp"

namespace kinesphere {

/// Where so many have arrived since windows started, among so many, all start anew with them.
constexpr bool are_many(std::size_t arrived, std::size_t all) { return arrived > 8 && 8 * arrived > all; }

class Starting {
 public:
  /// `found`, by worker, is kept for its memory only.
  Starting(Tables& tables, Island& everybody, Shift& shift, std::vector<FoundPairs>& found)
      : tables_(tables), everybody_(everybody), shift_(shift), found_(found) {}

  /// Bodies of which nothing is known yet.
  Survey survey(std::span<const std::uint32_t> numbers) const;
  /// The first main window lets most of them go about a quarter of the distance between them.
  void choose_tempo(const Survey& survey);

  /// Of bodies whose windows end, probes those for whom a larger capsule would cost more.
  Result<void> refresh(std::span<const std::uint32_t> ending);
  /// The windows that suit bodies which are in none, other than those of the tiers `held`
  /// (Window::free_at). For some there may be no window: they are dirty then.
  std::vector<Windows::Starter> choose_windows(std::span<const std::uint32_t> numbers,
                                               std::span<const int> held, Tempo::Round& round);
  /// They get capsules, and all pairs that may change before a window ends become hot. Returns how many pairs
  /// are near. With `others`, by number, pairs are not counted whose first body is one of these.
  std::uint64_t start(std::span<const Windows::Starter> starters,
                      const std::vector<std::uint8_t>* others = nullptr);

 private:
  std::uint64_t find_pairs(const std::vector<std::uint8_t>* others);
  void find_links_and_walls(std::span<const Windows::Starter> starters);
  Bodies& bodies() { return tables_.bodies; }
  const Bodies& bodies() const { return tables_.bodies; }
  double time() const { return everybody_.time(); }

  Tables& tables_;
  Island& everybody_;
  Shift& shift_;
  std::vector<FoundPairs>& found_;
};

}  // namespace kinesphere
