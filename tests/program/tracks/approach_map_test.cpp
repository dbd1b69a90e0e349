// Approaches as GPX and KML.
#include <array>

#include "program/support.hpp"

#ifdef KINESPHERE_WITH_EXPAT
#include <expat.h>
#endif

namespace kinesphere::program::approach_map_test {
namespace {

class ApproachMapOf : public ProgramTest {
 protected:
  /// Two ships with ids that XML must escape pass each other; `time` begins each time of the table.
  std::string map_in(const std::string& name, bool dates, bool heights) const {
    std::string text = heights ? "id,time,lon,lat,alt\n" : "id,time,lon,lat\n";
    const std::array<const char*, 2> times =
        dates ? std::array{"2024-05-01T08:00:00Z", "2024-05-01T08:10:00Z"} : std::array{"0", "600"};
    for (const std::size_t k : {0u, 1u}) {
      text += std::string("<A&B>,") + times[k] + (k == 0 ? ",8.00,54.0" : ",8.02,54.0") +
              (heights ? ",100" : "") + "\n";
      text += std::string("c,") + times[k] + (k == 0 ? ",8.02,54.0" : ",8.00,54.0") +
              (heights ? ",150" : "") + "\n";
    }
    const ProgramRun result =
        run("tracks " + write("s.csv", text) + " --distance 100 --quiet --contacts " + path(name));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_text(path(name));
  }
};

/// Expects text that an XML parser takes.
void expect_well_formed([[maybe_unused]] const std::string& text) {
#ifdef KINESPHERE_WITH_EXPAT
  XML_Parser parser = XML_ParserCreate(nullptr);
  EXPECT_EQ(XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1), XML_STATUS_OK)
      << XML_ErrorString(XML_GetErrorCode(parser)) << "\n"
      << text;
  XML_ParserFree(parser);
#endif
}

void expect_parts(const std::string& text, std::initializer_list<std::string_view> parts) {
  std::size_t at = 0;
  for (const std::string_view part : parts) {
    const std::size_t found = text.find(part, at);
    EXPECT_NE(found, std::string::npos) << part << "\nin " << text;
    if (found != std::string::npos) at = found;
  }
}

TEST_F(ApproachMapOf, GpxHasTwoWaypoints) {
  const std::string dated = map_in("a.gpx", true, true);
  expect_well_formed(dated);
  expect_parts(dated, {"<wpt lat=\"54.0000", "lon=\"8.01", "<ele>99.9", "<time>2024-05-01T08:05:00",
                       "Z</time>", "<name>&lt;A&amp;B&gt; by c</name>",
                       "<desc>first: &lt;A&amp;B&gt;; second: c; begin: 2024-05-01T", "<wpt ", "<ele>149.9",
                       "<name>c by &lt;A&amp;B&gt;</name>", "</gpx>\n"});
  // Numbers are no dates.
  const std::string numbers = map_in("b.gpx", false, false);
  expect_well_formed(numbers);
  EXPECT_EQ(numbers.find("<time>"), std::string::npos) << numbers;
  EXPECT_EQ(numbers.find("<ele>"), std::string::npos) << numbers;
}

TEST_F(ApproachMapOf, KmlHasAPlacemark) {
  const std::string dated = map_in("a.kml", true, true);
  expect_well_formed(dated);
  expect_parts(dated,
               {"<Placemark><name>&lt;A&amp;B&gt; by c</name>", "<TimeSpan><begin>2024-05-01T08:0", "<end>",
                "<Data name=\"distance_m\"><value>49.99", "<altitudeMode>absolute</altitudeMode>", ",54.0000",
                ",99.9", "<LineString>", "</kml>\n"});
  const std::string numbers = map_in("b.kml", false, false);
  expect_well_formed(numbers);
  EXPECT_EQ(numbers.find("TimeSpan"), std::string::npos) << numbers;
  EXPECT_EQ(numbers.find("altitudeMode"), std::string::npos) << numbers;
}

TEST_F(ApproachMapOf, NeedsPlacesOnTheEarth) {
  const std::string plain = write("p.csv", "id,t,x,y\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n");
  for (const char* name : {"a.gpx", "a.kml"})
    expect_wrong_input("tracks " + plain + " --distance 2 --contacts " + path(name),
                       {name, "--positions lonlat"});
  expect_wrong_input("tracks " + plain + " --distance 2 --contacts " + path("a.shp"),
                     {"a.shp", ".gpx or .kml"});
}

}  // namespace
}  // namespace kinesphere::program::approach_map_test
