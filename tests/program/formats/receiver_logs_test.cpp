// Logs of receivers: NMEA 0183.
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

}  // namespace
}  // namespace kinesphere::program::receiver_logs_test
