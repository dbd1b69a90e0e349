// Netcode with rollback: two ships among rocks. The inputs of the remote player arrive eight frames late.
// In each frame the game goes back to the first frame whose inputs have just become complete, plays it
// again, and those after it with a guess. It ends exactly as a game that had all inputs in time.
#include <kinesphere/kinesphere.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <vector>

using namespace kinesphere;

constexpr double dt = 1.0 / 60;

/// The whole game: a world with its motions, and what the game keeps beside them.
struct Game {
  Simulation bodies;
  MotionId<SteeredMotion> ships;
  MotionId<Ballistic> rocks;
  int hits = 0;
  EventHash hash{};

  Game clone() const { return {bodies.clone().value(), ships, rocks, hits, hash}; }
  void play_frame(int frame, const Vec3& local, const Vec3& remote);
};

Game new_game() {
  Simulation bodies(World::create({.contact_tolerance = 1e-3}).value());
  const auto ships = bodies.add_motion(
      SteeredMotion::create({.start = {{{-6, 0, 0}, {}}, {{6, 0, 0}, {}}}, .acceleration_limits = {20, 20}})
          .value());
  std::vector<State> start;
  for (int k = 0; k < 64; ++k)
    start.push_back({{3.0 * (k % 8) - 10.5, 3.0 * (k / 8) - 10.5, 0}, {std::sin(k), std::cos(k), 0}});
  const auto rocks = bodies.add_motion(Ballistic::create({.start = start}).value());
  bodies.add_all(ships, {.radius = 0.5}).value();
  bodies.add_all(rocks, {.radius = 0.5}).value();
  return {std::move(bodies), ships, rocks};
}

void Game::play_frame(int frame, const Vec3& local, const Vec3& remote) {
  const double now = bodies.world().time();
  bodies.motion(ships).steer(0, now, local).value();
  bodies.motion(ships).steer(1, now, remote).value();
  for (const Event& event : bodies.events(dt * (frame + 1))) {
    hash.add(event);
    if (event.kind != EventKind::contact_begin) continue;
    const bool is_hit =
        bodies.find(event.first)->motion == ships && bodies.find(event.second)->motion == rocks;
    if (is_hit) {
      bodies.remove(event.second).value();
      ++hits;
    } else {
      const Bounce after = bounce(event, 1, 1, 1);
      bodies.set_velocity(event.first, after.first_velocity).value();
      bodies.set_velocity(event.second, after.second_velocity).value();
    }
  }
}

/// What a player does in a frame.
Vec3 input(int player, int frame) {
  const double angle = 0.3 * (frame / 10) * (player + 1);
  return {19 * std::cos(angle), 19 * std::sin(angle), 0};
}

int main() {
  constexpr int frames = 300, delay = 8;
  Game in_time = new_game();
  for (int frame = 0; frame < frames; ++frame) in_time.play_frame(frame, input(0, frame), input(1, frame));

  Game game = new_game();
  std::deque<Game> past;  // before each frame whose remote input is not known yet
  for (int frame = 0; frame < frames + delay; ++frame) {
    const int known = frame - delay;  // the latest frame whose remote input has arrived
    if (known >= 0) {
      game = std::move(past.front());
      past.clear();
    }
    for (int again = known >= 0 ? known : frame; again <= frame && again < frames; ++again) {
      if (again > known) past.push_back(game.clone());
      const int arrived = std::clamp(known, 0, again);  // the guess: the remote player goes on as before
      game.play_frame(again, input(0, again), input(1, arrived));
    }
  }
  std::printf("%d rocks hit in time, %d with inputs eight frames late\n", in_time.hits, game.hits);
  std::printf("hashes of all events: %016llx and %016llx\n",
              static_cast<unsigned long long>(in_time.hash.value()),
              static_cast<unsigned long long>(game.hash.value()));
  return in_time.hits > 0 && game.hits == in_time.hits && game.hash.value() == in_time.hash.value() ? 0 : 1;
}
