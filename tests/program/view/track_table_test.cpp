// Recordings of real motion as JSON for the viewer's page: every number to the last bit, and a limited
// length.
#include "view/track_table.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "kinesphere/random.hpp"
#include "program/support.hpp"

namespace kinesphere::program::track_table_test {
namespace {

/// Returns a number with a random mantissa, of a size from 2^-300 to 2^300.
double any_number(Random& random) {
  const double size = std::ldexp(1.0, static_cast<int>(random.uniform(-300.0, 300.0)));
  return random.uniform(-1.0, 1.0) * size;
}

TEST(TrackTable, NumbersReadBackAsTheSame) {
  Random random(2005);
  TrackSet track_set;
  for (const char* const id : {"ann", "bob"}) {
    RecordedTrack track{id, {}};
    double time = random.uniform(-1.0, 1.0);
    for (int k = 0; k < 2000; ++k, time += random.uniform(0.1, 1.0))
      track.samples.push_back({time, {any_number(random), any_number(random), any_number(random)}});
    track.samples.front().position = {-0.0, std::numeric_limits<double>::denorm_min(), 1e22};
    track_set.tracks.push_back(track);
  }
  const auto table = nlohmann::json::parse(track_table(track_set, "numbers"));
  ASSERT_EQ(table["tracks"].size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const RecordedTrack& track = track_set.tracks[k];
    const auto& read = table["tracks"][k];
    EXPECT_EQ(read["id"], track.id);
    ASSERT_EQ(read["times"].size(), track.samples.size());
    ASSERT_EQ(read["positions"].size(), 3 * track.samples.size());
    for (std::size_t sample = 0; sample < track.samples.size(); ++sample) {
      EXPECT_EQ(read["times"][sample].get<double>(), track.samples[sample].time);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(read["positions"][3 * sample + axis].get<double>(),
                  track.samples[sample].position[static_cast<int>(axis)]);
      }
    }
  }
}

TEST(TrackTable, NamesAreText) {
  TrackSet track_set;
  track_set.is_plane = track_set.in_metres = true;
  track_set.tracks = {{"a\"b\\\n\xff", {{0.0, {}}, {1.0, {}}}}};
  EXPECT_EQ(track_table(track_set, "\xc3\xa9.csv"),
            "{\"name\": \"\xc3\xa9.csv\", \"plane\": true, \"unit\": \"m\", \"tracks\": [\n"
            "{\"id\": \"a\\\"b\\\\\\n\xef\xbf\xbd\", \"times\": [0,1], \"positions\": [0,0,0,0,0,0]}\n]}\n");
}

TEST(TrackTable, HasALimit) {
  TrackSet track_set;
  track_set.samples = 1000;
  track_set.tracks = {{"ann", {}}};
  for (int k = 0; k < 1000; ++k) track_set.tracks[0].samples.push_back({1.0 * k, {}});
  const std::string table = track_table(track_set, "long.csv");
  EXPECT_EQ(track_table(track_set, "long.csv", table.size()), table);
  error_of([&] { track_table(track_set, "long.csv", table.size() - 1); });
  const std::string error = error_of([&] { track_table(track_set, "long.csv", 5000); });
  for (const char* const part : {"long.csv", "5,000 bytes", "1,000 samples"})
    EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(TrackTable, RefusesCurvesThatOverflow) {
  TrackSet track_set;
  track_set.tracks = {{"ann", {{0.0, {}}, {1.0, {}}}},
                      {"bob", {{0.0, {-1e308, 0, 0}}, {1.0, {1e308, 0, 0}}}}};
  EXPECT_TRUE(error_of([&] { track_table(track_set, "far.csv"); }).starts_with("id 'bob': "));
}

}  // namespace
}  // namespace kinesphere::program::track_table_test
