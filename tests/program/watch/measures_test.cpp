// Numbers with units, and separations made of them.
#include "watch/tracks/motion_classes.hpp"

#include <gtest/gtest.h>

#include "formats/fields/separations.hpp"
#include "program/support.hpp"

namespace kinesphere::program::measures_test {
namespace {

TEST(Measures, HaveUnits) {
  EXPECT_DOUBLE_EQ(parse_measure("5NM", Measure::length, "--x"), 9260.0);
  EXPECT_DOUBLE_EQ(parse_measure("1000 ft", Measure::length, "--x"), 304.8);
  EXPECT_DOUBLE_EQ(parse_measure("1.5e3", Measure::length, "--x"), 1500.0);
  EXPECT_DOUBLE_EQ(parse_measure("2.5km", Measure::length, "--x"), 2500.0);
  EXPECT_DOUBLE_EQ(parse_measure("10m/s", Measure::speed, "--x"), 10.0);
  EXPECT_DOUBLE_EQ(parse_measure("3600kt", Measure::speed, "--x"), 1852.0);
  EXPECT_DOUBLE_EQ(parse_measure("3 m/s2", Measure::acceleration, "--x"), 3.0);
  EXPECT_DOUBLE_EQ(parse_measure("2g", Measure::acceleration, "--x"), 19.6133);
  EXPECT_DOUBLE_EQ(parse_measure("2min", Measure::time, "--x"), 120.0);
}

TEST(Measures, RefuseOthers) {
  for (const char* const text : {"", "NM", "5 parsecs", "-1", "5 m 3", "nan", "1e999", "5NM5"}) {
    const std::string error = error_of([&] { parse_measure(text, Measure::length, "--radius"); });
    EXPECT_NE(error.find("--radius"), std::string::npos) << error;
    EXPECT_NE(error.find(std::string("'") + text + "'"), std::string::npos) << error;
    EXPECT_NE(error.find("NM"), std::string::npos) << error;
  }
  error_of([] { parse_measure("5kt", Measure::length, "--radius"); });
}

TEST(Measures, AreBallsOrCylinders) {
  EXPECT_EQ(parse_spread("3", Measure::length, "--x"), ErrorBound(3.0));
  EXPECT_EQ(parse_spread("3:1ft", Measure::length, "--x"), ErrorBound::cylinder(3.0, foot));
}

TEST(Separations, AreShapesWithLengths) {
  EXPECT_EQ(parse_separation("sphere:50").separation, Separation::sphere(50.0));
  EXPECT_EQ(parse_separation("sphere:1NM:20min").separation, Separation::sphere(1852.0, 1200.0));
  EXPECT_EQ(parse_separation("cylinder:5NM:300m:60").separation, Separation::cylinder(9260.0, 300.0, 60.0));
  EXPECT_EQ(parse_separation("sphere 50m").name, "sphere 50m");
  EXPECT_EQ(parse_separation("cylinder:5NM:1000ft").separation, Separation::cylinder(9260.0, 304.8));
  EXPECT_EQ(parse_separation("cylinder 5NM 1000ft").separation, Separation::cylinder(9260.0, 304.8));
  EXPECT_EQ(parse_separation("ellipsoid:10:5").separation, Separation::ellipsoid(10.0, 5.0));
  const Separation volume = Separation::well_clear(0.66 * 1852.0, 450.0 * foot, 35.0, 55.0);
  EXPECT_EQ(parse_separation("well-clear:0.66NM:450ft:35s:55s").separation, volume);
  EXPECT_EQ(parse_separation("well-clear:10:5:0").separation, Separation::well_clear(10.0, 5.0, 0.0));
  EXPECT_EQ(parse_separation("do365:corrective").separation, volume);
  EXPECT_EQ(parse_separation("do365:corrective").name, "do365:corrective");
  for (const char* const text : {"", "50", "cube:50", "sphere", "sphere:0", "cylinder:5", "sphere:1:2:3",
                                 "well-clear:10:5", "well-clear:10:0:1", "do365:other"})
    EXPECT_NE(error_of([&] { parse_separation(text); }).find("--separation"), std::string::npos) << text;
}

}  // namespace
}  // namespace kinesphere::program::measures_test
