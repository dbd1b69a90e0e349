// Aircraft on the ground, which send no height: --ground.
#include <fmt/format.h>

#include <algorithm>

#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::ground_test {
namespace {

/// A landing: one aircraft stands on the runway, without a height, and another comes down to it.
std::string landing(std::string_view standing, std::string_view columns, std::string_view flying) {
  std::string text = fmt::format("icao24,time,lon,lat,{}\n", columns);
  for (int t = 0; t < 60; ++t) {
    text += fmt::format("aaaaaa,{},8,47,{}\n", t, standing);
    text += fmt::format("bbbbbb,{},8,{:.6f},{}{}\n", t, 47.03 - 0.0006 * t, 440 + 10 * (60 - t), flying);
  }
  return text;
}

std::string message(std::string_view hex, double latitude, std::string_view height) {
  return fmt::format(R"({{"hex":"{}","lat":{:.6f},"lon":8,"alt_baro":{},"seen_pos":0,"nac_p":8}})", hex,
                     latitude, height);
}

std::string landing_messages() {
  std::string text;
  for (int t = 0; t < 60; ++t)
    text += fmt::format(
        "{{\"now\":{},\"aircraft\":[{},{}]}}\n", 1600000000 + t, message("aaaaaa", 47.0, "\"ground\""),
        message("bbbbbb", 47.03 - 0.0006 * t, fmt::format("{}", 1400 + 30 * std::max(0, 50 - t))));
  return text;
}

TrackSet parse(const std::string& text, const std::string& ground) {
  TrackOptions options;
  options.ground = ground;
  return parse_tracks({{"t.txt", text}}, options);
}

double height_of(const TrackSet& track_set, std::size_t track) {
  return track_set.coordinates.geographic(track_set.tracks[track].samples[0].position)->z;
}

TEST(Ground, AircraftAreCountedAndNamed) {
  for (const std::string& text : {landing("ground", "altitude_m", ""),
                                  landing(",true", "altitude_m,onground", ",false"), landing_messages()}) {
    const TrackSet without = parse(text, "");
    EXPECT_EQ(without.on_ground.count, 60u) << text.substr(0, 200);
    EXPECT_EQ(without.missing.count, 0u);
    EXPECT_EQ(without.tracks.size(), 1u);
    ASSERT_EQ(without.presences.size(), 2u);
    EXPECT_EQ(without.presences[0].samples, 60u) << "known to be there";
    EXPECT_EQ(without.presences[0].used, 0u);
    const TrackSet with = parse(text, "440m");
    EXPECT_EQ(with.on_ground.count, 60u);
    ASSERT_EQ(with.tracks.size(), 2u);
    EXPECT_EQ(with.tracks[0].id, "aaaaaa");
    EXPECT_NEAR(height_of(with, 0), 440.0, 1e-6);
  }
}

TEST(Ground, HasAUnit) {
  EXPECT_NEAR(height_of(parse(landing("ground", "altitude_ft", ""), "1000ft"), 0), 304.8, 1e-6);
  EXPECT_NEAR(height_of(parse(landing("ground", "altitude_ft", ""), "-3"), 0), -3.0, 1e-6) << "metres";
  EXPECT_NE(error_of([&] { parse(landing("ground", "altitude_m", ""), "high"); }).find("--ground: expected"),
            std::string::npos);
  const std::string plain = "id,time,x,y,z\na,0,0,0,ground\na,1,1,0,ground\nb,0,0,0,5\nb,1,1,0,5\n";
  EXPECT_EQ(parse(plain, "2").tracks.at(0).samples[0].position.z -
                parse(plain, "2").tracks.at(1).samples[0].position.z,
            -3.0);
  EXPECT_NE(error_of([&] { parse(plain, "2m"); }).find("--ground: expected a number without a unit"),
            std::string::npos);
}

TEST(Ground, OtherRowsWithoutAHeightAreStillMissing) {
  const std::string text = landing(",false", "altitude_m,onground", ",false");
  EXPECT_NE(error_of([&] { parse(text, "440m"); }).find("(see --missing)"), std::string::npos);
}

class GroundProgram : public ProgramTest {};

TEST_F(GroundProgram, FindsALandingOnAnOccupiedRunway) {
  const std::string file = write("sky.json", landing_messages());
  const std::string question = "tracks " + file + " --separation cylinder:300m:100ft";
  const ProgramRun without = run(question);
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.out.find("\non the ground     60 "), std::string::npos) << without.out;
  EXPECT_NE(without.err.find("are of aircraft on the ground and left out"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("'aaaaaa'"), std::string::npos) << "it has no track: " << without.err;
  const ProgramRun with = run(question + " --ground 1400ft");
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_NE(with.out.find("\napproaches        1 "), std::string::npos) << with.out;
  EXPECT_EQ(with.err.find("ground"), std::string::npos) << with.err;
}

}  // namespace
}  // namespace kinesphere::program::ground_test
