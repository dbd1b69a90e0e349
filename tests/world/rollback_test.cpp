// Rollback as in games: a copy of the world each frame; for late input, back to its frame and forward again.
#include <gtest/gtest.h>

#include <deque>

#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere::rollback_test {
namespace {

constexpr double frame = 1.0 / 60.0;

/// 300 bouncing bodies; the whole state can be copied.
class Game {
 public:
  Game() {
    Random random(2005);
    for (int k = 0; k < 300; ++k) {
      const Vec3 place{1.5 + 3.0 * (k % 7), 1.5 + 3.0 * (k / 7 % 7), 1.5 + 3.0 * (k / 49)};
      const State state{place, 8.0 * random.point_in_ball()};
      const Vec3 acceleration = 3.0 * random.point_in_ball();
      world_
          .add({.radius = 0.9,
                .acceleration_limit = 3.0,
                .position = state.position,
                .velocity = state.velocity})
          .value();
      courses_.push_back({0.0, state, acceleration});
    }
  }

  /// A player's input for one of the bodies at the start of the frame.
  void push(std::uint32_t body) {
    set_velocity({body, 0}, courses_[body].at(world_.time()).velocity + Vec3{0, 0, 5});
  }

  void play_frame() {
    const double until = frame * ++frames_;
    while (const auto event = world_
                                  .advance(until,
                                           [this](auto ids, double time, auto states) {
                                             for (std::size_t k = 0; k < ids.size(); ++k)
                                               states[k] = courses_[ids[k].index].at(time);
                                           })
                                  .value()) {
      hash_.add(*event);
      if (event->approach_speed <= 0.0) continue;
      const Bounce after = bounce(*event, 1.0, 1.0, 1.0);
      set_velocity(event->first, after.first_velocity);
      if (event->second != no_body) set_velocity(event->second, after.second_velocity);
    }
  }

  Game copy() const { return Game(*this, world_.clone().value()); }
  Game stored() const { return Game(*this, World::restore(world_.save().value()).value()); }

  std::uint64_t hash() const { return hash_.value(); }
  std::vector<std::byte> bytes() const { return world_.save().value(); }
  std::uint64_t contacts() const { return world_.counters().count(EventKind::contact_begin); }

 private:
  Game(const Game& from, World world)
      : world_(std::move(world)), courses_(from.courses_), hash_(from.hash_), frames_(from.frames_) {}

  void set_velocity(BodyId body, const Vec3& velocity) {
    TrueCourse& course = courses_[body.index];
    course = {world_.time(), {course.at(world_.time()).position, velocity}, course.acceleration};
    world_.set_velocity(body, velocity).value();
  }

  World world_ =
      World::create({.box = Box{{0, 0, 0}, {21, 21, 21}}, .contacts = ContactEvents::impacts}).value();
  std::vector<TrueCourse> courses_;
  EventHash hash_;
  int frames_ = 0;
};

/// Every third frame a push arrives five frames late.
template <class Save>
Game with_late_input(Save save) {
  constexpr std::size_t delay = 5;
  Game game;
  std::deque<Game> saved;  // before each of the last frames
  for (std::uint32_t number = 0; number < 60; ++number) {
    saved.push_back(save(game));
    if (saved.size() > delay) saved.pop_front();
    game.play_frame();
    if (number % 3 != 0 || saved.size() < delay) continue;
    game = std::move(saved.front());
    saved.clear();
    game.push(number);
    for (std::size_t again = 0; again < delay; ++again) {
      saved.push_back(save(game));
      game.play_frame();
    }
  }
  return game;
}

Game with_input_in_time() {
  Game game;
  for (std::uint32_t number = 0; number < 60; ++number) {
    // The push that arrives in frame n + 4 belongs to this frame.
    if (number % 3 == 2 && number + 4 < 60) game.push(number + 4);
    game.play_frame();
  }
  return game;
}

TEST(Rollback, OfThreeHundredBodiesComesToTheSameEnd) {
  const Game expected = with_input_in_time();
  EXPECT_GT(expected.contacts(), 200u);
  const Game by_clone = with_late_input([](const Game& game) { return game.copy(); });
  EXPECT_EQ(by_clone.hash(), expected.hash());
  EXPECT_EQ(by_clone.bytes(), expected.bytes());
  const Game by_bytes = with_late_input([](const Game& game) { return game.stored(); });
  EXPECT_EQ(by_bytes.hash(), expected.hash());
  EXPECT_EQ(by_bytes.bytes(), expected.bytes());
}

}  // namespace
}  // namespace kinesphere::rollback_test
