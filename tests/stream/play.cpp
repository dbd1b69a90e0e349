// Plays a whole stream, and shortens one that fails.
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "stream/player.hpp"

namespace kinesphere::stream {

Played play(std::span<const std::uint8_t> bytes) {
  Player player(kind_of(bytes));
  Played played;
  try {
    for (const Operation& operation : operations_of(bytes)) {
      ++played.operations;
      player.perform(operation);
    }
  } catch (const std::runtime_error& error) {
    played.failure = Failure{played.operations - 1, error.what()};
  }
  played.events = player.events();
  return played;
}

Bytes shrunk(Bytes bytes) {
  auto played = play(bytes);
  if (!played.failure) return bytes;
  const std::size_t all = operations_of(bytes).size();
  bytes = without(bytes, played.failure->operation + 1, all);
  for (int fewer = 0; bytes.size() > 3 && fewer < 2 * bytes[3]; ++fewer) {
    Bytes rest = bytes;
    rest[3] = static_cast<std::uint8_t>(fewer);
    if (play(rest).failure) bytes = rest;
  }
  // Removes ever smaller pieces, as long as the rest still fails.
  for (std::size_t length = operations_of(bytes).size() / 2; length > 0; length /= 2) {
    for (bool shorter = true; shorter;) {
      shorter = false;
      for (std::size_t from = 0; from < operations_of(bytes).size();) {
        Bytes rest = without(bytes, from, from + length);
        played = play(rest);
        if (!played.failure) {
          from += length;
          continue;
        }
        bytes = without(rest, played.failure->operation + 1, all);
        shorter = true;
      }
      if (length > 1) break;
    }
  }
  return bytes;
}

std::string story_of(std::span<const std::uint8_t> bytes) {
  const Played played = play(bytes);
  std::ostringstream story;
  if (played.failure)
    story << "operation " << played.failure->operation << ": " << played.failure->what << "\n";
  const std::vector<Operation> operations = operations_of(bytes);
  for (std::size_t k = 0; k < std::min<std::size_t>(operations.size(), 100); ++k)
    story << "  " << Player::name_of(operations[k]) << " (body " << int{operations[k].body()} << ")\n";
  story << "bytes" << std::hex << std::setfill('0');
  for (const std::uint8_t byte : bytes.first(std::min<std::size_t>(bytes.size(), 1204)))
    story << " " << std::setw(2) << int{byte};
  return story.str();
}

}  // namespace kinesphere::stream
