// `kinesphere watch` with sentences of AIS: from a file, from standard input, from a UDP port.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"
#include "program/watch/live_watch.hpp"

namespace kinesphere::program::ais_program_test {
namespace {

using Json = nlohmann::json;

/// Returns lines of two ships head-on along 53.5 N, of class A every 10 s and of class B every 30 s, and of
/// one at anchor every 180 s, which are 5 minutes of `messages` messages. `tag` returns what precedes a
/// sentence.
template <class Tag>
std::string head_on_at_sea(Tag tag, int& messages) {
  std::string text;
  messages = 0;
  constexpr double degrees_of_metre = 1.0 / (111'319.5 * 0.5948);
  for (int t = 0; t <= 300; t += 10) {
    const auto add = [&](const std::string& bits) {
      text += tag(t) + vdm(bits) + "\n";
      ++messages;
    };
    const auto at = [&](double metres) { return encoded_degrees(8.0 + degrees_of_metre * metres); };
    EncodedStation s{
        .mmsi = 211'000'001, .latitude = encoded_degrees(53.5), .second = (20 + t) % 60, .status = 0};
    s.longitude = at(6.17333 * t);
    s.speed = 120;
    s.course = 900;
    add(class_a_message(s));
    s.mmsi = 211'000'003;
    s.longitude = at(2000.0 - 3.60111 * t);
    s.speed = 70;
    s.course = 2700;
    if (t % 30 == 0) add(class_b_message(s));
    if (t % 180 == 0)
      add(class_a_message({.mmsi = 211'000'002,
                           .longitude = at(1300.0),
                           .latitude = encoded_degrees(53.5005),
                           .speed = 0,
                           .status = 1}));
  }
  return text;
}

class AisProgram : public ProgramTest {};

/// Returns the pairs that are not apart at some time.
std::set<std::string> pairs_told(const std::string& alerts) {
  std::set<std::string> pairs;
  std::istringstream lines(alerts);
  for (std::string line; std::getline(lines, line);) {
    const Json alert = Json::parse(line);
    if (alert["event"] == "verdict" && alert["verdict"] != "apart")
      pairs.insert(alert["first"].get<std::string>() + " " + alert["second"].get<std::string>());
  }
  return pairs;
}

TEST_F(AisProgram, TakesBothClassesAndShipsAtAnchor) {
  int messages = 0;
  const std::string text =
      head_on_at_sea([](int t) { return tag_block(fmt::format("s:rx1,c:{}", 1700000000 + t)); }, messages);
  ASSERT_EQ(messages, 44);
  const std::string options = " --separation sphere:500m --summary '" + path("summary.json") + "'";
  const std::string file = write("ships.log", text);
  for (const auto& [arguments, before] : {std::pair{file, std::string()},
                                          {"-", "cat '" + file + "' | "},
                                          {file + " --format nmea", std::string()}}) {
    const ProgramRun run = this->run("watch " + arguments + options, before);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const Json summary = Json::parse(read_text(path("summary.json")));
    EXPECT_EQ(summary["reports"], messages) << run.err;
    EXPECT_EQ(summary["malformed"], 0);
    EXPECT_TRUE(pairs_told(run.out).contains("211000001 211000003")) << run.out;
  }
}

/// Reports of a single ship at anchor come each 180 s: none is a wrong clock.
TEST_F(AisProgram, TakesALonelyShipAtAnchor) {
  std::string text;
  for (int k = 0; k < 480; ++k)
    text += vdm(class_a_message({.longitude = 0, .latitude = 0, .speed = 0, .status = 1}),
                fmt::format("{}", 1700000000 + 180 * k)) +
            "\n";
  const ProgramRun run = this->run("watch " + write("a.nmea", text) +
                                   " --separation sphere:500m --summary '" + path("summary.json") + "'");
  EXPECT_EQ(Json::parse(read_text(path("summary.json")))["reports"], 480) << run.err;
}

TEST_F(AisProgram, AsksForTheTimesOfARecording) {
  int messages = 0;
  const std::string file = write("r.nmea", head_on_at_sea([](int) { return ""; }, messages));
  const std::string options = " --separation sphere:500m --quiet";
  expect_wrong_input("watch " + file + options,
                     {"r.nmea", "received", "\\c:1700000000*5F\\", "--clock arrival"});
  // It is not stamped with the time of its replay.
  expect_wrong_input("watch " + file + options + " --clock arrival", {"r.nmea", "received"});
  expect_wrong_input("watch -" + options, {"standard input", "received"}, "cat '" + file + "' | ");
  const ProgramRun live = run("watch -" + options + " --clock arrival", "cat '" + file + "' | ");
  EXPECT_EQ(live.exit_code, 0) << live.err;
  EXPECT_NE(live.out, "");
}

TEST_F(AisProgram, TellsTheSizeItCounts) {
  EncodedStation s{.mmsi = 1, .longitude = 0, .latitude = 0, .speed = 0};
  s.bow = s.stern = 399;
  s.port = s.starboard = 29;
  std::string text;
  for (int t = 0; t < 60; t += 10) {
    const std::string time = fmt::format("{}", 1700000000 + t);
    // 600 m apart: 500 m and the ship's 400 m are more.
    text +=
        vdm(static_message(s), time) + "\n" + vdm(class_a_message(s), time) + "\n" +
        vdm(class_b_message({.mmsi = 2, .longitude = 3240, .latitude = 0, .speed = 0, .accuracy = 1}), time) +
        "\n";
  }
  const ProgramRun run =
      this->run("watch " + write("a.nmea", text) + " --separation sphere:500m --position-error 1 --only all");
  EXPECT_NE(run.out.find("extent: 401.1"), std::string::npos) << run.out;
  EXPECT_EQ(pairs_told(run.out).size(), 1u);
}

class UdpSender {
 public:
  explicit UdpSender(int port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(port));
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;
  ~UdpSender() { ::close(socket_); }
  void send(const std::string& text) const {
    EXPECT_EQ(::sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&address_),
                       sizeof address_),
              static_cast<ssize_t>(text.size()));
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

int udp_port_of(const LiveWatch& watch) {
  const std::string before = "udp://127.0.0.1:";
  for (int k = 0; k < 500; ++k) {
    const std::string said = watch.err();
    const std::size_t at = said.find(before);
    if (at != std::string::npos && said.find('\n', at) != std::string::npos)
      return std::stoi(said.substr(at + before.size()));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ADD_FAILURE() << watch.err();
  return 0;
}

/// Without times of their own, datagrams have that at which they are read.
TEST_F(AisProgram, ReadsAUdpPort) {
  LiveWatch watch("udp://127.0.0.1:0 --separation sphere:500m --only all --alerts '" + path("alerts") + "'",
                  path("err"));
  const UdpSender sender(udp_port_of(watch));
  const auto ship = [](std::uint32_t mmsi) {
    return class_b_message({.mmsi = mmsi, .longitude = 0, .latitude = 0, .speed = 0});
  };
  sender.send("");
  // One sentence in a datagram, with or without the end of its line, and several.
  sender.send(vdm(ship(1)));
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  sender.send(vdm(ship(2)) + "\r\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  sender.send("mumble");
  sender.send(vdm(ship(1)) + "\n" + vdm(ship(3)) + "\n");
  std::string alerts;
  for (int k = 0; k < 500 && std::ranges::count(alerts, '\n') < 3; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    alerts = read_text(path("alerts"));
  }
  EXPECT_EQ(pairs_told(alerts).size(), 3u) << alerts << watch.err();
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const double told =
      alerts.empty() ? 0.0 : Json::parse(alerts.substr(0, alerts.find('\n')))["time"].get<double>();
  EXPECT_NEAR(told, now, 60.0);
  watch.signal(SIGTERM);
  EXPECT_EQ(watch.wait(), 0);
  EXPECT_NE(watch.err().find("malformed"), std::string::npos) << watch.err();
}

TEST_F(AisProgram, RefusesOtherUdpAddresses) {
  for (const char* address : {"udp://0.0.0.0:10110", "udp://192.168.0.1:10110", "udp://127.0.0.1",
                              "udp://127.0.0.1:x", "udp://127.0.0.1:70000"})
    expect_wrong_input(std::string("watch ") + address + " --separation sphere:500m",
                       {address, "udp://127.0.0.1:PORT"});
  LiveWatch first("udp://127.0.0.1:0 --separation sphere:500m", path("first"));
  const std::string taken = fmt::format("udp:localhost:{}", udp_port_of(first));
  expect_wrong_input("watch " + taken + " --separation sphere:500m", {"udp://127.0.0.1:", "cannot read"});
}

}  // namespace
}  // namespace kinesphere::program::ais_program_test
