// Which format a stream has, by its first text and where it comes from.
#include "watch/source/stream_kind.hpp"

#include <gtest/gtest.h>

#include "program/support.hpp"

namespace kinesphere::program::stream_kind_test {
namespace {

using Nature = ReportSource::Nature;

class NamedSource final : public ReportSource {
 public:
  explicit NamedSource(Nature nature) : nature_(nature) {}
  Outcome next(std::chrono::milliseconds, std::string_view&) override { return Outcome::quiet; }
  std::uint64_t position(std::size_t) const override { return 0; }
  Nature nature() const override { return nature_; }
  std::string name() const override { return "the stream"; }

 private:
  Nature nature_;
};

std::optional<StreamFormat> kind_of(std::string_view text, Nature nature = Nature::recording,
                                    bool has_ended = true, bool by_arrival = false) {
  const ColumnHints hints;
  const NamedSource source(nature);
  return StreamKind(hints, by_arrival, source).of(text, has_ended);
}

const std::string_view sentence = "!AIVDM,1,1,,A,13HOI:0P0000VOHLCnHQKwvL05Ip,0*23\n";
const std::string_view fix = "$GPRMC,120000,A,5400.000,N,00800.000,E,5.0,90.0,010120,,*3C\n";
const std::string_view list =
    R"([{"id": "a", "time": 1, "x": 2, "y": 3}, {"id": "b", "time": 1, "x": 5, "y": 3}])";

TEST(StreamKind, IsShownByTheFirstLine) {
  EXPECT_EQ(kind_of("", Nature::live, false), std::nullopt) << "nothing has come";
  EXPECT_EQ(kind_of("id,time", Nature::live, false), std::nullopt) << "the line goes on";
  EXPECT_EQ(kind_of("id,time,x,y\na,1,2,3\n", Nature::live, false), StreamFormat::csv);
  EXPECT_EQ(kind_of(sentence, Nature::live, false), StreamFormat::nmea);
  EXPECT_NE(error_of([] { kind_of(" \n"); }).find("the stream: expected reports, but it is empty"),
            std::string::npos);
}

TEST(StreamKind, RefusesWhatIsNoStream) {
  EXPECT_NE(error_of([] { kind_of("PK\x03\x04 and so on"); }).find("zip"), std::string::npos);
  EXPECT_NE(error_of([] { kind_of(std::string_view("a\0b\n", 4)); }).find("not text"), std::string::npos);
}

/// A list of JSON is a recording, but the answer of a service that is asked again and again is read at once.
TEST(StreamKind, DependsOnWhereItComesFrom) {
  EXPECT_EQ(kind_of(list), StreamFormat::recording);
  EXPECT_EQ(kind_of(list, Nature::unknown), StreamFormat::recording);
  EXPECT_EQ(kind_of(list, Nature::unknown, true, true), StreamFormat::json);
  EXPECT_EQ(kind_of(list, Nature::live), StreamFormat::json);
}

/// Sentences of AIS may come behind those of a receiver of GPS.
TEST(StreamKind, ALogOfAReceiverIsReadUntilItsEnd) {
  const ColumnHints hints;
  const NamedSource file(Nature::recording);
  StreamKind kind(hints, false, file);
  std::string text(fix);
  EXPECT_EQ(kind.of(text, false), std::nullopt);
  text += fix;
  EXPECT_EQ(kind.of(text, false), std::nullopt);
  EXPECT_EQ(kind.of(text, true), StreamFormat::recording);
  EXPECT_EQ(kind.of(text + std::string(sentence), false), StreamFormat::nmea);
}

}  // namespace
}  // namespace kinesphere::program::stream_kind_test
