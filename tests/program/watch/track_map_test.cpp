// Reports of a stream as those of the monitor: places and errors, in a plane and on the earth.
#include "watch/tracks/track_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "program/support.hpp"
#include "program/watch/stages.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::track_map_test {
namespace {

TrackReport placed(const TrackMap& map, const WatchSettings& settings, const SourceReport& report,
                   Declared& declared) {
  return map.place(report, 7.0, settings.classes, declared).value();
}

TEST(TrackMap, TakesTheErrorsOfTheStreamBeforeThoseOfTheOptions) {
  const WatchSettings settings = plane_settings();
  TrackMap map(settings);
  SourceReport report = report_at("a", 0, 3.0, 4.0);
  map.begin(report, settings.classes);
  Declared declared;
  TrackReport result = placed(map, settings, report, declared);
  EXPECT_EQ(result.timestamp, 7.0);
  EXPECT_EQ(result.state.position, (Vec3{3, 0, 0}));
  EXPECT_EQ(result.position_error, ErrorBound(1.0));
  EXPECT_EQ(declared.position_by, "test");
  report.position_error = {5.0, "nac_p"};
  report.extent = 2.0;
  report.velocity_age = 3.0;
  report.velocity_spread = 0.5;
  result = placed(map, settings, report, declared);
  EXPECT_EQ(result.position_error, ErrorBound(7.0)) << "with the extent";
  EXPECT_EQ(declared.position_by, "nac_p");
  EXPECT_DOUBLE_EQ(result.velocity_error.horizontal(), 0.1 + 0.5 + 3.0 * 2.0) << "it may have accelerated";
  report.velocity.reset();
  EXPECT_TRUE(std::isinf(placed(map, settings, report, declared).velocity_error.total()));
}

TEST(TrackMap, AsksForABoundThatNobodySays) {
  WatchSettings settings = plane_settings();
  settings.position_error = {};
  TrackMap map(settings);
  const SourceReport report = report_at("a", 0, 3.0, 4.0);
  map.begin(report, settings.classes);
  Declared declared;
  EXPECT_NE(error_of([&] { placed(map, settings, report, declared); }).find("--position-error"),
            std::string::npos);
}

TEST(TrackMap, AHeightThatIsNotKnownMayBeAny) {
  WatchSettings settings = plane_settings();
  settings.dimensions = 3;
  TrackMap map(settings);
  SourceReport report = report_at("a", 0, 3.0, 4.0);
  map.begin(report, settings.classes);
  Declared declared;
  EXPECT_TRUE(map.lacks_height(report));
  EXPECT_GE(placed(map, settings, report, declared).position_error.vertical(), 1e8);
  EXPECT_EQ(declared.height_by, unknown_height);
  report.has_height = true;
  EXPECT_EQ(placed(map, settings, report, declared).position_error, ErrorBound(1.0));
}

TEST(TrackMap, TheFirstReportSaysOfHowManyDimensionsItIs) {
  WatchSettings settings = plane_settings();
  settings.dimensions.reset();
  SourceReport report = report_at("a", 0, 3.0, 4.0);
  TrackMap flat(settings), high(settings);
  flat.begin(report, settings.classes);
  report.has_height = true;
  high.begin(report, settings.classes);
  EXPECT_EQ(flat.dimensions(), 2);
  EXPECT_EQ(high.dimensions(), 3);
  EXPECT_TRUE(flat.ignores_height_of(report));
  EXPECT_FALSE(high.ignores_height_of(report));
}

TEST(TrackMap, TheOwnTrackHasClassesOfItsOwn) {
  WatchSettings settings = plane_settings();
  settings.own = "own";
  TrackMap map(settings);
  const SourceReport other = report_at("a", 0, 3.0, 4.0), own = report_at("own", 0, 3.0, 4.0);
  map.begin(other, settings.classes);
  Declared declared;
  EXPECT_EQ(placed(map, settings, other, declared).track_class, 0u);
  EXPECT_EQ(placed(map, settings, own, declared).track_class, 1u);
  const MonitorDefinition definition = map.definition(settings.classes, 12.0);
  ASSERT_EQ(definition.separations.size(), 1u) << "pairs of two others are not watched";
  EXPECT_EQ(definition.separations[0].second_class, 1u);
  EXPECT_EQ(definition.start_time, 12.0);
}

TEST(TrackMap, AreasAreCircles) {
  WatchSettings settings = plane_settings();
  settings.areas = {{.first = 100.0, .second = 0.0, .radius = 10.0}};
  TrackMap map(settings);
  map.begin(report_at("a", 0, 3.0, 4.0), settings.classes);
  EXPECT_TRUE(map.is_in_area({.places = {{.centre = {5, 0, 0}}, {.centre = {92, 5, 0}}}}));
  EXPECT_FALSE(map.is_in_area({.places = {{.centre = {92, 7, 0}}}}));
}

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB
TEST(TrackMap, OnTheEarthItIsAsWideAsTheRadius) {
  WatchSettings settings = plane_settings();
  settings.radius = 100e3;
  SourceReport report = report_at("a", 0, 8.0, 4.0, 54.0);
  report.geographic = true;
  TrackMap map(settings), later(settings);
  map.begin(report, settings.classes);
  Declared declared;
  EXPECT_EQ(map.frame()->latitude(), 54.0);
  EXPECT_LT(norm(placed(map, settings, report, declared).state.position), 1e-6);
  report.position.y = 55.0;
  EXPECT_FALSE(map.place(report, 0.0, settings.classes, declared)) << "111 km to the north";
  ASSERT_TRUE(read_back(map, later));
  later.go_on(settings.classes);
  EXPECT_EQ(later.frame()->latitude(), 54.0);
}
#endif

}  // namespace
}  // namespace kinesphere::program::track_map_test
