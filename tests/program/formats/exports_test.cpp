// Exports that one line of Python converts are named, and so is where that line stands.
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::exports_test {
namespace {

std::string error_in(const std::string& text) {
  return error_of([&] { parse_tracks({{"folder/f.csv", text}}, {}); });
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
                  "a table of DeepLabCut")}) {
    const std::string error = error_in(text);
    EXPECT_TRUE(error.starts_with("folder/f.csv: ")) << error;
    EXPECT_NE(error.find(is), std::string::npos) << error;
    EXPECT_NE(error.find("docs/tables.md"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace kinesphere::program::exports_test
