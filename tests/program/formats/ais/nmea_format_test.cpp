// Lines with sentences of AIS: checksums, tag blocks, times, messages in parts, and the reports made of them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "formats/fields/units.hpp"
#include "formats/streams/known_names.hpp"
#include "formats/streams/report_format.hpp"
#include "formats/streams/sentence_assembler.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"

namespace kinesphere::program::nmea_format_test {
namespace {

class NmeaReports final : public ReportSink {
 public:
  explicit NmeaReports(const FormatChoices& choices = {})
      : format(make_format(StreamFormat::nmea, choices)) {}

  void take(const SourceReport& report) override {
    reports.push_back(report);
    ids.emplace_back(report.id);
  }
  void time_is(const FileTime&, TimeKind) override {}
  void pass_over(Passed reason) override { passed.push_back(reason); }
  void refuse(std::size_t line, const std::string& reason) override {
    refused.push_back(fmt::format("{}: {}", line, reason));
  }

  NmeaReports& read(const std::string& line, std::optional<FileTime> read_at = std::nullopt) {
    ++line_;
    try {
      format->read({.text = line, .line = line_, .read_at = read_at}, *this);
    } catch (const MalformedRecord& error) {
      refuse(line_, error.what());
    }
    return *this;
  }

  std::vector<SourceReport> reports;
  std::vector<std::string> ids;
  std::vector<Passed> passed;
  std::vector<std::string> refused;
  std::unique_ptr<ReportFormat> format;

 private:
  std::size_t line_ = 0;
};

/// A report of a ship at 8 E, 53.5 N, 10 knots to the east.
EncodedStation ship(int second = 60) {
  return {.longitude = 8 * 600'000,
          .latitude = encoded_degrees(53.5),
          .speed = 100,
          .course = 900,
          .second = second};
}

double stamp_of(const std::string& line) {
  const NmeaReports kept = std::move(NmeaReports().read(line));
  if (kept.reports.size() != 1) return -1.0;
  return static_cast<double>(kept.reports[0].stamp.whole) + kept.reports[0].stamp.fraction;
}

double unbounded_stamp_error() { return 30.0; }

TEST(NmeaFormat, MakesReports) {
  const NmeaReports kept = std::move(NmeaReports().read(vdm(class_a_message(ship(20)), "1700000000")));
  ASSERT_EQ(kept.reports.size(), 1u);
  EXPECT_EQ(kept.ids[0], "211000001");
  const SourceReport& report = kept.reports[0];
  EXPECT_TRUE(report.geographic);
  EXPECT_NEAR(report.position.x, 8.0, 1e-9);
  EXPECT_NEAR(report.position.y, 53.5, 1e-9);
  EXPECT_LT(norm(report.velocity.value() - Vec3{10.0 * knot, 0.0, 0.0}), 1e-9);
  EXPECT_FALSE(report.position_error) << "worse than 10 m: the declared default";
  EXPECT_FALSE(report.stamp_error);
  EXPECT_EQ(report.arrival->whole, 1700000000);
  // Flags: 10 m or better. An MMSI has nine digits.
  EncodedStation station = ship();
  station.accuracy = 1;
  station.mmsi = 2'110'001;
  const NmeaReports accurate = std::move(NmeaReports().read(vdm(class_b_message(station), "1700000000")));
  EXPECT_EQ(accurate.ids.at(0), "002110001");
  EXPECT_EQ(accurate.reports[0].position_error->bound, 25.0);
}

TEST(NmeaFormat, TakesTheSecondOfTheReportNearItsReceipt) {
  // 1700000000 is 22:13:20.
  EXPECT_EQ(stamp_of(vdm(class_a_message(ship(20)), "1700000000")), 1700000000.0);
  EXPECT_EQ(stamp_of(vdm(class_a_message(ship(17)), "1700000000")), 1699999997.0);
  EXPECT_EQ(stamp_of(vdm(class_a_message(ship(50)), "1700000000")), 1699999970.0);
  EXPECT_EQ(stamp_of(vdm(class_a_message(ship(22)), "1700000000")), 1700000002.0)
      << "the receiver's clock is slow";
  EXPECT_EQ(stamp_of(vdm(class_a_message(ship(58)), "1699999983")), 1699999978.0) << "before the full minute";
  const NmeaReports unknown = std::move(NmeaReports().read(vdm(class_a_message(ship(60)), "1700000000.25")));
  EXPECT_EQ(unknown.reports.at(0).stamp.fraction, 0.25);
  EXPECT_EQ(unknown.reports[0].stamp_error, unbounded_stamp_error());
}

TEST(NmeaFormat, ReadsTheTimesOfLines) {
  const std::string plain = vdm(class_a_message(ship()));
  EXPECT_EQ(stamp_of(tag_block("s:rx1,c:1700000000") + plain), 1700000000.0);
  EXPECT_EQ(stamp_of(tag_block("c:1700000000500,s:rx1") + plain), 1700000000.5) << "milliseconds";
  EXPECT_EQ(stamp_of(tag_block("s:rx1") + tag_block("c:1700000000") + plain), 1700000000.0);
  EXPECT_EQ(stamp_of("1700000000.5 " + plain), 1700000000.5);
  EXPECT_EQ(stamp_of("2023-11-14T22:13:20Z\t" + plain), 1700000000.0);
  EXPECT_EQ(stamp_of(plain + ",raishub,1700000000"), 1700000000.0);
  EXPECT_EQ(stamp_of(plain + ",s29089,d-107,r003669961,1700000000.25\r"), 1700000000.25);
  // A group of lines has one time.
  NmeaReports group;
  group.read(tag_block("g:1-2-77,c:1700000000") + vdm(class_a_message(ship())))
      .read(tag_block("g:2-2-77") + vdm(class_b_message({.mmsi = 1, .longitude = 0, .latitude = 0})));
  ASSERT_EQ(group.reports.size(), 2u);
  EXPECT_EQ(group.reports[1].stamp.whole, 1700000000);
  for (const char* before :
       {"[2023-11-14 22:13:20] ", "\"2023-11-14T22:13:20Z\",", "2023-11-14T22:13:20Z: ", "<1700000000>"})
    EXPECT_EQ(stamp_of(before + plain), 1700000000.0) << before;
  EXPECT_EQ(stamp_of("\"2023-11-14 22:13:20\",\"" + plain + "\""), 1700000000.0);
  EXPECT_EQ(stamp_of("\"" + plain + "\",\"2023-11-14 22:13:20\""), 1700000000.0);
  EXPECT_EQ(stamp_of("12.5 " + plain), -1.0) << "since when?";
  // A line before the sentence has its time, and that of no other.
  const std::string pghp = "PGHP,1,2023,11,14,22,13,20,250,338,2,,1,09";
  NmeaReports next;
  next.read(fmt::format("${}*{:02X}", pghp, checksum_of(pghp))).read(plain).read(plain);
  next.read(tag_block("c:1700000060")).read(plain);
  ASSERT_EQ(next.reports.size(), 2u);
  EXPECT_EQ(next.reports[0].stamp.whole, 1700000000);
  EXPECT_NEAR(next.reports[0].stamp.fraction, 0.25, 1e-9);
  EXPECT_EQ(next.reports[1].stamp.whole, 1700000060);
  EXPECT_EQ(next.refused.size(), 1u);
}

TEST(NmeaFormat, TakesAllTalkersAndSkipsOtherSentences) {
  NmeaReports kept;
  for (const char* talker : {"AIVDM", "AIVDO", "BSVDM", "ABVDM"})
    kept.read(vdm(class_a_message(ship()), "1700000000", talker));
  EXPECT_EQ(kept.reports.size(), 4u);
  kept.read("$GPZDA,201530.00,04,07,2002,00,00*60").read("").read("# a comment").read("$GPGGA,");
  kept.read(sentence("AIVSI,r3669961,1,013536.96326433,1386,-98,"))
      .read(vdm("000100" + std::string(162, '0'), "1700000000"));
  kept.format->finish(kept);
  EXPECT_EQ(kept.reports.size(), 4u);
  EXPECT_TRUE(kept.refused.empty());
}

TEST(NmeaFormat, RefusesDamagedLines) {
  const std::string good = vdm(class_a_message(ship()), "1700000000");
  std::string flipped = good;
  flipped[good.size() - 10] = flipped[good.size() - 10] == '0' ? '1' : '0';
  std::string wrong_tag = tag_block("c:1700000000");
  wrong_tag[4] = '2';
  NmeaReports kept;
  const auto ais = [](const char* body) { return sentence(body); };
  for (const std::string& line :
       {flipped, good.substr(0, good.size() - 2), good.substr(0, 10), wrong_tag, std::string("mumble"),
        ais("AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D"), ais("AIVDM,1,2,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,0"),
        ais("AIVDM,1,1,,A,,0"), ais("AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,6"),
        ais("AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069x,0"), ais("AIVDM,1,1,,A,13u?etPv2;0n:d,0"),
        vdm(class_a_message({.mmsi = 0}), "1700000000"), std::string("!AIVSI,r3669961,1*00")})
    kept.read(line);
  EXPECT_TRUE(kept.reports.empty());
  ASSERT_EQ(kept.refused.size(), 13u);
  for (const std::string& reason : kept.refused)
    EXPECT_NE(reason.find(": expected "), std::string::npos) << reason;
  EXPECT_NE(kept.refused[0].find("behind the sentence"), std::string::npos) << kept.refused[0];
}

/// A sentence that is whole is taken, though what is before it is damaged: its time is between those around
/// it.
TEST(NmeaFormat, TakesSentencesWithDamagedTagBlocks) {
  const auto at = [](int seconds) { return tag_block(fmt::format("s:rx1,c:{}", 1700000000 + seconds)); };
  const std::string bits = class_a_message(ship(21));
  std::string changed = at(0), open = at(0);
  changed[9] = '9';
  open[0] = 'x';
  NmeaReports kept;
  kept.read(at(0) + vdm(bits));
  for (const std::string& damaged :
       {changed, open, at(0).substr(0, 9), std::string("tomorrow "), tag_block("c:noon")})
    kept.read(damaged + vdm(bits));
  EXPECT_EQ(kept.reports.size(), 1u);
  kept.read(at(3) + vdm(bits));
  ASSERT_EQ(kept.reports.size(), 7u);
  for (const SourceReport& report : kept.reports) EXPECT_EQ(report.stamp.whole, 1700000001);
  EXPECT_TRUE(kept.refused.empty());
  // Without a second its time is not known better than by those two.
  kept.read(vdm(class_b_message(ship()))).read(at(23) + vdm(bits));
  EXPECT_EQ(kept.reports.at(7).stamp_error, 20.0 + unbounded_stamp_error());
  // If it is long until the next time, that may be the wrong minute.
  kept.read(vdm(bits)).read(at(100) + vdm(bits));
  EXPECT_EQ(kept.reports.size(), 10u);
  EXPECT_EQ(kept.refused.size(), 1u);
}

TEST(NmeaFormat, JoinsSentencesInAnyOrder) {
  const EncodedStation a{.mmsi = 1, .longitude = 0, .latitude = 0, .bow = 100},
      b{.mmsi = 2, .longitude = 0, .latitude = 0};
  const std::string one = extended_class_b_message(a), other = extended_class_b_message(b);
  const std::string time = tag_block("c:1700000000");
  NmeaReports kept;
  // The last first, mixed with those of the other channel, and one twice.
  kept.read(vdm_part(one, 3, 3, 5, 'A'))
      .read(time + vdm_part(other, 1, 3, 5, 'B'))
      .read(vdm_part(one, 1, 3, 5, 'A'));
  kept.read(vdm_part(other, 1, 3, 5, 'B'))
      .read(vdm_part(other, 2, 3, 5, 'B'))
      .read(vdm_part(other, 3, 3, 5, 'B'));
  EXPECT_EQ(kept.ids, (std::vector<std::string>{"000000002"}));
  kept.read(time + vdm_part(one, 2, 3, 5, 'A'));
  EXPECT_EQ(kept.ids, (std::vector<std::string>{"000000002", "000000001"}));
  EXPECT_GT(kept.reports[1].extent, 100.0);
  kept.read(time + vdm(class_b_static_message({.mmsi = 1}))).read(time + vdm(class_b_message(a)));
  EXPECT_GT(kept.reports.at(2).extent, 100.0) << "a size that is not available is no other one";
  EXPECT_TRUE(kept.refused.empty());
}

TEST(NmeaFormat, ForgetsMessagesWithALostSentence) {
  const std::string one = extended_class_b_message({.mmsi = 1, .longitude = 0, .latitude = 0});
  const std::string other = extended_class_b_message({.mmsi = 2, .longitude = 0, .latitude = 0});
  NmeaReports kept;
  const auto at = [](int seconds) { return tag_block(fmt::format("c:{}", 1700000000 + seconds)); };
  // The identifier comes again before the rest: what waits is another message.
  kept.read(at(0) + vdm_part(one, 1, 2, 3))
      .read(at(1) + vdm_part(other, 1, 2, 3))
      .read(at(1) + vdm_part(other, 2, 2, 3));
  EXPECT_EQ(kept.ids, (std::vector<std::string>{"000000002"}));
  ASSERT_EQ(kept.refused.size(), 1u);
  EXPECT_EQ(kept.refused[0], "1: expected 2 sentences of a message, but only 1 of them came");
  // The rest comes too late to belong to it.
  kept.read(at(2) + vdm_part(one, 1, 2, 4)).read(at(30) + vdm_part(other, 2, 2, 4));
  EXPECT_EQ(kept.ids.size(), 1u);
  EXPECT_EQ(kept.refused.size(), 2u);
  kept.format->finish(kept);
  EXPECT_EQ(kept.refused.size(), 3u);
}

TEST(SentenceAssembler, KeepsFewSentencesOnly) {
  NmeaReports kept;
  SentenceAssembler assembler;
  for (std::size_t k = 0; k < 10'000; ++k) {
    const std::string text = tag_block(fmt::format("g:1-2-{}", k)) + vdm_part(static_message({}), 1, 2, 1);
    EXPECT_FALSE(assembler.add(parse_nmea_line(text), k + 1, kept));
    ASSERT_EQ(k + 1 - kept.refused.size(), std::min(k + 1, SentenceAssembler::most_waiting));
  }
}

TEST(RecentValues, AreBounded) {
  using Sizes = RecentValues<std::uint32_t, double>;
  Sizes sizes;
  sizes.set(1, 10.0);
  for (std::uint32_t mmsi = 2; mmsi < 10 * Sizes::most; ++mmsi) {
    sizes.set(mmsi, 1.0);
    ASSERT_EQ(sizes.value_of(1), 10.0) << "it is in use";
  }
  EXPECT_EQ(sizes.value_of(2), 0.0);
  EXPECT_LE(sizes.size(), 2 * Sizes::most);
}

TEST(NmeaFormat, KnowsNoMoreThanItIsTold) {
  const auto report_of = [](EncodedStation s) {
    return std::move(NmeaReports().read(vdm(class_a_message(s), "1700000000"))).reports.at(0);
  };
  EncodedStation s = ship();
  s.speed = 1023;
  EXPECT_FALSE(report_of(s).velocity);
  s.speed = 0;
  s.course = 3600;
  EXPECT_EQ(norm(report_of(s).velocity.value()), 0.0) << "at rest";
  EXPECT_EQ(report_of(s).velocity_spread, 0.0);
  s.speed = 100;
  EXPECT_EQ(norm(report_of(s).velocity.value()), 0.0);
  EXPECT_DOUBLE_EQ(report_of(s).velocity_spread, 10.0 * knot) << "any direction";
  NmeaReports nowhere;
  nowhere.read(vdm(class_a_message({}), "1700000000"));
  s.longitude = 181 * 600'000;
  nowhere.read(vdm(class_b_message(s), "1700000000"));
  EXPECT_EQ(nowhere.passed, std::vector(2, Passed::no_position));
  // Entered by hand, estimated, or not valid: without a bound.
  NmeaReports guessed;
  for (const int second : {61, 62, 63}) guessed.read(vdm(class_a_message(ship(second)), "1700000000"));
  EXPECT_EQ(guessed.passed, std::vector(3, Passed::no_bound));
  FormatChoices choices;
  choices.position_error_is_said = true;
  NmeaReports said(choices);
  said.read(vdm(class_a_message(ship(62)), "1700000000"));
  EXPECT_EQ(said.reports.size(), 1u);
  // A fixed aid to navigation has a surveyed position, and does not move.
  NmeaReports aid;
  aid.read(vdm(aid_to_navigation_message({.longitude = 0, .latitude = 0, .second = 61}), "1700000000"));
  EXPECT_EQ(norm(aid.reports.at(0).velocity.value()), 0.0);
}

TEST(NmeaFormat, CountsSizesAndSteps) {
  EncodedStation s = ship();
  s.bow = 150;
  s.stern = 50;
  s.port = 10;
  s.starboard = 20;
  NmeaReports kept;
  const auto read = [&](const std::string& bits) { kept.read(vdm(bits, "1700000000")); };
  read(class_a_message(s));
  read(static_message(s));
  read(class_a_message(s));
  const double radius = std::hypot(151.0, 21.0);
  EXPECT_EQ(kept.reports.at(0).extent, 0.0);
  EXPECT_DOUBLE_EQ(kept.reports.at(1).extent, radius);
  EncodedStation b = s;
  b.mmsi = 5;
  read(class_b_static_message(b));
  read(class_b_message(b));
  EXPECT_DOUBLE_EQ(kept.reports.at(2).extent, radius);
  read(long_range_message({.mmsi = 5, .longitude = 4800, .latitude = 32100, .speed = 10, .course = 90}, 0));
  EXPECT_DOUBLE_EQ(kept.reports.at(3).extent, radius + std::hypot(185.2, 185.2));
  EXPECT_EQ(kept.reports[3].stamp_error, 6.0);
  EXPECT_NEAR(kept.reports[3].velocity_spread, knot * (1.0 + 10.0 * 3.14159265 / 180.0), 1e-6);
  read(search_aircraft_message(
      {.mmsi = 111'232'511, .longitude = 0, .latitude = 0, .speed = 100, .course = 0}));
  EXPECT_EQ(kept.reports.at(4).said_kind, MotionPreset::search_aircraft);
  EXPECT_NEAR(kept.reports[4].velocity->y, 100.0 * knot, 1e-9);
}

TEST(NmeaFormat, TakesSentencesThatShareALine) {
  const std::string first = vdm(class_a_message(ship()), "1700000000"),
                    second = vdm(class_b_message(ship()), "1700000001");
  std::string damaged = first;
  damaged.back() = damaged.back() == '0' ? '1' : '0';
  for (const char* between : {"", "\r", "\r\r", " "}) {
    NmeaReports kept;
    kept.read(first + between + second + "\r");
    ASSERT_EQ(kept.reports.size(), 2u) << between;
    EXPECT_EQ(kept.reports[1].stamp.whole, 1700000001);
    EXPECT_TRUE(kept.refused.empty());
    NmeaReports rest;
    rest.read(damaged + between + second).read(second + between + damaged);
    EXPECT_EQ(rest.reports.size(), 2u) << between;
    EXPECT_EQ(rest.refused.size(), 2u) << between;
  }
}

TEST(NmeaFormat, SaysWhatStandsBeforeSentences) {
  NmeaReports kept;
  kept.read("Nov 14 22:13:20 host ais: " + vdm(class_a_message(ship())));
  try {
    kept.format->finish(kept);
    FAIL() << "it has no year";
  } catch (const UnusableStream& error) {
    EXPECT_NE(std::string(error.what()).find("before the first stands 'Nov 14 22:13:20 host ais:'"),
              std::string::npos)
        << error.what();
  }
}

TEST(NmeaFormat, AsksForTimes) {
  const std::string line = vdm(class_a_message(ship()));
  NmeaReports few;
  few.read(line).read(line);
  EXPECT_THROW(few.format->finish(few), UnusableStream);
  NmeaReports many;
  for (int k = 0; k < 9; ++k) many.read(line);
  EXPECT_THROW(many.read(line), UnusableStream);
  EXPECT_TRUE(many.refused.empty());
  // Those before the first with a time are refused.
  NmeaReports mixed;
  mixed.read(line).read(tag_block("c:1700000000") + line).read(line);
  mixed.format->finish(mixed);
  EXPECT_EQ(mixed.reports.size(), 1u);
  EXPECT_EQ(mixed.refused.size(), 2u);
  NmeaReports live;
  live.read(line, FileTime{1700000000, 0.5});
  EXPECT_EQ(live.reports.at(0).arrival->fraction, 0.5);
  NmeaReports other;
  other.read("$GPZDA,201530.00,04,07,2002,00,00*60");
  EXPECT_THROW(other.format->finish(other), UnusableStream);
}

TEST(NmeaFormat, GoesOnFromItsState) {
  EncodedStation s = ship();
  s.bow = 90;
  NmeaReports first;
  first.read(tag_block("c:1700000000,g:1-2-9") + vdm_part(extended_class_b_message(s), 1, 2, 7))
      .read(tag_block("c:1700000000") + vdm(class_b_static_message(s)));
  NmeaReports second;
  take_state(*first.format, *second.format);
  second.read(tag_block("g:2-2-9") + vdm_part(extended_class_b_message(s), 2, 2, 7));
  ASSERT_EQ(second.reports.size(), 1u);
  EXPECT_EQ(second.reports[0].arrival->whole, 1700000000);
  second.read(tag_block("c:1700000001") + vdm(class_b_message(s)));
  EXPECT_GT(second.reports.at(1).extent, 90.0);
  // One without a time waits for the next.
  second.read(vdm(class_b_message(s)));
  NmeaReports third;
  take_state(*second.format, *third.format);
  third.read(tag_block("c:1700000003") + vdm(class_b_message(s)));
  EXPECT_EQ(third.reports.size(), 2u);
}

TEST(NmeaFormat, IsRecognised) {
  for (const char* beginning :
       {"!AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,0*23\n", "\\s:rx1,c:1700000000*01\\!AIVDM,1,1,,A,139",
        "!BSVDM,1,1", "1700000000 !AIVDO,1,1,,A", "# a comment\n!AIVDM,1,1", "3Q?v00000,0*67\n!AIVDM,1,1,,A",
        "$GPZDA,201530.00,04,07,2002,00,00*60", "\\g:1-2-77,c:1700000000*00\\\n"})
    EXPECT_EQ(recognised_format(beginning), StreamFormat::nmea) << beginning;
  for (const char* beginning : {"a,b,!c", "!note", "$5,$6", "\\a\\b,c"})
    EXPECT_NE(recognised_format(beginning), StreamFormat::nmea) << beginning;
}

}  // namespace
}  // namespace kinesphere::program::nmea_format_test
