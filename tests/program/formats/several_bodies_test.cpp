// Which body a number is of: columns for each body, ids of several files, and numbers
// that are of none.
#include <fmt/format.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::several_bodies_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f.csv", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}
TrackOptions with(const std::string& where, double frame_rate = 0.0) {
  TrackOptions options;
  options.hints.where = where;
  if (frame_rate > 0.0) options.hints.frame_rate = frame_rate;
  return options;
}

TEST(SeveralBodies, UnlikelyPlacesAreAskedAbout) {
  const std::string table = "frame,id,x,y,likelihood\n0,nose,1,2,0.9\n1,nose,1,2,0.9\n2,nose,3,4,0.02\n";
  EXPECT_EQ(
      error_in(table, with("", 25)),
      "f.csv:4: the likelihood 0.02 says that the position may be anywhere: leave such rows out with --where "
      "'likelihood >= 0.6', or keep them with --where 'likelihood != none'");
  EXPECT_EQ(parse(table, with("likelihood >= 0.6", 25)).samples, 2u);
  EXPECT_EQ(parse(table, with("likelihood != none", 25)).samples, 3u);
}

TEST(SeveralBodies, HaveColumnsOfLongitudeAndLatitude) {
  const std::string rows = "2024-01-01T00:00:00Z,47,8,47,8.001\n2024-01-01T00:00:10Z,47,8.0001,47,8.0011\n";
  for (const std::string_view header : {"time,lat1,lon1,lat2,lon2", "time,lat_1,lon_1,lat_2,lon_2",
                                        "time,Latitude1,Longitude1,Latitude2,Longitude2",
                                        "time,drone1_lat,drone1_lng,drone2_lat,drone2_lng"}) {
    const TrackSet two = parse(std::string(header) + "\n" + rows);
    ASSERT_EQ(two.tracks.size(), 2u) << header;
    EXPECT_NEAR(norm(two.tracks[1].samples[0].position - two.tracks[0].samples[0].position), 76.0, 0.5)
        << header;
    EXPECT_NEAR(norm(two.tracks[1].samples[1].position - two.tracks[1].samples[0].position), 7.6, 0.1)
        << header;
  }
  const TrackSet high =
      parse("time,lat1,lon1,alt1,lat2,lon2,alt2\n0,47,8,100,47,8,130\n1,47,8,100,47,8,130\n");
  EXPECT_NEAR(norm(high.tracks[1].samples[0].position - high.tracks[0].samples[0].position), 30.0, 1e-3);
  // A journey has a beginning and an end; so may boxes.
  EXPECT_NE(
      error_in("time,lat_from,lon_from,lat_to,lon_to\n" + rows).find("may be two bodies or parts of one"),
      std::string::npos);
  EXPECT_NE(error_in("time,kind,lat1,lon1,lat2,lon2\n2024-01-01T00:00:00Z,a,47,8,47,8\n").find("corners"),
            std::string::npos);
  EXPECT_EQ(error_in("time,x1,y1,lat1,lon1,x2,y2\n0,1,2,3,4,5,6\n"),
            "f.csv: columns 'x1' and 'lon1' may both be meant: say --positions plane or lonlat");
}

TEST(SeveralBodies, OfOneIdInTwoFilesAreAskedAbout) {
  const auto file = [](const std::string& name, double offset, const std::string& id = "id") {
    std::string text = id + ",time,x,y\n";
    for (int k = 0; k < 5; ++k) text += fmt::format("1,{},{},0\n", k + offset, k);
    return NamedText{name, text};
  };
  const auto both = [&](const TrackOptions& options = {}) {
    return parse_tracks({file("a.csv", 0), file("b.csv", 0.5)}, options);
  };
  EXPECT_EQ(error_of([&] { both(); }),
            "a.csv and b.csv both have the id '1' at the same times: say --columns "
            "id=@file,time=time,x=x,y=y if each file is one body, --where 'id != none' if the id is one body "
            "in both, or read them one by one if they are of different scenes");
  TrackOptions apart;
  apart.hints.columns = "id=@file,time=time,x=x,y=y";
  EXPECT_EQ(both(apart).tracks.size(), 2u);
  EXPECT_EQ(both(with("id != none")).presences.size(), 1u);
  EXPECT_EQ(parse_tracks({file("a.csv", 0), file("b.csv", 10)}, {}).presences.size(), 1u)
      << "the second goes on";
  EXPECT_EQ(parse_tracks({file("a.csv", 0, "mmsi"), file("b.csv", 0.5, "mmsi")}, {}).presences.size(), 1u)
      << "two stations hear one ship";
}

TEST(SeveralBodies, MarkersOfNoPositionAreAskedAbout) {
  const std::string head = "id,time,x,y\n1,0,3,50\n1,1,4,50\n2,0,300,200\n2,1,310,200\n";
  EXPECT_EQ(error_in(head + "1,2,-999,50\n"),
            "f.csv:6: -999 as x is no position in most files: leave such rows out with --where 'x != -999', "
            "or keep "
            "them with --where 'x != none'");
  EXPECT_NE(error_in(head + "1,2,5,99999\n").find("99999 as y"), std::string::npos);
  EXPECT_NE(error_in(head + "1,2,-9999,-9999\n").find("-9999 as x and y"), std::string::npos);
  EXPECT_EQ(parse(head + "1,2,-999,50\n", with("x != -999")).samples, 4u);
  EXPECT_EQ(parse(head + "1,2,-999,50\n", with("x != none")).samples, 5u);
  std::string pixels = "id,frame,x,y\n";
  for (int k = 0; k < 12; ++k) pixels += fmt::format("1,{},{},{}\n", k, 200 + k, 100);
  for (const char* lost : {"0,0", "-1,-1", "-1.0,-1.0"})
    EXPECT_NE(error_in(pixels + "1,12," + lost + "\n", with("", 25)).find("as x and y is no position"),
              std::string::npos)
        << lost;
  EXPECT_EQ(parse(pixels + "1,12,0,100\n", with("", 25)).samples, 13u);
  // A walk over such a number is none.
  std::string walk = "id,time,x,y\n";
  for (int k = 0; k < 40; ++k) walk += fmt::format("1,{},{},{}\n", k, 9980 + k, -1010 + k);
  EXPECT_EQ(parse(walk).samples, 40u);
}

TEST(SeveralBodies, DatesMayHaveYearsOfTwoDigits) {
  const auto times = [](const std::string& one, const std::string& other, DateOrder order) {
    TrackOptions options;
    options.hints.dates = order;
    const TrackSet track_set = parse("id,time,x,y\n1," + one + ",0,0\n1," + other + ",1,0\n", options);
    return track_set.times.text(track_set.tracks[0].samples[0].time);
  };
  EXPECT_EQ(times("31/01/24 12:00", "31/01/24 12:01", DateOrder::day_first), "2024-01-31T12:00:00");
  EXPECT_EQ(times("1/31/24 9:05:00 PM", "1/31/24 9:06:00 PM", DateOrder::month_first), "2024-01-31T21:05:00");
  EXPECT_EQ(times("24-01-31 12:00", "24-01-31 12:01", DateOrder::year_first), "2024-01-31T12:00:00");
  EXPECT_EQ(times("31.1.99 12:00", "31.1.99 12:01", DateOrder::day_first), "1999-01-31T12:00:00");
  EXPECT_EQ(times("31-Jan-24 12:00:00", "31-Jan-24 12:00:01", DateOrder::unknown), "2024-01-31T12:00:00");
  EXPECT_EQ(error_in("id,time,x,y\n1,31/01/24 12:00,0,0\n"),
            "f.csv:2: expected a date whose order of day and month is known (column 2), but got '31/01/24 "
            "12:00': say "
            "--dates day-first or --dates month-first, or year-first");
  EXPECT_NE(error_in("id,time,x,y\n1,01/02/2024 12:00,0,0\n").find("--dates month-first"), std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::several_bodies_test
