// Recordings of traffic: Vissim, pNEUMA; and what only looks like one.
#include <fmt/format.h>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::wide_recordings_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}

/// Places of bodies at each step, in thousandths, which texts say exactly.
using Places = std::vector<std::vector<Vec3>>;

Places drawn_places(Random& random, std::size_t steps, std::size_t bodies) {
  Places places(steps, std::vector<Vec3>(bodies));
  const auto draw = [&] { return std::round(random.uniform(-1e5, 1e5)) / 1e3; };
  for (auto& step : places)
    for (Vec3& at : step) at = {draw(), draw(), draw()};
  return places;
}

void expect_places(const TrackSet& track_set, const Places& places, double interval,
                   const std::function<std::string(std::size_t)>& name) {
  ASSERT_EQ(track_set.tracks.size(), places[0].size());
  for (std::size_t body = 0; body < places[0].size(); ++body) {
    EXPECT_EQ(track_set.tracks[body].id, name(body));
    const auto& samples = track_set.tracks[body].samples;
    ASSERT_EQ(samples.size(), places.size());
    for (std::size_t step = 0; step < places.size(); ++step) {
      EXPECT_DOUBLE_EQ(samples[step].time - samples[0].time, interval * static_cast<double>(step));
      EXPECT_EQ(track_set.coordinates.as_in_file(samples[step].position), places[step][body]);
    }
  }
}

const std::string vissim_begin =
    "$VISION\n* File: a.inpx\n*\n* Table: Vehicles In Network\n*\n* SIMSEC: SimSec, Simulation second\n*\n";

TEST(WideRecordings, OfVissim) {
  Random random(471);
  const Places places = drawn_places(random, 6, 3);
  for (const bool in_one : {false, true}) {
    std::string text = vissim_begin + "$VEHICLE:SIMSEC;NO;LANE\\LINK\\NO;" +
                       (in_one ? "COORDFRONT" : "COORDFRONTX;COORDFRONTY;COORDFRONTZ") + ";SPEED\r\n";
    for (std::size_t step = 0; step < places.size(); ++step)
      for (std::size_t body = 0; body < places[step].size(); ++body) {
        const Vec3& at = places[step][body];
        text += in_one ? fmt::format("{:.2f};{};7;{:.3f} {:.3f} {:.3f};50.1\r\n", 0.5 * double(step),
                                     body + 1, at.x, at.y, at.z)
                       : fmt::format("{:.2f};{};7;{:.3f};{:.3f};{:.3f};50.1\r\n", 0.5 * double(step),
                                     body + 1, at.x, at.y, at.z);
      }
    const TrackSet track_set = parse(text);
    EXPECT_EQ(track_set.format, "Vissim");
    expect_places(track_set, places, 0.5, [](std::size_t body) { return fmt::format("{}", body + 1); });
  }
  EXPECT_EQ(parse("$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n1;0;1;2\n1;1;1;3\n").samples, 2u);
  EXPECT_TRUE(error_in(vissim_begin +
                       "$VEHICLE:SIMSEC;NO;LANE\\LINK\\NO;LANE\\INDEX;POS;POSLAT\n0.2;1;1;1;2.57;0.5\n")
                  .starts_with("f: expected columns for id, time, x and y"));
  EXPECT_EQ(error_in("$VEHICLE:SIMSEC;NO;COORDFRONTX;COORDFRONTY\n0;1;1;2\n1;1;x;2\n"),
            "f:3: expected a number as x ('COORDFRONTX'), but got 'x'");
  EXPECT_EQ(error_in("$VEHICLE:SIMSEC;NO;COORDFRONTX;COORDFRONTY\n0;1;1;2\n1;1;1\n"),
            "f:3: expected 4 fields as behind $VEHICLE: or $PEDESTRIAN:, but got 3");
  EXPECT_EQ(error_in("$VISION\n1;2;3\n"),
            "f:2: expected 0 fields as behind $VEHICLE: or $PEDESTRIAN:, but got 3");
}

TEST(WideRecordings, OfPneuma) {
  const std::string header =
      "track_id; type; traveled_d; avg_speed; lat; lon; speed; lon_acc; lat_acc; time\n";
  const std::string groups =
      "37.977391; 23.737688; 4.9; 0.1; -0.1; 0.000000; 37.977400; 23.737688; 5.0; 0.1; 0.0; 0.040000; ";
  const TrackSet two = parse(header + "1; Car; 1.0; 5.0; " + groups + "\n2; Bus; 1.0; 5.0; " + groups + "\n");
  EXPECT_EQ(two.format, "pNEUMA");
  ASSERT_EQ(two.tracks.size(), 2u);
  EXPECT_EQ(two.tracks[1].id, "2");
  EXPECT_EQ(two.tracks[1].samples[1].time - two.tracks[1].samples[0].time, 0.04);
  EXPECT_NEAR(norm(two.tracks[0].samples[1].position - two.tracks[0].samples[0].position), 1.0, 0.01);
  EXPECT_TRUE(error_in(header + "1; Car; 1.0; 5.0; " + groups + "37.9; 23.7")
                  .starts_with("f:2: expected 4 fields of a vehicle and 6 of each of its places, but got 18 "
                               "in the last line, which may be cut"));
  EXPECT_EQ(error_in(header + "1; Car; 1; 5; " + groups + "\n2; Car; 1; 5; " + groups +
                     "37.9; east; 5; 0; 0; 0.08\n"),
            "f:3: expected a number as longitude ('lon'), but got 'east'");
}

TEST(WideRecordings, WhatLooksLikeOneIsNamed) {
  for (const char* strava :
       {R"({"time":{"data":[0,1],"series_type":"distance"},"latlng":{"data":[[46.1,7.2],[46.2,7.3]]}})",
        R"({"latlng": [[46.1, 7.2]], "time": [0]})",
        R"([{"type":"latlng","data":[[46.1,7.2]],"series_type":"time"},{"type":"time","data":[0]}])"})
    EXPECT_NE(error_in(strava).find("streams of Strava, whose times count from the start of their activity"),
              std::string::npos)
        << strava;
  for (const char* lists : {R"({"id":["a","b"],"time":[0,0],"x":[1,2],"y":[1,2]})",
                            R"({"id":{"0":"a","1":"b"},"time":{"0":0,"1":0}})"})
    EXPECT_NE(error_in(lists).find("JSON with a list for each name"), std::string::npos) << lists;
  for (const char* elements :
       {"OBJECT_NAME,OBJECT_ID,EPOCH,MEAN_MOTION,ECCENTRICITY\nISS,1998-067A,2024-01-01T00:00:00,15.5,0."
        "0001\n",
        R"([{"OBJECT_NAME":"ISS","EPOCH":"2024-01-01T00:00:00","MEAN_MOTION":15.5,"ECCENTRICITY":0.0001}])",
        "CCSDS_OMM_VERS = 2.0\nOBJECT_NAME = ISS\nEPOCH = 2024-01-01T00:00:00\nMEAN_MOTION = "
        "15.5\nECCENTRICITY = 0.0001\n"})
    EXPECT_NE(error_in(elements).find("orbital elements (OMM), not positions"), std::string::npos)
        << elements;
  // Records may begin with a time or a list.
  EXPECT_EQ(
      parse("{\"time\":0,\"id\":\"a\",\"x\":1,\"y\":2}\n{\"time\":1,\"id\":\"a\",\"x\":2,\"y\":2}\n").format,
      "JSON records");
  EXPECT_EQ(
      parse("{\"position\":[1,2],\"id\":\"a\",\"time\":0}\n{\"position\":[1,2],\"id\":\"a\",\"time\":1}\n",
            [] {
              TrackOptions options;
              options.hints.columns = "id=id,time=time,x=position.0,y=position.1";
              return options;
            }())
          .tracks.size(),
      1u);
}

}  // namespace
}  // namespace kinesphere::program::wide_recordings_test
