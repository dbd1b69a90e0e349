// Callsigns and ships' names: from each format into the state, and through snapshots.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/fields/separations.hpp"
#include "formats/nmea/ais_message.hpp"
#include "formats/streams/known_names.hpp"
#include "formats/streams/report_format.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"
#include "watch/output/watch_report.hpp"
#include "watch/watch_pipeline.hpp"

namespace kinesphere::program::names_test {
namespace {

using Json = nlohmann::json;
using Names = std::map<std::string, std::string>;

class NamedStream {
 public:
  explicit NamedStream(StreamFormat format)
      : format_(make_format(format, {})),
        cut_(records_of(format)),
        pipeline_({.separations = {parse_separation("sphere:10")},
                   .own = "own one",
                   .classes = TrackClasses({ErrorBound(1.0), ErrorBound(300.0)}),
                   .position_error = {10.0, "test"},
                   .height_error = {10.0, "test"},
                   .velocity_error = {1.0, "test"},
                   .climb_error = {1.0, "test"},
                   .silence = 60.0,
                   .forget = 600.0,
                   .source = "test",
                   .format = std::string(name_of(format))},
                  [](std::uint64_t, std::string_view) {}) {}

  NamedStream& read(std::string_view text) {
    cut_.feed(text);
    while (const auto record = cut_.next()) {
      pipeline_.begin_record(record->line);
      format_->read(*record, pipeline_);
      pipeline_.end_record();
    }
    return *this;
  }
  Json state() {
    // A short stream is taken at its end.
    pipeline_.finish();
    return Json::parse(watch_state_json(pipeline_.view()));
  }
  /// Names by ids; "-" where there is none.
  Names names() {
    Names names;
    const Json all = state();
    for (const Json& track : all["tracks"])
      names[track["id"]] = track["name"].is_null() ? "-" : track["name"];
    return names;
  }
  /// Continues from the snapshot of another, as read from its bytes.
  void continue_from(const NamedStream& other) {
    take_state(*other.format_, *format_);
    pipeline_.restore(other.pipeline_.save());
  }

 private:
  std::unique_ptr<ReportFormat> format_;
  RecordCutter cut_;
  WatchPipeline pipeline_;
};

TEST(NamesOfTracks, OfReadsbAndOpensky) {
  EXPECT_EQ(NamedStream(StreamFormat::readsb)
                .read(R"({"now":1700000000,"aircraft":[
    {"hex":"4ca1fa","flight":"RYR1  ","alt_baro":35000,"lat":51.5,"lon":-0.5,"nac_p":9,"seen_pos":0},
    {"hex":"4ca1fb","flight":"        ","alt_baro":35000,"lat":51.6,"lon":-0.5,"nac_p":9,"seen_pos":0},
    {"hex":"4ca1fc","flight":7,"alt_baro":35000,"lat":51.7,"lon":-0.5,"nac_p":9,"seen_pos":0}]}
)")
                .names(),
            (Names{{"4ca1fa", "RYR1"}, {"4ca1fb", "-"}, {"4ca1fc", "-"}}));
  EXPECT_EQ(NamedStream(StreamFormat::opensky)
                .read(R"({"time":1458564121,"states":[
    ["ab1644","UAL421  ","U",1458564120,1458564120,-81,35,11277,false,240,180,-1,null,11500,"1712",false,0],
    ["ac96b8",null,"U",1458564120,1458564120,-81,35.5,11277,false,240,180,-1,null,11500,"1712",false,0]]}
)")
                .names(),
            (Names{{"ab1644", "UAL421"}, {"ac96b8", "-"}}));
}

TEST(NamesOfTracks, OfMessagesThatCameBefore) {
  NamedStream sbs(StreamFormat::sbs);
  const std::string head = ",1,1,4CA1FA,1,2026/03/01,12:00:00.000,2026/03/01,12:00:00.000,";
  sbs.read("MSG,1" + head + "RYR1 ,,,,,,,,,,,\n");
  NamedStream later(StreamFormat::sbs);
  later.continue_from(sbs);
  later.read("MSG,3" + head + ",35000,,,51.5,-0.5,,,0,0,0,0\n");
  EXPECT_EQ(later.names(), (Names{{"4CA1FA", "RYR1"}}));
}

TEST(NamesOfTracks, OfShips) {
  // Samples of the documentation of gpsd: messages 5, 19, 21 and 24 part A, with the names that it gives.
  const auto name = [](std::string_view payload, std::size_t fill_bits) {
    AisBits bits;
    bits.append(payload, fill_bits);
    return ais_message_of(bits)->name;
  };
  EXPECT_EQ(name("55?MbV02;H;s<HtKR20EHE:0@T4@Dn2222222216L961O5Gf0NSQEp6ClRp888888888880", 2),
            "EVER DIADEM");
  EXPECT_EQ(name("C5N3SRgPEnJGEBT>NhWAwwo862PaLELTBJ:V00000000S0D:R220", 0), "CAPT.J.RIMES");
  EXPECT_EQ(name("E1mg=5J1T4W0h97aRh6ba84<h2d;W:Te=eLvH50```q:D44QDlp0C1DU00", 2), "CHINA ROSE MURPHY EX");
  EXPECT_EQ(name("H42O55i18tMET00000000000000", 2), "PROGUY");

  NamedStream table(StreamFormat::ais);
  table.read(
      "MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName\n"
      "367390380,2023-01-01T00:00:01,29.94672,-90.01,10.0,90.0,511.0,\"TUG, THE\"\n"
      "367390381,2023-01-01T00:00:02,29.9,-90.02,1,36,511.0,\n");
  EXPECT_EQ(table.names(), (Names{{"367390380", "TUG, THE"}, {"367390381", "-"}}));
}

TEST(NamesOfTracks, AreShortTextWithoutBlanksAtTheEnds) {
  EXPECT_EQ(shown_name(" \tAB C \r\n"), "AB C");
  EXPECT_EQ(shown_name("   "), "");
  EXPECT_EQ(shown_name(std::string(60, 'x')), std::string(40, 'x'));
  // A character of UTF-8 is not cut.
  EXPECT_EQ(shown_name(std::string(39, 'x') + "\u00e4b"), std::string(39, 'x'));

  NamedStream stream(StreamFormat::jsonl);
  const std::string hostile = R"(</script>\u0000\"\u202e<img>)";
  stream.read("{\"id\":\"own one\",\"name\":\"" + hostile + "\",\"stamp\":1,\"position\":[0,0]}\n");
  EXPECT_THROW(stream.read("{\"id\":\"2\",\"name\":\"\xff\xfe\",\"stamp\":1,\"position\":[5,0]}\n"),
               MalformedRecord);
  stream.read("{\"id\":\"3\",\"stamp\":1,\"position\":[500,0]}\n");
  stream.read("{\"id\":\"3\",\"stamp\":2,\"position\":[500,0]}\n");
  const Json state = stream.state();
  EXPECT_EQ(state["own"], "own one");
  EXPECT_EQ(state["format"], "jsonl");
  EXPECT_EQ(stream.names()["own one"], "</script>" + std::string(1, '\0') + "\"\u202e<img>");
}

TEST(NamesOfTracks, StayInASnapshotAndWhenAReportHasNone) {
  NamedStream stream(StreamFormat::jsonl);
  stream.read("{\"id\":\"1\",\"name\":\"Anna\",\"stamp\":1,\"position\":[0,0]}\n");
  // Its time has not been confirmed yet.
  NamedStream held(StreamFormat::jsonl);
  held.continue_from(stream);
  held.read(
      "{\"id\":\"1\",\"stamp\":2,\"position\":[1,0]}\n{\"id\":\"2\",\"stamp\":3,\"position\":[90,0]}\n");
  EXPECT_EQ(held.names(), (Names{{"1", "Anna"}, {"2", "-"}}));
  NamedStream later(StreamFormat::jsonl);
  later.continue_from(held);
  EXPECT_EQ(later.names(), held.names());
}

TEST(NamesOfTracks, OfMessagesOfTheirOwnAreBounded) {
  KnownNames names;
  names.set("first", "kept because it is asked for");
  for (std::size_t k = 0; k < 3 * KnownNames::Values::most; ++k) {
    names.set(std::to_string(k), "x");
    if (k % 1000 == 0) {
      EXPECT_FALSE(names.name_of("first").empty());
    }
  }
  EXPECT_TRUE(names.name_of("0").empty());
  EXPECT_LE(names.size(), 2 * KnownNames::Values::most);
}

}  // namespace
}  // namespace kinesphere::program::names_test
