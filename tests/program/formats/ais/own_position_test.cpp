// The receiver's own position beside sentences of AIS: as the clock of a log, and as the own track; streams
// that are joined in the middle of a line.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"

namespace kinesphere::program::own_position_test {
namespace {

using Json = nlohmann::json;

constexpr double degrees_of_metre = 1.0 / (111'319.5 * 0.5948);  // at 53.5 N

/// RMC at a time of 2023-11-14, with a speed of 10 knots eastward.
std::string rmc(int second, double longitude) {
  const double minutes = 60.0 * (longitude - 8.0);
  const std::string sentence =
      fmt::format("GPRMC,{:02}{:02}{:02}.00,A,5330.0000,N,008{:07.4f},E,10.0,90.0,141123,,,A", second / 3600,
                  second / 60 % 60, second % 60, minutes);
  const int sum = std::accumulate(sentence.begin(), sentence.end(), 0, [](int a, char c) { return a ^ c; });
  return fmt::format("${}*{:02X}\r\n", sentence, sum);
}

/// The own ship at 10 knots eastward, a position each second; a ship that comes towards it from 4 km, a
/// message each ten seconds; a message of the own transponder each ten, if it has one. They meet 389 s behind
/// 22:13:20.
std::string log_of_a_yacht(bool has_transponder) {
  constexpr int begin = 22 * 3600 + 13 * 60 + 20;
  constexpr double speed = 10 * 1852.0 / 3600.0;
  std::string log;
  for (int t = 0; t < 600; ++t) {
    const double east = 8.0 + degrees_of_metre * speed * t;
    log += rmc(begin + t, east);
    EncodedStation s{.mmsi = 211'000'002,
                     .latitude = encoded_degrees(53.5),
                     .speed = 100,
                     .course = 2700,
                     .second = (begin + t) % 60,
                     .accuracy = 1,
                     .status = 0};
    s.longitude = encoded_degrees(8.0 + degrees_of_metre * (4000.0 - speed * t));
    if (t % 10 == 4) log += vdm(class_a_message(s)) + "\r\n";
    s.mmsi = 211'000'001;
    s.longitude = encoded_degrees(east);
    s.course = 900;
    if (has_transponder && t % 10 == 7) {
      std::string own = vdm(class_b_message(s));
      own.replace(own.find("VDM"), 3, "VDO");
      // VDO instead of VDM changes the checksum by M ^ O.
      const std::size_t star = own.find('*');
      own = own.substr(0, star + 1) +
            fmt::format("{:02X}", std::stoi(own.substr(star + 1, 2), nullptr, 16) ^ 'M' ^ 'O');
      log += own + "\r\n";
    }
  }
  return log;
}

class OwnPosition : public ProgramTest {};

TEST_F(OwnPosition, IsTheClockOfALogWithoutTimes) {
  const std::string log = write("log", log_of_a_yacht(true));
  const ProgramRun watched =
      run("watch " + log + " --separation sphere:500m:2min --text --summary '" + path("summary.json") + "'");
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(watched.out.find("predicted  211000001 and 211000002"), std::string::npos)
      << watched.out << watched.err;
  const Json summary = Json::parse(read_text(path("summary.json")));
  EXPECT_EQ(summary["reports"], 120);
  EXPECT_EQ(summary["malformed"], 0);
  const ProgramRun approached =
      run("tracks " + log + " --distance 500m --quiet --contacts '" + path("a.csv") + "'");
  EXPECT_EQ(approached.exit_code, 0) << approached.err;
  const std::string contacts = read_text(path("a.csv"));
  EXPECT_EQ(std::ranges::count(contacts, '\n'), 2) << contacts;
  EXPECT_NE(contacts.find("2023-11-14T22:19:4"), std::string::npos) << contacts;
}

TEST_F(OwnPosition, IsTheOwnTrackOfWhoHasNoTransponder) {
  for (const bool has_transponder : {false, true}) {
    const std::string log = write("log", log_of_a_yacht(has_transponder));
    const ProgramRun watched =
        run("watch " + log + " --own gps --separation sphere:500m:2min --text --summary '" +
            path("summary.json") + "'");
    EXPECT_EQ(watched.exit_code, 0) << watched.err;
    EXPECT_NE(watched.out.find("predicted  211000002 and gps"), std::string::npos)
        << watched.out << watched.err;
    EXPECT_EQ(watched.out.find("211000001"), std::string::npos) << "the own transponder is no other ship\n"
                                                                << watched.out;
    EXPECT_EQ(Json::parse(read_text(path("summary.json")))["reports"], 660);
    std::filesystem::remove(path("summary.json"));
  }
  EXPECT_NE(run("watch " + write("log", "$GPGSV,1,1,00*79\n" + log_of_a_yacht(false).substr(80)) +
                " --own GPS --separation sphere:500m --text")
                .out.find("GPS"),
            std::string::npos);
}

TEST_F(OwnPosition, StreamsMayBeJoinedInTheMiddleOfALine) {
  const std::string log = log_of_a_yacht(true);
  const std::string later = log.substr(log.find("!AIVDM") + 9);
  const ProgramRun watched = run("watch " + write("log", later) + " --separation sphere:500m:2min --text");
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(watched.out.find("predicted"), std::string::npos) << watched.err;
  EXPECT_NE(watched.err.find("log:1: expected a sentence of AIS"), std::string::npos) << watched.err;
  std::string messages;
  for (int t = 0; t < 30; ++t)
    for (const char* hex : {"4CA1FA", "400A02"})
      messages += fmt::format(
          "MSG,3,1,1,{0},1,2024/03/01,12:00:{1:02}.000,2024/03/"
          "01,12:00:{1:02}.100,,35000,,,54.0,8.0,,,0,0,0,0\r\n",
          hex, t);
  const ProgramRun aircraft =
      run("watch " + write("sbs", messages.substr(12)) + " --separation cylinder:5NM:1000ft --text --quiet");
  EXPECT_NE(aircraft.out.find("within"), std::string::npos) << aircraft.err;
}

}  // namespace
}  // namespace kinesphere::program::own_position_test
