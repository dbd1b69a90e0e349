// Files that one line converts, or that only look like others that are read, are named, and so is that line.
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::exports_test {
namespace {

TrackSet parse_text(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"folder/f.csv", text}}, options);
}
std::string error_in(const std::string& text) {
  return error_of([&] { parse_text(text); });
}

TEST(Exports, ThatPandasConvertsAreNamed) {
  const std::string ethovision =
      "\"Number of header lines:\";\"3\"\n\"Trial time\";\"X center\";\"Y "
      "center\"\n\"s\";\"cm\";\"cm\"\n0;1;2\n";
  for (const auto& [text, is] :
       {std::pair(ethovision, "an export of EthoVision"),
        std::pair(ethovision.substr(1), "an export of EthoVision"),
        std::pair(std::string("Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction\n"
                              "1700000000,2023-11-14T22:13:20Z,DLH1,\"47.0,8.5\",1000,240,90\n"),
                  "a flight of Flightradar24"),
        std::pair(std::string("<?xml version=\"1.0\"?>\n<Tracks nTracks=\"1\">\n<particle nSpots=\"1\">\n"
                              "<detection t=\"0\" x=\"1\" y=\"2\"/>\n</particle>\n</Tracks>\n"),
                  "tracks of TrackMate in XML"),
        std::pair(std::string("# This file was created\n@    xaxis  label \"Time (ps)\"\n"
                              "@ s0 legend \"atom 1 X\"\n@ s1 legend \"atom 1 Y\"\n0.0 1.5 2.5\n"),
                  "coordinates of GROMACS"),
        std::pair(std::string("water t= 0.0\n    1\n    1SOL     OW    1   0.100   0.200   0.300\n 9 9 9\n"),
                  "frames of atoms (GRO or PDB)"),
        std::pair(std::string("ATOM      1  OW  SOL A   1       1.000   2.000   3.000\nEND\n"),
                  "frames of atoms (GRO or PDB)"),
        std::pair(std::string("scorer,net,net,net\nbodyparts,a,a,a\ncoords,x,y,likelihood\n0,1,2,0.9\n"),
                  "a table of DeepLabCut"),
        std::pair(std::string("scorer,net,net\nindividuals,a,a\nbodyparts,b,b\ncoords,x,y\n0,1,2\n"),
                  "a table of DeepLabCut"),
        std::pair(std::string("Trajectories\r\n100\r\n,,a,,,b,,\r\n"),
                  "motion capture with columns of each marker"),
        std::pair(std::string("PathFileType\t4\t(X/Y/Z)\tx.trc\n"), "motion capture with columns"),
        std::pair(std::string("NO_OF_FRAMES\t40\nNO_OF_MARKERS\t2\n"), "motion capture with columns"),
        std::pair(std::string("Format Version,1.23,Take Name,x\n"), "motion capture with columns"),
        std::pair(std::string("$VISION\n* File: a.inpx\n"), "a record of Vissim"),
        std::pair(std::string("track_id; type; traveled_d; avg_speed; lat; lon\n1; Car; 1; 1; 37.9; 23.7\n"),
                  "a table of pNEUMA"),
        std::pair(std::string("Geolife trajectory\r\nWGS 84\r\n"), "a walk of GeoLife")}) {
    const std::string error = error_in(text);
    EXPECT_TRUE(error.starts_with("folder/f.csv: ")) << error;
    EXPECT_NE(error.find(is), std::string::npos) << error;
    EXPECT_NE(error.find("docs/tables.md"), std::string::npos) << error;
  }
}

TEST(Exports, ThatGpsbabelConvertsAreNamed) {
  for (const auto& [text, command] :
       {std::pair("<?xml version=\"1.0\"?>\n<kml><Placemark/></kml>\n", "gpsbabel -i kml -f FILE"),
        std::pair("AXXX\nHFDTE311224\nB2359594700000N00800000EA0090000950\n", "gpsbabel -i igc -f FILE"),
        std::pair("HFDTE311224\n", "gpsbabel -i igc -f FILE"),
        std::pair("OziExplorer Track Point File Version 2.1\nWGS 84\n", "gpsbabel -i ozi -f FILE")})
    EXPECT_NE(error_in(text).find(command), std::string::npos) << text;
}

TEST(Exports, WhatLooksLikeARecordingIsNamed) {
  for (const char* strava :
       {R"({"time":{"data":[0,1],"series_type":"distance"},"latlng":{"data":[[46.1,7.2],[46.2,7.3]]}})",
        R"({"latlng": [[46.1, 7.2]], "time": [0]})",
        R"([{"type":"latlng","data":[[46.1,7.2]],"series_type":"time"},{"type":"time","data":[0]}])"})
    EXPECT_NE(error_in(strava).find("streams of Strava, whose times count from the start of their activity"),
              std::string::npos)
        << strava;
  for (const char* lists : {R"({"id":["a","b"],"time":[0,0],"x":[1,2],"y":[1,2]})",
                            R"({"id":{"0":"a","1":"b"},"time":{"0":0,"1":0}})"})
    EXPECT_NE(error_in(lists).find("JSON with a list for each name"), std::string::npos) << lists;
  for (const char* elements :
       {"OBJECT_NAME,OBJECT_ID,EPOCH,MEAN_MOTION,ECCENTRICITY\nISS,1998-067A,2024-01-01T00:00:00,15.5,0."
        "0001\n",
        R"([{"OBJECT_NAME":"ISS","EPOCH":"2024-01-01T00:00:00","MEAN_MOTION":15.5,"ECCENTRICITY":0.0001}])",
        "CCSDS_OMM_VERS = 2.0\nOBJECT_NAME = ISS\nEPOCH = 2024-01-01T00:00:00\nMEAN_MOTION = "
        "15.5\nECCENTRICITY = 0.0001\n"})
    EXPECT_NE(error_in(elements).find("orbital elements (OMM), not positions"), std::string::npos)
        << elements;
  // Records may begin with a time or a list.
  EXPECT_EQ(
      parse_text("{\"time\":0,\"id\":\"a\",\"x\":1,\"y\":2}\n{\"time\":1,\"id\":\"a\",\"x\":2,\"y\":2}\n")
          .format,
      "JSON records");
  EXPECT_EQ(
      parse_text(
          "{\"position\":[1,2],\"id\":\"a\",\"time\":0}\n{\"position\":[1,2],\"id\":\"a\",\"time\":1}\n",
          [] {
            TrackOptions options;
            options.hints.columns = "id=id,time=time,x=position.0,y=position.1";
            return options;
          }())
          .tracks.size(),
      1u);
}

}  // namespace
}  // namespace kinesphere::program::exports_test
