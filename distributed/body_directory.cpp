#include "distributed/body_directory.hpp"

#include <algorithm>
#include <utility>

namespace kinesphere {

std::optional<std::uint32_t> BodyDirectory::find(std::uint32_t name) const {
  const auto found = numbers_.find(name);
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

bool BodyDirectory::is_held(std::uint32_t number, int by) const {
  const std::vector<int>& holders = entries_[number].holders;
  return std::find(holders.begin(), holders.end(), by) != holders.end();
}

bool BodyDirectory::add_holder(std::uint32_t number, int rank) {
  if (is_held(number, rank)) return false;
  entries_[number].holders.push_back(rank);
  return true;
}

void BodyDirectory::add(std::uint32_t name, std::uint32_t number, int owner) {
  numbers_.emplace(name, number);
  if (number >= entries_.size()) {
    entries_.resize(number + std::size_t{1});
    are_ghosts_.resize(entries_.size());
  }
  entries_[number] = {.owner = owner};
  if (owner == rank_) return;
  are_ghosts_[number] = 1;
  entries_[number].place = static_cast<std::uint32_t>(ghosts_.size());
  ghosts_.push_back(number);
}

void BodyDirectory::remove(std::uint32_t name, std::uint32_t number) {
  numbers_.erase(name);
  const std::uint32_t place = std::exchange(entries_[number], {}).place;
  if (is_own(number)) return;
  are_ghosts_[number] = 0;
  // The last ghost in the list moves to the vacated position.
  ghosts_[place] = ghosts_.back();
  entries_[ghosts_[place]].place = place;
  ghosts_.pop_back();
}

}  // namespace kinesphere
