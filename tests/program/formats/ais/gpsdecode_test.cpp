// Messages of random fields give what gpsdecode (gpsd-clients) makes of the same sentences, where it is
// installed.
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/nmea/ais_message.hpp"
#include "kinesphere/random.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"

namespace kinesphere::program::gpsdecode_test {
namespace {

using Json = nlohmann::json;

class Gpsdecode : public ProgramTest {};

int any_int(Random& random, int below) {
  return std::min(below - 1, static_cast<int>(random.uniform(0.0, below)));
}

EncodedStation any_station(Random& random) {
  EncodedStation s{.mmsi = 200'000'000 + static_cast<std::uint32_t>(any_int(random, 500'000'000))};
  s.longitude = any_int(random, 2 * 108'000'000) - 108'000'000;
  s.latitude = any_int(random, 2 * 54'000'000) - 54'000'000;
  s.speed = any_int(random, 1022);
  s.course = any_int(random, 3600);
  s.second = any_int(random, 60);
  s.accuracy = any_int(random, 2);
  s.status = any_int(random, 15);
  s.bow = any_int(random, 512);
  s.stern = any_int(random, 512);
  s.port = any_int(random, 64);
  s.starboard = any_int(random, 64);
  return s;
}

std::string any_message(Random& random) {
  const EncodedStation s = any_station(random);
  switch (any_int(random, 7)) {
    case 0:
      return static_message(s);
    case 1:
      return search_aircraft_message(s);
    case 2:
      return class_b_message(s);
    case 3:
      return extended_class_b_message(s);
    case 4:
      return aid_to_navigation_message(s);
    case 5: {
      EncodedStation far = s;
      far.longitude /= 1000;
      far.latitude /= 1000;
      far.speed %= 63;
      far.course /= 10;
      return long_range_message(far, any_int(random, 2));
    }
    default:
      return class_a_message(s, 1 + any_int(random, 3));
  }
}

AisMessage decoded(const std::string& bits) {
  const auto [characters, fill] = payload_of(bits);
  AisBits read;
  read.append(characters, static_cast<std::size_t>(fill));
  return ais_message_of(read).value();
}

void expect_same(const AisMessage& message, const Json& other) {
  SCOPED_TRACE(other.dump());
  ASSERT_EQ(message.type, other["type"]);
  ASSERT_EQ(message.mmsi, other["mmsi"]);
  if (const auto& p = message.position) {
    EXPECT_NEAR(p->longitude.value(), other["lon"].get<double>(), p->is_coarse ? 0.051 : 1e-6);
    EXPECT_NEAR(p->latitude.value(), other["lat"].get<double>(), p->is_coarse ? 0.051 : 1e-6);
    EXPECT_EQ(p->is_accurate, other["accuracy"]);
    if (other.contains("second")) {
      EXPECT_EQ(p->second.value(), other["second"]);
    }
    if (other.contains("speed")) {
      EXPECT_NEAR(p->speed.value(), other["speed"].get<double>(), 0.051);
    }
    if (other.contains("course")) {
      EXPECT_NEAR(p->course.value(), other["course"].get<double>(), 0.051);
    }
    if (other.contains("status") && other["status"].is_number()) {
      EXPECT_EQ(p->status.value(), other["status"]);
    }
  }
  if (const auto& d = message.dimensions) {
    EXPECT_EQ(d->bow, other["to_bow"]);
    EXPECT_EQ(d->stern, other["to_stern"]);
    EXPECT_EQ(d->port, other["to_port"]);
    EXPECT_EQ(d->starboard, other["to_starboard"]);
  }
}

TEST_F(Gpsdecode, SaysTheSame) {
  if (std::system("command -v gpsdecode >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "gpsdecode is not installed (Debian: gpsd-clients)";
  Random random(3);
  std::vector<std::string> messages;
  std::string text;
  for (int k = 0; k < 2000; ++k) {
    messages.push_back(any_message(random));
    const bool is_long = messages.back().size() > 336;
    text += is_long ? vdm_part(messages.back(), 1, 2, k % 10) + "\n" +
                          vdm_part(messages.back(), 2, 2, k % 10) + "\n"
                    : vdm(messages.back()) + "\n";
  }
  const ProgramRun run = run_shell("gpsdecode -j < '" + write("messages.nmea", text) + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream lines(run.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    ASSERT_LT(count, messages.size());
    expect_same(decoded(messages[count]), Json::parse(line));
    if (HasFailure()) return;
  }
  EXPECT_EQ(count, messages.size());
}

}  // namespace
}  // namespace kinesphere::program::gpsdecode_test
