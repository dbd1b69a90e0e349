// A world that is saved in one process continues to the bit in another.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere::second_process_test {
namespace {

using Bytes = std::vector<std::byte>;
namespace fs = std::filesystem;

constexpr const char* variable = "KINESPHERE_SECOND_PROCESS";

/// Files that one process writes and the other reads.
struct Files {
  fs::path folder;
  fs::path saved() const { return folder / "saved"; }
  fs::path result() const { return folder / "result"; }
};

void write(const fs::path& path, const Bytes& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Bytes read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  Bytes bytes;
  for (std::istreambuf_iterator<char> at(file), end; at != end; ++at)
    bytes.push_back(static_cast<std::byte>(*at));
  return bytes;
}

/// Bouncing bodies that follow their plans, so that a snapshot determines all of their future.
class Billiards {
 public:
  explicit Billiards(World from) : world(std::move(from)) {
    for (const BodyId id : world.bodies()) start(id, world.body(id).value().bound);
  }

  void start(BodyId id, const Bound& bound) {
    if (id.index >= courses_.size()) courses_.resize(id.index + 1);
    courses_[id.index] = {bound.time, {bound.position, bound.velocity}, bound.planned_acceleration};
  }

  /// Delivers at most `at_most` events.
  void go(double until, int at_most) {
    const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = courses_[ids[k].index].at(time);
    };
    while (at_most-- > 0) {
      const auto event = world.advance(until, probe).value();
      if (!event) return;
      hash.add(*event);
      if (event->approach_speed <= 0.0) continue;
      const Bounce after = bounce(*event, 1.0, 1.0, 0.9);
      set_velocity(event->first, event->first_state.position, after.first_velocity);
      if (event->second != no_body)
        set_velocity(event->second, event->second_state.position, after.second_velocity);
    }
  }

  World world;
  EventHash hash;

 private:
  void set_velocity(BodyId id, const Vec3& position, const Vec3& velocity) {
    courses_[id.index].since = world.time();
    courses_[id.index].state = {position, velocity};
    world.set_velocity(id, velocity).value();
  }

  std::vector<TrueCourse> courses_;
};

/// Saves in the middle of an instant: four contacts begin at once, and one of them has been delivered.
Bytes saved_in_the_middle() {
  Billiards game(World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}}).value());
  const auto add = [&](const BodyDefinition& body) {
    const BodyId id = game.world.add(body).value();
    game.start(id, game.world.body(id).value().bound);
  };
  for (int k = 0; k < 4; ++k) {
    const double y = 1.0 + 2.0 * k;
    add({.radius = 0.5, .planned_acceleration = {0, 0, -1}, .position = {3, y, 5}, .velocity = {1, 0.1, 0}});
    add({.radius = 0.5, .planned_acceleration = {0, 0, -1}, .position = {6, y, 5}, .velocity = {-1, 0, 0.1}});
  }
  game.go(20.0, 1);
  EXPECT_LT(game.world.time(), 20.0);
  return game.world.save().value();
}

/// Continues from there; the last bytes contain the events.
Bytes outcome(const Bytes& saved) {
  Billiards game(World::restore(saved).value());
  game.go(game.world.time() + 20.0, 500);
  EXPECT_GT(game.world.counters().count(EventKind::contact_begin), 10u);
  Bytes bytes = game.world.save().value();
  for (int k = 0; k < 8; ++k) bytes.push_back(static_cast<std::byte>(game.hash.value() >> (8 * k)));
  return bytes;
}

/// Runs in the second process; by itself it tests nothing.
TEST(SecondProcess, GoesOnFromAFile) {
  const char* folder = std::getenv(variable);
  if (folder == nullptr) return;
  const Files files{folder};
  write(files.result(), outcome(read(files.saved())));
}

TEST(SecondProcess, ASavedWorldGoesOnTheSameThere) {
  if (!fs::exists("/proc/self/exe")) GTEST_SKIP() << "how to start this executable again is not known here";
  const Files files{fs::path(testing::TempDir()) /
                    ("kinesphere_second_process_" + fs::read_symlink("/proc/self").string())};
  fs::create_directory(files.folder);
  const Bytes saved = saved_in_the_middle();
  write(files.saved(), saved);
  std::string command = variable;
  command += "='" + files.folder.string() + "' '" + fs::read_symlink("/proc/self/exe").string() +
             "' --gtest_filter=SecondProcess.GoesOnFromAFile --gtest_output= >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const Bytes result = read(files.result());
  EXPECT_FALSE(result.empty());
  EXPECT_EQ(result, outcome(saved));
  fs::remove_all(files.folder);
}

}  // namespace
}  // namespace kinesphere::second_process_test
