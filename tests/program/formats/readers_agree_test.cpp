// tracks and watch read random tables alike: both refuse one, or both find the same samples.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "formats/recordings/recording_kinds.hpp"
#include "formats/streams/report_format.hpp"
#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::readers_agree_test {
namespace {

struct Found {
  double time;
  Vec3 position;
};
/// Samples of each id. Lengths are from the first sample of the table, times too.
using Samples = std::map<std::string, std::vector<Found>>;

/// Makes tables of three bodies with random names, units, order, separators and missing values.
class AnyTable {
 public:
  explicit AnyTable(Random& random) : random_(random) {
    is_geographic_ = chance(0.4);
    add(one_of({"id", "ID", "MMSI", "Track_ID", "agent", "icao24", "hex", "who"}),
        [](int body, int) { return fmt::format("b{}", body); });
    add_time();
    if (is_geographic_) {
      const bool in_radians = chance(0.1);
      const double unit = in_radians ? 0.017453292519943295 : 1.0;
      const std::string suffix = in_radians ? "_rad" : one_of({"", "_deg", " [deg]"});
      add(one_of({"lon", "longitude", "location-long", "LNG"}) + suffix,
          [unit](int body, int step) { return fmt::format("{}", unit * (8.0 + 0.25 * body + 0.01 * step)); });
      add(one_of({"lat", "Latitude", "location_lat"}) + suffix,
          [unit](int body, int) { return fmt::format("{}", unit * (47.0 + 0.125 * body)); });
    } else {
      const std::string unit = one_of({"", "", "_m", " (cm)", "/ft", " [px]"});
      const std::string other = chance(0.8) ? unit : one_of({"", "_km", "Ft"});
      add(one_of({"x", "pos_x", "East", "px"}) + unit,
          [](int body, int step) { return fmt::format("{}.25", 100 * body + step); });
      add(one_of({"y", "posY", "northing"}) + other,
          [](int body, int step) { return fmt::format("{}", body - 2 * step); });
    }
    if (chance(0.5))
      add(one_of({"z", "alt", "Altitude", "elevation"}) + one_of({"", "_m", "_ft", " (feet)", "_furlong"}),
          [](int body, int) { return fmt::format("{}.5", 7 * body); });
    for (const char* extra : {"note", "geoaltitude", "valid", "frame", "x", "timestamp", "length", "width_m"})
      if (chance(0.08)) add(extra, [](int, int step) { return fmt::format("{}", step + 1); });
    std::vector<std::size_t> order(names_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[draw(k)]);
    write(order);
  }

  const std::string& text() const { return text_; }

 private:
  using Value = std::function<std::string(int body, int step)>;

  std::size_t draw(std::size_t count) {
    return std::min(static_cast<std::size_t>(random_.uniform() * static_cast<double>(count)), count - 1);
  }
  bool chance(double part) { return random_.uniform() < part; }
  std::string one_of(std::vector<std::string> words) { return words[draw(words.size())]; }
  void add(std::string name, Value value) {
    names_.push_back(std::move(name));
    values_.push_back(std::move(value));
  }

  void add_time() {
    switch (draw(5)) {
      case 0:
        return add(one_of({"time", "t", "timestamp_ms", "time (ms)", "timeMin", "when"}),
                   [](int, int step) { return fmt::format("{}.5", 10 * step); });
      case 1:
        return add(one_of({"Timestamp", "date_time"}),
                   [](int, int step) { return fmt::format("2024-02-29 23:59:{:02}", 10 * step); });
      case 2:
        return add("utc",
                   [](int, int step) { return fmt::format("2024-02-29T23:59:{:02}.125+01:00", 10 * step); });
      case 3:
        return add("time", [](int, int step) { return fmt::format("0{}/03/2024 00:00:00", step + 1); });
      default:
        return add("time", [](int, int step) { return fmt::format("17000000{:02}123", 10 * step); });
    }
  }

  void write(const std::vector<std::size_t>& order) {
    const std::string separator = one_of({",", ";", "\t", ", "});
    const bool is_comment = chance(0.15);
    const auto line = [&](auto field) {
      std::vector<std::string> fields;
      for (const std::size_t k : order) fields.push_back(field(k));
      text_ += fmt::format("{}\n", fmt::join(fields, separator));
    };
    if (is_comment) text_ += "# ";
    line([&](std::size_t k) { return names_[k]; });
    for (int step = 0; step < 5; ++step) {
      for (int body = 0; body < 3; ++body) {
        line([&](std::size_t k) {
          if (k > 1 && chance(0.03)) return one_of({"", "nan", "inf", "NULL"});
          std::string field = values_[k](body, step);
          if (separator == ";" && chance(0.5)) std::replace(field.begin(), field.end(), '.', ',');
          return field;
        });
      }
    }
  }

  Random& random_;
  bool is_geographic_ = false;
  std::vector<std::string> names_;
  std::vector<Value> values_;
  std::string text_;
};

/// Sorts by time, and makes lengths and times those from the first sample of all.
Samples from_first(Samples samples, bool is_geographic) {
  for (auto& [id, list] : samples)
    std::sort(list.begin(), list.end(), [](const Found& a, const Found& b) { return a.time < b.time; });
  if (samples.empty()) return samples;
  const Found first = samples.begin()->second.front();
  for (auto& [id, list] : samples) {
    for (Found& each : list) {
      each.time -= first.time;
      if (!is_geographic) each.position -= first.position;
    }
  }
  return samples;
}

Samples by_tracks(const std::string& text, const ColumnHints& hints) {
  TrackOptions options;
  options.hints = hints;
  options.missing = MissingPolicy::skip;
  options.max_gap = 1e12;
  const TrackSet track_set = parse_tracks({{"t", text}}, options);
  Samples samples;
  const bool is_geographic = track_set.coordinates.are_geographic();
  for (const RecordedTrack& track : track_set.tracks)
    for (const TrackSample& sample : track.samples)
      samples[track.id].push_back({sample.time, is_geographic
                                                    ? *track_set.coordinates.geographic(sample.position)
                                                    : sample.position});
  return from_first(samples, is_geographic);
}

class SampleSink final : public ReportSink {
 public:
  void take(const SourceReport& report) override {
    const double height = report.has_height ? report.position.z : 0.0;
    // Tables of tracks have a height in each row, if they have heights.
    if (report.may_have_height && !report.has_height) return;
    is_geographic = report.geographic;
    samples[std::string(report.id)].push_back(
        {static_cast<double>(report.stamp.whole) + report.stamp.fraction,
         {report.position.x, report.position.y, height}});
  }
  void time_is(const FileTime&, TimeKind) override {}
  void pass_over(Passed) override {}
  void refuse(std::size_t, const std::string& reason) override { throw ProgramError(reason); }

  Samples samples;
  bool is_geographic = false;
};

Samples by_watch(const std::string& text, const ColumnHints& hints, StreamFormat kind = StreamFormat::csv) {
  const auto format = make_format(kind, {.hints = hints, .source = "t"});
  RecordCutter cutter(records_of(kind));
  cutter.feed(text);
  SampleSink sink;
  try {
    while (const auto record = cutter.next()) format->read(*record, sink);
    if (const auto record = cutter.rest()) format->read(*record, sink);
  } catch (const WrongInput& error) {
    throw ProgramError(error.what());
  }
  // A track of one sample has no motion.
  std::erase_if(sink.samples, [](const auto& track) { return track.second.size() < 2; });
  return from_first(sink.samples, sink.is_geographic);
}

template <class Read>
std::pair<Samples, std::string> read_or_error(Read read) {
  try {
    return {read(), ""};
  } catch (const ProgramError& error) {
    return {{}, error.what()};
  }
}

void expect_same(const Samples& tracks, const Samples& watch) {
  ASSERT_EQ(tracks.size(), watch.size());
  for (const auto& [id, samples] : tracks) {
    ASSERT_TRUE(watch.contains(id)) << id;
    const auto& others = watch.at(id);
    ASSERT_EQ(samples.size(), others.size()) << id;
    for (std::size_t each = 0; each < samples.size(); ++each) {
      ASSERT_NEAR(samples[each].time, others[each].time, 1e-5) << id;
      ASSERT_LT(norm(samples[each].position - others[each].position), 1e-6) << id;
    }
  }
}

TEST(Readers, AgreeOnRandomTables) {
  Random random(42);
  int taken = 0, refused = 0;
  for (int k = 0; k < 3000; ++k) {
    const AnyTable table(random);
    ColumnHints hints;
    if (k % 3 == 0) hints.dates = DateOrder::day_first;
    if (k % 7 == 0) hints.where = "time != 0.5";
    const auto [tracks, tracks_error] = read_or_error([&] { return by_tracks(table.text(), hints); });
    const auto [watch, watch_error] = read_or_error([&] { return by_watch(table.text(), hints); });
    SCOPED_TRACE(
        fmt::format("table {}:\n{}\ntracks: {}\nwatch: {}", k, table.text(), tracks_error, watch_error));
    ASSERT_EQ(tracks_error.empty(), watch_error.empty());
    ++(tracks_error.empty() ? taken : refused);
    expect_same(tracks, watch);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(taken, 800);
  EXPECT_GT(refused, 800);
}

TEST(Readers, AgreeOnRecordings) {
  const std::string recordings[] = {
      "$GPRMC,120000,A,5400.0000,N,00801.0000,E,10.0,90,010324,,,A\n$GPGGA,120001,5400.1,N,00801.0,E,1,8,1,2."
      "5,M,,M,,\n",
      "2\nTime=0.5\nH 1 2 3\nH 4 5 6\n2\nTime=1.0\nH 1 2 4\nH 4 5 7\n",
      "ITEM: TIMESTEP\n0\nITEM: TIME\n0.5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 "
      "9\nITEM: ATOMS id x y "
      "z\n7 1 2 3\nITEM: TIMESTEP\n1\nITEM: TIME\n1.0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff "
      "ff\n0 9\n0 9\n0 9\nITEM: ATOMS "
      "id x y z\n7 1 2 4\n",
      "CCSDS_OEM_VERS = 2.0\nMETA_START\nOBJECT_NAME = A\nMETA_STOP\n2024-060T00:00:00.5 7000 0 0 1 0 "
      "0\n2024-060T00:01:00.5 7001 1 0 1 0 "
      "0\n",
      R"([{"id":"b","time":1,"x":5,"y":6},{"id":"a","time":0,"x":1,"y":2},{"id":"a","time":1,"x":1,"y":3},{"id":"b","time":2,"x":5,"y":7}])",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"a","times":[0,10]},"geometry":{"type":"LineString","coordinates":[[8,47],[8,47.1]]}}]})",
      R"({"header":{"gtfsRealtimeVersion":"2.0"},"entity":[{"id":"a","vehicle":{"position":{"latitude":47,"longitude":8},"timestamp":"1"}},{"id":"a","vehicle":{"position":{"latitude":47,"longitude":8.1},"timestamp":"2"}}]})",
      R"([{"category":62,"I010":{"SAC":{"val":1}},"I070":{"ToT":{"val":1.5}},"I105":{"Lat":{"val":47},"Lon":{"val":8}},"I040":{"TrkN":{"val":7}}},{"category":62,"I010":{"SAC":{"val":1}},"I070":{"ToT":{"val":2.5}},"I105":{"Lat":{"val":47},"Lon":{"val":8.1}},"I040":{"TrkN":{"val":7}}}])"};
  for (const std::string& text : recordings) {
    SCOPED_TRACE(text);
    EXPECT_NE(recording_kind_of(text), nullptr);
    expect_same(by_tracks(text, {}), by_watch(text, {}, StreamFormat::recording));
  }
  const std::string lines =
      "{\"id\":\"a\",\"time\":0,\"x\":1,\"y\":2}\n{\"id\":\"a\",\"time\":1,\"more\":3,\"x\":1,\"y\":3}\n\n{"
      "\"x\":1,\"y\":4,\"id\":\"a\",\"time\":2}\n";
  EXPECT_TRUE(are_json_lines(lines));
  expect_same(by_tracks(lines, {}), by_watch(lines, {}, StreamFormat::json));
}

}  // namespace
}  // namespace kinesphere::program::readers_agree_test
