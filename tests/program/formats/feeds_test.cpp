// ASTERIX as its decoders write it in JSON, and feeds of GTFS-realtime.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::feeds_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}
bool warns(const TrackSet& track_set, std::string_view part) {
  return std::ranges::any_of(track_set.warnings,
                             [&](const std::string& each) { return each.find(part) != each.npos; });
}

enum class Decoder { lines, indented, python, jasterix };

/// What a record says: seconds since midnight, degrees (or NM from a radar), feet.
struct Plot {
  int category;
  double time;
  std::string address;
  int track;
  double first, second, feet;
};

/// Items of a record with the names of a decoder: values behind paths such as 105/Lat.
std::string record(const Plot& plot, Decoder decoder) {
  const bool ours = decoder != Decoder::jasterix;
  const std::string hex = "\"" + plot.address + "\"";
  const std::string address = ours ? hex : fmt::format("{}", std::stoi(plot.address, nullptr, 16));
  const std::string level = fmt::format("{}", plot.feet / 100.0), feet = fmt::format("{}", plot.feet);
  const auto value = [&](const char* name, const std::string& text) {
    return decoder == Decoder::python ? fmt::format(R"("{}": {{"val": {}, "desc": "some"}})", name, text)
                                      : fmt::format(R"("{}": {})", name, text);
  };
  const auto item = [&](const char* number, const std::string& content) {
    return fmt::format(", \"{}{}\": {{{}}}", ours ? "I" : "", number, content);
  };
  const auto number = [](double given) { return fmt::format("{:.9f}", given); };
  std::string text =
      fmt::format("\"{}010\": {{{}, {}}}", ours ? "I" : "", value("SAC", "25"), value("SIC", "7"));
  if (plot.category == 62) {
    text += item("070", value(ours ? "ToT" : "Time Of Track Information", number(plot.time)));
    text += item("105", value(ours ? "Lat" : "Latitude", number(plot.second)) + ", " +
                            value(ours ? "Lon" : "Longitude", number(plot.first)));
    if (!plot.address.empty())
      text += item("380", "\"ADR\": {" + value(ours ? "ADR" : "Target Address", address) + "}");
    text += item("040", value(ours ? "TrkN" : "Track Number", fmt::format("{}", plot.track)));
    return text + item("136", ours ? value("MFL", feet) : value("Measured Flight Level", level));
  }
  if (plot.category == 21) {
    text += item("073", value(ours ? "time_reception_position" : "Time of Message Reception for Position",
                              number(plot.time)));
    text +=
        item("130", value(ours ? "Lat" : "Latitude", "0") + ", " + value(ours ? "Lon" : "Longitude", "0"));
    text += item("131", value(ours ? "Lat" : "Latitude", number(plot.second)) + ", " +
                            value(ours ? "Lon" : "Longitude", number(plot.first)));
    text += item("080", value(ours ? "TAddr" : "Target Address", address));
    text += item("140",
                 value(ours ? "geometric_height" : "Geometric Height", fmt::format("{}", plot.feet + 500)));
    return text + item("145", value(ours ? "FL" : "Flight Level", level));
  }
  text += item("140", value(ours ? "ToD" : "Time-of-Day", number(plot.time)));
  text += item("220", value(ours ? "ACAddr" : "AIRCRAFT ADDRESS", address));
  text += item("042", value(ours ? "X" : "X-Component", number(plot.first)) + ", " +
                          value(ours ? "Y" : "Y-Component", number(plot.second)));
  return text + item("090", value(ours ? "FL" : "Flight Level", level));
}

std::string written(const std::vector<Plot>& plots, Decoder decoder) {
  std::string text = decoder == Decoder::python ? "[" : "";
  for (std::size_t k = 0; k < plots.size(); ++k) {
    const std::string items = record(plots[k], decoder);
    const int category = plots[k].category;
    switch (decoder) {
      case Decoder::lines:
        text += fmt::format("{{\"id\":{},\"cat\":{},\"timestamp\":1.5,\"CAT{:03}\":{{{}}}}}\n", k, category,
                            category, items);
        break;
      case Decoder::indented:
        text += fmt::format("{{\"id\":{},\n\"cat\":{},\n\"CAT{:03}\":{{\n\t{}}}}},\n", k, category, category,
                            items);
        break;
      case Decoder::python:
        text += fmt::format("{}{{\"category\": {}, \"len\": 45, {}, \"ts\": 3.5}}", k > 0 ? ", " : "",
                            category, items);
        break;
      case Decoder::jasterix:
        text += fmt::format(
            "{{\n  \"data_blocks\": [{{\"category\": {}, \"content\": {{\"index\": 3, \"records\": "
            "[{{{}}}]}}}}]\n}}\n",
            category, items);
    }
  }
  return text + (decoder == Decoder::python ? "]" : "");
}

/// Plots of two aircraft each second, at drawn places near each other.
std::vector<Plot> drawn_plots(int category, double begin) {
  Random random(93);
  std::vector<Plot> plots;
  for (int step = 0; step < 5; ++step)
    for (int body = 0; body < 2; ++body)
      plots.push_back({category, std::fmod(begin + step, 86'400.0), body == 0 ? "3C660C" : "0000A7",
                       40 + body, std::round(random.uniform(8.0, 8.1) * 1e6) / 1e6,
                       std::round(random.uniform(47.0, 47.1) * 1e6) / 1e6, 1000.0 * (30 + body)});
  return plots;
}

TEST(Asterix, IsReadAsEachDecoderWritesIt) {
  for (const int category : {21, 48, 62}) {
    const auto plots = drawn_plots(category, 86'397.5);
    for (const Decoder decoder : {Decoder::lines, Decoder::indented, Decoder::python, Decoder::jasterix}) {
      SCOPED_TRACE(fmt::format("category {}, decoder {}", category, static_cast<int>(decoder)));
      const TrackSet found = parse(written(plots, decoder));
      EXPECT_EQ(found.format, "ASTERIX (barometric altitude)");
      ASSERT_EQ(found.tracks.size(), 2u);
      EXPECT_EQ(found.coordinates.are_geographic(), category != 48);
      EXPECT_TRUE(warns(found, "seconds since midnight UTC"));
      for (std::size_t body = 0; body < 2; ++body) {
        const RecordedTrack& track = found.tracks[body];
        EXPECT_EQ(track.id, plots[body].address);
        ASSERT_EQ(track.samples.size(), 5u) << "the clock passes midnight";
        for (std::size_t k = 0; k < 5; ++k) {
          const Plot& plot = plots[2 * k + body];
          EXPECT_NEAR(track.samples[k].time - track.samples[0].time, static_cast<double>(k), 1e-9);
          const Vec3 at = category == 48 ? found.coordinates.as_in_file(track.samples[k].position)
                                         : *found.coordinates.geographic(track.samples[k].position);
          EXPECT_NEAR(at.x, plot.first, 1e-8);
          EXPECT_NEAR(at.y, plot.second, 1e-8);
          EXPECT_NEAR(category == 48 ? track.samples[k].position.z : at.z, 0.3048 * plot.feet, 1e-6);
        }
      }
    }
  }
}

TEST(Asterix, LateReportsAreFromBeforeMidnight) {
  auto plots = drawn_plots(62, 86'396.0);
  // Of the other aircraft that of the last second of the day comes behind the first of the next.
  std::rotate(plots.begin() + 7, plots.begin() + 8, plots.begin() + 9);
  const TrackSet found = parse(written(plots, Decoder::lines));
  ASSERT_EQ(found.tracks.size(), 2u);
  for (const RecordedTrack& track : found.tracks)
    EXPECT_NEAR(track.samples.back().time - track.samples.front().time, 4.0, 1e-9) << track.id;
}

TEST(Asterix, TakesGeometricHeightsWhereAsked) {
  TrackOptions options;
  options.altitude = FormatChoices::Altitude::geometric;
  const auto plots = drawn_plots(21, 5.0);
  const TrackSet found = parse(written(plots, Decoder::lines), options);
  EXPECT_NEAR(found.coordinates.geographic(found.tracks[0].samples[0].position)->z, 0.3048 * 30'500.0, 1e-6);
}

TEST(Asterix, KnowsAircraftByTheAddressOfTheirTrack) {
  auto plots = drawn_plots(62, 5.0);
  plots[0].address.clear();
  const TrackSet found = parse(written(plots, Decoder::lines));
  ASSERT_EQ(found.tracks.size(), 2u);
  for (const RecordedTrack& track : found.tracks)
    EXPECT_EQ(track.samples.size(), 5u) << "the track number of " << track.id << " has an address later";
  for (Plot& plot : plots) plot.address.clear();
  EXPECT_EQ(parse(written(plots, Decoder::python)).tracks[1].id, "track 41 (cat 62 of 25/7)");
}

TEST(Asterix, RadarsAreReadBySlantRangesOrLeftOut) {
  std::string text;
  for (int step = 0; step < 3; ++step)
    text += fmt::format(
        R"({{"cat":48,"CAT048":{{"I010":{{"SAC":1,"SIC":2}},"I140":{{"ToD":{}}},"I040":{{"RHO":{}.0,"THETA":90.0}},"I161":{{"Tn":9}}}}}})"
        "\n",
        step, 10 + step);
  const TrackSet slant = parse(text);
  ASSERT_EQ(slant.tracks.size(), 1u);
  EXPECT_NEAR(slant.coordinates.as_in_file(slant.tracks[0].samples[2].position).x, 12.0, 1e-9);
  EXPECT_TRUE(warns(slant, "places are by slant ranges, as the radar calculated none: 3"));
  const TrackSet both = parse(written(drawn_plots(62, 1.0), Decoder::lines) + text);
  EXPECT_EQ(both.tracks.size(), 2u);
  EXPECT_TRUE(warns(both, "places count from the radar, are left out: 3"));
}

TEST(Asterix, SeveralSensorsAreAskedAboutAndNothingIsNamed) {
  const std::string text =
      written(drawn_plots(62, 1.0), Decoder::lines) + written(drawn_plots(21, 1.5), Decoder::lines);
  EXPECT_NE(error_in(text).find("take one with --where 'sensor = \"cat 62 of 25/7\"'"), std::string::npos)
      << error_in(text);
  TrackOptions options;
  options.hints.where = "sensor = 'cat 62 of 25/7'";
  EXPECT_EQ(parse(text, options).samples, 10u);
  EXPECT_TRUE(error_in(R"({"cat":65,"CAT065":{"I010":{"SAC":25,"SIC":1},"I030":{"ToD":5}}})")
                  .starts_with("f: expected records of CAT021, CAT048 or CAT062"));
  EXPECT_TRUE(error_in(written(drawn_plots(21, 1.0), Decoder::lines).substr(0, 400))
                  .starts_with("f:2: expected JSON"));
  EXPECT_NE(error_in("\n\n-----\nData Block 1\nCategory: 48\n")
                .find("ASTERIX as text: write it as JSON, with asterix -j"),
            std::string::npos);
}

std::string vehicle(const char* id, int time, double longitude, bool snake) {
  return fmt::format(
      R"({{"id":"e{0}","vehicle":{{"trip":{{"{3}":"t"}},"position":{{"latitude":47.5,"longitude":{2},"speed":3.5}},"timestamp":"{1}","vehicle":{{"id":"{0}"}}}}}})",
      id, time, longitude, snake ? "trip_id" : "tripId");
}
std::string feed(const std::string& entities, bool snake = false) {
  return fmt::format(R"({{"header":{{"{}":"2.0","timestamp":"1700000100"}},"entity":[{}]}})",
                     snake ? "gtfs_realtime_version" : "gtfsRealtimeVersion", entities);
}

TEST(GtfsRealtime, ReadsVehiclesOfFeeds) {
  for (const bool snake : {false, true}) {
    std::string lines, list;
    for (const int step : {0, 1, 1, 2}) {
      const std::string one =
          feed(vehicle("a", 1'700'000'000 + step, 8.0 + 0.001 * step, snake) + "," +
                   vehicle("b", 1'700'000'000 + step, 8.5, snake) + R"(,{"id":"x","tripUpdate":{"trip":{}}})",
               snake);
      lines += one + "\n";
      list += (list.empty() ? "[" : ",\n") + one;
    }
    for (const std::string& text : {lines, list + "]"}) {
      const TrackSet found = parse(text);
      EXPECT_EQ(found.format, "GTFS-realtime");
      ASSERT_EQ(found.tracks.size(), 2u);
      EXPECT_EQ(found.tracks[0].id, "a");
      EXPECT_EQ(found.tracks[0].samples.size(), 3u) << "a position that is told again counts once";
      EXPECT_TRUE(found.coordinates.are_geographic());
    }
  }
}

TEST(GtfsRealtime, VehiclesWithoutAnIdOrATimeHaveThoseOfTheirEntity) {
  const std::string bare = R"({"id":"e1","vehicle":{"position":{"latitude":47.5,"longitude":8.5}}})";
  std::string next = feed(bare);
  next.replace(next.find("1700000100"), 10, "1700000130").replace(next.find("8.5"), 3, "8.6");
  const TrackSet found = parse(feed(bare) + "\n" + next);
  ASSERT_EQ(found.tracks.size(), 1u);
  EXPECT_EQ(found.tracks[0].id, "e1");
  EXPECT_EQ(found.tracks[0].samples[1].time - found.tracks[0].samples[0].time, 30.0);
  EXPECT_TRUE(warns(found, "positions without a time have that of their feed: 2"));
  EXPECT_EQ(error_in(feed(R"({"id":"x","tripUpdate":{}})")),
            "f: expected positions, but this file (GTFS-realtime) has none");
}

}  // namespace
}  // namespace kinesphere::program::feeds_test
