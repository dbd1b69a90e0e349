// Messages of AIS: published ones with their published values, and each bit of each field.
#include "formats/nmea/ais_message.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "program/formats/ais/ais_encoder.hpp"

namespace kinesphere::program::ais_message_test {
namespace {

AisMessage decoded(std::string_view payload, std::size_t fill_bits = 0) {
  AisBits bits;
  bits.append(payload, fill_bits);
  return ais_message_of(bits).value();
}

struct Published {
  const char* payload;
  int type;
  std::uint32_t mmsi;
  double speed, course, longitude, latitude;
  int second;
  bool is_accurate;
};

/// Samples of the documentation of gpsd (AIVDM/AIVDO protocol decoding, sample.aivdm), checked there against
/// other decoders.
TEST(AisMessage, HasThePublishedValues) {
  for (const Published& each :
       {Published{"15RTgt0PAso;90TKcjM8h6g208CQ", 1, 371798000, 12.3, 224.0, -123.3953833, 48.3816333, 33,
                  true},
        Published{"16SteH0P00Jt63hHaa6SagvJ087r", 1, 440348000, 0.0, 93.4, -70.7582, 43.08015, 13, false},
        Published{"25Cjtd0Oj;Jp7ilG7=UkKBoB0<06", 2, 356302000, 13.9, 87.7, -71.6261433, 40.3923583, 41,
                  false},
        Published{"38Id705000rRVJhE7cl9n;160000", 3, 563808000, 0.0, 252.0, -76.3275333, 36.91, 35, true},
        Published{"91b55wi;hbOS@OdQAC062Ch2089h", 9, 111232511, 42.0, 154.5, -6.2788433, 58.144, 15, false},
        Published{"B52K>;h00Fc>jpUlNV@ikwpUoP06", 18, 338087471, 0.1, 79.6, -74.0721317, 40.68454, 49, false},
        Published{"C5N3SRgPEnJGEBT>NhWAwwo862PaLELTBJ:V00000000S0D:R220", 19, 367059850, 8.7, 335.9,
                  -88.8103917, 29.543695, 46, false}}) {
    const AisMessage message = decoded(each.payload);
    EXPECT_EQ(message.type, each.type);
    EXPECT_EQ(message.mmsi, each.mmsi);
    const AisPosition& position = message.position.value();
    EXPECT_NEAR(position.speed.value(), each.speed, 1e-9) << each.payload;
    EXPECT_NEAR(position.course.value(), each.course, 1e-9) << each.payload;
    EXPECT_NEAR(position.longitude.value(), each.longitude, 5e-8) << each.payload;
    EXPECT_NEAR(position.latitude.value(), each.latitude, 5e-8) << each.payload;
    EXPECT_EQ(position.second, each.second) << each.payload;
    EXPECT_EQ(position.is_accurate, each.is_accurate) << each.payload;
  }
  EXPECT_EQ(decoded("38Id705000rRVJhE7cl9n;160000").position->status, 5) << "moored";
  EXPECT_EQ(decoded("B52K>;h00Fc>jpUlNV@ikwpUoP06").position->station, AisStation::class_b);

  const AisMessage aid = decoded("E1mg=5J1T4W0h97aRh6ba84<h2d;W:Te=eLvH50```q:D44QDlp0C1DU00", 2);
  EXPECT_EQ(aid.mmsi, 123456789u);
  EXPECT_NEAR(aid.position->longitude.value(), -122.698591667, 5e-8);
  EXPECT_NEAR(aid.position->latitude.value(), 47.9206183333, 5e-8);
  EXPECT_EQ(aid.position->second, 50);
  EXPECT_FALSE(aid.position->speed);

  const AisMessage far = decoded("KC5E2b@U19PFdLbMuc5=ROv62<7m");
  EXPECT_EQ(far.mmsi, 206914217u);
  EXPECT_EQ(far.position->status, 2);
  EXPECT_NEAR(far.position->longitude.value(), 137.0233333, 5e-8);
  EXPECT_NEAR(far.position->latitude.value(), 4.84, 5e-8);
  EXPECT_EQ(far.position->speed, 57.0);
  EXPECT_EQ(far.position->course, 167.0);
  EXPECT_TRUE(far.position->is_coarse);
}

TEST(AisMessage, HasThePublishedDimensions) {
  struct Sample {
    const char* payload;
    std::size_t fill_bits;
    std::uint32_t mmsi;
    std::vector<int> distances;
  };
  for (const Sample& each :
       {Sample{"55?MbV02;H;s<HtKR20EHE:0@T4@Dn2222222216L961O5Gf0NSQEp6ClRp888888888880",
               2,
               351759000,
               {225, 70, 1, 31}},
        Sample{"C5N3SRgPEnJGEBT>NhWAwwo862PaLELTBJ:V00000000S0D:R220", 0, 367059850, {5, 21, 4, 4}},
        Sample{"E1mg=5J1T4W0h97aRh6ba84<h2d;W:Te=eLvH50```q:D44QDlp0C1DU00", 2, 123456789, {5, 5, 5, 5}},
        Sample{"H42O55lti4hhhilD3nink000?050", 0, 271041815, {0, 15, 0, 5}}}) {
    const AisMessage message = decoded(each.payload, each.fill_bits);
    EXPECT_EQ(message.mmsi, each.mmsi);
    const ShipDimensions& size = message.dimensions.value();
    EXPECT_EQ((std::vector{size.bow, size.stern, size.port, size.starboard}), each.distances);
  }
  EXPECT_FALSE(decoded("H42O55i18tMET00000000000000", 2).dimensions) << "part A has the name";
}

using Fields = std::map<std::string, std::string>;

template <class Value>
std::string shown(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

Fields fields_of(const std::string& bits) {
  const auto [characters, fill] = payload_of(bits);
  AisBits read;
  read.append(characters, static_cast<std::size_t>(fill));
  Fields fields;
  std::optional<AisMessage> message;
  try {
    message = ais_message_of(read).value();
  } catch (const MalformedRecord&) {
    return {{"mmsi", "refused"}};
  }
  fields["mmsi"] = fmt::format("{}", message->mmsi);
  if (const auto& p = message->position) {
    fields["longitude"] = shown(p->longitude);
    fields["latitude"] = shown(p->latitude);
    fields["speed"] = shown(p->speed);
    fields["course"] = shown(p->course);
    fields["status"] = shown(p->status);
    fields["accuracy"] = fmt::format("{}", p->is_accurate);
    fields["second"] = shown(p->second) + fmt::format("{}", static_cast<int>(p->origin));
    fields["latency"] = fmt::format("{}", p->is_prompt);
  }
  if (const auto& d = message->dimensions) {
    fields["bow"] = fmt::format("{}", d->bow);
    fields["stern"] = fmt::format("{}", d->stern);
    fields["port"] = fmt::format("{}", d->port);
    fields["starboard"] = fmt::format("{}", d->starboard);
  }
  return fields;
}

struct FieldPlace {
  const char* name;
  std::size_t begin, count;
};

/// Flips each bit behind the type: the field that has it changes, and no other one.
void expect_fields(const std::string& bits, const std::vector<FieldPlace>& places) {
  SCOPED_TRACE(fmt::format("message {}", std::stoi(bits.substr(0, 6), nullptr, 2)));
  const Fields before = fields_of(bits);
  for (std::size_t at = 6; at < bits.size(); ++at) {
    std::string expected;
    for (const FieldPlace& place : places)
      if (place.begin <= at && at < place.begin + place.count) expected = place.name;
    std::string flipped = bits, changed;
    flipped[at] = bits[at] == '0' ? '1' : '0';
    const Fields after = fields_of(flipped);
    if (after.at("mmsi") != before.at("mmsi")) {
      changed = "mmsi";
    } else {
      for (const auto& [name, value] : after)
        if (value != before.at(name)) changed += name;
    }
    EXPECT_EQ(changed, expected) << "bit " << at;
  }
}

TEST(AisMessage, HasEachFieldAtItsBits) {
  const EncodedStation s{.mmsi = 211'234'567,
                         .longitude = 4'800'123,
                         .latitude = -32'100'456,
                         .speed = 123,
                         .course = 2240,
                         .second = 33,
                         .accuracy = 1,
                         .status = 1,
                         .bow = 200,
                         .stern = 33,
                         .port = 12,
                         .starboard = 21};
  const FieldPlace mmsi{"mmsi", 8, 30};
  for (const int type : {1, 2, 3})
    expect_fields(class_a_message(s, type), {mmsi,
                                             {"status", 38, 4},
                                             {"speed", 50, 10},
                                             {"accuracy", 60, 1},
                                             {"longitude", 61, 28},
                                             {"latitude", 89, 27},
                                             {"course", 116, 12},
                                             {"second", 137, 6}});
  expect_fields(static_message(s),
                {mmsi, {"bow", 240, 9}, {"stern", 249, 9}, {"port", 258, 6}, {"starboard", 264, 6}});
  expect_fields(search_aircraft_message(s), {mmsi,
                                             {"speed", 50, 10},
                                             {"accuracy", 60, 1},
                                             {"longitude", 61, 28},
                                             {"latitude", 89, 27},
                                             {"course", 116, 12},
                                             {"second", 128, 6}});
  const std::vector<FieldPlace> class_b{mmsi,
                                        {"speed", 46, 10},
                                        {"accuracy", 56, 1},
                                        {"longitude", 57, 28},
                                        {"latitude", 85, 27},
                                        {"course", 112, 12},
                                        {"second", 133, 6}};
  expect_fields(class_b_message(s), class_b);
  std::vector<FieldPlace> extended = class_b;
  extended.insert(extended.end(),
                  {{"bow", 271, 9}, {"stern", 280, 9}, {"port", 289, 6}, {"starboard", 295, 6}});
  expect_fields(extended_class_b_message(s), extended);
  expect_fields(aid_to_navigation_message(s), {mmsi,
                                               {"accuracy", 163, 1},
                                               {"longitude", 164, 28},
                                               {"latitude", 192, 27},
                                               {"bow", 219, 9},
                                               {"stern", 228, 9},
                                               {"port", 237, 6},
                                               {"starboard", 243, 6},
                                               {"second", 253, 6}});
  expect_fields(long_range_message({.mmsi = 211'234'567,
                                    .longitude = 4800,
                                    .latitude = -32100,
                                    .speed = 12,
                                    .course = 224,
                                    .accuracy = 1,
                                    .status = 1},
                                   0),
                {mmsi,
                 {"accuracy", 38, 1},
                 {"status", 40, 4},
                 {"longitude", 44, 18},
                 {"latitude", 62, 17},
                 {"speed", 79, 6},
                 {"course", 85, 9},
                 {"latency", 94, 1}});
  const std::string part_b = class_b_static_message(s);
  const Fields size = fields_of(part_b);
  EXPECT_EQ(size.at("bow"), "200");
  EXPECT_EQ(size.at("starboard"), "21");
}

TEST(AisMessage, KnowsWhatIsNotAvailable) {
  for (const auto& bits : {class_a_message({}), class_b_message({}), search_aircraft_message({})}) {
    const Fields fields = fields_of(bits);
    for (const char* name : {"longitude", "latitude", "speed", "course", "status"})
      EXPECT_EQ(fields.at(name), "none") << name;
    EXPECT_EQ(fields.at("second"), "none0");
  }
  const Fields far = fields_of(
      long_range_message({.longitude = 181 * 600, .latitude = 91 * 600, .speed = 63, .course = 511}, 1));
  for (const char* name : {"longitude", "latitude", "speed", "course", "status"})
    EXPECT_EQ(far.at(name), "none") << name;
  EXPECT_EQ(fields_of(class_a_message({.speed = 1022})).at("speed"), "none") << "102.2 knots or higher";
  EXPECT_EQ(fields_of(class_a_message({.speed = 1021})).at("speed"), fmt::format("{}", 1021 * 0.1));
  EXPECT_EQ(fields_of(class_a_message({.course = 3599})).at("course"), "359.9");
  EXPECT_EQ(fields_of(class_a_message({.longitude = -180 * 600'000})).at("longitude"), "-180");
  // Those of a craft of a ship (MMSI 98...) are the MMSI of the ship.
  AisBits craft;
  craft.append(payload_of(class_b_static_message({.mmsi = 982'110'001, .bow = 9})).characters, 0);
  EXPECT_FALSE(ais_message_of(craft)->dimensions);
}

TEST(ShipDimensions, CoverTheShip) {
  EXPECT_EQ(ShipDimensions{}.radius(), 0.0) << "not available";
  EXPECT_DOUBLE_EQ((ShipDimensions{225, 70, 1, 31}.radius()), std::hypot(226.0, 32.0));
  EXPECT_DOUBLE_EQ((ShipDimensions{0, 15, 0, 5}.radius()), std::hypot(16.0, 6.0))
      << "an antenna at an unknown place, in a ship of 15 m by 5 m";
}

}  // namespace
}  // namespace kinesphere::program::ais_message_test
