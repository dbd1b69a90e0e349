// Streams with lost, changed and swapped bytes: bad records are counted, nothing breaks, and complete lines
// are read.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "formats/fields/separations.hpp"
#include "formats/streams/report_format.hpp"
#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "watch/watch_pipeline.hpp"

namespace kinesphere::program::damaged_streams_test {
namespace {

const std::map<StreamFormat, std::string> samples{
    {StreamFormat::readsb,
     "{ \"now\" : 1000.5,\n\"aircraft\" : [\n"
     "{\"hex\":\"4ca1fa\",\"alt_baro\":35000,\"gs\":450.0,\"track\":90.0,\"baro_rate\":-600,\"lat\":51.5,"
     "\"lon\":-0.5,\"rc\":186,\"seen_pos\":0.25,\"nac_v\":2},\n"
     "{\"hex\":\"400a02\",\"alt_baro\":\"ground\",\"gs\":5.0,\"lat\":51.47,\"lon\":-0.45,\"seen_pos\":2.5,"
     "\"nac_p\":8}\n]}\n"},
    {StreamFormat::opensky,
     "{\"time\":1001,\"states\":[[\"ab1644\",\"UAL "
     "\\\"421\",\"US\",1000,1000,-0.1264,51.4021,11277.6,false,240.5,180.0,-1.5,null,11500.2,\"1712\",false,"
     "0]]}\n"},
    {StreamFormat::sbs,
     "MSG,3,1,1,4CA1FA,1,2026/03/01,12:00:00.000,2026/03/01,12:00:00.100,,35000,,,51.5,-0.5,,,0,0,0,0\n"
     "MSG,4,1,1,4CA1FA,1,2026/03/01,12:00:00.500,2026/03/01,12:00:00.600,,,450,90,,,-600,,,,,\n"},
    {StreamFormat::ais, "367390380,2023-01-01T00:00:01,51.5,-0.5,10.0,90.0,511.0,\"TUG, \"\"THE\"\"\"\n"},
    {StreamFormat::nmea,
     "\\s:rx1,c:1700000000*01\\!AIVDM,1,1,,A,139>Jh@P1p0TWh0NW>`3Q?v00000,0*67\n"
     "\\s:rx1,c:1700000010*00\\!AIVDM,1,1,,A,139>Jh@P1p0T`1PNW>`3Q?vD0000,0*1D\n"
     "!AIVDM,2,1,1,A,55?MbV02;H;s<HtKR20EHE:0@T4@Dn2222222216L961O5Gf0NSQEp6ClRp8,0*1C\n"
     "!AIVDM,2,2,1,A,88888888880,2*25\n"},
    {StreamFormat::csv, "ann,1000.5,51.5,-0.5,3,0.1,0.2,0.3,0.5\n"},
    {StreamFormat::jsonl,
     R"({"id": "d1", "stamp": 1000.5, "lat": 51.5, "lon": -0.5, "alt": 3, "velocity": [4, 5, 6], "position_error": [3, 1]})"
     "\n"}};

const std::map<StreamFormat, std::string> headers{
    {StreamFormat::ais, "MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName\n"},
    {StreamFormat::csv, "id,time,lat,lon,alt,vx,vy,vz,position_error\n"}};

std::string damaged(std::string text, Random& random) {
  const auto place = [&] {
    return static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size())));
  };
  for (int k = static_cast<int>(random.uniform(1.0, 4.0)); k > 0 && !text.empty(); --k) {
    const std::size_t at = std::min(place(), text.size() - 1);
    switch (static_cast<int>(random.uniform(0.0, 5.0))) {
      case 0:
        text[at] = static_cast<char>(random.uniform(0.0, 256.0));
        break;
      case 1:
        text.erase(at, static_cast<std::size_t>(random.uniform(1.0, 20.0)));
        break;
      case 2:
        text.insert(at, text.substr(place() / 2, static_cast<std::size_t>(random.uniform(1.0, 20.0))));
        break;
      case 3:
        text[at] = "\"{}[],:\n\\e-9"[static_cast<std::size_t>(random.uniform(0.0, 12.0))];
        break;
      default:
        std::swap(text[at], text[std::min(place(), text.size() - 1)]);
    }
  }
  return text;
}

/// Counts the reports that it receives.
class CountingSink final : public ReportSink {
 public:
  explicit CountingSink(WatchPipeline& pipeline) : pipeline_(pipeline) {}
  void take(const SourceReport& report) override {
    ++reports;
    pipeline_.take(report);
  }
  void time_is(const FileTime& arrival, TimeKind kind) override { pipeline_.time_is(arrival, kind); }
  void pass_over(Passed reason) override { pipeline_.pass_over(reason); }
  void refuse(std::size_t line, const std::string& reason) override { pipeline_.refuse(line, reason); }

  int reports = 0;

 private:
  WatchPipeline& pipeline_;
};

class DamagedStream : public testing::TestWithParam<StreamFormat> {};

TEST_P(DamagedStream, IsReadAsFarAsItGoes) {
  const StreamFormat format = GetParam();
  const WatchSettings settings{
      .separations = {parse_separation("cylinder:5NM:1000ft")},
      .classes = TrackClasses({ErrorBound::cylinder(6.0, 3.0), ErrorBound::cylinder(400.0, 60.0)}),
      .position_error = {100.0, "test"},
      .height_error = {80.0, "test"},
      .velocity_error = {25.0, "test"},
      .climb_error = {25.0, "test"},
      .silence = 15.0,
      .forget = 60.0,
      .source = "test"};
  WatchPipeline pipeline(settings, [](std::uint64_t, std::string_view) {});
  CountingSink sink(pipeline);
  const auto reader = make_format(format, {});
  RecordCutter cutter(records_of(format));
  const auto read = [&](const Record& record) {
    pipeline.begin_record(record.line);
    try {
      reader->read(record, sink);
    } catch (const WrongInput& error) {
      pipeline.refuse(error.what());
    }
    pipeline.end_record();
  };
  const auto feed = [&](const std::string& text) {
    cutter.feed(text);
    while (const auto record = cutter.next()) read(*record);
  };
  if (headers.contains(format)) feed(headers.at(format));
  const std::string& sample = samples.at(format);
  for (int k = 0; k < 3; ++k) feed(sample);
  Random random(17);
  int whole = 0, read_whole = 0;
  for (int k = 0; k < 5000; ++k) {
    feed(damaged(sample, random));
    if (k % 16 != 0) continue;
    const int before = sink.reports;
    feed(sample);
    ++whole;
    if (sink.reports > before) ++read_whole;
  }
  if (const auto last = cutter.rest()) read(*last);
  EXPECT_GT(pipeline.view().counts.malformed, 500u);
  EXPECT_LE(pipeline.view().counts.first_malformed.size(), 10u);
  for (const MalformedLine& line : pipeline.view().counts.first_malformed)
    EXPECT_EQ(line.reason.find('\n'), std::string::npos) << line.reason;
  // All lines except those that continue a damaged line without an end.
  EXPECT_GT(read_whole, 0.75 * whole);
  EXPECT_GT(pipeline.view().counters().reports, 0u);
}

INSTANTIATE_TEST_SUITE_P(OfEachFormat, DamagedStream,
                         testing::Values(StreamFormat::readsb, StreamFormat::opensky, StreamFormat::sbs,
                                         StreamFormat::ais, StreamFormat::nmea, StreamFormat::csv,
                                         StreamFormat::jsonl),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace kinesphere::program::damaged_streams_test
