// Damaged files: a result or an error that names the file, never anything else.
#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "program/formats/any_table.hpp"
#include "program/support.hpp"

namespace kinesphere::program::damaged_tables_test {
namespace {

constexpr std::string_view healthy[] = {
    "id,time,x,y\na,0,0,0\na,1,1,0\nb,0,5,5\nb,1,4,5\n",
    "\xEF\xBB\xBF\"MMSI\";\"Base Date "
    "Time\";\"LAT\";\"LON\"\r\n\"1\";\"2024-01-31T12:30:00Z\";54.1;\"11.2\"\r\n"
    "1;2024-01-31 "
    "12:30:10+00:00;54.2;11.3\r\n2;20240131T123000Z;54.2;11.3\r\n2;20240131T123010Z;54.2;11.3\r\n",
    "# framerate: 25 fps\n# id frame x/m y/m z/m\n1\t0\t2\t3\t1.76\n1\t5\t4\t6\t1.76\n",
    "0 7 1 0 2 0 0 0\n10 7 1 0 2 0 0 0\n20 7 1 0 2 0 0 0\n",
    "LABEL,TRACK_ID,POSITION_X,POSITION_Y,POSITION_T\nLabel,Track ID,X,Y,T\n,,(micron),(micron),(sec)\n"
    "a,1,0,0,0\nb,1,1,0,1\nc,None,2,0,2\n",
    "seconds;x1;y1;x2;y2\n0;0,5;0;5;1\n1;1,5;0;4;1\n",
    "<?xml version=\"1.0\"?><gpx><trk><name>a</name><trkseg>\n<trkpt lat=\"47.0\" "
    "lon=\"8.0\"><time>2024-01-01T00:00:00Z"
    "</time></trkpt>\n<trkpt lat=\"47.0\" "
    "lon=\"8.1\"><time>2024-01-01T00:00:10Z</time></trkpt></trkseg></trk></gpx>",
    "1\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:id:I:1:pos:R:3 Time=0\nS 7 1 2 3\n1\nTime=1\nS "
    "7 8 2 3\n",
    "ITEM: TIME\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS id xs ys "
    "zs\n"
    "1 0.9 0 0\nITEM: TIME\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id xs ys zs\n1 0.1 0 0\n",
    "$GPRMC,235959,A,4700.1,N,00800.0,E,,,311224,,\n$GPGGA,235959,4700.1,N,00800.0,E,1,8,1,5,M,,,,\n"
    "$GPRMC,000000,A,4700.1,N,00800.1,E,,,010125,,\n$GPGGA,000000,4700.1,N,00800.1,E,1,8,1,5,M,,,,\n",
    "# framerate: 25 fps\nframe,lat1,lon1,lat2,lon2\n0,47,8,47,9\n1,47,8.1,47,9\n",
    "<fcd-export>\n<timestep time=\"0\"><vehicle id=\"a\" x=\"1\" y=\"2\"/></timestep>\n"
    "<timestep time=\"1\"><vehicle id=\"a\" x=\"2\" y=\"2\"/></timestep></fcd-export>",
    R"({"type": "FeatureCollection", "features": [
{"geometry": {"type": "Point", "coordinates": [8, 47]}, "properties": {"id": 1, "time": "2024-01-01T00:00:00Z"}},
{"geometry": {"type": "Point", "coordinates": [8.1, 47]}, "properties": {"id": 1, "time": "2024-01-01T00:00:10Z"}},
{"geometry": {"type": "LineString", "coordinates": [[8, 47], [8, 47.1]]}, "properties": {"name": "b", "coordTimes":
["2024-01-01T00:00:00Z", "2024-01-01T00:00:10Z"]}}]})",
    "CCSDS_OEM_VERS = 2.0\nMETA_START\nOBJECT_NAME = A \"1\"\nREF_FRAME = GCRF\nTIME_SYSTEM = "
    "UTC\nMETA_STOP\n"
    "2024-060T00:00:00 7000 0 0 1 0 0\n2024-060T00:01:00 7000 9 0 1 0 0\nCOVARIANCE_START\n1e-4\n",
    "[{\"id\": \"a\", \"time\": 0, \"pose\": {\"position\": {\"x\": 1, \"y\": 2}}},\n"
    "{\"time\": 1, \"id\": \"a\", \"pose\": {\"position\": {\"x\": 3, \"y\": 2}}}]",
    "{\"id\":1,\"time\":0,\"x\":1,\"y\":2}\n{\"id\":1,\"time\":1,\"x\":1,\"y\":[3]}\n{\"id\":1,\"time\":2,"
    "\"x\":1,\"y\":4}\n",
    R"({"header":{"gtfsRealtimeVersion":"2.0","timestamp":"5"},"entity":[{"id":"a","vehicle":{"position":{"latitude":47,)"
    R"("longitude":8},"timestamp":"1"}},{"id":"a","vehicle":{"position":{"latitude":47,"longitude":8.1},"timestamp":"2"}}]})",
    R"({"cat":62,"CAT062":{"I010":{"SAC":1,"SIC":2},"I070":{"ToT":1.5},"I105":{"Lat":47,"Lon":8},"I040":{"TrkN":7}}})"
    "\n"
    R"({"cat":62,"CAT062":{"I010":{"SAC":1,"SIC":2},"I070":{"ToT":2.5},"I105":{"Lat":47,"Lon":8.1},"I040":{"TrkN":7}}})",
    R"({"icao":"4ca1fa","timestamp":1600000000.5,"trace":[[10,47.1,8.1,1000,100,90,0,64,{"flight":"A"},"adsb_icao",1],)"
    R"([20,47.2,8.2,2000,100,90,1,64,null]]})"};

/// Bytes with a meaning in tables are drawn often.
std::string damaged(std::string_view text, Random& random) {
  constexpr std::string_view bytes = "\"\"\"\r\n,;\t #-+.:0123456789eETZnaN/()[]{}<>=_\0\xFF";
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  };
  std::string result(text);
  for (std::size_t k = 1 + below(4); k > 0 && !result.empty(); --k) {
    const std::size_t at = below(result.size());
    switch (below(4)) {
      case 0:
        result[at] = bytes[below(bytes.size())];
        break;
      case 1:
        result.insert(at, 1, bytes[below(bytes.size())]);
        break;
      case 2:
        result.erase(at, 1 + below(5));
        break;
      default:
        result.insert(at, result.substr(below(result.size()), below(30)));
    }
  }
  return result;
}

TEST(DamagedTables, AreReadOrRefusedByName) {
  constexpr std::uint64_t seed = 2005;
  Random random(seed);
  int read = 0, refused = 0;
  for (unsigned trial = 0; trial < 50000; ++trial) {
    const std::string text = damaged(healthy[trial % std::size(healthy)], random);
    const AnyTable table = read_any_table(text, trial);
    ASSERT_FALSE(table.complaint) << *table.complaint << "\nseed " << seed << ", trial " << trial;
    ++(table.was_read ? read : refused);
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(DamagedTables, OfTheCorpusBreakNothing) {
  std::size_t count = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(KINESPHERE_CORPUS) / "tables")) {
    const std::string bytes = read_text(file.path());
    ASSERT_FALSE(bytes.empty()) << file.path();
    const AnyTable table = read_any_table(bytes.substr(1), static_cast<unsigned char>(bytes[0]));
    EXPECT_FALSE(table.complaint) << *table.complaint << "\n" << file.path();
    ++count;
  }
  EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace kinesphere::program::damaged_tables_test
