// Logs of receivers: NMEA 0183 and IGC.
#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::receiver_logs_test {
namespace {

TrackSet parse(std::vector<NamedText> files, const TrackOptions& options = {}) {
  return parse_tracks(std::move(files), options);
}
std::string error_in(const std::string& text) {
  return error_of([&] { parse({{"log.nmea", text}}); });
}

std::string with_checksum(const std::string& sentence, const std::string& head = "") {
  const int sum = std::accumulate(sentence.begin(), sentence.end(), 0, [](int a, char c) { return a ^ c; });
  return fmt::format("{}${}*{:02X}\r\n", head, sentence, sum);
}

/// A place in ten-thousandths of minutes, which the sentences say exactly.
struct LoggedPlace {
  std::int64_t east = 0, north = 0;  ///< 1e-4 minutes
  int second = 0;                    ///< since the first midnight
  double height = 0.0;

  double longitude() const { return static_cast<double>(east) / 600'000.0; }
  double latitude() const { return static_cast<double>(north) / 600'000.0; }
};

std::string minutes(std::int64_t angle, int digits, std::string_view letters) {
  const std::int64_t size = std::abs(angle), whole = size / 600'000, rest = size % 600'000;
  return fmt::format("{:0{}}{:02}.{:04},{}", whole, digits, rest / 10'000, rest % 10'000,
                     letters[angle < 0 ? 1 : 0]);
}
std::string place_text(const LoggedPlace& place) {
  return minutes(place.north, 2, "NS") + "," + minutes(place.east, 3, "EW");
}
std::string clock_text(int second) {
  return fmt::format("{:02}{:02}{:02}", second / 3600 % 24, second / 60 % 60, second % 60);
}

std::string rmc(const LoggedPlace& place, const std::string& talker = "GP", const std::string& head = "") {
  return with_checksum(fmt::format("{}RMC,{}.50,A,{},0.0,0.0,{:02}1224,,,A", talker, clock_text(place.second),
                                   place_text(place), 31 + place.second / 86'400),
                       head);
}
std::string gga(const LoggedPlace& place, const std::string& talker = "GP", const std::string& head = "") {
  return with_checksum(fmt::format("{}GGA,{}.50,{},1,08,0.9,{:.1f},M,46.9,M,,", talker,
                                   clock_text(place.second), place_text(place), place.height),
                       head);
}

/// A second a step, around midnight of the last day of 2024.
std::vector<LoggedPlace> drawn_places(Random& random, int count, std::int64_t east = 0,
                                      std::int64_t north = 0) {
  std::vector<LoggedPlace> places;
  for (int k = 0; k < count; ++k)
    places.push_back({east + static_cast<std::int64_t>(random.uniform(-900, 900)),
                      north + static_cast<std::int64_t>(random.uniform(-900, 900)), 86'000 + k,
                      std::round(random.uniform(-50, 90)) / 10.0});
  return places;
}

void expect_places(const TrackSet& track_set, std::size_t track, const std::vector<LoggedPlace>& places,
                   bool has_heights) {
  const auto& samples = track_set.tracks[track].samples;
  ASSERT_EQ(samples.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto at = track_set.coordinates.geographic(samples[k].position);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x, places[k].longitude(), 1e-9);
    EXPECT_NEAR(at->y, places[k].latitude(), 1e-9);
    EXPECT_NEAR(at->z, has_heights ? places[k].height : 0.0, 1e-6);
    EXPECT_EQ(samples[k].time - samples[0].time, static_cast<double>(places[k].second - places[0].second));
  }
}

TEST(ReceiverLogs, AreReadAsTheyWereWritten) {
  constexpr std::uint64_t seed = 183;
  Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(fmt::format("seed {}, trial {}", seed, trial));
    const auto places = drawn_places(random, 500, static_cast<std::int64_t>(random.uniform(-9e7, 9e7)),
                                     static_cast<std::int64_t>(random.uniform(-4e7, 4e7)));
    std::string log = "$GPGSV,1,1,00*79\r\n";
    // The date of the second day is that of the first, and a midnight.
    for (const LoggedPlace& place : places)
      log += gga(place, "GN") + (place.second < 86'400 ? rmc(place, "GN") : "");
    const TrackSet boat = parse({{"boat.nmea", log}});
    EXPECT_EQ(boat.format, "NMEA 0183");
    ASSERT_EQ(boat.tracks.size(), 1u);
    EXPECT_EQ(boat.tracks[0].id, "boat");
    EXPECT_EQ(boat.times.text(boat.tracks[0].samples[0].time), "2024-12-31T23:53:20.5Z");
    expect_places(boat, 0, places, true);
  }
}

TEST(ReceiverLogs, KeepReceiversApart) {
  constexpr std::uint64_t seed = 184;
  Random random(seed);
  const auto one = drawn_places(random, 60), other = drawn_places(random, 60, 5000, 0);
  std::string merged, tagged, grouped, first, second, handed_over;
  for (std::size_t k = 0; k < one.size(); ++k) {
    LoggedPlace day_before = one[k], day_before_other = other[k];
    first += rmc(day_before);
    second += rmc(day_before_other);
    merged += rmc(day_before, "GP") + rmc(day_before_other, "GL");
    tagged += rmc(day_before, "GP", "\\s:a*28\\") + rmc(day_before_other, "GP", "\\s:b*2B\\");
    handed_over += rmc(day_before, k < 30 ? "GP" : "GN");
  }
  for (const auto& [files, ids, warnings] :
       {std::tuple(std::vector<NamedText>{{"a/port.nmea", first}, {"starboard.log", second}},
                   std::vector<std::string>{"port", "starboard"}, 0u),
        std::tuple(std::vector<NamedText>{{"log", merged}}, std::vector<std::string>{"log GP", "log GL"}, 1u),
        std::tuple(std::vector<NamedText>{{"log", tagged}}, std::vector<std::string>{"a", "b"}, 0u)}) {
    const TrackSet two = parse(files);
    ASSERT_EQ(two.tracks.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(two.tracks[k].id, ids[k]);
    EXPECT_EQ(two.warnings.size(), warnings);
    expect_places(two, 0, one, false);
    expect_places(two, 1, other, false);
  }
  // A receiver that begins to use other satellites is the same.
  expect_places(parse({{"log", handed_over}}), 0, one, false);
  // Two of one talker are asked about, not mixed.
  EXPECT_NE(error_in(first.substr(0, first.find('\n') + 1) + second).find("see --duplicates"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              parse({{"a/log", first}, {"b/log", second}});
            }).find("files of different names"),
            std::string::npos);
}

TEST(ReceiverLogs, WithoutDatesCountSeconds) {
  constexpr std::uint64_t seed = 185;
  Random random(seed);
  auto places = drawn_places(random, 500);
  std::string log;
  for (const LoggedPlace& place : places) log += gga(place);
  const TrackSet track_set = parse({{"rover.nmea", log}});
  expect_places(track_set, 0, places, true);
  EXPECT_EQ(track_set.times.text(track_set.tracks[0].samples[450].time), "86450.5");
  EXPECT_EQ(track_set.warnings.size(), 1u);
}

TEST(ReceiverLogs, WrongOnesNameLineAndField) {
  const std::string good = rmc({6000, 0, 10, 0}) + rmc({6000, 0, 11, 0});
  const auto wrong = [&](const std::string& fields) {
    return error_in(good + with_checksum("GPRMC," + fields));
  };
  EXPECT_EQ(
      wrong("000012,A,0960.0,N,00800.0,E,,,311224,,"),
      "log.nmea:3: expected a latitude, ddmm.mm and N or S (field 4 of the sentence), but got '0960.0,N'");
  EXPECT_EQ(wrong("000012,A,0900.0,N,00800.0,X,,,311224,,"),
            "log.nmea:3: expected a longitude, dddmm.mm and E or W (field 6 of the sentence), but got "
            "'00800.0,X'");
  EXPECT_EQ(wrong("006012,A,0900.0,N,00800.0,E,,,311224,,"),
            "log.nmea:3: expected a time of day, hhmmss (field 2 of the sentence), but got '006012'");
  EXPECT_EQ(wrong("000012,A,0900.0,N,00800.0,E,,,310224,,"),
            "log.nmea:3: expected a date, ddmmyy (field 10 of the sentence), but got '310224'");
  EXPECT_EQ(error_in(with_checksum("GPRMC,,V,,,,,,,,,,N")),
            "log.nmea: expected sentences RMC, GGA or GNS with a valid position, but of those that it has 0 "
            "have a wrong checksum and 1 have no position");
  // What is damaged, or has no fix, is left out and said.
  std::string damaged = rmc({6000, 0, 12, 0});
  damaged[20] ^= 1;
  const TrackSet rest = parse(
      {{"f", with_checksum("GPRMC,,V,,,,,,,,,,N") + good + damaged + rmc({6000, 0, 13, 0}) + "$GPRMC,0000"}});
  ASSERT_EQ(rest.tracks.size(), 1u);
  EXPECT_EQ(rest.tracks[0].samples.size(), 3u);
  EXPECT_EQ(rest.warnings,
            (std::vector<std::string>{"f: sentences without a valid position are left out: 1",
                                      "f:4: a wrong checksum (so many damaged sentences are left out: 2)"}));
}

/// Fixes of a glider have thousandths of minutes, and altitudes in whole metres.
std::string igc(const std::vector<LoggedPlace>& places, bool has_pressure) {
  std::string text = "AXXXABC FLIGHT:1\r\nHFDTEDATE:311224,01\r\nHFGTYGLIDERTYPE:B4\r\n";
  for (const LoggedPlace& place : places) {
    const auto angle = [](std::int64_t size, int digits, std::string_view letters) {
      return fmt::format("{:0{}}{:05}{}", std::abs(size) / 600'000, digits, std::abs(size) % 600'000 / 10,
                         letters[size < 0 ? 1 : 0]);
    };
    text += fmt::format("B{}{}{}A{:05}{:05}00123\r\n", clock_text(place.second), angle(place.north, 2, "NS"),
                        angle(place.east, 3, "EW"), has_pressure ? static_cast<int>(place.height) : 0,
                        static_cast<int>(place.height) + (has_pressure ? 50 : 0));
  }
  return text;
}

TEST(ReceiverLogs, OfGlidersAreReadAsTheyWereWritten) {
  constexpr std::uint64_t seed = 186;
  Random random(seed);
  auto one = drawn_places(random, 450, 5'000'000, 28'000'000),
       other = drawn_places(random, 450, 5'000'400, 28'000'000);
  for (auto* const places : {&one, &other})
    for (LoggedPlace& place : *places)
      place.east -= place.east % 10, place.north -= place.north % 10,
          place.height = std::round(900 + place.height);
  for (const bool has_pressure : {true, false}) {
    const TrackSet two = parse({{"a.igc", igc(one, has_pressure)}, {"b.igc", igc(other, has_pressure)}});
    ASSERT_EQ(two.tracks.size(), 2u);
    EXPECT_EQ(two.tracks[1].id, "b");
    EXPECT_EQ(two.times.text(two.tracks[0].samples[420].time), "2025-01-01T00:00:20Z");
    expect_places(two, 0, one, true);
    expect_places(two, 1, other, true);
  }
  TrackOptions geometric;
  geometric.altitude = FormatChoices::Altitude::geometric;
  const TrackSet satellite = parse({{"a.igc", igc(one, true)}}, geometric);
  for (LoggedPlace& place : one) place.height += 50;
  expect_places(satellite, 0, one, true);
}

TEST(ReceiverLogs, WrongOnesOfGlidersNameLineAndColumns) {
  const std::string head = "AXXX\nHFDTE311224\n", good = "B0000004700000N00800000EA0090000950\n";
  const auto wrong = [&](const std::string& line) {
    return error_of([&] { parse({{"f.igc", head + good + line}}); });
  };
  EXPECT_EQ(wrong("B0000014760000N00800000EA0090000950\n"),
            "f.igc:4: expected a latitude, ddmmmmm and N or S (columns 8 to 15), but got '4760000N'");
  EXPECT_EQ(wrong("B0000014700000N00800000EA009x000950\n"),
            "f.igc:4: expected an altitude by pressure (columns 26 to 30), but got '009x0'");
  EXPECT_EQ(wrong("B00000147\n"),
            "f.igc:4: expected a whole B record (columns 1 to 35), but got 'B00000147'");
  EXPECT_EQ(error_of([&] {
              parse({{"f.igc", "AXXX\n" + good + "HFDTE311224\n"}});
            }),
            "f.igc:2: expected a date (a record HFDTE) before the first fix");
}

TEST(ReceiverLogs, ReadsPlt) {
  const auto plt = [](const std::string& title, const std::string& datum, const std::string& rows) {
    return title + "\n" + datum + "\nAltitude is in Feet\nReserved 3\n0,2,255,My Track,0,0,2,8421376\n0\n" +
           rows;
  };
  const std::string ozi_title = "OziExplorer Track Point File Version 2.1";
  // Days are rounded: these are 14:04:30 and 14:04:35.
  const std::string geolife = plt("Geolife trajectory", "WGS 84",
                                  "39.906631,116.385564,0,492,40097.5864583333,2009-10-11,14:04:30\r\n"
                                  "39.906554,116.385625,0,492,40097.5865162037,2009-10-11,14:04:35\r\n");
  const std::string row = "  39.906631, 116.385564,1,{}, {}, 11-Oct-09, 14:04:30\n";
  const auto ozi = [&](const char* height) {
    return plt(ozi_title, "WGS 84",
               fmt::format(fmt::runtime(row), 492, "40097.5864583") +
                   fmt::format(fmt::runtime(row), height, "40097.5864612"));
  };
  TrackOptions options;
  options.max_gap = 10.0;
  const TrackSet track_set = parse({{"walks/20091011.plt", geolife}, {"b.plt", ozi("492")}}, options);
  EXPECT_EQ(track_set.format, "PLT");
  EXPECT_TRUE(track_set.has_heights);
  ASSERT_EQ(track_set.tracks.size(), 2u);
  EXPECT_EQ(track_set.tracks[0].id, "20091011");
  const auto time = [&](std::size_t track, std::size_t sample) {
    return track_set.times.text(track_set.tracks[track].samples[sample].time);
  };
  EXPECT_EQ(time(0, 0), "2009-10-11T14:04:30Z");
  EXPECT_EQ(time(0, 1), "2009-10-11T14:04:35Z");
  EXPECT_EQ(time(1, 0), "2009-10-11T14:04:30Z");
  EXPECT_EQ(time(1, 1), "2009-10-11T14:04:30.248Z") << "parts of a second stay";
  const auto& places = track_set.tracks;
  // Both begin at one place, and 492 ft high.
  EXPECT_NEAR(norm(places[0].samples[0].position - places[1].samples[0].position), 0.0, 1e-6);
  EXPECT_NEAR(track_set.coordinates.as_in_file(places[0].samples[0].position).z, 492.0, 1e-6);
  const TrackSet without = parse({{"b.plt", ozi("-777")}});
  EXPECT_FALSE(without.has_heights);
  EXPECT_EQ(without.warnings.size(), 1u);
  EXPECT_NE(error_in(plt(ozi_title, "Tokyo", "")).find(":2: expected places of WGS 84"), std::string::npos);
  EXPECT_NE(error_in(plt(ozi_title, "WGS 84", "47,8,0,1\n"))
                .find(":7: expected latitude, longitude, break, height, days since 1899, but got '47,8,0,1'"),
            std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::receiver_logs_test
