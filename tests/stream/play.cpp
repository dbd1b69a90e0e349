// Plays a whole stream, and shortens one that fails.
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "stream/player.hpp"

namespace kinesphere::stream {

Played play(std::span<const std::uint8_t> bytes) {
  Played played;
  std::optional<Player> player;
  try {
    player.emplace(scenario_of(bytes));
    for (const Operation& operation : operations_of(bytes)) {
      ++played.operations;
      player->perform(operation);
    }
    player->finish();
  } catch (const CutShort&) {
    played.cut_short = true;
  } catch (const std::exception& error) {
    played.failure = error.what();
  }
  if (player) {
    played.tally = player->tally();
    played.story = player->story();
  }
  return played;
}

std::vector<std::byte> snapshot_after(std::span<const std::uint8_t> bytes) {
  Player player(scenario_of(bytes));
  try {
    for (const Operation& operation : operations_of(bytes)) player.perform(operation);
  } catch (const CutShort&) {
  }
  return player.world().save().value();
}

Bytes shrunk(Bytes bytes) {
  const auto try_instead = [&](const Bytes& smaller) {
    const Played played = play(smaller);
    if (played.failure) bytes = without(smaller, played.operations, operations_of(smaller).size());
    return played.failure.has_value();
  };
  if (!try_instead(bytes)) return bytes;
  for (std::size_t k = 0; k < features().size(); ++k)
    if (scenario_of(bytes).*features()[k].is_on) try_instead(without_feature(bytes, k));
  for (const int most : {1, 2, 3, 5, 8, 12})
    if (scenario_of(bytes).bodies > most && try_instead(with_bodies(bytes, most))) break;
  // Removes ever smaller pieces, as long as the rest still fails.
  for (std::size_t length = operations_of(bytes).size() / 2; length > 0; length /= 2)
    for (std::size_t from = 0; from < operations_of(bytes).size();)
      if (!try_instead(without(bytes, from, from + length))) from += length;
  return bytes;
}

std::string story_of(std::span<const std::uint8_t> bytes) {
  const Played played = play(bytes);
  std::ostringstream story;
  story << "operation " << played.operations << ": " << played.failure.value_or("no failure") << "\n"
        << scenario_of(bytes).text() << played.story << "\nbytes" << std::hex << std::setfill('0');
  for (const std::uint8_t byte : bytes.first(std::min<std::size_t>(bytes.size(), 1204)))
    story << " " << std::setw(2) << int{byte};
  return story.str();
}

}  // namespace kinesphere::stream
