// Inspection of a world: memory by part, timings, cells and certificates.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>
#include <thread>

#include "kinesphere/inspection.hpp"
#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"
#include "world/crowd.hpp"

namespace kinesphere::inspection_test {
namespace {

struct BusyCrowd : Crowd {
  BusyCrowd() : Crowd({ContactEvents::begin_and_end, true, 0.0, 200, 3}) { run(0.0); }
};

TEST(Memory, GrowsWithTheBodiesAndBelongsToParts) {
  World world = World::create({}).value();
  const Memory none = world.inspection().memory();
  EXPECT_EQ(none.bodies + none.pairs + none.contacts + none.recording, 0u);
  EXPECT_LT(none.total(), 32768u);
  BusyCrowd crowd;
  const Memory memory = crowd.world.inspection().memory();
  const std::size_t count = crowd.world.size();
  // Lower limits of the parts.
  EXPECT_GE(memory.bodies, count * sizeof(Bound));
  EXPECT_GE(memory.pairs, crowd.world.inspection().certificates().size() * 16);
  EXPECT_GE(memory.contacts, count * 24);
  EXPECT_GE(memory.windows, count * 2 * 28);
  EXPECT_EQ(memory.recording, 0u);
  // An upper limit of a few times that.
  EXPECT_LT(memory.total(), count * 4000);
  EXPECT_EQ(memory.total(), memory.bodies + memory.windows + memory.pairs + memory.contacts + memory.other);
}

TEST(Memory, ShowsARecordingGrow) {
  BusyCrowd crowd;
  const std::size_t before = crowd.world.inspection().memory().total();
  crowd.world.start_recording().value();
  const std::size_t at_start = crowd.world.inspection().memory().recording;
  const std::size_t snapshot = crowd.world.save().value().size();
  EXPECT_GE(at_start, snapshot);
  crowd.run(1.0);
  EXPECT_GT(crowd.world.inspection().memory().recording, at_start);
  const std::size_t recorded = crowd.world.stop_recording().value().size();
  EXPECT_EQ(crowd.world.inspection().memory().recording, 0u);
  EXPECT_GT(recorded, snapshot);
  EXPECT_LT(crowd.world.inspection().memory().total(), before + recorded);
}

TEST(Cells, HoldTheMiddlesOfTheCapsules) {
  const BusyCrowd crowd{};
  const std::vector<CellView> cells = crowd.world.inspection().cells();
  std::size_t entries = 0;
  for (const CellView& cell : cells) {
    EXPECT_GT(cell.bodies, 0u);
    entries += cell.bodies;
    EXPECT_GT(cell.box.upper.x, cell.box.lower.x);
  }
  EXPECT_EQ(entries, crowd.world.size());
  for (const BodyId id : crowd.world.bodies()) {
    const Box box = crowd.world.body(id).value().box;
    // Part of the way has been covered, and the box is that of the rest.
    const auto holds = [&](const CellView& cell) {
      for (int axis = 0; axis < 3; ++axis)
        if (box.upper[axis] < cell.box.lower[axis] || box.lower[axis] > cell.box.upper[axis]) return false;
      return true;
    };
    EXPECT_TRUE(std::any_of(cells.begin(), cells.end(), holds)) << id;
  }
  const World empty = World::create({}).value();
  EXPECT_TRUE(empty.inspection().cells().empty());
}

TEST(Certificates, AreTrueOfTheTruth) {
  BusyCrowd crowd;
  const std::vector<Certificate> all = crowd.world.inspection().certificates();
  ASSERT_GT(all.size(), 20u);
  std::size_t checked = 0;
  for (const Certificate& certificate : all) {
    ASSERT_LT(certificate.first, certificate.second);
    EXPECT_GE(certificate.until, crowd.world.time());
    if (certificate.second == no_body || crowd.gap(certificate.first, certificate.second) <= 5 * Crowd::eps)
      continue;
    const double end = std::min(certificate.until, crowd.world.time() + 10.0);
    for (int k = 0; k <= 20; ++k, ++checked) {
      const double time = crowd.world.time() + (end - crowd.world.time()) * k / 20;
      EXPECT_GE(crowd.gap(certificate.first, certificate.second, time), -Crowd::eps);
    }
  }
  EXPECT_GT(checked, 100u);
  const World empty = World::create({}).value();
  EXPECT_TRUE(empty.inspection().certificates().empty());
}

TEST(Certificates, OfWallsAreTrueOfTheTruth) {
  Playground p({.box = Box{{0, 0, 0}, {20, 20, 20}}});
  Random random(11);
  for (int k = 0; k < 60; ++k) {
    p.add({.radius = 0.1,
           .acceleration_limit = 2,
           .position = Vec3{10, 10, 10} + 8 * random.point_in_ball(),
           .velocity = 4 * random.point_in_ball(),
           .filter = {.group = -1}});
  }
  std::map<BodyId, double> safe_until;
  std::size_t recorded = 0, walls = 0;
  for (double time = 0.05; time < 6.0; time += 0.05) {
    for (const Event& event : p.run(time)) {
      if (event.kind != EventKind::wall_begin && event.kind != EventKind::wall_end) continue;
      ++walls;
      EXPECT_GE(event.time, safe_until.at(event.first)) << event.first;
    }
    for (const BodyId id : p.world.bodies()) safe_until[id] = p.world.body(id).value().box_end;
    for (const Certificate& certificate : p.world.inspection().certificates()) {
      ASSERT_EQ(certificate.second, no_body) << "nothing else may touch";
      safe_until[certificate.first] = std::min(safe_until[certificate.first], certificate.until);
      ++recorded;
    }
  }
  EXPECT_GT(recorded, 100u);
  EXPECT_GT(walls, 20u);
}

TEST(Certificates, OfBodiesThatAreKickedAreGone) {
  BusyCrowd crowd;
  const auto redirected = [](BodyId id) { return id != no_body && id.index % 3 == 0; };
  for (const BodyId id : crowd.world.bodies())
    if (redirected(id)) crowd.set_velocity(id, {1, 1, 1});
  ASSERT_FALSE(crowd.world.inspection().certificates().empty());
  for (const Certificate& certificate : crowd.world.inspection().certificates())
    EXPECT_FALSE(redirected(certificate.first) || redirected(certificate.second));
}

TEST(Timings, AreOffAtFirstAndThenTellProbesFromTheRest) {
  Playground p;
  p.add({.acceleration_limit = 1, .position = {-5, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.acceleration_limit = 1, .position = {5, 0, 0}, .velocity = {-1, 0, 0}});
  p.run(1.0);
  EXPECT_EQ(p.world.inspection().timings().advances, 0u);
  EXPECT_EQ(p.world.inspection().timings().advance, 0.0);
  p.world.set_profiling(true).value();
  p.distort = [](BodyId, double, State&) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  const std::uint64_t probes = p.world.counters().probes;
  p.run(6.0);
  const Timings timings = p.world.inspection().timings();
  EXPECT_GT(timings.advances, 1u);
  EXPECT_GE(timings.probes, 0.002 * static_cast<double>(p.world.counters().probes - probes));
  EXPECT_GE(timings.advance, timings.probes);
  p.world.set_profiling(false).value();
  p.run(7.0);
  EXPECT_EQ(p.world.inspection().timings().advances, timings.advances) << "kept, but not gone on with";
  p.world.set_profiling(true).value();
  EXPECT_EQ(p.world.inspection().timings().advances, 0u);
}

TEST(Timings, CountAProbeThatThrows) {
  Playground p;
  p.add({});
  p.world.set_profiling(true).value();
  p.set_velocity({0, 0}, {1, 0, 0});
  p.run(1.0);
  p.set_velocity({0, 0}, {2, 0, 0});
  p.distort = [](BodyId, double, State&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    throw std::runtime_error("no answer");
  };
  EXPECT_THROW(p.advance(2.0), std::runtime_error);
  EXPECT_GE(p.world.inspection().timings().probes, 0.002);
  EXPECT_GE(p.world.inspection().timings().advance, p.world.inspection().timings().probes);
}

TEST(Timings, AndRecordingsDoNotDisturbEachOther) {
  BusyCrowd timed;
  timed.world.set_profiling(true).value();
  timed.world.start_recording().value();
  timed.run(1.0);
  BusyCrowd plain;
  plain.run(1.0);
  EXPECT_EQ(timed.hash.value(), plain.hash.value());
  EXPECT_EQ(timed.world.save().value(), plain.world.save().value());
  EXPECT_GT(timed.world.inspection().timings().advance, 0.0);
  const World copy = timed.world.clone().value();
  EXPECT_FALSE(copy.inspection().timings().advances);
}

TEST(WrongCalls, AProbeMayLookInsideButNotSwitchTimingOn) {
  Playground p;
  p.add({});
  int calls = 0;
  p.distort = [&](BodyId, double, State&) {
    ++calls;
    expect_error(p.world.set_profiling(true), ErrorCode::probe_in_progress, "probe", "set_profiling");
    EXPECT_GT(p.world.inspection().memory().total(), 0u);
    EXPECT_LE(p.world.inspection().cells().size(), 8u);
    EXPECT_TRUE(p.world.inspection().certificates().empty());
  };
  p.set_velocity({0, 0}, {1, 0, 0});
  p.advance(1.0);
  p.set_velocity({0, 0}, {2, 0, 0});
  p.advance(2.0);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(p.world.inspection().timings().advances, 0u);
}

}  // namespace
}  // namespace kinesphere::inspection_test
