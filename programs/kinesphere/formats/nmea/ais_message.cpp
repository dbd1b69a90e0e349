// What a message of AIS says, by the tables of ITU-R M.1371-5, annex 8.
#include "formats/nmea/ais_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {
namespace {

/// First bits of the fields of a position, which follow each other: longitude (28 bits), latitude (27).
struct PositionPlaces {
  std::size_t accuracy, longitude, second;
};

/// Units of coordinates to a degree: 1/10,000 minute, and 1/10 minute in message 27.
constexpr double fine_units = 600'000.0, coarse_units = 600.0;

/// Returns the angle in degrees if it is at most `most`; AIS has 181 and 91 for "not available".
std::optional<double> angle(std::int32_t value, double units, double most) {
  const double degrees = value / units;
  if (std::abs(degrees) > most) return std::nullopt;
  return degrees;
}

void require_bits(const AisBits& bits, std::size_t least, int type) {
  if (bits.size() < least)
    throw MalformedRecord(
        fmt::format("expected {} bits or more of message {}, but got {}", least, type, bits.size()));
}

void read_place(const AisBits& bits, const PositionPlaces& at, AisPosition& position) {
  position.is_accurate = bits.flag(at.accuracy);
  position.longitude = angle(bits.signed_number(at.longitude, 28), fine_units, 180.0);
  position.latitude = angle(bits.signed_number(at.longitude + 28, 27), fine_units, 90.0);
  const auto second = static_cast<int>(bits.number(at.second, 6));
  if (second < 60) position.second = second;
  if (second == 61) position.origin = AisPosition::Origin::manual;
  if (second == 62) position.origin = AisPosition::Origin::dead_reckoning;
  if (second == 63) position.origin = AisPosition::Origin::inoperative;
}

/// Reads the speed (10 bits, steps of `step` knots: 1023 is "not available", 1022 "or higher") and the course
/// (12 bits, steps of 0.1 degrees: 3600 is "not available").
void read_motion(const AisBits& bits, std::size_t speed_at, std::size_t course_at, double step,
                 AisPosition& position) {
  const std::uint32_t speed = bits.number(speed_at, 10), course = bits.number(course_at, 12);
  if (speed < 1022) position.speed = speed * step;
  if (course < 3600) position.course = course / 10.0;
}

std::optional<int> status_of(std::uint32_t value) {
  if (value == 15) return std::nullopt;
  return static_cast<int>(value);
}

AisPosition class_a_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::class_a};
  position.status = status_of(bits.number(38, 4));
  read_place(bits, {.accuracy = 60, .longitude = 61, .second = 137}, position);
  read_motion(bits, 50, 116, 0.1, position);
  return position;
}

AisPosition search_aircraft_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::search_aircraft};
  read_place(bits, {.accuracy = 60, .longitude = 61, .second = 128}, position);
  read_motion(bits, 50, 116, 1.0, position);
  return position;
}

/// Messages 18 and 19 have these fields at the same places.
AisPosition class_b_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::class_b};
  read_place(bits, {.accuracy = 56, .longitude = 57, .second = 133}, position);
  read_motion(bits, 46, 112, 0.1, position);
  return position;
}

AisPosition aid_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::aid_to_navigation};
  read_place(bits, {.accuracy = 163, .longitude = 164, .second = 253}, position);
  position.is_off_position = bits.flag(259);
  return position;
}

AisPosition long_range_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::class_a, .is_coarse = true};
  position.is_accurate = bits.flag(38);
  position.status = status_of(bits.number(40, 4));
  position.longitude = angle(bits.signed_number(44, 18), coarse_units, 180.0);
  position.latitude = angle(bits.signed_number(62, 17), coarse_units, 90.0);
  const std::uint32_t speed = bits.number(79, 6), course = bits.number(85, 9);
  if (speed < 63) position.speed = speed;
  if (course < 360) position.course = course;
  position.is_prompt = !bits.flag(94);
  return position;
}

/// Reads the four distances (9, 9, 6 and 6 bits).
ShipDimensions dimensions_at(const AisBits& bits, std::size_t at) {
  const auto distance = [&](std::size_t begin, std::size_t count) {
    return static_cast<int>(bits.number(begin, count));
  };
  return {distance(at, 9), distance(at + 9, 9), distance(at + 18, 6), distance(at + 24, 6)};
}

/// Reads a name of 20 characters; @ ends it.
std::string name_at(const AisBits& bits, std::size_t at) {
  std::string name;
  for (std::size_t k = 0; k < 20 && at + 6 * (k + 1) <= bits.size(); ++k) {
    const std::uint32_t six = bits.number(at + 6 * k, 6);
    if (six == 0) break;
    name += static_cast<char>(six < 32 ? six + 64 : six);
  }
  name.erase(name.find_last_not_of(' ') + 1);
  return name;
}

/// Returns true for the MMSI of a craft of a mother ship, 98XXXXXXX: its message 24 has that ship's MMSI in
/// place of dimensions.
bool is_craft_of_a_ship(std::uint32_t mmsi) { return mmsi / 10'000'000 == 98; }

}  // namespace

double ShipDimensions::radius() const {
  if (bow == 0 && stern == 0 && port == 0 && starboard == 0) return 0.0;
  constexpr double rounded = 1.0;
  return std::hypot(std::max(bow, stern) + rounded, std::max(port, starboard) + rounded);
}

namespace {

constexpr std::size_t head_bits = 38;

/// Message 24: a name, or what kind of craft it is and how large.
void read_static_data(const AisBits& bits, AisMessage& message) {
  constexpr std::size_t bits_of_part = 2;
  require_bits(bits, head_bits + bits_of_part, message.type);
  const auto part = bits.number(head_bits, bits_of_part);
  if (part == 0) message.name = name_at(bits, 40);
  if (part != 1 || is_craft_of_a_ship(message.mmsi)) return;
  require_bits(bits, 162, message.type);
  message.dimensions = dimensions_at(bits, 132);
  message.ship_type = static_cast<int>(bits.number(40, 8));
}

/// Reads what a type of messages has behind its head; returns false for a type that is not read.
bool read_body(const AisBits& bits, AisMessage& message) {
  switch (message.type) {
    case 1:
    case 2:
    case 3:
      require_bits(bits, 149, message.type);
      message.position = class_a_position(bits);
      return true;
    case 5:
      require_bits(bits, 270, message.type);
      message.name = name_at(bits, 112);
      message.dimensions = dimensions_at(bits, 240);
      message.ship_type = static_cast<int>(bits.number(232, 8));
      return true;
    case 9:
      require_bits(bits, 148, message.type);
      message.position = search_aircraft_position(bits);
      return true;
    case 18:
      require_bits(bits, 148, message.type);
      message.position = class_b_position(bits);
      return true;
    case 19:
      require_bits(bits, 306, message.type);
      message.position = class_b_position(bits);
      message.name = name_at(bits, 143);
      message.dimensions = dimensions_at(bits, 271);
      message.ship_type = static_cast<int>(bits.number(263, 8));
      return true;
    case 21:
      require_bits(bits, 270, message.type);
      message.position = aid_position(bits);
      message.name = name_at(bits, 43);
      message.dimensions = dimensions_at(bits, 219);
      return true;
    case 24:
      read_static_data(bits, message);
      return true;
    case 27:
      require_bits(bits, 95, message.type);
      message.position = long_range_position(bits);
      return true;
    default:
      return false;
  }
}

}  // namespace

std::optional<AisMessage> ais_message_of(const AisBits& bits) {
  if (bits.size() < head_bits)
    throw MalformedRecord(
        fmt::format("expected {} bits or more of a message, but got {}", head_bits, bits.size()));
  AisMessage message{.type = static_cast<int>(bits.number(0, 6)), .mmsi = bits.number(8, 30)};
  if (!read_body(bits, message)) return std::nullopt;
  if (message.mmsi == 0 || message.mmsi > 999'999'999)
    throw MalformedRecord(fmt::format("expected an MMSI of at most nine digits in message {}, but got {}",
                                      message.type, message.mmsi));
  return message;
}

}  // namespace kinesphere::program
