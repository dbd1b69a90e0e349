// Tables as their owners have them: what a file means is known, asked for or refused.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>

#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::tables_of_the_field_test {
namespace {

class TablesOfTheField : public ProgramTest {
 protected:
  /// Returns the row "approaches" of the summary, without blanks: its number, or the error.
  std::string approaches(const std::string& text, const std::string& arguments) {
    return approaches_in({write("t.csv", text)}, arguments);
  }
  std::string approaches_in(const std::vector<std::string>& files, const std::string& arguments) {
    std::string names;
    for (const std::string& file : files) names += file + " ";
    const ProgramRun result = run("tracks " + names + arguments);
    out_ = result.out;
    if (result.exit_code != 0) return result.err;
    const std::size_t row = result.out.find("\napproaches");
    const std::size_t begin = result.out.find_first_of("0123456789", row);
    return result.out.substr(begin, result.out.find(' ', begin) - begin);
  }
  std::string out_;
};

TEST_F(TablesOfTheField, UnitsInNamesCountInEveryColumn) {
  // 1000 ft apart in height, 304.8 m.
  const std::string flight =
      "id,time,lon,lat,{}\nu,0,8,47,33000\nu,10,8,47,33000\nu,20,8,47,33000\n"
      "v,0,8,47,34000\nv,10,8,47,34000\nv,20,8,47,34000\n";
  for (const char* name :
       {"altitude_ft", "alt [feet]", "\"alt, ft\"", "altitudeFt", "z (ft)", "alt/ft", "Altitude..ft.",
        "alt-ft", "zpos{ft}", "Alt (ft MSL)", "alt_ft_amsl", "altitude [ft] above sea level"}) {
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(flight), name), "--distance 305"), "1") << name;
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(flight), name), "--distance 304"), "0") << name;
  }
  const std::string space = "id,time,{}\nu,0,0,0,0\nu,1,0,0,0\nv,0,0,0,10\nv,1,0,0,10\n";
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z_ft"), "--distance 3.1"), "1");
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z_ft"), "--distance 3"), "0");
  const std::string levels = "id,time,lon,lat,{}\nu,0,8,47,330\nu,10,8,47,330\nv,0,8,47,340\nv,10,8,47,340\n";
  for (const char* name : {"FL", "Flight Level", "altitude_hft"}) {
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(levels), name), "--distance 305"), "1") << name;
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(levels), name), "--distance 304"), "0") << name;
  }
  // In metres nothing flies at 33000.
  const std::string unit = approaches(fmt::format(fmt::runtime(flight), "alt"), "--distance 305");
  EXPECT_NE(unit.find("z=alt:ft"), std::string::npos) << unit;
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(flight), "alt"), "--distance 305 --unit ft"), "1");
  EXPECT_EQ(approaches("id,t,x_cm,y_m\nu,0,0,0\nu,1,0,0\nv,0,100,0\nv,1,100,0\n", "--distance 1.1"), "1");
  // What comes out has the file's own units.
  approaches("id,t,x_cm,y_m\nu,0,50,7\nu,1,50,7\nv,0,100,7\nv,1,100,7\n",
             "--distance 1 --contacts " + path("c.csv"));
  EXPECT_NE(read_text(path("c.csv")).find(",50,7,,100,7,"), std::string::npos) << read_text(path("c.csv"));
  const std::string unsaid = approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z"), "--distance 5");
  EXPECT_NE(unsaid.find("column 'z' does not say its unit, but column 'x_m' does"), std::string::npos)
      << unsaid;
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z"), "--distance 3.1 --unit ft"),
            approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z"), "--distance 3.1 --unit ft"));
  EXPECT_NE(
      approaches(fmt::format(fmt::runtime(space), "x_m,y_m,z_m"), "--distance 5 --unit ft").find("--unit"),
      std::string::npos);
}

TEST_F(TablesOfTheField, DistancesMayHaveUnits) {
  const std::string cells = "id,t,x_um,y_um\nu,0,0,0\nu,1,0,0\nv,0,10,0\nv,1,10,0\n";
  EXPECT_EQ(approaches(cells, "--distance 11um"), "1");
  EXPECT_EQ(approaches(cells, "--distance 9um"), "0");
  EXPECT_EQ(approaches(cells, "--distance 9e-6"), "0");
  const std::string plain = "id,t,x,y\nu,0,0,0\nu,1,0,0\nv,0,10,0\nv,1,10,0\n";
  EXPECT_NE(approaches(plain, "--distance 11um").find("the unit of lengths is not known"), std::string::npos);
  EXPECT_EQ(approaches(plain, "--distance 0.011mm --unit um"), "1");
  EXPECT_NE(approaches(plain, "--distance 3parsec")
                .find("perhaps a unit (m, km, cm, mm, um, ft, NM, mi, yd, inch, FL, kft)"),
            std::string::npos);
}

TEST_F(TablesOfTheField, DegreesAreNoLengths) {
  // Two animals half a degree apart.
  const std::string animals =
      "timestamp,location-long,location-lat,who\n2021-02-11 17:30:00.000,8.00,47.00,u\n"
      "2021-02-11 17:40:00.000,8.01,47.00,u\n2021-02-11 17:30:00.000,8.00,47.50,v\n2021-02-11 "
      "17:40:00.000,8.01,47.50,v\n";
  EXPECT_EQ(
      approaches(animals, "--distance 100 --columns id=who,time=timestamp,x=location-long,y=location-lat"),
      "0");
  const std::string swapped =
      approaches(animals, "--distance 100 --columns id=who,time=timestamp,x=location-lat,y=location-long");
  EXPECT_NE(swapped.find("lon=location-long,lat=location-lat"), std::string::npos) << swapped;
  // Names that have a word for them, with numbers that may be anything.
  const std::string birds = "id,time,{0},{1}\nu,0,8,47\nu,600,18,47\nv,0,8,47.5\nv,600,18,47.5\n";
  for (const auto& [x, y] :
       std::initializer_list<std::pair<const char*, const char*>>{{"start_long", "start_lat"},
                                                                  {"X_WGS84", "Y_WGS84"},
                                                                  {"gpsLon", "gpsLat"},
                                                                  {"Longitud", "Latitud"}})
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(birds), x, y),
                         fmt::format("--distance 100 --columns id=id,time=time,x={},y={}", x, y)),
              "0")
        << x;
  // Names that say nothing: the numbers do.
  const std::string plain =
      "id;t;X;Y\nu;0;8.391305;47.898573\nu;2;8.391317;47.898617\nv;0;8.390928;47.898613\n"
      "v;2;8.390833;47.898635\n";
  const std::string asked = approaches(plain, "--distance 50");
  EXPECT_NE(asked.find("may be degrees: say --positions lonlat"), std::string::npos) << asked;
  EXPECT_EQ(approaches(plain, "--distance 50 --positions lonlat"), "1");
  EXPECT_EQ(approaches(plain, "--distance 20 --positions lonlat"), "0");
  EXPECT_EQ(approaches(plain, "--distance 50 --positions plane"), "1");
  EXPECT_EQ(approaches("id,t,x_deg,y_deg\nu,0,8,47\nu,1,8,47\nv,0,8,47.5\nv,1,8,47.5\n", "--distance 100"),
            "0");
  EXPECT_EQ(
      approaches("id,t,lon_rad,lat_rad\nu,0,0,1\nu,1,0,1\nv,0,0,1.0001\nv,1,0,1.0001\n", "--distance 100"),
      "0");
  // Rooms, roads and whole numbers are not asked about.
  EXPECT_EQ(approaches("id,t,x,y\nu,0,3.5,2.5\nu,1,4.5,2.5\nv,0,3.5,2.75\nv,1,4.5,2.75\n", "--distance 1"),
            "1");
  EXPECT_EQ(approaches("id,t,x,y\nu,0,100,50\nu,1,101,50\nv,0,100,50\nv,1,101,50\n", "--distance 1"), "1");
}

TEST_F(TablesOfTheField, HeightsAreAskedAboutAndUnusedColumnsNamed) {
  const std::string flights =
      "id,time,lon,lat,geoaltitude,remark\nu,0,8,47,10000,7000\nu,1,8,47,10000,7000\nv,0,8,47,6000,7000\nv,1,"
      "8,47,6000,"
      "7000\n";
  const std::string asked = approaches(flights, "--distance 100");
  EXPECT_NE(
      asked.find("column 'geoaltitude' may be a height: say --columns id=id,time=time,lon=lon,lat=lat,z="
                 "geoaltitude to use it, or --columns id=id,time=time,lon=lon,lat=lat to leave heights out"),
      std::string::npos)
      << asked;
  EXPECT_EQ(approaches(flights, "--distance 100 --columns id=id,time=time,lon=lon,lat=lat,alt=geoaltitude"),
            "0");
  EXPECT_NE(out_.find("columns remark"), std::string::npos) << out_;
  EXPECT_EQ(approaches(flights, "--distance 100 --columns id=id,time=time,lon=lon,lat=lat"), "1");
  EXPECT_NE(out_.find("columns geoaltitude, remark"), std::string::npos) << out_;
}

TEST_F(TablesOfTheField, HeightsUnderOtherNamesAreAskedAbout) {
  const auto asked = [&](const std::string& header) {
    std::string text = "id,time,x,y," + header + "\n";
    const auto extra = std::count(header.begin(), header.end(), ',');
    for (const char* row : {"u,0,0,0", "u,1,0,0", "v,0,0,0", "v,1,0,0"}) {
      text += row;
      for (auto k = extra; k >= 0; --k) text += ",10";
      text += "\n";
    }
    const std::string answer = approaches(text, "--distance 1");
    EXPECT_TRUE(answer == "1" || answer.find(" may be ") != std::string::npos) << answer;
    return answer != "1";
  };
  for (const char* name : {"altGeom", "baroAlt", "alt_baro", "GPSAlt", "h", "H\xC3\xB6he [m]",
                           "H\xF6"
                           "he",
                           "floor", "level", "up", "hae", "modeC", "galt", "Altura"})
    EXPECT_TRUE(asked(name)) << name;
  for (const char* name : {"w,h", "width,height", "bb_w,bb_h", "battery_level", "vertical_rate", "heading"})
    EXPECT_FALSE(asked(name)) << name;
  const std::string movebank =
      "timestamp,location-long,location-lat,height-above-ellipsoid,individual-local-identifier\n"
      "2021-02-11 17:30:00,8,47,100,u\n2021-02-11 17:31:00,8,47,100,u\n"
      "2021-02-11 17:30:00,8,47,900,v\n2021-02-11 17:31:00,8,47,900,v\n";
  EXPECT_EQ(approaches(movebank, "--distance 100"), "0");
  EXPECT_EQ(approaches("time,x1,y1,z1,x2,y2,z2\n0,0,0,0,0,0,9\n1,0,0,0,0,0,9\n", "--distance 1"), "0");
  EXPECT_NE(approaches("time,x1,y1,z1,x2,y2\n0,0,0,0,0,0\n", "--distance 1").find("a height for each pair"),
            std::string::npos);
}

TEST_F(TablesOfTheField, CornersOfBoxesAreNoBodies) {
  const std::string boxes = "label,time,x1,y1,x2,y2\na,0,0,0,0,1\na,1,0,0,0,1\n";
  EXPECT_NE(approaches(boxes, "--distance 2").find("the corners of boxes: say --format table"),
            std::string::npos);
  EXPECT_EQ(approaches(boxes, "--distance 2 --format table"), "1");
  EXPECT_NE(approaches("time,x0,y0,x1,y1\n0,0,0,0,1\n", "--distance 2").find("the corners of boxes"),
            std::string::npos);
  EXPECT_EQ(approaches("seconds,x1,y1,p1,x2,y2,p2\n0,0,0,1,0,1,1\n1,0,0,1,0,1,1\n", "--distance 2"), "1");
}

TEST_F(TablesOfTheField, ColumnsOfEachBodyByName) {
  const std::string rows = "0,0,0,9,9\n1,1,0,1,0.5\n2,2,0,9,9\n";
  for (const char* header :
       {"t,x1,y1,x2,y2\n", "t,car1_x,car1_y,car2_x,car2_y\n", "t,X_fish 1,Y_fish 1,X_fish 2,Y_fish 2\n"})
    EXPECT_EQ(approaches(header + rows, "--distance 1"), "1") << header;
  approaches("t,car1.x,car1.y,car2.x,car2.y\n" + rows, "--distance 1");
  EXPECT_NE(out_.find("car1 car2"), std::string::npos) << out_;
  const std::string parts = "t,head.x,head.y,tail.x,tail.y\n" + rows;
  EXPECT_NE(approaches(parts, "--distance 1")
                .find("head.x, head.y, tail.x and tail.y may be two bodies or parts of one"),
            std::string::npos);
  EXPECT_EQ(approaches(parts, "--distance 1 --format table"), "1");
}

TEST_F(TablesOfTheField, ColumnsOfEachBodyHaveUnitsAndATimeThatIsSaid) {
  // Half a metre apart at one time, and far from each other else.
  const std::string rows = "0,0,0,900,900\n1,100,0,100,50\n2,200,0,900,900\n";
  for (const char* header :
       {"t,x1_cm,y1_cm,x2_cm,y2_cm\n", "t,Fish 1 X (cm),Fish 1 Y (cm),Fish 2 X (cm),Fish 2 Y (cm)\n",
        "t,x1,y1,x2,y2\ns,cm,cm,cm,cm\n", "t,X(1) [cm],Y(1) [cm],X(2) [cm],Y(2) [cm]\n"}) {
    EXPECT_EQ(approaches(header + rows, "--distance 0.6"), "1") << header;
    EXPECT_EQ(approaches(header + rows, "--distance 0.2"), "0") << header;
  }
  EXPECT_EQ(approaches("t,PosX1,PosY1,PosX2,PosY2\n" + rows, "--distance 60"), "1");
  EXPECT_NE(approaches("t,x1_cm,y1_cm,x2_m,y2_m\n" + rows, "--distance 1").find("expected one unit of x"),
            std::string::npos);
  const std::string clock = "lap,car1_x,car1_y,car2_x,car2_y\n" + rows;
  EXPECT_NE(approaches(clock, "--distance 60").find(": say --columns time=..."), std::string::npos);
  EXPECT_EQ(approaches(clock, "--distance 60 --columns time=lap:s"), "1");
  EXPECT_EQ(approaches(clock, "--distance 60 --columns frame=lap --frame-rate 5"), "1");
  // Messages that have a position twice are of one body.
  const std::string twice =
      approaches("at.MMSI,at.lat,at.lon,report.lat,report.lon\n1,2,3,2,3\n", "--distance 1");
  EXPECT_NE(twice.find("say --columns time=...,id=at.MMSI,x=...,y=..."), std::string::npos) << twice;
}

TEST_F(TablesOfTheField, AdviceLeadsOn) {
  const auto advice = [&](const std::string& text, std::string_view expected) {
    const std::string answer = approaches(text, "--distance 1");
    EXPECT_NE(answer.find(expected), std::string::npos) << answer;
  };
  // Numbers that can be given as they stand would be wrong for most files.
  advice("0 7 1.5 2.5\n",
         "say --columns id=...,time=...,x=...,y=... with the numbers of its columns, whose first "
         "row is '0 7 1.5 2.5'");
  advice(
      "time,timestamp,x,y\n0,0,1,1\n",
      "say which, as in --columns id=...,time=timestamp,x=x,y=y, with id=@file where each file is one body");
  advice("TrackID,ID,t,x,y\n1,1,0,1,1\n", "as in --columns id=TrackID,time=t,x=x,y=y");
  advice("id t x y\nu 0 0,5 1\n", "but got '0,5': decimal commas are read where ; or tabs separate");
  advice("id,t,x,y\nu,0,\"1.234,5\",1\n", "leave out what separates thousands");
  advice("id,t,x,y\nu,0,12 m,1\n", "leave units out, and say them");
  advice("id,t,x,y,tz\nu,2024-01-01 10:00,0,0,UTC\nv,2024-01-01 10:01,0,0,CET\n",
         "coordinates or times that cannot be compared");
  advice("id,t,x,y\nu,2024.250001,0,0\nu,2024.250002,0,0\n", "may be years");
  advice("id,t,x,y\n,s,furlong,furlong\nu,0,0,0\n", "is in 'furlong', which is no known unit");
}

TEST_F(TablesOfTheField, NamesOfOtherHabits) {
  const auto with = [&](std::string_view header, std::string_view options) {
    std::string text(header);
    for (int body = 1; body <= 2; ++body)
      for (int step = 0; step < 3; ++step) text += fmt::format("{},{},0,{}\n", body, step, 0.5 * body);
    return approaches(text, fmt::format("--distance 1 {}", options));
  };
  for (const char* header : {"identity,t,x,y\n", "PersID,Time (UTC),x,y\n", "NORAD_CAT_ID,epoch_utc,x,y\n",
                             "car_id,Date & Time [GMT],x,y\n", "track,t,x,y\n", "id,t,Points_0,Points:1\n"})
    EXPECT_EQ(with(header, "--time-unit s"), "1") << header;
  EXPECT_EQ(with("id,TimeStep,x,y\n", "--frame-rate 1"), "1");
  // Beside a speed it is a course.
  EXPECT_NE(approaches("track,speed,t,x,y\n1,1,0,0,0\n", "--distance 1").find("id=..."), std::string::npos);
  // The h of km_h is no height.
  EXPECT_EQ(
      approaches("id,t,lon,lat,speed_km_h\nu,0,8,47,1\nu,1,8,47,1\nv,0,8,47,1\nv,1,8,47,1\n", "--distance 1"),
      "1");
}

TEST_F(TablesOfTheField, LinesBetweenHeadersAndRows) {
  for (const char* text :
       {" id | t | x | y\n----+---+---+---\n u | 0 | 0 | 0\n u | 1 | 0 | 0\n v | 0 | 0 | 0.5\n v | 1 | 0 | "
        "0.5\n",
        "| id | t | x | y |\n|:---|---|---|--:|\n| u | 0 | 0 | 0 |\n| u | 1 | 0 | 0 |\n| v | 0 | 0 | 0.5 "
        "|\n| v | 1 | 0 | 0.5 |\n",
        "\xEF\xBB\xBFid,t,x,y\nu,0,0,0\nu,1,0,0\n\xEF\xBB\xBFid,t,x,y\nv,0,0,0.5\nv,1,0,0.5\n"})
    EXPECT_EQ(approaches(text, "--distance 1"), "1") << text;
}

TEST_F(TablesOfTheField, TenMillionthsOfDegrees) {
  const std::string text =
      "id,time,lat,lon\nu,0,470000000,80000000\nu,1,470000000,80000000\nv,0,470000040,80000000\nv,1,"
      "470000040,80000000\n";
  EXPECT_NE(approaches(text, "--distance 1").find("say --columns ...,lon=...:degE7,lat=...:degE7"),
            std::string::npos);
  const std::string columns = " --columns id=id,time=time,lon=lon:degE7,lat=lat:degE7";
  EXPECT_EQ(approaches(text, "--distance 0.45" + columns), "1");
  EXPECT_EQ(approaches(text, "--distance 0.44" + columns), "0");
  // Heights of such messages are mostly millimetres: 0.2 m are no 200 m.
  const std::string messages =
      "id,time,lat,lon,alt\nu,0,470000000,80000000,15000\nu,1,470000000,80000000,15000\n"
      "v,0,470000000,80000000,15200\nv,1,470000000,80000000,15200\n";
  const std::string asked = approaches(messages, "--distance 1" + columns + ",z=alt");
  EXPECT_NE(
      asked.find("column 'alt' does not say its unit, which beside ten-millionths of degrees is mostly mm: "
                 "say --columns id=id,time=time,z=alt:mm,lon=lon:degE7,lat=lat:degE7, or another unit"),
      std::string::npos)
      << asked;
  EXPECT_EQ(approaches(messages, "--distance 1" + columns + ",z=alt:mm"), "1");
  EXPECT_EQ(approaches(messages, "--distance 0.19" + columns + ",z=alt:mm"), "0");
}

TEST_F(TablesOfTheField, NobodyIsNoTrack) {
  for (const char* id : {"-2", "-999", "unknown", "UNK", "noise", "?", "-", "<NA>", "4294967295"})
    EXPECT_NE(
        approaches(fmt::format("id,t,x,y\nu,0,0,0\nu,1,0,0\n{0},0,0,0\n{0},1,0,0\n", id), "--distance 1")
            .find("is that of nobody in most files"),
        std::string::npos)
        << id;
  for (const char* name : {"MMSI", "icao24"})
    EXPECT_NE(approaches(fmt::format("{},t,x,y\n0,0,0,0\n0,1,0,0\n", name), "--distance 1").find("of nobody"),
              std::string::npos);
  EXPECT_EQ(approaches("id,t,x,y\n0,0,0,0\n0,1,0,0\n1,0,0,0\n1,1,0,0\n", "--distance 1"), "1");
  EXPECT_NE(
      approaches("id,t,x,y\n,0,0,0\n", "--distance 1").find("--where 'id != \"\"' leaves such rows out"),
      std::string::npos);
}

TEST_F(TablesOfTheField, PlacesThatAreNone) {
  const std::string far = "id,t,{}\nu,0,{}\nu,1,{}\nv,0,{}\nv,1,{}\n";
  const auto text = [&](const char* names, const char* u, const char* v, const char* none) {
    return fmt::format(fmt::runtime(far), names, u, none, v, none);
  };
  const std::string unfixed = text("lon,lat", "8,47", "9,47", "0,0.000");
  EXPECT_NE(
      approaches(unfixed, "--distance 1")
          .find(":3: 0 as longitude and latitude is no position in most files: leave such rows out with "
                "--where 'lon != 0 or lat != 0', or keep them with --where 'lon != none'"),
      std::string::npos);
  EXPECT_EQ(approaches(unfixed, "--distance 1 --where 'lon != none'"), "1");
  const std::string marked = text("x,y", "1,2", "8,9", "-9999,-9999");
  EXPECT_NE(approaches(marked, "--distance 1").find("--where 'x != -9999 or y != -9999'"), std::string::npos);
  for (const char* none : {"-,-", "?,?", "#N/A,#N/A", "#VALUE!,#VALUE!", "-1.#IND,-nan(ind)", "ground,ground",
                           "<NA>,<NA>", "\\N,\\N", "nil,NaT"}) {
    const std::string gone = text("x,y", "1,2", "8,9", none);
    EXPECT_NE(approaches(gone, "--distance 1").find("(see --missing)"), std::string::npos) << none;
  }
}

TEST_F(TablesOfTheField, ScenesOfOneTableAreAskedAbout) {
  const std::string cases =
      "case_id,track_id,frame_id,timestamp_ms,agent_type,x,y\n1,7,1,100,car,0,0\n1,7,2,200,car,0,0\n"
      "2,8,1,100,car,0,0\n2,8,2,200,car,0,0\n";
  const std::string asked = approaches(cases, "--distance 1");
  EXPECT_NE(
      asked.find("the rows with case_id as '1' and '2' have the same times, so that they may be different "
                 "scenes: take one with --where 'case_id = 1', or all as one with --where 'case_id != none'"),
      std::string::npos)
      << asked;
  EXPECT_EQ(approaches(cases, "--distance 1 --where 'case_id != none'"), "1");
  EXPECT_EQ(approaches(cases, "--distance 1 --where 'case_id = 2'"), "0");
  const std::string trials = "trial,id,t,x,y\n1,u,0,0,0\n1,u,1,0,0\n2,u,2,0,0\n2,u,3,0,0\n";
  EXPECT_EQ(approaches(trials, "--distance 1"), "0");
}

TEST_F(TablesOfTheField, MarkersOfNoPlaceInOneColumn) {
  const std::string head = "id,time,x,y,z\nu,0,0,0,1\nu,1,0,0,1\n";
  for (const std::string row : {"u,2,0,0,-9999\n", "u,2,3.4e38,0,1\n", "u,2,0,-1.7976931348623157e308,1\n"})
    EXPECT_NE(approaches(head + row, "--distance 1")
                  .find("is no position in most files: leave such rows out with --where '"),
              std::string::npos)
        << row;
  EXPECT_EQ(
      approaches(head + "u,2,0,0,-9999\nv,0,0,0,1.5\nv,1,0,0,1.5\n", "--distance 1 --where 'z != -9999'"),
      "1");
}

TEST_F(TablesOfTheField, BodiesAtOnePlaceAreTold) {
  const auto is_told = [&](const std::string& rows) {
    const ProgramRun result = run("tracks " + write("t.csv", "id,time,x,y\n" + rows) + " --distance 1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err.find("two bodies are at exactly one place in 1 approaches, as u and v are at ") !=
           std::string::npos;
  };
  const auto rows = [](auto row) {
    std::string text;
    for (int step = 0; step < 12; ++step) text += row(step);
    return text;
  };
  EXPECT_TRUE(is_told(rows([](int k) { return fmt::format("u,{0},{0},0\nv,{0},{0},0\n", k); }))) << "two ids";
  EXPECT_FALSE(is_told(rows([](int k) { return fmt::format("u,{0},{0},0\nv,{0},{0},0.1\n", k); })));
  EXPECT_FALSE(is_told(rows([](int k) { return fmt::format("u,{0},{0},5\nv,{0},5,{0}\n", k); })))
      << "they meet";
  EXPECT_TRUE(is_told(rows([](int k) {
    return k == 5 ? "u,5,-1,-1\nv,5,-1,-1\n" : fmt::format("u,{0},{0},500\nv,{0},900,{0}\n", k);
  }))) << "a marker of none";
}

TEST_F(TablesOfTheField, ColumnsThatMarkVoidRows) {
  for (const auto& [name, bad, good] :
       std::initializer_list<std::tuple<const char*, const char*, const char*>>{
           {"is_lost", "True", "False"},
           {"import-marked-outlier", "true", ""},
           {"missing", "1", "0"},
           {"Valid", "N", "Y"},
           {"detected", "0", "1"},
           {"inView", "false", "true"},
           {"fix_type", "0", "3"}})
    EXPECT_NE(
        approaches(fmt::format("id,t,x,y,{0}\nu,0,0,0,{2}\nu,1,0,0,{1}\n", name, bad, good), "--distance 1")
            .find(fmt::format("--where '{} != {}'", name, bad)),
        std::string::npos)
        << name;
}

TEST_F(TablesOfTheField, RowsThatMeanNothingBecomeNoTracks) {
  const std::string noise = "0 0 0 0\n0 0 0 1\n-1 0.5 0 0\n-1 9 9 0\n-1 0.4 0 1\n-1 8 8 1\n";
  const std::string columns = "--distance 1 --columns id=1,x=2,y=3,frame=4 --frame-rate 1 ";
  const std::string asked = approaches(noise, columns);
  EXPECT_NE(
      asked.find(":3: the id -1 is that of nobody in most files: leave its rows out with --where 'id != -1'"),
      std::string::npos)
      << asked;
  EXPECT_EQ(approaches("0 0 0 0\n0 0 0 1\n" + noise, columns + "--where 'id != -1' --duplicates first"), "0");
  EXPECT_NE(out_.find("rows for which not: id != -1"), std::string::npos) << out_;
  const std::string flagged =
      "id,t,x,y,lost\nu,0,0,0,0\nu,1,0,0,0\nv,0,5,0,0\nv,1,5,0,0\nv,2,0,0,1\nu,2,0,0,0\n";
  EXPECT_NE(approaches(flagged, "--distance 1").find("--where 'lost != 1'"), std::string::npos);
  EXPECT_EQ(approaches(flagged, "--distance 1 --where 'lost != 1'"), "0");
  EXPECT_NE(
      approaches(flagged, "--distance 1 --where 'lost = 2'").find("rows for which this holds: lost = 2; but"),
      std::string::npos);
  EXPECT_EQ(approaches(flagged, "--distance 1 --interpolate linear --where 'lost != none'"), "1");
  EXPECT_NE(approaches("id,t,x,y\nu,0,0,0\nu,1,0,0\nNone,0,0,0\nNone,1,0,0\n", "--distance 1")
                .find(":4: the id None is that of nobody in most files: leave its rows out with --where 'id "
                      "!= None'"),
            std::string::npos);
  const std::string numbered = "row,id,t,x,y,person_no\n1,1,0,0,0,7\n2,2,1,0,0,7\n3,3,0,1,0,8\n4,4,1,1,0,8\n";
  const std::string which = approaches(numbered, "--distance 1");
  EXPECT_NE(which.find("each row has an id of its own in column 'id', as a row number is"), std::string::npos)
      << which;
  EXPECT_NE(
      approaches("id;trajectory_id;t;x;y\n1;1;0;0;0\n", "--distance 1").find("'id' and 'trajectory_id'"),
      std::string::npos);
}

TEST_F(TablesOfTheField, NumbersAndTimesOfOtherHabits) {
  EXPECT_EQ(approaches("Tag;Zeit;X;Y\nu;0,5;0,0;0,0\nv;0,5;0,75;0,0\nu;1,5;0,0;0,0\nv;1,5;0,75;0,0\n",
                       "--distance 0.8"),
            "1");
  const std::string infinite =
      "id,time,x,y\nu,0,72,119.3\nu,1,inf,-Inf\nu,2,72.3,119.3\nv,0,72,119.8\nv,1,72,119.8\n"
      "v,2,72.2,119.8\n";
  EXPECT_NE(approaches(infinite, "--distance 1")
                .find("t.csv:3: expected a number as x (column 3), but got 'inf' (see "
                      "--missing)"),
            std::string::npos);
  EXPECT_EQ(approaches(infinite, "--distance 1 --missing skip"), "1");
  const std::string seconds =
      "id,sec,nanosec,x,y\nu,1,0,0,0\nu,2,0,0,0\nv,1,900000000,0,0.5\nv,2,900000000,0,0.5\n";
  EXPECT_EQ(approaches(seconds, "--distance 1"), "1");
  EXPECT_EQ(approaches(seconds, "--distance 1 --columns id=id,time=sec:s,x=x,y=y"), "1");
  const std::string dates =
      "id,time,x,y\nu,03/04/2025 10:00,0,0\nu,03/04/2025 10:01,0,0\nv,04/03/2025 10:00,0,0\n"
      "v,04/03/2025 10:01,0,0\n";
  EXPECT_NE(approaches(dates, "--distance 1").find("say --dates day-first or --dates month-first"),
            std::string::npos);
  EXPECT_EQ(approaches(dates, "--distance 1 --dates day-first"), "0");
  EXPECT_NE(out_.find("from 2025-03-04T10:00:00 to 2025-04-03T10:01:00"), std::string::npos) << out_;
  approaches(dates, "--distance 1 --dates month-first");
  EXPECT_NE(out_.find("from 2025-03-04T10:00:00 to 2025-04-03T10:01:00"), std::string::npos) << out_;
  EXPECT_EQ(approaches("id,t,x,y\nu,1/2/2025 1:05:00 PM,0,0\nu,1/2/2025 1:05:01 PM,0,0\n",
                       "--distance 1 --dates "
                       "month-first"),
            "0");
  EXPECT_NE(out_.find("from 2025-01-02T13:05:00 to"), std::string::npos) << out_;
  // A comment can be the header, as in Danish AIS.
  EXPECT_EQ(approaches("# t,The Id,x,y\n0,u,0,0\n1,u,0,0\n0,v,0.5,0\n1,v,0.5,0\n",
                       "--distance 1 --columns 'id=The Id,time=t,x=x,y=y'"),
            "1");
  // Rows of labels and units below the header.
  EXPECT_EQ(
      approaches("ID,TIME,X,Y\nId,Time,X,Y\n,(sec),(micron),(micron)\nu,0,0,0\nu,1,0,0\nv,0,50,0\nv,1,50,0\n",
                 "--distance 0.00004"),
      "0");
  EXPECT_NE(approaches("id,t,x,y\n,s,(furlong),m\nu,0,0,0\n", "--distance 1")
                .find("'furlong', which is no known unit"),
            std::string::npos);
}

TEST_F(TablesOfTheField, DegreesAndMinutesOfSailors) {
  const std::string rows = "id,t,lat,lon\nu,0,55-30.0N,010-30.0W\nu,1,55-30.0N,010-30.0W\n";
  EXPECT_EQ(approaches(rows + "v,0,55.5,-10.5\nv,1,55:30:00,-10.5\n", "--distance 1"), "1");
  EXPECT_EQ(approaches("id,t,x,y\nu,0,\xE2\x88\x92"
                       "3,0\nu,1,-3,0\nv,0,-3,0\nv,1,-3,0\n",
                       "--distance 1"),
            "1");
  EXPECT_NE(approaches("id,t,x,y\nu,0,-5.0D+00,0\n", "--distance 1")
                .find("'-5.0D+00': exponents of Fortran are read as 1.5E+00, which sed -E "
                      "'s/([0-9.])[Dd]([-+0-9])/\\1E\\2/g' writes"),
            std::string::npos);
  // Seconds that were rounded up are 60, as many programs write them.
  const std::string parts = "id,t,lat,lon\nu,0,{0},{1}\nu,1,{0},{1}\nv,0,47.5,-0.2\nv,1,47.5,-0.2\n";
  for (const auto& [lat, lon] : {std::pair{"47 29 60.000", "-0 11 60"}, std::pair{"47 30", "-0 12"},
                                 std::pair{"47 30 00 N", "0 12 W"}, std::pair{"47:29:60.0", "-00:12:00"}})
    EXPECT_EQ(approaches(fmt::format(fmt::runtime(parts), lat, lon), "--distance 1"), "1") << lat;
  EXPECT_NE(approaches(fmt::format(fmt::runtime(parts), "47 30 61", "-0 12"), "--distance 1")
                .find("expected a number as latitude"),
            std::string::npos);
}

TEST_F(TablesOfTheField, HemispheresAreSigns) {
  const std::string text = "id,time,{0}\nu,0,{1}\nu,9,{1}\nv,0,{2}\nv,9,{2}\n";
  const auto apart = [&](const char* names, const char* u, const char* v) {
    return approaches(fmt::format(fmt::runtime(text), names, u, v), "--distance 100");
  };
  EXPECT_EQ(apart("lat,ns,lon,ew", "0.1,N,8,E", "0.1,N,8,E"), "1");
  EXPECT_EQ(apart("lat,ns,lon,ew", "0.1,N,8,E", "0.1,S,8,E"), "0");
  EXPECT_EQ(apart("lat,ns,lon,ew", "0.1,S,8,w", "-0.1,S,8,W"), "1");
  EXPECT_EQ(apart("lat,lon", "0.1N,8E", "0.1S,8E"), "0");
  EXPECT_EQ(apart("lat,lon", "0.1N,8W", "N0.1,-8"), "1");
  EXPECT_EQ(apart("lat,lon",
                  "\"47\xC2\xB0 30' 15.5\"\" N\",8\xB0"
                  "06'W",
                  "47.50430555,-8.1"),
            "1");
  EXPECT_NE(apart("lat,ns,lon,ew", "0.1,N,8,E", "0.1,X,8,E")
                .find("expected N or S of '0.1' (column 4), but got 'X'"),
            std::string::npos);
  EXPECT_NE(apart("lat,lon", "47 61 N,8E", "0,1").find("expected a number as latitude"), std::string::npos);
}

TEST_F(TablesOfTheField, HeightsOfAircraftHaveAUnit) {
  const std::string text =
      "{},time,lon,lat,altitude\nu,0,8,47,3000\nu,9,8,47,3000\nv,0,8,47,4000\nv,9,8,47,4000\n";
  const std::string asked = approaches(fmt::format(fmt::runtime(text), "icao24"), "--distance 400");
  EXPECT_NE(asked.find("which for heights of aircraft (column 'icao24') may be ft or m: say --columns "
                       "id=icao24,time=time,z=altitude:ft,lon=lon,lat=lat (or :m)"),
            std::string::npos)
      << asked;
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(text), "hex"),
                       "--distance 400 --columns id=hex,time=time,z=altitude:ft,lon=lon,lat=lat"),
            "1");
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(text), "id"), "--distance 400"), "0");
}

TEST_F(TablesOfTheField, DatesBesideClocks) {
  const std::string text = "id,{0},x,y\nu,{1},0,0\nu,{2},0,0\nv,{1},1,0\nv,{2},1,0\n";
  const auto read = [&](const char* names, const char* from, const char* to, const char* options = "") {
    return approaches(fmt::format(fmt::runtime(text), names, from, to),
                      std::string("--distance 2 ") + options);
  };
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"2024-02-29,23:59:50", "2024-03-01,0:00:10"},
           {"20240229,23:59:50", "20240301,00:00:10"},
           {"29-Feb-2024,11:59:50 PM", "1-Mar-2024,12:00:10 AM"},
           {"2024-02-29 00:00:00,23:59:50", "2024-03-01 00:00:00,00:00:10"}}) {
    EXPECT_EQ(read("Date,Time", from, to), "1") << from;
    EXPECT_NE(out_.find("from 2024-02-29T23:59:50 to 2024-03-01T00:00:10"), std::string::npos) << out_;
  }
  EXPECT_EQ(read("date,time", "29/02/2024,23:59:50", "01/03/2024,00:00:10", "--dates day-first"), "1");
  EXPECT_NE(read("date,time", "12:30,23:59:50", "12:30,00:00:10").find("expected a time (column 3)"),
            std::string::npos);
  EXPECT_NE(read("date,time", "NA,23:59:50", "NA,00:00:10").find("(see --missing)"), std::string::npos);
  EXPECT_EQ(read("date", "2024-02-29 23:59:50", "2024-03-01 00:00:10"), "1") << "a date with its clock";
  EXPECT_NE(read("date,time", "20240229,235950", "20240301,000010")
                .find("the time '235950' and the date '20240229' may belong together: write both as one "
                      "column, as in "
                      "2024-01-31T12:30:00, or say --columns id=id,time=time,x=x,y=y"),
            std::string::npos);
  EXPECT_NE(read("time", "23:59:50", "00:00:10").find("which has no date"), std::string::npos);
  EXPECT_NE(read("gps_week,time", "2300,604799", "2301,10").find("'gps_week' may be a part of the time"),
            std::string::npos);
  EXPECT_NE(read("time", "45351.50001157", "45351.50002315")
                .find("may be days, as spreadsheets, MATLAB and astronomers have them"),
            std::string::npos);
  EXPECT_EQ(read("time", "45351.50001157", "45351.50002315", "--time-unit d"), "1");
  EXPECT_EQ(read("time", "45351.5", "45352.5"), "1");
}

TEST_F(TablesOfTheField, RowsThatGoBackInTimeAreTold) {
  const std::string back = "id,time,x,y\nu,0,0,0\nu,1,0,0\nu,0.5,9,0\nu,1.5,9,0\n";
  const auto warning = [&](const std::string& text) {
    return run("tracks " + write("t.csv", text) + " --distance 1").err;
  };
  EXPECT_NE(
      warning(back).find(":4: this row and 0 others are earlier than the row of their id before (id 'u')"),
      std::string::npos);
  EXPECT_EQ(warning("id,time,x,y\nu,2,0,0\nu,1,0,0\nu,0,0,0\n"), "") << "a file that begins with its end";
  EXPECT_EQ(warning("id,time,x,y\nu,0,0,0\nv,0.5,0,9\nu,1,0,0\nv,1.5,0,9\n"), "");
}

TEST_F(TablesOfTheField, BodiesThatAreNeverThereAtOneTimeAreTold) {
  const auto warning = [&](const std::string& text, const std::string& other) {
    return run("tracks " + write("t.csv", text) + " " + write("u.csv", other) + " --distance 1").err;
  };
  const std::string u = "id,time,x,y\nu,0,0,0\nu,1,0,0\nu,2,0,0\n";
  const std::string told = warning(u, "id,time,x,y\nv,1700000000,0,0\nv,1700000001,0,0\n");
  EXPECT_NE(
      told.find("no two bodies are recorded at one time, so that there is no pair: 'u' from 0 to 2, 'v' "
                "from 1700000000 to 1700000001"),
      std::string::npos)
      << told;
  EXPECT_EQ(warning(u, "id,time,x,y\nv,2,0,9\nv,3,0,9\n"), "");
  EXPECT_EQ(warning(u, "id,time,x,y\nv,1.2,0,9\nv,1.3,0,9\n"), "");
  EXPECT_EQ(warning(u, "id,time,x,y\nu,10,0,0\nu,11,0,0\n"), "") << "one body";
}

TEST_F(TablesOfTheField, HeadersBelowOtherLinesAreFound) {
  const std::string rows = "id,time,x,y\nu,0,0,0\nu,1,0,0\nv,0,0,0.5\nv,1,0,0.5\n";
  for (const std::string above : {"Device: XY 3\nDate: 2024-01-01\n\n", "Device,XY,,\nRate,25,,\n,,,\n",
                                  "Position\n====\nof all\n", "a,\"b\nc,\"d\ne\n"}) {
    const std::string told = approaches(above + rows, "--distance 1");
    EXPECT_NE(told.find("line 4 looks like it: leave out what is above, with tail -n +4 " + path("t.csv") +
                        " | kinesphere tracks - ..."),
              std::string::npos)
        << told;
  }
  EXPECT_EQ(approaches(rows, "--distance 1"), "1");
  EXPECT_EQ(approaches(rows + "one,two\n", "--distance 1").find("looks like"), std::string::npos);
}

TEST_F(TablesOfTheField, NamesOfZones) {
  const auto at = [&](const char* first, const char* second) {
    return approaches(fmt::format("id,time,x,y\nu,{0},0,0\nu,{1},0,0\nv,2024-10-27T00:59:50Z,0,0\n"
                                  "v,2024-10-27T01:00:10Z,0,0\n",
                                  first, second),
                      "--distance 1");
  };
  EXPECT_EQ(at("2024-10-27T02:59:50+02:00[Europe/Berlin]", "2024-10-27T02:00:10+01:00[Europe/Berlin]"), "1");
  EXPECT_EQ(at("2024-10-27T00:59:50Z[UTC]", "2024-10-27 02:00:10 +0100 CET"), "1");
  EXPECT_NE(
      at("2024-10-27 02:59:50 CEST", "2024-10-27 02:00:10 CET").find("write offsets, such as +01:00 for CET"),
      std::string::npos);
  for (const char* wrong : {"2024-10-27T02:59:50[Europe/Berlin]", "2024-10-27T02:59:50+02:00[Europe/Berlin"})
    EXPECT_NE(at(wrong, wrong).find("expected a time"), std::string::npos);
}

TEST_F(TablesOfTheField, SlipsInOptionsAreNamed) {
  const std::string rows = "id,time,x,y\nu,0,0,0\nu,1,9,0\nv,0,0,5\nv,1,9,5\n";
  for (const auto& [columns, part] :
       {std::pair{"id=id,time=time,x=x,y=x", "expected two columns for x and y, but both are x"},
        std::pair{"id=1,time=2,x=3,y=4,z=4", "expected two columns for y and z, but both are y"},
        std::pair{"id=1,time=2,lon=4,lat=4", "expected two columns for lon and lat, but both are y"}})
    EXPECT_NE(approaches(rows, fmt::format("--distance 1 --columns {}", columns)).find(part),
              std::string::npos)
        << columns;
  EXPECT_NE(approaches(rows, "--distance 1 --max-speed 0.5")
                .find("expected an id with two samples that can be reached at --max-speed 0.5"),
            std::string::npos);
}

TEST_F(TablesOfTheField, TimesAreNoFramesOfAnObsmat) {
  const std::string atc = "{0},9990000,100,0,1700,1000,0,0\n{0},9990001,100,0,200,1000,0,0\n";
  const auto with_times = [&](const char* first, const char* second) {
    return approaches(fmt::format(fmt::runtime(atc), first) + fmt::format(fmt::runtime(atc), second),
                      "--distance 1");
  };
  EXPECT_NE(with_times("780", "790").find("it looks like an obsmat"), std::string::npos);
  for (const char* time : {"1351038605.213", "1351038605"})
    EXPECT_NE(with_times(time, "1351038606").find("it has no header and 8 columns"), std::string::npos);
}

TEST_F(TablesOfTheField, IdsThatASpreadsheetHasRounded) {
  const std::string text = "mmsi,time,x,y\n{0},0,0,0\n{0},1,0,0\n";
  EXPECT_NE(approaches(fmt::format(fmt::runtime(text), "2.19E+08"), "--distance 1")
                .find("the id 2.19E+08 looks rounded"),
            std::string::npos);
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(text), "2.19E+08"), "--distance 1 --where 'mmsi != none'"),
            "0");
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(text), "2.190123450e+08"), "--distance 1"), "0");
  EXPECT_EQ(approaches(fmt::format(fmt::runtime(text), "3.000000e+00"), "--distance 1"), "0");
}

TEST_F(TablesOfTheField, OneBodyInEachFile) {
  const std::string text = "time,x [cm],y [cm]\n0,{0},0\n1,{0},0\n";
  const auto files = [&](const char* other) {
    std::filesystem::create_directories(path("other"));
    return std::vector{write("fish0.csv", fmt::format(fmt::runtime(text), 0)),
                       write(other, fmt::format(fmt::runtime(text), 50))};
  };
  const std::string asked = approaches_in(files("fish1.csv"), "--distance 1");
  EXPECT_NE(
      asked.find(
          "say --columns 'id=...,time=time,x=x [cm],y=y [cm]', with id=@file where each file is one body"),
      std::string::npos)
      << asked;
  const std::string said =
      "--distance 1 --columns 'id=@file,time=time,x=x [cm],y=y [cm]' --contacts " + path("c.csv");
  EXPECT_EQ(approaches_in(files("fish1.csv"), said), "1");
  EXPECT_NE(read_text(path("c.csv")).find(",fish0,fish1,"), std::string::npos);
  EXPECT_NE(approaches_in(files("other/fish0.csv"), said).find("is called fish0, too"), std::string::npos);
}

TEST_F(TablesOfTheField, CoordinatesOfSeveralZonesAreAskedAbout) {
  const std::string zones =
      "id,t,x,y,utm_zone\nu,0,500000,0,32\nu,1,500000,0,32\nv,5,500000,0,33\nv,6,500000,0,33\n";
  EXPECT_NE(approaches(zones, "--distance 1")
                .find("the rows with utm_zone as '32' and '33' may have coordinates or times that cannot be "
                      "compared: "
                      "take one "
                      "with --where 'utm_zone = 32'"),
            std::string::npos);
  EXPECT_EQ(approaches(zones, "--distance 1 --where 'utm_zone != none'"), "0");
}

TEST_F(TablesOfTheField, ClockTimesAreNoSeconds) {
  const std::string clock =
      "id,utc,x,y\nu,101530,0,0\nu,101600,0,0\nu,101630,0,0\nv,101530.5,0,0\nv,101600.5,0,0\n";
  EXPECT_NE(approaches(clock, "--distance 1")
                .find("the times 101530 to 101630 may be those of a clock (hhmmss): write them as in "
                      "2024-01-31T12:30:15, or say --time-unit s"),
            std::string::npos);
  EXPECT_EQ(approaches(clock, "--distance 1 --time-unit s"), "1");
  // A few seconds, from one minute into the next.
  EXPECT_NE(approaches("id,t,x,y\nu,120058,0,0\nu,120059,1,0\nu,120100,2,0\nu,120101,3,0\n", "--distance 1")
                .find("the times 120058 to 120101 may be those of a clock"),
            std::string::npos);
  EXPECT_EQ(approaches("id,t,x,y\nu,101530,0,0\nu,101660,0,0\nv,101530,0,0\nv,101660,0,0\n", "--distance 1"),
            "1");
  for (const auto& [packed, parts] :
       {std::pair{"20240131101530", R"(([0-9]{8})([0-9]{6})\b/\1T\2/')"},
        std::pair{"20240131101530250", R"(([0-9]{8})([0-9]{6})([0-9]{3})\b/\1T\2.\3/')"},
        std::pair{"202401311015", R"(([0-9]{8})([0-9]{4})\b/\1T\200/')"},
        std::pair{"240131101530", R"(([0-9]{6})([0-9]{6})\b/20\1T\2/')"}}) {
    const std::string asked = approaches(fmt::format("id,t,x,y\nu,{},0,0\n", packed), "--distance 1");
    EXPECT_NE(asked.find(std::string("read as 20240131T123015, which sed -E 's/\\b") + parts),
              std::string::npos)
        << asked;
  }
  // A moment of 2024 in milliseconds is none.
  EXPECT_NE(
      approaches("id,t,x,y\nu,1711929590000,0,0\n", "--distance 1").find("say --time-unit ms, us or ns"),
      std::string::npos);
  EXPECT_NE(
      approaches("id,t,x,y\nu,2460380.5,0,0\nu,2460380.50001,0,0\n", "--distance 1").find("may be days"),
      std::string::npos)
      << "Julian dates";
  // Clocks of a spreadsheet are parts of a day.
  const auto parts_of_a_day = [&](double step, const char* unit) {
    std::string text = "id,t,x,y\n";
    for (int k = 0; k < 9; ++k) text += fmt::format("u,{0:.9f},0,0\nv,{0:.9f},0,1\n", 0.5 + k * step);
    return approaches(text, fmt::format("--distance 2{}", unit));
  };
  for (const double seconds : {1.0, 10.0, 60.0}) {
    const std::string asked = parts_of_a_day(seconds / 86400, "");
    EXPECT_NE(asked.find("say --time-unit d, or s if they are seconds"), std::string::npos) << asked;
  }
  EXPECT_EQ(parts_of_a_day(1.0 / 86400, " --time-unit d"), "1");
  for (const double per_second : {1000.0, 240.0, 120.0, 30.0})
    EXPECT_EQ(parts_of_a_day(1 / per_second, ""), "1");
  EXPECT_EQ(approaches("id,t,x,y\nu,2024.01.31 10:00:00,0,0\nu,2024.01.31 10:00:01,0,0\n", "--distance 1"),
            "0");
  // The day of a year.
  const std::string ordinal =
      "id,t,x,y\nu,2024-060T00:00:00,0,0\nu,2024-060T00:00:01,0,0\nv,2024-02-29T00:00:00,0,0\nv,2024-02-"
      "29T00:00:01,0,0\n";
  EXPECT_EQ(approaches(ordinal, "--distance 1"), "1");
  EXPECT_NE(approaches("id,t,x,y\nu,2023-366T00:00:00,0,0\n", "--distance 1").find("expected a time"),
            std::string::npos);
}

TEST_F(TablesOfTheField, ClocksWithoutADateCountFromMidnight) {
  const std::string clocks =
      "id,time,x,y\nu,23:59:59,0,0\nu,24:00:00.5,0,0\nv,11:59:59 PM,0,0.5\nv,24:00:01,0,0.5\n";
  EXPECT_NE(approaches(clocks, "--distance 1").find("or say --time-unit clock to count from midnight"),
            std::string::npos);
  EXPECT_EQ(approaches(clocks, "--distance 1 --time-unit clock --contacts " + path("c.csv")), "1");
  EXPECT_NE(read_text(path("c.csv")).find("\n86399,86400.5,"), std::string::npos) << read_text(path("c.csv"));
  // Minutes and seconds of films; 86399 is a number of seconds.
  EXPECT_EQ(approaches("id,time,x,y\nu,01:05.25,0,0\nu,1:06.0,0,0\nv,65.25,0,0\nv,66,0,0\n",
                       "--distance 1 --time-unit clock"),
            "1");
  // Durations as pandas and Python write them.
  const std::string durations =
      "id;time;x;y\nu;{0}0:00:01;0;0\nu;{0}0:00:02.5;0;0\nv;{0}00:00:02;0;0\nv;{0}00:00:03;0;0\n";
  for (const char* days : {"0 days ", "2 days ", "1 day, "}) {
    const std::string text = fmt::format(fmt::runtime(durations), days);
    EXPECT_NE(approaches(text, "--distance 1").find("or say --time-unit clock"), std::string::npos);
    EXPECT_EQ(approaches(text, "--distance 1 --time-unit clock --contacts " + path("c.csv")), "1");
    const int from = 86400 * (days[0] - '0');
    EXPECT_NE(read_text(path("c.csv")).find(fmt::format("\n{},{}.5,", from + 2, from + 2)), std::string::npos)
        << read_text(path("c.csv"));
  }
  for (const char* unclear : {"01:65", "9:30", "01:65:00", "9:30 XM", "1 days 9:30"})
    EXPECT_NE(approaches(fmt::format("id,time,x,y\nu,{},0,0\n", unclear), "--distance 1 --time-unit clock")
                  .find("write 9:30 as 09:30:00, or as 00:09:30"),
              std::string::npos)
        << unclear;
}

TEST_F(TablesOfTheField, TimesComeBackAsTheyWere) {
  const std::string text =
      "id,time,x,y\nu,0,0,0\nu,12,0,0\nu,24.975016,0,0\nv,1.648337,0.5,0\nv,1.673317,0.5,0\n"
      "v,1.698297,0.5,0\n";
  EXPECT_EQ(approaches(text, "--distance 1 --max-gap 20 --contacts " + path("c.csv")), "1");
  EXPECT_NE(read_text(path("c.csv")).find("\n1.648337,1.698297,"), std::string::npos)
      << read_text(path("c.csv"));
}

TEST_F(TablesOfTheField, DistancesInAnotherUnitThanTheFileAreWarnedOf) {
  const std::string file =
      write("mm.csv",
            "id,time,x_mm,y_mm\nu,0,0,0\nu,1,1000,0\nu,2,2000,0\nv,0,0,400\nv,1,1000,400\nv,2,2000,400\n");
  EXPECT_NE(run("tracks " + file + " --distance 100").err.find("--distance 100 is in metres"),
            std::string::npos);
  for (const char* fine : {"100mm", "1", "100m"})
    EXPECT_EQ(run("tracks " + file + " --distance " + fine).err, "") << fine;
}

TEST_F(TablesOfTheField, OtherFilesAreNamed) {
  for (const auto& [text, part] : std::initializer_list<std::pair<std::string, std::string>>{
           {std::string("\xFF\xFEi\0d\0", 6), "UTF-16: convert it with iconv"},
           {"[1, 2]\n", "JSON"},
           {"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"/>", "VTK"},
           {"# vtk DataFile Version 3.0\nballs\nASCII\n", "VTK"},
           {std::string("\x1A\x33\0\0\0", 5), "Beast"},
           {"*8D4840D6202CC371C32CE0576098;\n", "Mode S"},
           {std::string("i\0d\0", 4), "UTF-16"},
           {std::string("PK\3\4\0\0", 6), "zip archive"},
           {"PAR1\1\2", "Parquet"},
           {"id,t\r1,2\r", "old Macs: convert it with tr '\\r' '\\n'"},
           {"#cP2024  1  1\n", "SP3"},
           {"ISS\n1 25544U 98067A   24001.50000000  .00016717  00000-0  10270-3 0  9009\n"
            "2 25544  51.6400 208.9163 0006703 130.5360 325.0288 15.72125391 10008\n",
            "TLE"},
           {std::string("\0\0\x07\xCB\0\0", 6), "(XTC, TRR or DCD): write it as XYZ"},
           {std::string("T\0\0\0CORD", 8), "with MDAnalysis"},
           {std::string("\x02P\1\0", 4), "C3D"},
           {"MATLAB 5.0 MAT-file", ".mat file"},
           {std::string("\xFF\xFE\0\0i\0\0\0", 8), "iconv -f UTF-32"},
           {"HIERARCHY\nROOT Hips\n", "BVH"},
           {"---\ncreator: LAMMPS\ntimestep: 0\n", "dump_style custom"},
           {"CCSDS_OPM_VERS = 2.0\n", "OPM"},
           {"header: \n  seq: 0\n", "rostopic echo -p"},
           {"*******************************************************************************\nEphemeris / "
            "WWW_USER Mon Jan  1 00:00:00 2024 Pasadena, USA\n",
            "JPL (HORIZONS): write its rows between $$SOE and $$EOE as CSV"},
           {"Type,Local Number,Message,Field 1,Value 1,Units 1,Field 2\nData,0,record,timestamp,\"1\",s,\n",
            "a FIT file as its SDK prints it"},
           {"1000:1,0,3,-1000,0,1.00;1,1,4,50,-1000,1.00;:0,0,0,5.2,H,Alive;:\n", "tracking data of TRACAB"},
           {",,,Home,,Home,,,\n,,,11,,1,,,\nPeriod,Frame,Time [s],Player11,,Player1,,Ball,\n",
            "tracking data of Metrica, in parts of the pitch"},
           {"AA_BB LSZH EDDF A320 120000 120100 300 310 0 ABC1 240101 240101 2838 510 2839 510 1 1 0.3 0\n",
            "segments of flights (SO6)"},
           {"<?xml version=\"1.0\"?>\n<events version=\"1.0\">\n<event time=\"1.0\"/></events>\n",
            "events of MATSim, which say links and no places"},
           {"<?xml version=\"1.0\"?>\n<mvnx version=\"4\"/>", "MVNX"}}) {
    const std::string message = approaches(text, "--distance 1");
    EXPECT_NE(message.find("expected a table in a text file, but it is "), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  }
}

/// Two bodies that pass each other at half a unit, six samples each, in the shape of a known tool.
struct Shape {
  const char* title;   ///< part of the summary's row "format"
  const char* header;  ///< with its line ends
  const char* row;     ///< {0}: body, {1}: step, {2}: x, {3}: y, {4}: longitude, {5}: latitude
  const char* options = "";
  int files = 1;
};

const Shape shapes[] = {
    {"table", "agent_id,t_s,px,py\n", "{0},{1},{2},{3}\n"},
    {"Argoverse", "TIMESTAMP,TRACK_ID,OBJECT_TYPE,X,Y,CITY_NAME\n",
     "3159699{1}.5,0000-{0},OTHERS,{2},{3},MIA\n"},
    {"DJI, by AirData", "time(millisecond),datetime(utc),latitude,longitude,height_above_takeoff(meters)\n",
     "{1}00,2024-01-01 00:00:0{1},{5},{4},10\n", "", 2},
    {"ROS (rostopic echo -p)",
     "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.position.x,field.pose."
     "position.y,"
     "field.pose.position.z\n",
     "{1}000000000,{1},{1}000000000,map,{2},{3},0\n", "", 2},
    {"Vissim", "SIMSEC;NO;COORDFRONTX;COORDFRONTY\n", "{1};{0};{2};{3}\n"},
    {"Danish AIS", "# Timestamp,Type of mobile,MMSI,Latitude,Longitude,Navigational status,ROT,SOG,COG\n",
     "03/09/2025 00:00:0{1},Class A,11100000{0},{5},{4},Under way,0,1,90\n"},
    {"AIS of marinecadastre.gov", "MMSI,BaseDateTime,LAT,LON,SOG,COG\n",
     "11100000{0},2025-01-01T00:00:0{1},{5},{4},1,90\n"},
    {"times in ms since 1970", "id,timestamp,lat,lon\n", "{0},160000000{1}000,{5},{4}\n"},
    {"highD", "frame,id,x,y,width,height,xVelocity,yVelocity\n", "{1},{0},{2},{3},4,2,1,0\n"},
    {"2 pairs of columns", "seconds,x1,y1,x2,y2\n", ""},
    {"inD, rounD, exiD", "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length\n",
     "0,{0},{1},{1},{2},{3},0,2,4\n"},
    {"INTERACTION", "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy\n",
     "{0},{1},{1}00,car,{2},{3},1,0\n"},
    {"PeTrack, in cm", "# id frame x/cm y/cm z/cm\n", "{0} {1} {2}e2 {3}e2 180\n", "--frame-rate 16"},
    {"columns as given", "", "{0} {1} {2}e2 {3}e2 180\n",
     "--columns id=1,frame=2,x=3:cm,y=4:cm --frame-rate 16"},
    {"MOT", "", "{1},{0},{2},{3},10,20,1,-1,-1,-1\n", "--frame-rate 30"},
    {"KITTI tracking", "", "{1} {0} Car 0 0 -1.5 296 161 452 292 2.0 1.8 4.4 {2} 1.8 {3} -1.59\n"},
    {"columns as given", "header.stamp.secs,pose.position.x,pose.position.y,pose.position.z\n",
     "160000000{1},{2},{3},0\n",
     "--columns id=@file,time=header.stamp.secs,x=pose.position.x,y=pose.position.y", 2},
    {"table", "#framerate: 8.00\n#ID\tFR\tX\tY\tZ\tA\n", "{0}\t{1}\t{2}\t{3}\t0\t0.2\n"},
    {"table", "t,shipid,lon,lat,heading\n", "{1},s{0},{4},{5},1\n"},
    {"table", "MMSI,TSTAMP,LATITUDE,LONGITUDE\n", "36600000{0},2024-01-01 00:00:0{1} GMT,{5},{4}\n"},
    {"Stanford Drone Dataset", "", "{0} {2} {3} 9 9 {1} 0 0 1 \"Biker\"\n", "--frame-rate 30"},
    {"Movebank",
     "event-id,visible,timestamp,location-long,location-lat,tag-local-identifier,individual-local-"
     "identifier\n",
     "{1}{0},true,2021-02-11 17:30:0{1}.000,{4},{5},10{0},A{0}\n9{1}{0},false,2021-02-11 "
     "17:30:0{1}.500,0,0,10{0},"
     "A{0}\n"},
    {"NFL", "time,x,y,s,event,nflId,displayName,frame.id,gameId,playId\n",
     "2017-09-08T00:41:59.{1}00Z,{2},{3},0,NA,100{0},p,{1},1,1\n"},
    {"NGSIM", "Vehicle_ID,Frame_ID,Global_Time,Local_X,Local_Y,v_Length\n",
     "{0},{1},1118846980{1}00,{2},{3},14\n"},
    {"OpenSky state vectors",
     "time,icao24,lat,lon,velocity,heading,vertrate,callsign,baroaltitude,geoaltitude\n",
     "160000000{1},aaaaa{0},{5},{4},200,90,0,T,10000,10100\n"},
    {"traffic", "timestamp,icao24,latitude,longitude,groundspeed,track,vertical_rate,callsign,altitude\n",
     "2024-01-01 00:00:0{1}+00:00,aaaaa{0},{5},{4},450,90,0,T,30000\n"},
    {"PX4", "timestamp,timestamp_sample,ref_timestamp,x,y,z,vx,vy,vz\n", "{1}000000,0,0,{2},{3},-10,0,0,0\n",
     "", 2},
    {"ArduPilot", "TimeUS,Status,Lat,Lng,Alt,Spd\n", "{1}000000,3,{5},{4},120,0\n", "", 2},
    {"SUMO FCD", "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_speed\n", "{1};v{0};{2};{3};1\n"},
    {"columns as given", "", "{0},2008-02-02 15:36:0{1},{4},{5}\n", "--columns id=1,time=2,lon=3,lat=4"},
    {"TrackMate spots",
     "LABEL,ID,TRACK_ID,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME\n"
     "Label,Spot ID,Track ID,X,Y,Z,T,Frame\n,,,(micron),(micron),(micron),(sec),\n",
     "ID{1},{1}{0},{0},{2},{3},0,{1},{1}\nID9{1},9{1}{0},,0,0,0,{1},{1}\n", "--unit um"},
    {"Imaris (positions)", "Position X,Position Y,Position Z,Unit,Category,Collection,Time,TrackID,ID,\n",
     "{2},{3},0,um,Spot,Position,{1},100000{0},{1}{0},\n", "--frame-rate 10"},
    {"table", "y,x,mass,size,frame,particle\n", "{3},{2},100,2,{1},{0}\n", "--frame-rate 10"},
    {"TUM", "", "160000000{1} {2} {3} 0 0 0 0 1\n", "", 2},
    {"TUM", "", "{1}.5 {2}.5 {3} 0 0 0 0 1\n", "", 2},
    {"MOT", "", "1{1},1{0},{2},{3},10,20,1,1,0.86\n", "--frame-rate 30"},
    {"TUM", "# timestamp tx ty tz qx qy qz qw\n", "{1}.25 {2} {3} 0 0 0 0 1\n", "", 2},
    {"table", "Tag;Zeit;X;Y\n", "T{0};{1},5;{2};{3}\n"},
    {"Vadere", "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1\n",
     "{0} {1} 9 {2} {3} 0 0\n"},
};

TEST_F(TablesOfTheField, PresetsAreRecognisedByTheirHeaders) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.header + std::string(shape.row));
    std::vector<std::string> texts(static_cast<std::size_t>(shape.files), shape.header);
    for (int step = 0; step < 6; ++step) {
      if (*shape.row == '\0') texts[0] += fmt::format("{},{},0,{},0.5\n", step, step, 5 - step);
      for (int body = 0; body < 2 && *shape.row != '\0'; ++body) {
        const double x = body == 0 ? step : 5 - step, y = body == 0 ? 0.0 : 0.5;
        texts[static_cast<std::size_t>(body % shape.files)] +=
            fmt::format(fmt::runtime(shape.row), body, step, x, y, 8.0 + 1e-5 * x, 47.0 + 1e-5 * y);
      }
    }
    std::vector<std::string> files;
    for (const std::string& text : texts)
      files.push_back(write(fmt::format("body{}.csv", files.size()), text));
    EXPECT_EQ(approaches_in(files, std::string("--distance 1 ") + shape.options), "1");
    const std::size_t row = out_.find("\nformat");
    EXPECT_NE(out_.substr(row, out_.find('\n', row + 1) - row).find(shape.title), std::string::npos) << out_;
  }
}

TEST_F(TablesOfTheField, PresetsAskForWhatTheirFilesDoNotSay) {
  EXPECT_NE(
      approaches("1,1,0,0,10,20,1,-1,-1,-1\n2,1,0,0,10,20,1,-1,-1,-1\n", "--distance 1").find("--frame-rate"),
      std::string::npos);
  EXPECT_NE(approaches("y,x,frame,particle\n0,0,0,1\n", "--distance 1").find("--frame-rate"),
            std::string::npos);
  EXPECT_NE(approaches("1 0 0.5 0.5 180\n", "--distance 1").find("no header and 5 columns"),
            std::string::npos);
  EXPECT_NE(approaches("id,t,x,y\nu,1600000000000,0,0\n", "--distance 1").find("--time-unit ms, us or ns"),
            std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::tables_of_the_field_test
