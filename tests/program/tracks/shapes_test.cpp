// The public recordings, converted to all usual forms of data: the approaches stay equal.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "contact/contact_rule.hpp"
#include "formats/tables/presets.hpp"
#include "kinesphere/random.hpp"
#include "program/formats/preset_shapes.hpp"
#include "program/support.hpp"
#include "program/tracks/simulated_events.hpp"
#include "simulation/oracle/comparison.hpp"
#include "tracks/projection.hpp"
#include "tracks/track_file.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program::shapes_test {
namespace {

constexpr std::uint64_t seed = 2005;

struct Source {
  const char* name;
  const char* file;
  const char* format;
  double distance;
  double seconds = 1e9;  ///< of the recording, from its begin
};

constexpr Source sources[] = {
    {"ucy", "ucy_students03/ucy_students03_obsmat.txt.gz", "ucy", 0.4},
    {"pedpy", "pedpy_bottleneck/pedpy_bottleneck_040_c_56_h-.txt.gz", "", 0.3},
    {"mosquitoes", "mosquito3d/anopheles_swarm_splined.csv.gz", "", 0.03},
};

/// A sample in the original file's form.
struct Row {
  std::string id;
  std::int64_t milliseconds;
  Vec3 position;
};

struct Original {
  TrackSet track_set;
  std::vector<Row> rows;
  double distance;
  bool has_z() const { return !track_set.is_plane; }
};

/// A converted recording: its files, and the options to read them.
struct WrittenTracks {
  std::vector<NamedText> files;
  TrackOptions options;
};

using TracksWriter = std::function<WrittenTracks(Original&)>;

std::string header_of(const Original& original, std::string header) {
  return header + (original.has_z() ? ",z\n" : "\n");
}

/// `time_text` and positions have the fewest digits that read back as the same double.
std::string table(const Original& original, const std::string& header,
                  const std::function<std::string(const Row&)>& time_text) {
  std::string text = header_of(original, header);
  for (const Row& row : original.rows) {
    text += fmt::format("{},{},{},{}", row.id, time_text(row), row.position.x, row.position.y);
    text += original.has_z() ? fmt::format(",{}\n", row.position.z) : "\n";
  }
  return text;
}

std::string in_seconds(const Row& row) {
  return fmt::format("{}.{:03}", row.milliseconds / 1000, row.milliseconds % 1000);
}

std::string plain_table(const Original& original) { return table(original, "id,time,x,y", in_seconds); }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

WrittenTracks plain(Original& original) { return {{{"t.csv", plain_table(original)}}, {}}; }

/// Every field quoted, an extra name with quotes, separators and line ends, CRLF, a byte order mark.
WrittenTracks quoted(Original& original) {
  std::string text = "\xEF\xBB\xBF\"Name; \"\"of it\"\"\";\"TRACK_ID\";\"Time\";\"X\";\"Y\"";
  text += original.has_z() ? ";\"Z\"\r\n" : "\r\n";
  for (const Row& row : original.rows) {
    text += fmt::format("\"a;\"\"b\"\"\r\n#c\";\"{}\";\"{}\";\"{}\";\"{}\"", row.id, in_seconds(row),
                        row.position.x, row.position.y);
    text += original.has_z() ? fmt::format(";\"{}\"\r\n", row.position.z) : "\r\n";
  }
  return {{{"t.csv", text}}, {}};
}

/// Dates from the last minute before a leap day on, in two zones.
WrittenTracks dates(Original& original) {
  const auto date = [](const Row& row) {
    const std::int64_t seconds = row.milliseconds / 1000 + 23 * 3600 + 59 * 60;
    const bool east = row.milliseconds % 3 == 0;
    const std::int64_t reported = east ? seconds + 2 * 3600 : seconds;
    return fmt::format("2024-02-{}{}{:02}:{:02}:{:02}.{:03}{}", 28 + reported / 86400, east ? ' ' : 'T',
                       reported % 86400 / 3600, reported % 3600 / 60, reported % 60, row.milliseconds % 1000,
                       east ? "+02:00" : "Z");
  };
  return {{{"t.csv", table(original, "agent,BaseDateTime,x,y", date)}}, {}};
}

WrittenTracks unix_seconds(Original& original) {
  const auto time = [](const Row& row) {
    return fmt::format("{}.{:03}", 1700000000 + row.milliseconds / 1000, row.milliseconds % 1000);
  };
  return {{{"t.csv", table(original, "MMSI,Timestamp,x,y", time)}}, {}};
}

WrittenTracks unix_milliseconds(Original& original) {
  WrittenTracks reported{
      {{"t.csv", table(original, "object,t,x,y",
                       [](const Row& row) { return fmt::format("{}", 1700000000000 + row.milliseconds); })}},
      {}};
  reported.options.hints.time_unit = "ms";
  return reported;
}

/// 9 decimals: rounding errors up to 1e-9, the distance of two doubles there.
WrittenTracks utm(Original& original) {
  std::string text = header_of(original, "ped,time,Easting,Northing");
  for (const Row& row : original.rows) {
    text += fmt::format("{},{},{:.9f},{:.9f}", row.id, in_seconds(row), row.position.x + 500000,
                        row.position.y + 5400000);
    text += original.has_z() ? fmt::format(",{}\n", row.position.z) : "\n";
  }
  WrittenTracks reported{{{"t.csv", text}}, {}};
  reported.options.hints.positions = "utm:33N";
  return reported;
}

/// On the ground of the Earth, or in space above it. 14 decimals of a degree are 1e-9 m.
WrittenTracks longitudes_and_latitudes(Original& original) {
  const Vec3 somewhere{11.5, 54.25, 0};
  const auto projection = project(std::span(&somewhere, 1), original.has_z(), ProjectionChoice::automatic);
  std::string text = original.has_z() ? "id,time,LAT,LON,Altitude\n" : "id,time,LAT,LON\n";
  for (const Row& row : original.rows) {
    const Vec3 place = projection->geographic(row.position);
    text += fmt::format("{},{},{:.14f},{:.14f}", row.id, in_seconds(row), place.y, place.x);
    text += original.has_z() ? fmt::format(",{:.10f}\n", place.z) : "\n";
  }
  return {{{"t.csv", text}}, {}};
}

/// Each id loses 4 samples of 40: its track ends before them and another begins after them.
WrittenTracks gaps(Original& original) {
  std::map<std::string, std::size_t> count;
  std::erase_if(original.rows, [&](const Row& row) { return count[row.id]++ % 40 >= 36; });
  TrackSet& track_set = original.track_set;
  std::vector<RecordedTrack> cut;
  for (const RecordedTrack& track : track_set.tracks) {
    std::vector<TrackSample> samples;
    for (std::size_t k = 0; k <= track.samples.size(); ++k) {
      if (k < track.samples.size() && k % 40 < 36) {
        samples.push_back(track.samples[k]);
      } else if (samples.size() > 1) {
        cut.push_back({track.id, std::exchange(samples, {})});
      } else {
        samples.clear();
      }
    }
  }
  track_set.tracks = std::move(cut);
  return plain(original);
}

WrittenTracks duplicates(Original& original, DuplicatePolicy policy) {
  std::vector<std::string> lines = lines_of(plain_table(original));
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    text += lines[k] + '\n';
    if (k > 0 && k % 7 == 0) text += lines[k] + '\n';
    if (k > 0 && k % 100 == 0) text += lines[k - 50] + '\n';
  }
  WrittenTracks reported{{{"t.csv", text}}, {}};
  reported.options.duplicates = policy;
  return reported;
}

WrittenTracks first_duplicates(Original& original) { return duplicates(original, DuplicatePolicy::first); }
/// Equal positions: the mean of two of them is exact, of three up to rounding.
WrittenTracks mean_duplicates(Original& original) { return duplicates(original, DuplicatePolicy::mean); }

/// Rows without a position between rows with one, and rows without a time.
WrittenTracks missing(Original& original) {
  std::string text = header_of(original, "id,time,x,y");
  const char* const ways[] = {"NaN,1", "1,", "null,NA"};
  std::size_t k = 0;
  for (const std::string& line : lines_of(plain_table(original))) {
    if (k++ == 0) continue;
    text += line + '\n';
    const std::string id = line.substr(0, line.find(','));
    if (k % 5 == 0)
      text += fmt::format("{},{},{}{}", id, in_seconds({"", static_cast<std::int64_t>(k), {}}), ways[k % 3],
                          original.has_z() ? ",1\n" : "\n");
    if (k % 11 == 0) text += fmt::format("{},,1,1{}", id, original.has_z() ? ",1\n" : "\n");
  }
  WrittenTracks reported{{{"t.csv", text}}, {}};
  reported.options.missing = MissingPolicy::skip;
  return reported;
}

WrittenTracks shuffled(Original& original) {
  Random random(seed);
  for (std::size_t k = original.rows.size(); k > 1; --k)
    std::swap(original.rows[k - 1],
              original.rows[static_cast<std::size_t>(random.uniform(0, static_cast<double>(k)))]);
  return plain(original);
}

/// Half of the rows are in one file, the others alternate between two.
WrittenTracks several_files(Original& original) {
  const std::string header = header_of(original, "id,time,x,y");
  std::string texts[3] = {header, header, header};
  std::size_t k = 0;
  for (const std::string& line : lines_of(plain_table(original))) {
    if (k++ > 0) texts[k < original.rows.size() / 2 ? 0 : 1 + k % 2] += line + '\n';
  }
  WrittenTracks several{{{"a.csv", texts[0]}, {"b.csv", texts[1]}, {"c.csv", texts[2]}}, {}};
  // Ids at the same times in two files might be two bodies.
  several.options.hints.where = "id != none";
  return several;
}

std::string date(const std::string& day, std::int64_t milliseconds) {
  const std::int64_t seconds = milliseconds / 1000;
  return fmt::format("{} {:02}:{:02}:{:02}.{:03}", day, seconds / 3600, seconds / 60 % 60, seconds % 60,
                     milliseconds % 1000);
}

/// A preset's files, without an option that is not needed.
WrittenTracks in_preset(const PresetShape& shape, const Original& original) {
  const bool has_heights = shape.heights == with_heights;
  const Vec3 somewhere{11.5, 54.25, 0};
  const auto projection = project(std::span(&somewhere, 1), has_heights, ProjectionChoice::automatic);
  std::map<std::string, std::string> texts;
  for (const Row& row : original.rows) {
    const Vec3 place = projection->geographic(row.position);
    const std::int64_t ms = row.milliseconds;
    std::string& text = texts[shape.one_body_a_file ? row.id + ".csv" : "t.csv"];
    if (text.empty()) text = shape.header;
    for (const char* line : {shape.row, shape.void_row}) {
      text += fmt::format(
          fmt::runtime(line), fmt::arg("id", row.id), fmt::arg("s", in_seconds(row)), fmt::arg("ms", ms),
          fmt::arg("us", 1000 * ms), fmt::arg("frame", ms / 40), fmt::arg("date", date("2024-02-29", ms)),
          fmt::arg("day_first", date("29/02/2024", ms)),
          fmt::arg("unix", fmt::format("{}.{:03}", 1600000000 + ms / 1000, ms % 1000)),
          fmt::arg("x", row.position.x / shape.unit), fmt::arg("y", row.position.y / shape.unit),
          fmt::arg("lon", fmt::format("{:.14f}", place.x)), fmt::arg("lat", fmt::format("{:.14f}", place.y)),
          fmt::arg("alt", fmt::format("{:.10f}", place.z)),
          fmt::arg("alt_ft", fmt::format("{:.10f}", place.z / 0.3048)));
    }
  }
  WrittenTracks written;
  for (auto& [name, text] : texts) written.files.push_back({name, std::move(text)});
  const std::string option = shape.options;
  if (option == "25") written.options.hints.frame_rate = 25.0;
  if (option == "ucy" || option == "eth") written.options.hints.format = option;
  return written;
}

struct Shape {
  const char* name;
  std::function<WrittenTracks(Original&)> write;
};

std::vector<Shape> shapes_of_presets() {
  std::vector<Shape> shapes;
  for (const PresetShape& shape : preset_shapes)
    shapes.push_back({shape.preset, [&shape](Original& original) { return in_preset(shape, original); }});
  return shapes;
}

const Shape shapes[] = {
    {"plain", plain},
    {"quoted", quoted},
    {"dates", dates},
    {"unix_seconds", unix_seconds},
    {"unix_milliseconds", unix_milliseconds},
    {"utm", utm},
    {"longitudes_and_latitudes", longitudes_and_latitudes},
    {"gaps", gaps},
    {"first_duplicates", first_duplicates},
    {"mean_duplicates", mean_duplicates},
    {"missing", missing},
    {"shuffled", shuffled},
    {"several_files", several_files},
};

/// The body of the original for a track of the converted recording, and the shift of time.
struct Counterpart {
  std::uint32_t body;
  double shift;
};

/// Finds bodies by id and order in time among the tracks of the id.
std::vector<Counterpart> counterparts(const TrackSet& reported, const TrackSet& original) {
  std::map<std::string, std::vector<std::uint32_t>> bodies;
  for (std::uint32_t body = 0; body < original.tracks.size(); ++body)
    bodies[original.tracks[body].id].push_back(body);
  std::map<std::string, std::size_t> next;
  std::vector<Counterpart> result;
  for (const RecordedTrack& track : reported.tracks) {
    const std::uint32_t body = bodies.at(track.id).at(next[track.id]++);
    const RecordedTrack& same = original.tracks[body];
    EXPECT_EQ(track.samples.size(), same.samples.size()) << track.id;
    result.push_back({body, same.samples.front().time - track.samples.front().time});
  }
  return result;
}

using Pairs = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

Pairs pairs_of(const std::vector<Event>& events) {
  Pairs pairs;
  for (const Event& event : events)
    if (event.kind == EventKind::contact_begin) ++pairs[std::minmax(event.first.index, event.second.index)];
  return pairs;
}

/// Cuts the recording off so many seconds after its begin.
void keep_first(double seconds, TrackSet& track_set) {
  double begin = track_set.tracks.front().samples.front().time;
  for (const RecordedTrack& track : track_set.tracks) begin = std::min(begin, track.samples.front().time);
  for (RecordedTrack& track : track_set.tracks)
    std::erase_if(track.samples, [&](const TrackSample& sample) { return sample.time > begin + seconds; });
  std::erase_if(track_set.tracks, [](const RecordedTrack& track) { return track.samples.size() < 2; });
}

class Shapes : public ::testing::TestWithParam<std::tuple<Source, Shape>> {};

TEST_P(Shapes, HaveTheSameApproaches) {
  const auto& [source, shape] = GetParam();
  const std::string file = recorded_file(source.file);
  if (file.empty()) GTEST_SKIP() << "no recording " << source.file << " (see KINESPHERE_DATA)";
  TrackOptions options;
  options.hints.format = source.format;
  Original original{read_tracks({file}, options), {}, source.distance};
  keep_first(source.seconds, original.track_set);
  for (const RecordedTrack& track : original.track_set.tracks) {
    for (const TrackSample& sample : track.samples)
      original.rows.push_back({track.id, std::llround(1000 * sample.time), sample.position});
  }
  WrittenTracks reported = shape.write(original);
  const TrackSet read = parse_tracks(std::move(reported.files), reported.options);
  ASSERT_EQ(read.tracks.size(), original.track_set.tracks.size());
  const std::vector<Counterpart> same = counterparts(read, original.track_set);

  // The truth of the original checks the approaches in the converted recording. Its positions differ by
  // rounding errors of 1e-9 at most, and a spline passes on no more than twice that: far less than a
  // tolerance of a millionth of the distance, so that twice the tolerance covers it.
  const ApproachQuestion question{.distance = source.distance};
  Scene truth = scene_of(original.track_set, question).scene;
  const std::vector<Event> expected = events_of(truth);
  const ContactComparison own = require(compare_with_oracle(truth, expected));
  ASSERT_TRUE(own.agrees());
  ASSERT_EQ(own.grazing, 0u) << "no approach may be in doubt, or another shape may see it or not";

  std::vector<Event> events = events_of(scene_of(read, question).scene);
  for (Event& event : events) {
    event.time += same[event.first.index].shift;
    for (BodyId* body : {&event.first, &event.second}) {
      body->index = same[body->index].body;
      // The shift may have been rounded; the first and last times of a track are exact.
      for (double time : {truth.bodies[body->index].appears, truth.bodies[body->index].vanishes})
        if (std::abs(event.time - time) < 1e-12 * (1 + time)) event.time = time;
    }
    if (event.first.index > event.second.index) std::swap(event.first, event.second);
  }
  EXPECT_EQ(pairs_of(events), pairs_of(expected));
  truth.world.separation_distance = ContactRule(truth.world).separation_distance();
  truth.world.contact_tolerance *= 2;
  const ContactComparison comparison = require(compare_with_oracle(truth, events));
  EXPECT_TRUE(comparison.agrees()) << *comparison.first_difference;
  EXPECT_EQ(comparison.grazing, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, Shapes,
                         ::testing::Combine(::testing::ValuesIn(sources), ::testing::ValuesIn(shapes)),
                         [](const auto& each) {
                           return fmt::format("{}_{}", std::get<0>(each.param).name,
                                              std::get<1>(each.param).name);
                         });

constexpr Source slice{"ucy", "ucy_students03/ucy_students03_obsmat.txt.gz", "ucy", 0.4, 60.0};

INSTANTIATE_TEST_SUITE_P(Presets, Shapes,
                         ::testing::Combine(::testing::Values(slice),
                                            ::testing::ValuesIn(shapes_of_presets())),
                         [](const auto& each) { return std::string(std::get<1>(each.param).name); });

TEST(PresetShapes, AreThoseOfAllPresets) {
  std::string names;
  for (const PresetShape& shape : preset_shapes) names += shape.preset + std::string("|");
  EXPECT_EQ(names + "table", preset_names());
}

}  // namespace
}  // namespace kinesphere::program::shapes_test
