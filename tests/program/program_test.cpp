// The program in use: exit codes, one clear line for each error, complete files.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/tables/column_names.hpp"
#include "kinesphere/version.hpp"
#include "scenes/scene_file.hpp"
#include "support.hpp"

namespace kinesphere::program::program_test {
namespace {

using Names = std::vector<std::string>;

constexpr std::string_view small_scene = R"({
  "bodies": 40, "radius": [1, 5], "box": [[0, 0, 0], [60, 60, 60]], "seconds": 2, "response": "bounce" })";

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream stream(csv);
  for (std::string line; std::getline(stream, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Returns the number of lines of `text` that begin with `start`.
std::size_t lines_with(const std::string& text, std::string_view start) {
  std::size_t count = 0;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) count += line.starts_with(start) ? 1 : 0;
  return count;
}

TEST_F(ProgramTest, SaysItsVersionAndHelps) {
  const ProgramRun version_run = run("--version");
  EXPECT_EQ(version_run.exit_code, 0);
  EXPECT_EQ(version_run.out, std::string(version) + "\n");
  for (const char* command :
       {"--help", "run --help", "replay --help", "tracks --help", "verify --help", "scenes --help"}) {
    const ProgramRun help = run(command);
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    EXPECT_NE(help.out.find("Usage"), std::string::npos) << command;
  }
}

/// Lines fit a terminal, words are whole, and each command ends with what may be typed.
TEST_F(ProgramTest, HelpsInEightyColumns) {
  for (const std::string command : {"", "run", "replay", "verify", "scenes", "tracks", "view", "watch"}) {
    const std::string help = run(command + " --help").out;
    std::istringstream stream(help);
    for (std::string line; std::getline(stream, line);)
      EXPECT_LE(line.size(), 80u) << command << ": " << line;
    if (command.empty()) continue;
    const std::size_t examples = help.find("\nExamples:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_EQ(lines_with(help.substr(examples), "  kinesphere "), 3u) << command;
  }
  const std::string tracks = run("tracks --help").out;
  EXPECT_NE(tracks.find("\nHow close:\n  --distance LENGTH       How close counts as an approach: a number,"),
            std::string::npos)
      << tracks;
  // A description that is broken goes on below its beginning.
  EXPECT_NE(tracks.find("\n                          a unit, such as 500m, 5NM, 2um\n"), std::string::npos)
      << tracks;
}

TEST_F(ProgramTest, AsksWhatIsMeant) {
  expect_wrong_input("track x", {"there is no command track: did you mean tracks?"});
  expect_wrong_input("wacth x", {"did you mean watch?"});
  expect_wrong_input("tracks a.csv --distnce 3",
                     {"tracks has no option --distnce: did you mean --distance?"});
  expect_wrong_input("tracks a.csv --interp linear", {"did you mean --interpolate?"});
  expect_wrong_input("run paper1 --sed=4", {"run has no option --sed: did you mean --seed?"});
  expect_wrong_input("run paper1 --colour", {"run has no option --colour (see --help)"});
}

/// What is wrong first is said first: without the file no option helps.
TEST_F(ProgramTest, SaysThatThereIsNoFile) {
  for (const char* arguments : {"tracks none.csv", "tracks none.csv --distance 1"})
    expect_wrong_input(arguments, {"none.csv: cannot read: No such file"});
}

TEST_F(ProgramTest, ListsTheScenes) {
  const ProgramRun result = run("scenes");
  EXPECT_EQ(result.exit_code, 0);
  for (const SceneParameters& scene : built_in_scenes())
    EXPECT_EQ(lines_with(result.out, scene.name + " "), 1u);
}

/// KINESPHERE_BUILD_PROGRAM=scenes builds a program that says what it lacks.
TEST_F(ProgramTest, OfScenesAloneSaysWhatIsLeftOut) {
  const std::string program = std::string("'") + KINESPHERE_SCENES_ALONE + "' ";
  EXPECT_EQ(run_shell(program + "run paper1 --bodies 50 --hash-only").out,
            run("run paper1 --bodies 50 --hash-only").out);
  for (const std::string command : {"tracks --distance 3 a.csv", "view", "watch --separation sphere:1 -"}) {
    const ProgramRun result = run_shell(program + command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(result.err.starts_with("kinesphere: this program was built for scenes alone, without " +
                                       command.substr(0, command.find(' ')) + "."))
        << result.err;
  }
}

/// Messages name what the user has written, not the calls of the library that refused it.
TEST_F(ProgramTest, SaysNothingOfItsCalls) {
  const std::string scene = write(
      "scene.json",
      R"({"motion": "ballistic", "bodies": 10, "box": [[0, 0, 0], [1, 1, 1]], "radius": [3, 3], "speed": [1, 1], "limit": [0, 0], "seconds": 1})");
  const std::string noise = write("noise.ksr", "this is no recording");
  const std::string far =
      write("far.csv", "id,time,x,y,z\na,0,0,0,0\na,1,1e300,0,0\na,2,0,0,0\nb,0,0,0,0\nb,2,1,0,0\n");
  for (const std::string& arguments : {"run '" + scene + "'", std::string("run paper1 --packing 0.9"),
                                       "replay '" + noise + "'", "tracks '" + far + "' --distance 1"}) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    for (const std::string_view call : {"::", "make_scene", "create:", "add:", "advance:", "open:"})
      EXPECT_EQ(result.err.find(call), std::string::npos) << result.err;
  }
}

TEST_F(ProgramTest, RefusesWrongOptions) {
  const std::string scene = write("s.json", small_scene);
  expect_wrong_input("", {"expected a command: run, replay, verify, scenes, tracks, view or watch"});
  expect_wrong_input("fly", {"there is no command fly: expected run, replay, verify"});
  expect_wrong_input("--fly", {"--fly"});
  expect_wrong_input("watch --seperation sphere:1", {"--seperation"});
  expect_wrong_input("watch", {"--separation: expected it, as sphere:50"});
  expect_wrong_input("run", {"SCENE"});
  expect_wrong_input("run " + scene + " --fast", {"--fast"});
  expect_wrong_input("run " + scene + " --bodies -1", {"--bodies", "-1"});
  expect_wrong_input("run " + scene + " --bodies 010", {"--bodies", "010"});
  expect_wrong_input("run " + scene + " --bodies 4294967296",
                     {"--bodies", "from 0 to 4294967295", "4294967296"});
  expect_wrong_input("run " + scene + " --bodies many", {"--bodies", "many"});
  expect_wrong_input("run " + scene + " --seed -1", {"--seed", "-1"});
  expect_wrong_input("run " + scene + " --radius 1", {"--radius"});
  expect_wrong_input("run " + scene + " --radius -1 2", {"radius"});
  expect_wrong_input("run " + scene + " --seconds soon", {"--seconds", "expected a finite number", "soon"});
  expect_wrong_input("run " + scene + " --response stick", {"--response", "pass_through", "stick"});
  for (const char* threads : {"0", "257", "-1", "two"}) {
    expect_wrong_input("run " + scene + " --threads " + threads, {"--threads", "from 1 to 256", threads});
  }
  expect_wrong_input("run " + scene + " --threads 2 --audit", {"--audit", "--threads"});
  expect_wrong_input("run " + scene + " --frames " + path("f.xyz") + " --frame-interval 0",
                     {"--frame-interval", "0"});
  expect_wrong_input("tracks " + scene, {"--distance"});
  EXPECT_EQ(names(), Names{"s.json"});
}

TEST_F(ProgramTest, RefusesWrongScenes) {
  expect_wrong_input("run nowhere.json", {"nowhere.json", "built-in", built_in_scenes().front().name});
  expect_wrong_input("verify nowhere.json", {"nowhere.json"});
  const std::string typo = write("typo.json", "{\n  \"bodys\": 3\n}");
  expect_wrong_input("run " + typo, {"typo.json:2:", "'bodys'", "bodies"});
  const std::string wrong = write("wrong.json", "{\n  \"seconds\": 1,\n  \"radius\": [-1, 2]\n}");
  expect_wrong_input("run " + wrong, {"wrong.json:3:", "radius"});
  const ProgramRun overridden = run("run " + wrong + " --radius 1 2 --bodies 3 --quiet");
  EXPECT_EQ(overridden.exit_code, 0) << overridden.err;
  // A wrong option is not an error of the file.
  const ProgramRun by_option = run("run " + wrong + " --radius -3 2");
  EXPECT_EQ(by_option.err.find("wrong.json"), std::string::npos) << by_option.err;
}

TEST_F(ProgramTest, SummarisesARun) {
  const ProgramRun result = run("run " + write("s.json", small_scene) + " --seed 42");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* label : {"scene", "bodies", "seed", "simulated", "contacts", "wall contacts", "hardest",
                            "probes", "hash", "real time"}) {
    EXPECT_EQ(lines_with(result.out, std::string(label) + " "), 1u) << label << "\n" << result.out;
  }
  EXPECT_TRUE(result.out.starts_with("contacts ")) << "first what was asked for: " << result.out;
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos) << "no colours in a file";
  const ProgramRun verbose = run("run " + path("s.json") + " --seed 42 --verbose");
  for (const char* label : {"detector", "steps", "  pair checks", "searches", "pair tests", "memory"}) {
    EXPECT_EQ(lines_with(result.out, label), 0u) << label << "\n" << result.out;
    EXPECT_EQ(lines_with(verbose.out, label), 1u) << label << "\n" << verbose.out;
  }
  EXPECT_NE(result.out.find("42"), std::string::npos);
}

TEST_F(ProgramTest, WritesTheSameFilesWhenTheWorldGoesOnByItself) {
  const std::string scene = write("s.json", small_scene);
  const auto files = [&](const std::string& name, const std::string& options) {
    const ProgramRun result =
        run("run " + scene + " --hash-only --contacts " + path(name + ".csv") + " --frames " +
            path(name + ".xyz") + " --frame-interval 0.3 --record " + path(name + ".kin") + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(run("replay " + path(name + ".kin")).exit_code, 0);
    return std::vector{result.out, read_text(path(name + ".csv")), read_text(path(name + ".xyz"))};
  };
  const auto looped = files("loop", "");
  for (const char* threads : {"1", "2", "4"})
    EXPECT_EQ(files("by_itself", std::string(" --threads ") + threads), looped) << threads;
  EXPECT_NE(run("run " + scene + " --threads 2").out.find("by itself, 2 threads"), std::string::npos);
}

TEST_F(ProgramTest, TellsOfTheZenoGuardIfAsked) {
  for (const std::size_t told : {0u, 1u}) {
    const ProgramRun result =
        run(std::string("run pile --bodies 50 --seconds 3") + (told ? " --verbose" : ""));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(lines_with(result.out, "repeated "), told) << result.out;
    EXPECT_EQ(lines_with(result.out, "zeno guard "), told) << result.out;
  }
}

TEST_F(ProgramTest, ExplainsWhichBodiesCostMostAndWhy) {
  const std::string scene = "run " + write("s.json", small_scene) + " --explain";
  const ProgramRun result = run(scene);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(lines_with(result.out, "  body "), 10u) << result.out;
  EXPECT_EQ(lines_with(result.out, "busiest bodies "), 1u) << result.out;
  EXPECT_GE(lines_with(result.out, "contacts: Its contacts begin often"), 1u) << result.out;
  // The same bodies without the summary, with threads, and beside a recording.
  const std::string list = result.out.substr(result.out.find("\nbusiest bodies"));
  EXPECT_EQ(run(scene + " --quiet").out, list);
  EXPECT_EQ(run(scene + " --quiet --threads 2 --record " + path("r.kin")).out, list);
  EXPECT_EQ(run(scene + " --hash-only").out.size(), 17u);
  EXPECT_NE(run(scene + " --bodies 0").out.find("none was probed"), std::string::npos);
}

TEST_F(ProgramTest, RunsScenesOfNothing) {
  for (const char* nothing : {" --bodies 0", " --seconds 0"}) {
    const ProgramRun result =
        run("run " + write("s.json", small_scene) + nothing + " --frames " + path("f.xyz"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("inf"), std::string::npos) << result.out;
  }
}

TEST_F(ProgramTest, RepeatsSpaceOnRequest) {
  const std::string gas =
      R"({"motion": "ballistic", "bodies": 40, "limit": [0, 0], "seconds": 1, "packing": 0.2)";
  const std::string periodic =
      run("run " + write("p.json", gas + R"(, "periodic": true})") + " --hash-only").out;
  const std::string walled = write("w.json", gas + R"(, "periodic": false})");
  EXPECT_EQ(run("run " + walled + " --periodic --hash-only").out, periodic);
  EXPECT_NE(run("run " + walled + " --hash-only").out, periodic);
}

TEST_F(ProgramTest, PrintsNothingButTheHash) {
  const std::string scene = "run " + write("s.json", small_scene) + " --hash-only";
  const ProgramRun result = run(scene);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.size(), 17u);
  EXPECT_EQ(result.out.find_first_not_of("0123456789abcdef"), 16u) << result.out;
  EXPECT_EQ(run(scene).out, result.out);
  EXPECT_NE(run(scene + " --seed 2").out, result.out);
  EXPECT_EQ(run(scene + " --quiet --audit --seconds 0.1").exit_code, 0);
}

TEST_F(ProgramTest, WritesContactsAndFrames) {
  const std::string scene = write("s.json", small_scene);
  const ProgramRun result = run("run " + scene + " --quiet --contacts " + path("c.csv") + " --frames " +
                                path("f.xyz") + " --frame-interval 0.5");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(names(), (Names{"c.csv", "f.xyz", "s.json"}));
  const auto rows = rows_of(read_text(path("c.csv")));
  ASSERT_GT(rows.size(), 1u);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  const std::string frames = read_text(path("f.xyz"));
  EXPECT_EQ(lines_with(frames, "40"), 5u);
  EXPECT_EQ(lines_with(frames, "Lattice="), 5u);
  EXPECT_EQ(lines_with(frames, "S "), 5u * 40u);
}

TEST_F(ProgramTest, LeavesNothingHalfWritten) {
  const std::string scene = write("s.json", small_scene);
  expect_wrong_input("run " + scene + " --contacts " + path("none/c.csv"),
                     {"none/c.csv", "No such file or directory"});
  expect_wrong_input("run " + scene + " --contacts " + path("c.txt"), {"c.txt", ".csv or .jsonl"});
  expect_wrong_input("run " + scene + " --frames " + path("f.xyz") + " --contacts " + path("none/c.csv"),
                     {"none/c.csv"});
  // A limit on the size of files stands in for a full disk.
  const ProgramRun full = run("run " + scene + " --frames " + path("f.xyz"), "trap '' XFSZ; ulimit -f 8; ");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.err.find("f.xyz: cannot write: "), std::string::npos) << full.err;
  EXPECT_EQ(names(), Names{"s.json"});
}

TEST_F(ProgramTest, VerifiesAScene) {
  const ProgramRun result = run("verify " + write("s.json", small_scene));
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_NE(result.out.find("detector and oracle agree"), std::string::npos);
}

/// Two bodies that meet head-on at 2 units/s: closer than 2 from time 4 to time 6. A third starts close to
/// the first and stays behind.
constexpr std::string_view meeting =
    "id,time,x,y\n"
    "ann,0,0,0\nann,5,5,0\nann,10,10,0\n"
    "bob,0,10,0\nbob,5,5,0\nbob,10,0,0\n"
    "cy,0,0,1\ncy,5,0,1\ncy,10,0,1\n";

TEST_F(ProgramTest, FindsApproachesInTracks) {
  const std::string file = write("t.csv", meeting);
  const ProgramRun result =
      run("tracks " + file + " --distance 2 --tolerance 1e-9 --verify --contacts " + path("a.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const auto rows = rows_of(read_text(path("a.csv")));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{
                "begin",           "end",          "first",         "second",       "begins_with_track",
                "ends_with_track", "closest_time", "distance",      "first_x",      "first_y",
                "first_z",         "second_x",     "second_y",      "second_z",     "relative_speed",
                "first_before",    "first_after",  "second_before", "second_after", "samples_apart_s"}));
  const auto expect_row = [&](std::size_t row, double begin, double end,
                              const std::vector<std::string>& others) {
    EXPECT_NEAR(std::stod(rows[row][0]), begin, 1e-7);
    EXPECT_NEAR(std::stod(rows[row][1]), end, 1e-7);
    EXPECT_EQ(std::vector<std::string>(rows[row].begin() + 2, rows[row].begin() + 6), others);
  };
  expect_row(1, 0.0, std::sqrt(3.0), {"ann", "cy", "true", "false"});
  expect_row(2, 4.0, 6.0, {"ann", "bob", "false", "false"});
  expect_row(3, 10.0 - std::sqrt(3.0), 10.0, {"bob", "cy", "false", "true"});
  for (const char* label : {"format", "tracks", "samples", "approaches", "probes", "verdict"}) {
    EXPECT_EQ(lines_with(result.out, std::string(label) + " "), 1u) << label << "\n" << result.out;
  }
}

TEST_F(ProgramTest, ShowsTheClosestApproaches) {
  const ProgramRun result = run("tracks " + write("t.csv", meeting) + " --distance 2");
  EXPECT_EQ(result.exit_code, 0);
  const auto closest = result.out.find("ann bob");
  EXPECT_NE(closest, std::string::npos) << result.out;
  EXPECT_LT(closest, result.out.find("ann cy")) << result.out;
}

TEST_F(ProgramTest, TellsWhereTracksCameClosest) {
  run("tracks " + write("t.csv", meeting) + " --distance 2 --contacts " + path("a.csv"));
  const auto rows = rows_of(read_text(path("a.csv")));
  ASSERT_EQ(rows.size(), 4u);
  const auto numbers = [&](std::size_t row) {
    std::vector<double> values;
    for (std::size_t column = 6; column < 15; ++column)
      values.push_back(rows[row][column].empty() ? -1.0 : std::stod(rows[row][column]));
    return values;
  };
  // Time, distance, places without z, and relative speed.
  const auto expect_near = [](const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9) << k;
  };
  expect_near(numbers(1), {0, 1, 0, 0, -1, 0, 1, -1, 1});
  expect_near(numbers(2), {5, 0, 5, 0, -1, 5, 0, -1, 2});
  expect_near(numbers(3), {10, 1, 0, 0, -1, 0, 1, -1, 1});
}

TEST_F(ProgramTest, SaysUnitsInNamesOfColumnsWhereTheyAreKnown) {
  const auto header_of = [this](const std::string& text, const std::string& option) {
    const ProgramRun result =
        run("tracks " + write("t.csv", text) + " --distance 2 --quiet " + option + " " + path("o.csv"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return rows_of(read_text(path("o.csv"))).at(0);
  };
  const std::string in_feet = "id,time,x_ft,y_ft\na,0,0,0\na,5,1,0\nb,0,2,0\nb,5,2,0\n";
  // The program itself reads these units.
  int lengths = 0, speeds = 0;
  for (const char* option : {"--contacts", "--minima"}) {
    for (const std::string& name : header_of(in_feet, option)) {
      lengths += unit_in_name(name, Measure::length) == "m" ? 1 : 0;
      speeds += unit_in_name(name, Measure::speed) == "mps" ? 1 : 0;
    }
  }
  EXPECT_EQ(lengths, 2 + 3 + 6);
  EXPECT_EQ(speeds, 2 + 3 + 6);
  EXPECT_EQ(header_of(in_feet, "--pairs"),
            (std::vector<std::string>{"first", "second", "approaches", "duration_s", "least_distance_m",
                                      "closest_time"}));
  EXPECT_EQ(header_of(std::string(meeting), "--pairs").at(4), "least_distance");
}

TEST_F(ProgramTest, SumsUpPairsOfTracks) {
  const std::string twice =
      "id,time,x,y\na,0,0,0\na,10,0,0\na,20,0,0\nb,0,-5,1\nb,10,5,1\nb,20,-5,1\nc,0,0,1.5\nc,20,0,1.5\n";
  const ProgramRun result =
      run("tracks " + write("t.csv", twice) + " --interpolate linear --max-gap 100 --distance 1.2 --pairs " +
          path("p.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = rows_of(read_text(path("p.csv")));
  ASSERT_EQ(rows.size(), 3u) << read_text(path("p.csv"));
  EXPECT_EQ(rows[0], (std::vector<std::string>{"first", "second", "approaches", "duration_s",
                                               "least_distance", "closest_time"}));
  EXPECT_EQ(rows[1][0] + rows[1][1], "bc");  // the closest first
  EXPECT_NEAR(std::stod(rows[1][4]), 0.5, 1e-9);
  EXPECT_EQ(rows[2][0] + rows[2][1], "ab");
  EXPECT_EQ(rows[2][2], "2");
  // Each approach ends at a gap of 4 to 5 tolerances, which are 1.2e-6 each; the gap grows by 0.55 a second
  // there.
  EXPECT_NEAR(std::stod(rows[2][3]), 4.0 * std::sqrt(1.2 * 1.2 - 1.0) + 2.0 * 4.5 * 1.2e-6 / 0.55, 4e-6);
  EXPECT_NEAR(std::stod(rows[2][4]), 1.0, 1e-9);
}

TEST_F(ProgramTest, WritesApproachesOnAMap) {
  const std::string ships =
      "id,time,lon,lat\na,0,8.00,54.0\na,600,8.02,54.0\nb,0,8.02,54.0001\nb,600,8.00,54.0001\n";
  const ProgramRun result = run("tracks " + write("s.csv", ships) +
                                " --positions lonlat --distance 100 --contacts " + path("a.geojson"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto map = nlohmann::json::parse(read_text(path("a.geojson")));
  EXPECT_EQ(map["type"], "FeatureCollection");
  ASSERT_EQ(map["features"].size(), 1u);
  const auto& feature = map["features"][0];
  EXPECT_EQ(feature["geometry"]["type"], "MultiPoint");
  EXPECT_NEAR(feature["geometry"]["coordinates"][0][0].get<double>(), 8.01, 1e-6);
  // A straight way of 1.3 km leaves its parallel for the pole by 5 cm.
  EXPECT_NEAR(feature["geometry"]["coordinates"][1][1].get<double>(), 54.0001 + 4.16e-7, 1e-8);
  EXPECT_EQ(feature["properties"]["first"], "a");
  EXPECT_NEAR(feature["properties"]["closest_time"].get<double>(), 300.0, 1e-3);
  EXPECT_NEAR(feature["properties"]["distance_m"].get<double>(), 11.13, 0.02);
  expect_wrong_input("tracks " + write("t.csv", meeting) + " --distance 2 --contacts " + path("b.geojson"),
                     {"b.geojson", "--positions lonlat"});
}

TEST_F(ProgramTest, DrawsApproaches) {
  const std::string file = write("t.csv", meeting);
  ASSERT_EQ(run("tracks " + file + " --distance 2 --quiet --plot " + path("a.svg")).exit_code, 0);
  const std::string svg = read_text(path("a.svg"));
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg;
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (const char* text : {"3 tracks, 3 approaches closer than 2<", "time from the closest approach (s)",
                           "distance (unit of the file)", "ann and bob<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  // The ways of a pair have its colour, as its curve and its ring have.
  std::size_t of_first_pair = 0;
  for (std::size_t at = 0; (at = svg.find("stroke=\"#d55e00\"", at)) != std::string::npos; ++at)
    ++of_first_pair;
  EXPECT_EQ(of_first_pair, 5u);
  const std::string dated =
      write("dated.csv",
            "id,time,x_km,y_km\na,2026-05-01T09:59:50Z,0,0\na,2026-05-01T10:00:10Z,1,0\n"
            "b,2026-05-01T09:59:50Z,1,0.001\nb,2026-05-01T10:00:10Z,0,0.001\n");
  ASSERT_EQ(run("tracks " + dated + " --distance 100 --quiet --plot " + path("d.svg")).exit_code, 0);
  const std::string with_clock = read_text(path("d.svg"));
  for (const char* text :
       {"2 tracks, 1 approach closer than 100 m<", "x (km)", "distance (m)", "1 m at 2026-05-01 10:00:00Z<"})
    EXPECT_NE(with_clock.find(text), std::string::npos) << text << "\n" << with_clock;
  // No track is near another, and none moves.
  const std::string still = write("u.csv", "id,time,x,y\na,0,1,1\na,1,1,1\n");
  ASSERT_EQ(run("tracks " + still + " --distance 2 --quiet --plot " + path("b.svg")).exit_code, 0);
  EXPECT_NE(read_text(path("b.svg")).find("No approaches."), std::string::npos);
  expect_wrong_input("tracks " + file + " --distance 2 --plot " + path("a.png"), {"a.png", ".svg"});
  expect_wrong_input(
      "tracks " + file + " --distance 2 --plot " + path("c.svg") + " --contacts " + path("c.svg"), {"c.svg"});
}

TEST_F(ProgramTest, DrawsARun) {
  const std::string scene = write("s.json", small_scene);
  const ProgramRun result = run("run " + scene + " --plot " + path("a.svg"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = read_text(path("a.svg"));
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  const std::string contacts = result.out.substr(result.out.find("contacts") + 18, 9);
  const std::string count = contacts.substr(0, contacts.find(' '));
  EXPECT_NE(svg.find(": " + count + " contact"), std::string::npos) << count;
  for (const char* text : {"Contacts in a second", "time (s)", "approach speed (length / s)", "of walls"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const std::string nothing =
      write("n.json", R"({"bodies": 1, "seconds": 0, "box": [[0, 0, 0], [9, 9, 9]]})");
  ASSERT_EQ(run("run " + nothing + " --quiet --plot " + path("n.svg")).exit_code, 0);
  EXPECT_NE(read_text(path("n.svg")).find(": 0 contacts<"), std::string::npos);
  EXPECT_EQ(read_text(path("n.svg")).find("nan"), std::string::npos);
  expect_wrong_input("run " + scene + " --plot " + path("a.png"), {"a.png", ".svg"});
  expect_wrong_input("run " + scene + " --plot " + path("b.svg") + " --contacts " + path("b.svg"), {"b.svg"});
}

TEST_F(ProgramTest, RefusesWrongTracks) {
  const std::string file = write("t.csv", "id,time,x,y\na,0,0,0\na,1,zero,0\n");
  expect_wrong_input("tracks " + file + " --distance 1", {"t.csv:3:", "column 3", "zero"});
  expect_wrong_input("tracks nowhere.csv --distance 1", {"nowhere.csv", "No such file"});
  expect_wrong_input("tracks " + file + " --distance 0", {"--distance", "> 0"});
  expect_wrong_input("tracks " + write("good.csv", meeting) + " --distance 0.1 --tolerance 0.2",
                     {"--tolerance", "0.1"});
  expect_wrong_input("tracks " + file + " --distance 1 --columns id=1", {"--columns", "time="});
  expect_wrong_input("tracks " + file + " --distance 1 --max-gap -1", {"--max-gap"});
}

class TracksOfRecording : public ProgramTest,
                          public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(TracksOfRecording, AgreesWithTheOracle) {
  const std::string file = recorded_file(GetParam().first);
  if (file.empty()) GTEST_SKIP() << "no recording " << GetParam().first << " (see KINESPHERE_DATA)";
  const std::string format = file.find("obsmat") == std::string::npos ? "" : " --format ucy";
  const ProgramRun result = run("tracks '" + file + "' --verify --distance " + GetParam().second + format);
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("detector and oracle agree"), std::string::npos) << result.out;
}

INSTANTIATE_TEST_SUITE_P(All, TracksOfRecording,
                         ::testing::Values(std::pair{"ucy_students03/ucy_students03_obsmat.txt.gz", "0.4"},
                                           std::pair{"ucy_students03/ucy_students03_obsmat.txt.gz", "0.6"},
                                           std::pair{"pedpy_bottleneck/pedpy_bottleneck_040_c_56_h-.txt.gz",
                                                     "0.3"},
                                           std::pair{"mosquito3d/anopheles_swarm_splined.csv.gz", "0.03"},
                                           std::pair{"mosquito3d/anopheles_swarm_splined.csv.gz", "0.1"}),
                         [](const auto& each) {
                           std::string name = each.param.first;
                           name.resize(name.find('/'));
                           std::string distance = each.param.second;
                           std::replace(distance.begin(), distance.end(), '.', '_');
                           return name + "_" + distance;
                         });

}  // namespace
}  // namespace kinesphere::program::program_test
