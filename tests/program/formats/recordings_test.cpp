// Files of other formats that tracks reads: GPX, XYZ, dumps of LAMMPS.
#include <fmt/format.h>

#include "formats/recordings/recording_kinds.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::recordings_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}

TrackOptions frames(double rate) {
  TrackOptions options;
  options.hints.frame_rate = rate;
  return options;
}

const std::string point_a =
    R"(<trkpt lat="47.0" lon="8.0"><ele>10</ele><time>2024-01-01T00:00:00Z</time></trkpt>)";
const std::string point_b = R"(<trkpt lon="8.0001" lat="47.0"><time>2024-01-01T00:00:10Z</time></trkpt>)";

TEST(Recordings, ReadsGpx) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  const auto gpx = [](const std::string& body) {
    return R"(<?xml version="1.0"?><gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">)" + body +
           "</gpx>";
  };
  const TrackSet two =
      parse(gpx("<trk><name>a, b</name><trkseg>" + point_a + "\n" + point_b + "</trkseg></trk><trk><trkseg>" +
                point_a + point_b + "</trkseg></trk><wpt lat=\"1\" lon=\"1\"/>"));
  EXPECT_EQ(two.format, "GPX");
  ASSERT_EQ(two.tracks.size(), 2u);
  EXPECT_EQ(two.tracks[0].id, "a, b");
  EXPECT_EQ(two.tracks[1].id, "track 2");
  EXPECT_TRUE(two.is_plane);
  EXPECT_EQ(two.warnings.size(), 1u) << "one of two points has a height";
  // Two tracks of one name are no body that is in two places.
  const std::string walk = "<trk><name>walk</name><trkseg>" + point_a + point_b + "</trkseg></trk>";
  const TrackSet walks = parse(gpx(walk + walk));
  ASSERT_EQ(walks.tracks.size(), 2u);
  EXPECT_EQ(walks.tracks[1].id, "walk (2)");
  EXPECT_EQ(two.times.text(two.tracks[0].samples[1].time), "2024-01-01T00:00:10Z");
  EXPECT_NEAR(norm(two.tracks[0].samples[1].position - two.tracks[0].samples[0].position), 7.6, 0.1);
  EXPECT_EQ(error_in(gpx("<trk><trkseg>\n\n<trkpt lat=\"north\" "
                         "lon=\"8\"><time>2024-01-01T00:00:00Z</time></trkpt></trkseg></trk>")),
            "f:3: expected a number as latitude ('lat'), but got 'north'");
  EXPECT_EQ(error_in("<gpx>\n<trk></gpx>"), "f:2: expected GPX: mismatched tag");
  const std::string expected =
      "f: expected tracks (trk) whose points have times, as receivers log them, but ";
  EXPECT_EQ(error_in(gpx("<wpt lat=\"1\" lon=\"1\"/>")), expected + "it has no tracks");
  EXPECT_EQ(error_in(gpx("<trk><trkseg><trkpt lat=\"1\" lon=\"1\"/></trkseg></trk>")),
            expected + "none has a time");
  EXPECT_TRUE(
      error_in("<!DOCTYPE gpx [<!ENTITY a \"aaaa\">]><gpx>&a;</gpx>").starts_with("f:1: expected GPX: "));
}

TEST(Recordings, ReadsGeoJson) {
  const auto collection = [](const std::string& features) {
    return "{\"type\": \"FeatureCollection\", \"features\": [\n" + features + "]}";
  };
  const auto point = [](int second, std::string_view place) {
    return fmt::format(
        R"({{"type": "Feature", "geometry": {{"type": "Point", "coordinates": [{}]}}, "properties": {{"mmsi": 211, )"
        R"("lat": 1, "time": "2024-01-01T00:00:0{}Z"}}}})",
        place, second);
  };
  const TrackSet points = parse(collection(point(0, "8, 47") + ",\n" + point(5, "8.0001, 47")));
  EXPECT_EQ(points.format, "GeoJSON");
  ASSERT_EQ(points.tracks.size(), 1u);
  EXPECT_EQ(points.tracks[0].id, "211");
  EXPECT_NEAR(norm(points.tracks[0].samples[1].position - points.tracks[0].samples[0].position), 7.6, 0.1);
  const std::string line =
      R"({"type": "Feature", "properties": {"name": "a", "coordTimes": ["2024-01-01T00:00:00Z", "2024-01-01T00:00:05Z"]},)"
      R"("geometry": {"type": "LineString", "coordinates": [[8, 47, 10], [8.0001, 47, 10]]}})";
  const std::string area =
      R"({"type": "Feature", "properties": null, "geometry": {"type": "Polygon", "coordinates": []}})";
  const TrackSet lines = parse(collection(line + ",\n" + area));
  ASSERT_EQ(lines.tracks.size(), 1u);
  EXPECT_EQ(lines.tracks[0].id, "a");
  EXPECT_TRUE(lines.has_heights);
  EXPECT_EQ(lines.warnings.size(), 1u) << "an area is no track";
  EXPECT_TRUE(
      error_in(collection(area)).starts_with("f: expected points with properties such as id and time"));
  EXPECT_EQ(error_in(collection(point(0, "8, 47") + ",\n" + point(5, "8, \"north\""))),
            "f:3: expected numbers as coordinates");
  const auto of_system = [&](const std::string& name) {
    return "{\"type\": \"FeatureCollection\", \"crs\": " + name + ", \"features\": [" + line + "]}";
  };
  EXPECT_EQ(error_in(of_system(R"({"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}})")),
            "f: expected longitudes and latitudes, but its coordinates are of urn:ogc:def:crs:EPSG::25832: "
            "convert them with ogr2ogr -t_srs EPSG:4326 degrees.geojson f");
  for (const char* degrees : {"null", R"({"type": "name", "properties": {"name": "EPSG:4326"}})",
                              R"({"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}})"})
    EXPECT_EQ(parse(of_system(degrees)).tracks.size(), 1u) << degrees;
  EXPECT_TRUE(error_in(collection("{\"type\": \"Feature\", ")).starts_with("f:1: expected JSON"));
  EXPECT_TRUE(error_in(collection(area) + "\n" + collection(area)).starts_with("f:1: expected JSON"));
}

TEST(Recordings, ReadsEphemerides) {
  const auto segment = [](const std::string& name, const std::string& frame, double x) {
    return fmt::format(
        "META_START\nOBJECT_NAME = {}\nCENTER_NAME = EARTH\nREF_FRAME = {}\nTIME_SYSTEM = "
        "UTC\nMETA_STOP\nCOMMENT 1 2 3 4\n"
        "2024-060T00:00:00.5 {} 0 0 1 0 0\n2024-02-29T00:01:00.5 {} 1 0 1 0 0\n"
        "COVARIANCE_START\nEPOCH = 2024-060T00:00:00\n3.3e-4\nCOVARIANCE_STOP\n",
        name, frame, x, x);
  };
  const std::string version = "CCSDS_OEM_VERS = 2.0\nORIGINATOR = X\n";
  const TrackSet two = parse(version + segment("A 1", "GCRF", 7000) + segment("B", "GCRF", 7001));
  EXPECT_EQ(two.format, "OEM");
  ASSERT_EQ(two.tracks.size(), 2u);
  EXPECT_EQ(two.tracks[0].id, "A 1");
  EXPECT_EQ(parse(version + segment("A \"1\", B", "GCRF", 7000)).tracks[0].id, "A \"1\", B");
  EXPECT_EQ(two.times.text(two.tracks[0].samples[0].time), "2024-02-29T00:00:00.5");
  EXPECT_DOUBLE_EQ(norm(two.tracks[0].samples[0].position - two.tracks[1].samples[0].position), 1000.0);
  EXPECT_NE(
      error_in(version + segment("A", "GCRF", 7000) + segment("B", "ITRF", 7001)).find("with ref_frame as"),
      std::string::npos);
  EXPECT_EQ(error_in(version + "META_STOP\n2024-060T00:00:00 1\n"),
            "f:4: expected a time and a position, but got '2024-060T00:00:00 1'");
}

TEST(Recordings, ReadsFcdOutputOfSumo) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  const auto step = [](int time, double x) {
    return fmt::format(
        "<timestep time=\"{}.50\">\n<vehicle id=\"a\" x=\"{}\" y=\"2\" type=\"car\"/>\n"
        "<person id=\"a\" x=\"5\" y=\"2\" speed=\"1\"/>\n</timestep>\n",
        time, x);
  };
  const TrackSet fcd =
      parse("<?xml version=\"1.0\"?>\n<fcd-export>\n" + step(0, 1) + step(1, 2) + "</fcd-export>\n");
  EXPECT_EQ(fcd.format, "SUMO FCD");
  ASSERT_EQ(fcd.tracks.size(), 2u);
  EXPECT_EQ(fcd.tracks[0].id, "a");
  EXPECT_EQ(fcd.tracks[1].id, "person a");
  EXPECT_EQ(fcd.tracks[0].samples[1].position, (Vec3{2, 2, 0}));
  EXPECT_EQ(fcd.times.text(fcd.tracks[0].samples[1].time), "1.5");
  EXPECT_TRUE(fcd.warnings.empty());
  const TrackSet some = parse(
      "<fcd-export><timestep time=\"0\"><vehicle id=\"a\" x=\"0\" y=\"0\" z=\"5\"/></timestep>"
      "<timestep time=\"1\"><vehicle id=\"a\" x=\"0\" y=\"0\"/></timestep></fcd-export>");
  EXPECT_FALSE(some.has_heights);
  EXPECT_EQ(some.warnings,
            std::vector<std::string>{"f: some points have no height (z), so that none is used"});
  EXPECT_EQ(
      error_in("<fcd-export>\n<timestep time=\"0\">\n<vehicle id=\"a\" x=\"one\" y=\"2\"/>\n</timestep>\n"
               "</fcd-export>"),
      "f:3: expected a number as x ('x'), but got 'one'");
}

TEST(Recordings, ReadsJsonRecords) {
  const std::string list =
      R"([{"id": "a, \"b\"", "time": 1700000000.123456, "pose": {"position": {"x": 1, "y": 2}}},)"
      "\n"
      R"({"time": 1700000001.123456, "id": "a, \"b\"", "pose": {"position": {"x": 3, "y": null}}, "note": [1, 2, 3, 4]},)"
      "\n"
      R"({"time": 1700000002.123456, "id": "a, \"b\"", "pose": {"position": {"x": 3, "y": 2.5}}}])";
  TrackOptions skip;
  skip.missing = MissingPolicy::skip;
  const TrackSet records = parse(list, skip);
  EXPECT_EQ(records.format, "JSON records");
  ASSERT_EQ(records.tracks.size(), 1u);
  EXPECT_EQ(records.tracks[0].id, "a, \"b\"");
  EXPECT_EQ(records.times.text(records.tracks[0].samples[1].time), "1700000002.123456");
  EXPECT_EQ(records.missing.count, 1u);
  EXPECT_EQ(error_in(list),
            "f:2: expected a number as y ('pose.position.y'), but got nothing (see --missing)");
  const std::string lines = "{\"id\":1,\"t\":0,\"at\":[1,2]}\n{\"id\":1,\"t\":1,\"at\":[1,3]}\n";
  TrackOptions columns;
  columns.hints.columns = "id=id,time=t,x=at.0,y=at.1";
  EXPECT_EQ(parse(lines, columns).tracks[0].samples.size(), 2u);
  EXPECT_EQ(error_in(lines + "{\"id\":1,\"t\":\"two\",\"at\":[1,3]}\n", columns),
            "f:3: expected a number as time ('t'), but got 'two'");
  std::string keys;
  for (int k = 0; k < 1200; ++k) keys += fmt::format("{{\"{}\":1}}\n", k);
  EXPECT_EQ(error_in(keys), "f:1001: expected records of at most 1000 names, but got more");
  EXPECT_TRUE(error_in(lines + "{\"id\":1,\n", columns).starts_with("f:3: expected JSON records: "));
  // Nothing is passed over in silence.
  EXPECT_EQ(error_in(lines + R"({"id":1,"t":2,"at":[1,3]}{"id":1,"t":3,"at":[1,3]})", columns),
            "f:3: expected one JSON object, or one list of objects, in a line, but there is more");
  EXPECT_EQ(error_in(list + "\n" + list), "f:3: expected one list of JSON records, but there is more");
}

/// Values inside each other without end would exhaust the stack.
TEST(Recordings, SaysHowRecordsInListsAreTakenOut) {
  std::string players;
  for (int k = 0; k < 5; ++k)
    players += fmt::format(R"({}{{"id":{},"x":{},"y":0}})", k == 0 ? "" : ",", k, k);
  const std::string frame = R"({"frame":1,"players":[)" + players + "]}\n";
  EXPECT_EQ(error_in(frame + frame),
            "f: expected records with a position each, but they are in a list 'players': say jq -c '. + "
            ".players[] | del(.players)' FILE | kinesphere tracks -");
  EXPECT_NE(error_in(R"({"tracks":[{"id":1,"points":[{"x":1},{"x":2},{"x":3},{"x":4}]}]})")
                .find("'. + .tracks[] |"),
            std::string::npos);
  EXPECT_EQ(error_in("[{\"x\":1},[{\"x\":2}]]"), "f:1: expected JSON records: objects, or one list of them");
  EXPECT_EQ(
      error_in("[" + frame + "]"),
      "f: expected records with a position each, but they are in a list 'players': say jq -c '.[] | . + "
      ".players[] | del(.players)' FILE | kinesphere tracks -");
}

TEST(Recordings, RefusesDeepJson) {
  constexpr std::size_t deep = 200'000;
  std::string objects, ends;
  for (std::size_t k = 0; k < deep; ++k) objects += "{\"a\":", ends += '}';
  const std::string lists(deep, '['), list_ends(deep, ']');
  const std::string refusal = "f:1: expected records nested at most 64 deep, but got deeper";
  EXPECT_EQ(error_in("[" + objects + "1" + ends + "]"), refusal);
  EXPECT_EQ(error_in(objects + "1" + ends), refusal);
  EXPECT_EQ(error_in("{\"a\":" + lists + "1" + list_ends + "}"), refusal);
  EXPECT_TRUE(error_in("{\"type\": \"FeatureCollection\", \"features\": [{\"properties\":" + objects + "1" +
                       ends + ", \"geometry\": {\"type\": \"Point\", \"coordinates\": [1, 2]}}]}")
                  .starts_with("f:1: expected JSON"));
}

TEST(Recordings, ReadsRecordsOverSeveralLines) {
  TrackOptions options;
  options.hints.columns = "id=id,time=time,x=pose.x,y=pose.y";
  std::string nested = "[\n";
  for (int k = 0; k < 4; ++k)
    nested += std::string(k == 0 ? "" : ",\n") +
              "  {\n    \"id\": \"a\",\n    \"time\": " + std::to_string(k) +
              ",\n    \"pose\": {\n      \"x\": 1.5,\n      \"y\": " + std::to_string(k) +
              "\n    },\n    \"twist\": {\r\n\t\"x\": 1,\n\t\"y\": 0.0\n    },\n    \"ok\": true\n  }";
  const TrackSet found = parse(nested + "\n]\n", options);
  ASSERT_EQ(found.tracks.size(), 1u);
  EXPECT_EQ(found.tracks[0].samples.size(), 4u);
  EXPECT_EQ(found.tracks[0].samples[3].position - found.tracks[0].samples[0].position, (Vec3{0, 3, 0}));
  const std::string flat =
      "[\n {\n  \"id\":\"a\",\"time\":0,\n  \"x\":0,\"y\":0\n },\n {\n  \"id\":\"a\",\"time\":1,\n  "
      "\"x\":\"oops\",\"y\":0\n }\n]\n";
  EXPECT_EQ(error_in(flat), "f:6: expected a number as x ('x'), but got 'oops'") << "the line of the record";
}

TEST(Recordings, NamesWhatAFileLacks) {
  EXPECT_EQ(error_in("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
                     "ITEM: ATOMS id x y z\n"),
            "f: expected positions, but this file (LAMMPS dump) has none");
}

TEST(Recordings, OfXmlAreKnownByTheirOutermostElement) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  const std::string sumo =
      "<?xml version=\"1.0\"?>\n<!-- generated with <gpx> and <kml> in mind -->\n<!DOCTYPE fcd-export>\n"
      "<fcd-export><timestep time=\"0\"><vehicle id=\"a, b\" x=\"1\" y=\"2\"/></timestep>\n"
      "<timestep time=\"1\"><vehicle id=\"a, b\" x=\"2\" y=\"2\"/></timestep></fcd-export>\n";
  const TrackSet track_set = parse(sumo);
  EXPECT_EQ(track_set.format, "SUMO FCD");
  ASSERT_EQ(track_set.tracks.size(), 1u);
  EXPECT_EQ(track_set.tracks[0].id, "a, b") << "commas are those of the id";
  EXPECT_NE(error_in("<a><gpx/></a>").find("but it is XML"), std::string::npos);
  EXPECT_EQ(root_element("<!-- <gpx> -->"), "");
  EXPECT_EQ(root_element("<x:gpx version='1'>"), "gpx");
  EXPECT_EQ(root_element("<?xml"), "");
}

TEST(Recordings, OfSeveralPlacesInALineNameThatLine) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  EXPECT_EQ(
      error_in("<fcd-export>\n<timestep time=\"0\"><vehicle id=\"a\" x=\"1\" y=\"2\"/><vehicle id=\"b\" "
               "x=\"1\" y=\"2\"/></timestep>\n<timestep time=\"one\"><vehicle id=\"a\" x=\"1\" y=\"2\"/>"
               "</timestep>\n</fcd-export>"),
      "f:3: expected a number as time ('time'), but got 'one'");
}

TEST(Recordings, FormatTableExcludesThem) {
  TrackOptions options;
  options.hints.format = "table";
  const std::string like_log = "id,note,time,x,y\na,$GPRMC,0,0,0\na,$GPRMC,1,1,0\n";
  EXPECT_NE(error_in(like_log).find("expected a time of day, hhmmss"), std::string::npos);
  EXPECT_EQ(parse(like_log, options).tracks.size(), 1u);
  // Records in JSON are a table.
  EXPECT_EQ(parse(R"([{"id":"a","time":0,"x":1,"y":2},{"id":"a","time":1,"x":1,"y":2}])", options).format,
            "JSON records");
}

TEST(Recordings, TablesMayHaveAColumnOfScorers) {
  const TrackSet found = parse("scorer,id,time,x,y\ns,a,0,0,0\ns,a,1,1,0\ns,b,0,5,5\ns,b,1,4,5\n");
  EXPECT_EQ(found.format, "table");
  EXPECT_EQ(found.tracks.size(), 2u);
  EXPECT_EQ(parse("scorer,id,time,x,y\nbodyparts,a,0,0,0\nbodyparts,a,1,1,0\n").tracks.size(), 1u);
}

TEST(Recordings, ReadsTracesOfTar1090) {
  const std::string trace =
      R"({"icao":"4ca1fa","timestamp":1600000000.5,"trace":[[0,47,8,"ground",10,90,0,null,null,"adsb_icao",null],)"
      R"([10.25,47.1,8.1,1000,100,90,0,64,{"flight":"A"},"adsb_icao",1200],[20,47.2,8.2,2000,100,90,1,64,null]]})";
  const auto read = [&](FormatChoices::Altitude altitude) {
    TrackOptions options;
    options.altitude = altitude;
    return parse(trace, options);
  };
  const TrackSet flight = read(FormatChoices::Altitude::barometric);
  EXPECT_EQ(flight.format, "trace of tar1090 (barometric altitude)");
  ASSERT_EQ(flight.tracks.size(), 1u);
  EXPECT_EQ(flight.tracks[0].id, "4ca1fa");
  EXPECT_EQ(flight.times.text(flight.tracks[0].samples[0].time), "1600000010.75");
  EXPECT_NEAR(flight.coordinates.geographic(flight.tracks[0].samples[1].position)->z, 2000 * 0.3048, 1e-6);
  EXPECT_TRUE(flight.warnings.empty());
  EXPECT_EQ(flight.on_ground.count, 1u);
  EXPECT_NE(error_of([&] { read(FormatChoices::Altitude::geometric); }), "") << "one sample alone";
  EXPECT_TRUE(
      error_in(R"({"icao":"4ca1fa","trace":[[0,47,8,1,)").starts_with("f:1: expected JSON records: "));
}

TEST(Recordings, ReadsXyz) {
  const std::string ours =
      "2\nLattice=\"9 0 0 0 9 0 0 0 9\" pbc=\"F F F\" Properties=species:S:1:id:I:1:pos:R:3 Time=0.125\n"
      "S 7 1 2 3\nS 9 4 5 6\n2\nProperties=species:S:1:id:I:1:pos:R:3 Time=0.25\nS 7 1.5 2 3\nS 9 4 5 6\n";
  const TrackSet run = parse(ours);
  EXPECT_EQ(run.format, "XYZ");
  ASSERT_EQ(run.tracks.size(), 2u);
  EXPECT_EQ(run.tracks[0].id, "7");
  EXPECT_EQ(run.tracks[0].samples[1].time, 0.25);
  EXPECT_EQ(run.tracks[0].samples[1].position, (Vec3{1.5, 2, 3}));
  // Plain XYZ has neither ids nor times.
  const std::string plain = "1\nwater\nO 1 2 3\n1\nwater\nO 2 2 3\n";
  EXPECT_EQ(error_in(plain), "f: expected --frame-rate, because column 'frame' counts frames");
  EXPECT_EQ(parse(plain, frames(2)).tracks[0].samples[1].time, 0.5);
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\n1\nwater\nO 2 two 3\n", frames(2)),
            "f:6: expected a number as y ('y'), but got 'two'");
  EXPECT_EQ(error_in("1\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3 Time=0\nO 1 two 3\n"),
            "f:3: expected a number as y ('y'), but got 'two'");
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\nwater\n", frames(2)),
            "f:4: expected a number of atoms, but got 'water'");
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\n1\nwater\nO 2 2 3", frames(2)),
            "f:6: expected a whole line of an atom with 4 columns or more, but got 'O 2 2 3'");
  // Tracks go on through the faces of a periodic box.
  const TrackSet periodic = parse(
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3 Time=0\nO 9 1 1\n"
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3 Time=1\nO 0.5 1 9\n");
  EXPECT_EQ(periodic.tracks[0].samples[1].position, (Vec3{10.5, 1, -1}));
  EXPECT_EQ(periodic.warnings.size(), 1u);
}

TEST(Recordings, ReadsDumpsOfLammps) {
  const auto frame = [](int step, const std::string& kinds, const std::string& atoms,
                        const std::string& rows) {
    return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS " +
           kinds + "\n0 10\n0 10\n-5 5\nITEM: ATOMS " + atoms + "\n" + rows;
  };
  const TrackSet plain = parse(frame(0, "ff ff ff", "id type x y z vx", "1 1 1 2 3 0\n2 1 4 5 6 0\n") +
                                   frame(100, "ff ff ff", "id type x y z vx", "2 1 4 5 6.5 0\n1 1 1 2 3 0\n"),
                               frames(100));
  EXPECT_EQ(plain.format, "LAMMPS dump");
  ASSERT_EQ(plain.tracks.size(), 2u);
  EXPECT_EQ(plain.tracks[1].samples[1].time, 1.0);
  EXPECT_EQ(plain.tracks[1].samples[1].position, (Vec3{4, 5, 6.5}));
  EXPECT_TRUE(plain.warnings.empty());
  const TrackSet scaled = parse(frame(0, "pp ff pp", "id xs ys zs", "1 0.95 0.5 0.5\n2 0 0 0\n") +
                                    frame(1, "pp ff pp", "id xs ys zs", "1 0.05 0.5 0.5\n2 0 0 0.9\n"),
                                frames(1));
  EXPECT_LT(norm(scaled.tracks[0].samples[1].position - Vec3{10.5, 5, 0}), 1e-9);
  EXPECT_LT(norm(scaled.tracks[1].samples[1].position - Vec3{0, 0, -6}), 1e-9);
  EXPECT_EQ(scaled.warnings.size(), 1u);
  EXPECT_EQ(error_in(frame(0, "ff ff ff", "type x y z", "1 1 2 3\n")),
            "f:9: expected columns id and x y z, xu yu zu or xs ys zs of atoms");
  EXPECT_EQ(error_in(frame(0, "ff ff ff", "id x y z", "1 1 2\n")),
            "f:10: expected a whole line of an atom, but got '1 1 2'");
  // An unfinished frame counts as far as it goes.
  EXPECT_EQ(parse(frame(0, "ff ff ff", "id x y z", "1 1 2 3\n2 1 2 3\n") +
                      frame(1, "ff ff ff", "id x y z", "1 1 2 3\n") + "",
                  frames(1))
                .tracks.size(),
            1u);
}

}  // namespace
}  // namespace kinesphere::program::recordings_test
