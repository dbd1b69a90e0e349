// Records the run of an example whose calls are linked to these functions (ld --wrap), for games.py. The game
// that it plays longest is written to the file that the environment variable KINESPHERE_RECORDING names.
#include <cstdlib>
#include <fstream>

#include "kinesphere/game_world.hpp"

namespace kinesphere {

// GameWorld::create() and ~GameWorld() as the library has them, and in their place.
Result<GameWorld> real_create(const GameDefinition& definition) __asm__(
    "__real__ZN10kinesphere9GameWorld6createERKNS_14GameDefinitionE");
Result<GameWorld> recorded_create(const GameDefinition& definition) __asm__(
    "__wrap__ZN10kinesphere9GameWorld6createERKNS_14GameDefinitionE");
void real_destroy(GameWorld* game) __asm__("__real__ZN10kinesphere9GameWorldD1Ev");
void recorded_destroy(GameWorld* game) __asm__("__wrap__ZN10kinesphere9GameWorldD1Ev");

namespace {

/// Writes the recording of a game that ends, if there is one, and none of a longer game.
void write_recording(GameWorld& game) {
  static double longest = 0.0;
  try {
    const auto bytes = game.world().stop_recording();
    if (!bytes || game.time() <= longest) return;
    longest = game.time();
    std::ofstream file(std::getenv("KINESPHERE_RECORDING"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
  } catch (const BadResult&) {
    // The game has been moved from.
  }
}

}  // namespace

Result<GameWorld> recorded_create(const GameDefinition& definition) {
  Result<GameWorld> game = real_create(definition);
  if (game && std::getenv("KINESPHERE_RECORDING") != nullptr) game->world().start_recording().value();
  return game;
}

void recorded_destroy(GameWorld* game) {
  write_recording(*game);
  real_destroy(game);
}

}  // namespace kinesphere
