// Exports of programs that have their own way to write a table: EthoVision, Flightradar24.
#include <fmt/format.h>

#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::exports_test {
namespace {

TrackSet parse(const std::string& text) { return parse_tracks({{"folder/f.csv", text}}, {}); }
std::string error_in(const std::string& text) {
  return error_of([&] { parse(text); });
}

TEST(Exports, OfEthoVisionHaveTheirSubject) {
  for (const char separator : {';', ',', '\t'})
    for (const bool has_subject : {true, false}) {
      std::string text = "\"Number of header lines:\";\"6\"\r\n\"Experiment\";\"x\"\r\n";
      text += has_subject ? "\"Subject name\";\"Rat 7\"\r\n" : "\"Subject\";\"\"\r\n";
      text +=
          "\r\n\"Trial time\";\"Recording time\";\"X center\";\"Y center\"\r\n\"s\";\"s\";\"cm\";\"cm\"\r\n";
      text += "0.00;1.00;125;-50\r\n0.04;1.04;150;-50\r\n";
      std::ranges::replace(text, ';', separator);
      const TrackSet track_set = parse(text);
      EXPECT_EQ(track_set.format, "EthoVision");
      ASSERT_EQ(track_set.tracks.size(), 1u);
      EXPECT_EQ(track_set.tracks[0].id, has_subject ? "Rat 7" : "f");
      ASSERT_EQ(track_set.tracks[0].samples.size(), 2u);
      EXPECT_DOUBLE_EQ(track_set.tracks[0].samples[1].time - track_set.tracks[0].samples[0].time, 0.04);
      const auto& samples = track_set.tracks[0].samples;
      EXPECT_NEAR(norm(samples[1].position - samples[0].position), 0.25, 1e-12);
    }
  EXPECT_EQ(error_in("\"Number of header lines:\";\"many\"\n"),
            "folder/f.csv:1: expected the number of header lines, 3 or more, but got '\"Number of header "
            "lines:\";\"many\"'");
  const std::string broken = error_in(
      "\"Number of header lines:\";\"3\"\n\"Trial time\";\"X center\";\"Y center\"\n\"s\";\"cm\";\"cm\"\n"
      "0;1;2\n1;?!;2\n");
  EXPECT_NE(broken.find("folder/f.csv:5: expected a number as x"), std::string::npos) << broken;
  EXPECT_FALSE(error_in("\"Number of header lines:\"").empty());
}

TEST(Exports, OfFlightradar24HaveFeetAndKnots) {
  const std::string head = "Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction\n";
  const TrackSet flight = parse(head +
                                "1700000000,2023-11-14T22:13:20Z,DLH1,\"47.0,8.5\",1000,240,90\n"
                                "1700000060,2023-11-14T22:14:20Z,DLH1,\"47.0,8.5\",2000,240,90\n");
  EXPECT_EQ(flight.format, "Flightradar24");
  ASSERT_EQ(flight.tracks.size(), 1u);
  EXPECT_EQ(flight.tracks[0].id, "DLH1");
  const auto& samples = flight.tracks[0].samples;
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_DOUBLE_EQ(samples[1].time - samples[0].time, 60.0);
  EXPECT_NEAR(norm(samples[1].position - samples[0].position), 304.8, 1e-6);
  EXPECT_NE(
      error_in(head + "1700000000,2023-11-14T22:13:20Z,DLH1,47.0,1000,240,90\n").find("f.csv:2: expected 7"),
      std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::exports_test
