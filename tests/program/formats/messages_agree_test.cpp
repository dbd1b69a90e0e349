// A recording means the same as a table and as messages of each format, to tracks and to watch.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "kinesphere/random.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::messages_agree_test {
namespace {

constexpr int begin_of_all = 1'700'000'000;

/// Degrees, and feet of a multiple of 25, which all formats write exactly enough.
struct Sent {
  int second = 0, body = 0;
  double longitude = 0.0, latitude = 0.0;
  int feet = 0;
};

/// Aircraft that report in turn, at times that only some share, and now and then not at all.
std::vector<Sent> any_recording(Random& random) {
  std::vector<Sent> all;
  for (int second = 0; second < 40; ++second)
    for (int body = 0; body < 3; ++body)
      if (random.uniform() < 0.7)
        all.push_back({second, body,
                       8.0 + 0.01 * body + 1e-4 * std::floor(random.uniform(0.0, 100.0)) + 1e-3 * second,
                       50.0 - 2e-3 * second, 25 * (400 + 40 * body + second)});
  return all;
}

std::string address(const Sent& sent) { return fmt::format("{}", 211'000'001 + sent.body); }
std::string clock_of(const Sent& sent) {
  return fmt::format("22:{:02}:{:02}.000", 13 + (20 + sent.second) / 60, (20 + sent.second) % 60);
}

std::string table_row(const Sent& s) {
  return fmt::format("{},{},{},{},{}\n", address(s), begin_of_all + s.second, s.longitude, s.latitude,
                     s.feet);
}
std::string readsb_document(const Sent& s) {
  return fmt::format(
      R"({{"now": {}.5, "aircraft": [{{"hex": "{}", "lat": {}, "lon": {}, "alt_baro": {}, "seen_pos": 0.5, "rc": 100}},)"
      R"({{"hex": "other", "alt_baro": 1000}}]}})"
      "\n",
      begin_of_all + s.second, address(s), s.latitude, s.longitude, s.feet);
}
std::string adsbx_document(const Sent& s) {
  return fmt::format(
      R"({{"ac": [{{"hex": "{}", "lat": {}, "lon": {}, "alt_baro": {}, "seen_pos": 0, "nac_p": 8}}], "now": {}000}})"
      "\n",
      address(s), s.latitude, s.longitude, s.feet, begin_of_all + s.second);
}
std::string mutability_document(const Sent& s) {
  return fmt::format(
      R"({{"now": {}.0, "aircraft": [{{"hex": "{}", "lat": {}, "lon": {}, "altitude": {}, "seen_pos": 0, "nucp": 7}}]}})"
      "\n",
      begin_of_all + s.second, address(s), s.latitude, s.longitude, s.feet);
}
std::string opensky_document(const Sent& s) {
  return fmt::format(
      R"({{"time": {0}, "states": [["{1}", "C", "X", {0}, {0}, {2}, {3}, {4}, false, 100, 90, 0, null, 9, null, false, 0]]}})"
      "\n",
      begin_of_all + s.second, address(s), s.longitude, s.latitude, s.feet * 0.3048);
}
std::string sbs_line(const Sent& s) {
  return fmt::format("MSG,3,1,1,{0},1,2023/11/14,{1},2023/11/14,{1},,{2},,,{3},{4},,,0,0,0,0\r\n", address(s),
                     clock_of(s), s.feet, s.latitude, s.longitude);
}
std::string json_line(const Sent& s) {
  return fmt::format(R"({{"id": "{}", "stamp": {}, "lat": {}, "lon": {}, "alt": {}}})"
                     "\n",
                     address(s), begin_of_all + s.second, s.latitude, s.longitude, s.feet * 0.3048);
}
std::string ais_line(const Sent& s) {
  const EncodedStation station{.mmsi = static_cast<std::uint32_t>(211'000'001 + s.body),
                               .longitude = encoded_degrees(s.longitude),
                               .latitude = encoded_degrees(s.latitude),
                               .second = (20 + s.second) % 60};
  return vdm(class_a_message(station), fmt::format("{}", begin_of_all + s.second)) + "\n";
}

struct MessageShape {
  StreamFormat format;
  std::string (*write)(const Sent& sent);
  bool has_heights = true;
  std::string header{};
};
const MessageShape shapes[] = {{StreamFormat::csv, table_row, true, "id,time,lon,lat,alt_ft\n"},
                               {StreamFormat::readsb, readsb_document},
                               {StreamFormat::readsb, adsbx_document},
                               {StreamFormat::readsb, mutability_document},
                               {StreamFormat::opensky, opensky_document},
                               {StreamFormat::sbs, sbs_line},
                               {StreamFormat::jsonl, json_line},
                               {StreamFormat::nmea, ais_line, false}};

/// Longitude, latitude and metres of each id by whole seconds.
using Samples = std::map<std::string, std::map<std::int64_t, Vec3>>;

Samples by_tracks(const std::string& text) {
  TrackOptions options;
  options.max_gap = 1e9;
  const TrackSet track_set = parse_tracks({{"t", text}}, options);
  Samples samples;
  for (const RecordedTrack& track : track_set.tracks)
    for (const TrackSample& sample : track.samples) {
      const auto time = time_field(track_set.times.text(sample.time, 6)).value().time;
      samples[track.id][time.whole + std::lround(time.fraction)] =
          *track_set.coordinates.geographic(sample.position);
    }
  return samples;
}

class SampleSink final : public ReportSink {
 public:
  void take(const SourceReport& report) override {
    samples[std::string(report.id)][report.stamp.whole + std::lround(report.stamp.fraction)] =
        report.position;
  }
  void time_is(const FileTime&, TimeKind) override {}
  void pass_over(Passed) override {}
  void refuse(std::size_t, const std::string& reason) override { FAIL() << reason; }

  Samples samples;
};

Samples by_watch(StreamFormat format, const std::string& text) {
  RecordCutter cutter(records_of(format));
  cutter.feed(text);
  const auto reader = make_format(format, {.position_error_is_said = true});
  SampleSink sink;
  while (const auto record = cutter.next()) reader->read(*record, sink);
  reader->finish(sink);
  return sink.samples;
}

void expect_same(const Samples& found, const std::vector<Sent>& sent, bool has_heights) {
  std::size_t count = 0;
  for (const auto& [id, samples] : found) count += samples.size();
  EXPECT_EQ(count, sent.size());
  for (const Sent& each : sent) {
    SCOPED_TRACE(fmt::format("{} at {}", address(each), each.second));
    const Vec3& at = found.at(address(each)).at(begin_of_all + each.second);
    // Sentences round to 1/600,000 of a degree.
    EXPECT_NEAR(at.x, each.longitude, 1e-6);
    EXPECT_NEAR(at.y, each.latitude, 1e-6);
    EXPECT_NEAR(at.z, has_heights ? 0.3048 * each.feet : 0.0, 1e-3);
  }
}

TEST(Messages, MeanTheSameInEachFormatToTracksAndWatch) {
  Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const std::vector<Sent> sent = any_recording(random);
    for (const MessageShape& shape : shapes) {
      std::string text = shape.header;
      for (const Sent& each : sent) text += shape.write(each);
      SCOPED_TRACE(fmt::format("trial {}, {}:\n{}", trial, name_of(shape.format), text.substr(0, 400)));
      EXPECT_EQ(recognised_format(text), shape.format);
      ASSERT_NO_FATAL_FAILURE(expect_same(by_tracks(text), sent, shape.has_heights));
      ASSERT_NO_FATAL_FAILURE(expect_same(by_watch(shape.format, text), sent, shape.has_heights));
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(Messages, DamagedOnesAreCountedAndTheOthersTaken) {
  Random random(8);
  for (const MessageShape& shape : shapes) {
    if (is_table(shape.format)) continue;
    const std::vector<Sent> sent = any_recording(random);
    std::vector<Sent> whole;
    std::string text;
    std::size_t damaged = 0;
    for (const Sent& each : sent) {
      const std::string message = shape.write(each);
      // The first ones show the format; of a message in two lines, half would be none.
      if (whole.size() < 3 || random.uniform() < 0.9) {
        whole.push_back(each);
        text += message;
      } else {
        ++damaged;
        text += message.substr(0, message.size() / 2) + "\n";
      }
    }
    SCOPED_TRACE(fmt::format("{}:\n{}", name_of(shape.format), text));
    TrackOptions options;
    options.max_gap = 1e9;
    const TrackSet track_set = parse_tracks({{"t", text}}, options);
    EXPECT_EQ(track_set.malformed.count, damaged);
    EXPECT_EQ(track_set.samples, whole.size());
    ASSERT_EQ(track_set.warnings.size(), damaged > 0 ? 1u : 0u);
  }
}

TEST(Messages, OfNoUseAreRefusedInOneLine) {
  const auto error = [](const std::string& text, const std::string& format = "",
                        const std::string& where = "") {
    TrackOptions options;
    options.hints.format = format;
    options.hints.where = where;
    return error_of([&] { parse_tracks({{"t", text}}, options); });
  };
  const std::string line = R"({"id": "a", "stamp": 1, "position": [1, 2], "speeed": 3})"
                           "\n";
  EXPECT_NE(error(line + line).find("speeed"), std::string::npos) << error(line + line);
  EXPECT_EQ(error(json_line({}), "", "id != 3"), "--where: expected a table, but t has no columns");
  EXPECT_NE(error("!AIVDM,1,1,,A,139>Jh@P1p0TWh0NW>`3Q?v00000,0*67\n")
                .find("time at which each sentence was received"),
            std::string::npos);
  EXPECT_NE(error("id,time,x,y\n1,2,3,4\n", "nmea").find("expected sentences of AIS"), std::string::npos);
}

TEST(Messages, ThatAreRepeatedCountOnce) {
  std::string text;
  // A receiver tells the latest position in each document, here to the 0.1 s.
  for (int second = 0; second < 20; ++second)
    text += fmt::format(
        R"({{"now": {}.{}, "aircraft": [{{"hex": "a", "lat": 50, "lon": {}, "seen_pos": {}, "rc": 9}}]}})"
        "\n",
        1000 + second, second % 2, 8.0 + 0.001 * (second / 4), second % 4);
  const TrackSet track_set = parse_tracks({{"t", text}}, {});
  EXPECT_EQ(track_set.samples, 5u);
  EXPECT_EQ(track_set.repeated.count, 15u);
  EXPECT_TRUE(track_set.is_plane);
}

TEST(Messages, WithoutAHeightAreMissingWhereOthersHaveOne) {
  std::string text;
  for (int second = 0; second < 10; ++second)
    text += json_line({.second = second, .longitude = 8.0, .latitude = 50.0, .feet = 100});
  text += R"({"id": "211000001", "stamp": 1700000020, "lat": 50, "lon": 8})"
          "\n";
  const TrackSet track_set = parse_tracks({{"t", text}}, {});
  EXPECT_EQ(track_set.missing.count, 1u);
  EXPECT_EQ(track_set.samples, 10u);
  EXPECT_TRUE(track_set.has_heights);
}

using MessagesProgram = ProgramTest;

TEST_F(MessagesProgram, ApproachesAreThoseOfATable) {
  Random random(9);
  const std::vector<Sent> sent = any_recording(random);
  std::set<std::string> found;
  for (const MessageShape& shape : shapes) {
    if (!shape.has_heights) continue;
    std::string text = shape.header;
    for (const Sent& each : sent) text += shape.write(each);
    const std::string file = write(fmt::format("recording-{}", found.size()), text);
    const ProgramRun ran =
        run(fmt::format("tracks {} --separation cylinder:1NM:2000ft --contacts {} --quiet --max-gap 100",
                        file, path("contacts.jsonl")));
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    std::istringstream lines(read_text(path("contacts.jsonl")));
    std::string closest;
    for (std::string line; std::getline(lines, line);)
      closest += fmt::format("{:.3f} ", nlohmann::json::parse(line).at("distance_m").get<double>());
    EXPECT_FALSE(closest.empty());
    found.insert(closest);
  }
  EXPECT_EQ(found.size(), 1u);
}

}  // namespace
}  // namespace kinesphere::program::messages_agree_test
