// Facets of a world, and calls that take several bodies or several properties at once.
#include <gtest/gtest.h>

#include <memory>
#include <type_traits>

#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/recording.hpp"
#include "support/expect_error.hpp"
#include "world/crowd.hpp"

namespace kinesphere::facets_test {
namespace {

/// A crowd in which every third body is of category 2.
class Teams : public testing::TestWithParam<std::uint64_t> {
 protected:
  Teams() : crowd({ContactEvents::begin_and_end, true, 0.0, 60, GetParam()}) {
    for (const BodyId id : crowd.world.bodies())
      if (id.index % 3 == 0) crowd.world.change(id, {.filter = Filter{.category = 2}}).value();
    while (crowd.advance(0.3)) {
    }
  }

  Crowd crowd;
};

/// Oracle: a copy of the world from which all bodies that are left out have been removed.
TEST_P(Teams, QueriesWithOptionsFindWhatAWorldWithoutTheOthersHas) {
  for (int round = 0; round < 40; ++round) {
    const Vec3 point = crowd.any_point();
    const Vec3 direction = crowd.random.unit_vector();
    const Box box{point, point + Vec3{2, 3, 4}};
    const BodyId except = crowd.any();
    const QueryOptions options{.filter = Filter{.category = 1, .mask = crowd.random.bits() % 4},
                               .except = except};
    World others = crowd.world.clone().value();
    for (const BodyId id : crowd.world.bodies())
      if (id == except || !passes(*options.filter, crowd.world.body(id).value().definition.filter))
        others.remove(id).value();
    const World::Queries all = crowd.world.queries(), left = others.queries();
    EXPECT_EQ(all.overlapping(point, 3.0, options).value(), left.overlapping(point, 3.0).value());
    EXPECT_EQ(all.overlapping(box, options).value(), left.overlapping(box).value());
    EXPECT_EQ(all.nearest(point, 3, options).value(), left.nearest(point, 3).value());
    EXPECT_EQ(all.ray_cast(point, direction, 10.0, options).value(),
              left.ray_cast(point, direction, 10.0).value());
    EXPECT_EQ(all.sphere_cast(point, 0.3, direction, 10.0, options).value(),
              left.sphere_cast(point, 0.3, direction, 10.0).value());
  }
}

TEST_P(Teams, OptionsHoldWithAProbeToo) {
  const QueryOptions team{.filter = Filter{.mask = 2}};
  const auto found = crowd.world.queries(crowd.probe()).nearest({5, 5, 5}, 4, team).value();
  ASSERT_EQ(found.size(), 4u);
  for (const NearestHit& hit : found) EXPECT_EQ(hit.body.index % 3, 0u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Teams, testing::Values(1, 2, 3));

TEST(Facet, MayBeKeptWhileTheWorldChanges) {
  Playground p;
  const World::Queries queries = p.world.queries();
  const World::Inspection inspection = p.world.inspection();
  EXPECT_TRUE(queries.overlapping({}, 1.0)->empty());
  const BodyId ball = p.add({});
  EXPECT_EQ(queries.overlapping({}, 1.0)->size(), 1u);
  EXPECT_FALSE(inspection.is_recording());
  p.world.start_recording().value();
  EXPECT_TRUE(inspection.is_recording());
  EXPECT_EQ(p.world.certificates().safe_until(ball)->time, std::numeric_limits<double>::infinity());
}

TEST(Facet, OwnsATemporaryProbe) {
  Playground p;
  const BodyId ball = p.add({.acceleration_limit = 1.0, .velocity = {1, 0, 0}});
  EXPECT_FALSE(p.advance(1.0));
  const World::Queries queries = p.world.queries(p.probe());
  const auto hits = queries.overlapping({1, 0, 0}, 0.001).value();
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits.front(), (OverlapHit{ball, Certainty::certainly}));
}

template <class Held>
concept HasFacets = requires(Held&& world) {
  std::forward<Held>(world).queries();
};

TEST(Facet, IsNotOfATemporaryWorld) {
  static_assert(HasFacets<World&> && HasFacets<const World&> && !HasFacets<World> && !HasFacets<const World>);
}

TEST(Facet, OfAMovedWorldIsRefused) {
  Playground p;
  const BodyId ball = p.add({});
  const auto queries = p.world.queries(p.probe());
  const auto certificates = p.world.certificates(p.probe());
  const auto inspection = p.world.inspection();
  const World taken = std::move(p.world);
  expect_error(queries.nearest({}, 1), ErrorCode::moved_from, "world", "nearest");
  expect_error(queries.refresh(ball), ErrorCode::moved_from, "world", "refresh");
  expect_error(certificates.safe_until(ball), ErrorCode::moved_from, "world", "safe_until");
  EXPECT_THROW((void)inspection.memory(), BadResult);
  EXPECT_EQ(taken.queries().nearest({}, 1)->size(), 1u);
}

TEST(Query, ReusesTheMemoryOfAFormerAnswer) {
  Playground p;
  for (int k = 0; k < 10; ++k) p.add({.position = {3.0 * k, 0, 0}});
  auto hits = p.world.queries().overlapping({}, 100.0).value();
  ASSERT_EQ(hits.size(), 10u);
  const OverlapHit* const memory = hits.data();
  hits = p.world.queries().overlapping({}, 1.0, {}, std::move(hits)).value();
  EXPECT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits.data(), memory);
}

TEST(Refresh, ProbesStaleBodiesInOneCall) {
  Playground p;
  const BodyId a = p.add({.acceleration_limit = 1.0}), b = p.add({.position = {9, 0, 0}});
  const BodyId off = p.add({.position = {0, 9, 0}});
  p.world.disable(off).value();
  EXPECT_FALSE(p.advance(1.0));
  std::vector<BodyId> asked;
  int calls = 0;
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    ++calls;
    asked.insert(asked.end(), ids.begin(), ids.end());
    p.probe()(ids, time, states);
  };
  EXPECT_TRUE(p.world.queries(probe).refresh({b, off, a}).value());
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(asked, (std::vector{b, a}));
  EXPECT_FALSE(p.world.queries(probe).refresh(a).value()) << "its report is fresh";
  expect_error(p.world.queries().refresh(a), ErrorCode::null_probe, "probe", "refresh");
  expect_error(p.world.queries(probe).refresh(BodyId{7, 0}), ErrorCode::unknown_body, "body", "refresh",
               {7, 0});
}

TEST(Change, OfSeveralPropertiesIsWholeOrNone) {
  Playground p({.allow_overlap = false});
  const BodyId a = p.add({}), b = p.add({.position = {5, 0, 0}});
  const BodyView before = p.world.body(a).value();
  expect_error(p.world.change(a, {.radius = 2, .mass = -1}), ErrorCode::out_of_range, "mass", "change", a);
  expect_error(p.world.change(a, {.radius = 2, .motion_limits = MotionLimits{.position_error = 3}}),
               ErrorCode::overlapping, "position_error", "change", b);
  EXPECT_EQ(p.world.body(a).value(), before);
  p.world.start_recording().value();
  p.world
      .change(a, {.radius = 2,
                  .motion_limits = MotionLimits{.acceleration_limit = 4},
                  .filter = Filter{.category = 8},
                  .solid = false,
                  .sensor_class = SensorClass{3},
                  .mass = 5,
                  .user_data = 6})
      .value();
  const BodyDefinition after = p.world.body(a).value().definition;
  EXPECT_EQ(after, (BodyDefinition{.radius = 2,
                                   .acceleration_limit = 4,
                                   .filter = {.category = 8},
                                   .solid = false,
                                   .contacts = ContactEvents::all,
                                   .sensor_class = 3,
                                   .user_data = 6,
                                   .mass = 5}));
  EXPECT_FALSE(p.advance(1.0));
  const std::vector<std::byte> bytes = p.world.save().value();
  Replay replay = Replay::open(p.world.stop_recording().value()).value();
  while (!replay.finished()) (void)replay.advance().value();
  EXPECT_EQ(replay.world().save().value(), bytes);
}

TEST(Remove, TakesOneBodyOrSeveral) {
  Playground p;
  std::vector<BodyId> ids;
  for (int k = 0; k < 6; ++k) ids.push_back(p.add({.position = {3.0 * k, 0, 0}}));
  p.world.remove(ids[0]).value();
  p.world.remove({ids[1], ids[2]}).value();
  p.world.remove(std::span(ids).subspan(3, 1)).value();
  p.world.remove({}).value();
  expect_error(p.world.remove({ids[4], ids[4]}), ErrorCode::stale_body, "body", "remove: bodies[1]", ids[4]);
  EXPECT_EQ(p.world.bodies(), (std::vector{ids[4], ids[5]}));
}

TEST(PairFilter, OwnsANamedCallable) {
  Playground p;
  const auto alive = std::make_shared<bool>(true);
  {
    const auto nobody = [alive](BodyId, BodyId) { return !*alive; };
    p.world.set_pair_filter(nobody).value();
  }
  EXPECT_EQ(alive.use_count(), 2);
  p.add({});
  p.add({.position = {0.5, 0, 0}});
  EXPECT_FALSE(p.advance(1.0)) << "the filter lets no two bodies touch";
  p.world.set_pair_filter({}).value();
  EXPECT_EQ(alive.use_count(), 1);
}

}  // namespace
}  // namespace kinesphere::facets_test
