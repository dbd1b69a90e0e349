// Values survive a round trip, the bytes are equal on every machine, and bad bytes fail without harm.
#include "archive/archive.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <variant>

#include "archive/fields.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere::archive_test {
namespace {

std::vector<int> as_numbers(std::span<const std::byte> bytes) {
  std::vector<int> numbers;
  for (const std::byte byte : bytes) numbers.push_back(std::to_integer<int>(byte));
  return numbers;
}

TEST(Archive, IsLittleEndianOnEveryMachine) {
  ByteWriter writer;
  writer(std::uint32_t{0x01020304}, -2.0, true, std::vector<std::uint8_t>{7, 8}, std::optional<bool>());
  EXPECT_EQ(as_numbers(writer.bytes()), (std::vector<int>{4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0xc0, 1,  //
                                                          2, 0, 0, 0, 0, 0, 0, 0, 7, 8, 0}));
}

TEST(Archive, GivesBackWhatItTook) {
  const std::vector<std::pair<int, float>> pairs{{-5, 0.25f},
                                                 {1 << 30, std::numeric_limits<float>::infinity()}};
  const std::optional<Event> event = Event{.kind = EventKind::wall_end, .time = -0.0, .first = {3, 4}};
  const std::set<std::uint16_t> numbers{1, 500};
  ByteWriter writer;
  writer(pairs, event, numbers, Counters{.probes = 9});
  std::remove_const_t<decltype(pairs)> pairs_back;
  std::optional<Event> event_back;
  std::set<std::uint16_t> numbers_back{17};
  Counters counters_back;
  ByteReader reader(writer.bytes());
  reader(pairs_back, event_back, numbers_back, counters_back);
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ(reader.remaining(), 0u);
  EXPECT_EQ(pairs_back, pairs);
  EXPECT_EQ(numbers_back, numbers);
  EXPECT_EQ(counters_back.probes, 9u);
  ASSERT_TRUE(event_back);
  EXPECT_TRUE(std::signbit(event_back->time));
  EXPECT_EQ(event_back->kind, EventKind::wall_end);
  EXPECT_EQ(event_back->first, (BodyId{3, 4}));
}

TEST(Archive, AVariantIsItsIndexAndWhatItHolds) {
  using Choice = std::variant<bool, std::uint16_t, std::vector<double>>;
  ByteWriter writer;
  writer(Choice(std::uint16_t{258}), Choice(std::vector{1.0, 2.0}), std::uint8_t{3});
  EXPECT_EQ(as_numbers(writer.bytes())[0], 1);
  Choice number, values, nothing;
  ByteReader reader(writer.bytes());
  reader(number, values);
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ(number, Choice(std::uint16_t{258}));
  EXPECT_EQ(values, Choice(std::vector{1.0, 2.0}));
  reader(nothing);
  EXPECT_TRUE(reader.failed()) << "there is no fourth";
}

TEST(Archive, AnImmenseCountTakesNoMemory) {
  ByteWriter writer;
  writer(std::numeric_limits<std::uint64_t>::max(), 1.0, 2.0);
  std::vector<double> values;
  ByteReader reader(writer.bytes());
  reader(values);
  EXPECT_TRUE(reader.failed());
  EXPECT_LE(values.size(), 2u);
}

TEST(Archive, ABoolIsZeroOrOne) {
  ByteWriter writer;
  writer(std::uint8_t{2});
  bool flag = false;
  ByteReader reader(writer.bytes());
  reader(flag);
  EXPECT_TRUE(reader.failed());
}

TEST(Archive, FailureStays) {
  const std::array<std::byte, 5> bytes{};
  ByteReader reader(bytes);
  double number = 1.0;
  std::uint8_t small = 1;
  reader(number, small);
  EXPECT_TRUE(reader.failed());
  EXPECT_EQ(small, 0);
}

}  // namespace
}  // namespace kinesphere::archive_test
