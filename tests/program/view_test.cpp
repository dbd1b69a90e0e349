// `kinesphere view`: the served content, access to it, and its end.
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "program/support.hpp"
#include "tracks/track_file.hpp"
#include "view/track_table.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>
#endif

namespace kinesphere::program::view_test {
namespace {

class View : public ProgramTest {
 protected:
  /// Makes a folder with a page.
  std::string viewer() const {
    std::filesystem::create_directory(path("viewer"));
    write("viewer/index.html", "<p>the page</p>");
    return path("viewer");
  }
  /// Makes a recording of a world of 20 bodies in a file of this name.
  std::string world_recording(const std::string& name) const {
    const std::string scene = write("scene.json", R"({
      "bodies": 20, "radius": [1, 5], "box": [[0, 0, 0], [60, 60, 60]], "seconds": 1, "response": "bounce" })");
    EXPECT_EQ(run("run " + scene + " --quiet --record '" + path(name) + "'").exit_code, 0);
    return path(name);
  }
  /// Expects that the program serves nothing, and ends as in expect_wrong_input().
  void expect_refused(const std::string& arguments, std::initializer_list<std::string_view> parts) const {
    expect_wrong_input("view --no-browser --folder '" + viewer() + "' " + arguments, parts, "timeout 10 ");
  }
};

/// Two people who walk side by side.
constexpr std::string_view walk = "id,t,x,y\nann,0,0,0\nann,1,0.5,0\nbob,0,0.1,3\nbob,1,0.7,3\n";

TEST_F(View, NeedsAPage) {
  expect_wrong_input("view --folder '" + path("nowhere") + "'",
                     {"--folder: expected a folder with index.html"});
  expect_wrong_input("view --port 70000", {"--port"});
}

TEST_F(View, RefusesFilesThatCannotBeRead) {
  expect_refused(path("none.csv"), {"none.csv", "cannot read"});
  expect_refused(path("viewer"), {"viewer", "it is a folder"});
  const std::string good = write("good.csv", walk);
  const std::string bad = write("bad.csv", std::string(walk) + "bob,2,east,3\n");
  expect_refused(bad, {"bad.csv:6: expected a number as x (column 3), but got 'east'"});
  expect_refused(good + " " + bad, {"bad.csv:6:"});
  expect_refused(good + " " + path("none.csv"), {"none.csv", "cannot read"});
  expect_refused(write("empty.csv", ""), {"empty.csv"});
  const std::string damaged = write("packed.csv.gz", std::string("\x1f\x8b\x08\0\0\0\0\0\0\3 no", 13));
  expect_refused(damaged, {"packed.csv.gz", "damaged gzip data"});
  expect_refused(write("far.csv", "id,t,x,y\nann,0,-1e308,0\nann,1,1e308,0\n"),
                 {"far.csv:2", "-1e+308 as x"});
}

TEST_F(View, RefusesRecordingsThatCannotBeShown) {
  const std::string first = world_recording("first.rec");
  const std::string second = world_recording("second.rec");
  const std::string table = write("walk.csv", walk);
  expect_refused(first + " " + second, {"first.rec", "no other file", "2 files"});
  expect_refused(table + " " + second, {"second.rec", "no other file"});
  const std::string whole = read_text(first);
  expect_refused(write("cut.rec", whole.substr(0, whole.size() / 2)), {"cut.rec", "must be whole"});
  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  expect_refused(write("damaged.rec", damaged), {"damaged.rec", "checksum"});
}

TEST_F(View, TakesOptionsAboutTablesWithTablesAlone) {
  const std::string table = write("walk.csv", walk);
  expect_refused("--format pedpy", {"--format", "no FILE"});
  expect_refused("--max-gap 3 " + world_recording("world.rec"), {"--max-gap", "world.rec"});
  expect_refused(table + " --format xml", {"--format", "pedpy", "'xml'"});
  expect_refused(table + " --columns id=1", {"--columns"});
  expect_refused(table + " --interpolate linear", {"--interpolate"});
  const std::string help = run("view --help").out;
  for (const char* part : {"[FILE...]", "run --record", "kinesphere tracks", "--frame-rate"})
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
}

TEST_F(View, SaysHowItIsBuilt) {
  const ProgramRun run =
      this->run("view --no-browser", "KINESPHERE_VIEWER='" + path("nowhere") + "' timeout 10 ");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find(path("nowhere")), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("cmake --preset browser"), std::string::npos) << run.err;
}

#ifdef KINESPHERE_WITH_HTTPLIB

/// A program that serves a folder until destruction.
class Served {
 public:
  /// `arguments` are shell text.
  explicit Served(const std::string& folder, const std::string& arguments = "") {
    const std::string command = std::string("echo $$; exec timeout 60 '") + KINESPHERE_PROGRAM +
                                "' view --no-browser --folder '" + folder + "' " + arguments;
    pipe_ = popen(command.c_str(), "r");
    char line[128];
    if (std::fgets(line, sizeof line, pipe_) != nullptr) process_ = std::stoi(line);
    if (std::fgets(line, sizeof line, pipe_) != nullptr) address_ = line;
    address_ = address_.substr(0, address_.find('\n'));
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() {
    if (pipe_ != nullptr) stop();
  }

  /// The printed address.
  const std::string& address() const { return address_; }
  int port() const { return std::stoi(address_.substr(address_.rfind(':') + 1)); }
  httplib::Client client() const { return httplib::Client("127.0.0.1", port()); }
  nlohmann::json json(const std::string& address) const {
    const auto answer = client().Get(address);
    if (!answer || answer->status != 200) return nlohmann::json("no answer");
    EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json");
    return nlohmann::json::parse(answer->body);
  }
  int status(const std::string& address, const httplib::Headers& headers = {}) const {
    const auto answer = client().Get(address, headers);
    return answer ? answer->status : 0;
  }
  /// Stops the program; returns the exit code.
  int stop() {
    kill(process_, SIGTERM);
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  FILE* pipe_ = nullptr;
  pid_t process_ = 0;
  std::string address_;
};

TEST_F(View, ServesTheFilesOfItsFolderAlone) {
  write("secret", "not for others");
  std::filesystem::create_directory(path("viewer"));
  write("viewer/index.html", "<p>the page</p>");
  write("viewer/kinesphere.wasm", "bytes");
  write("viewer/page.js", "let there = 'be light';");
  write("viewer/empty.js", "");
  Served served(path("viewer"));
  ASSERT_TRUE(served.address().starts_with("http://127.0.0.1:")) << served.address();
  auto client = served.client();
  const auto page = client.Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->body, "<p>the page</p>");
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html");
  EXPECT_NE(page->get_header_value("Content-Security-Policy").find("'wasm-unsafe-eval'"), std::string::npos);
  EXPECT_EQ(client.Get("/kinesphere.wasm")->get_header_value("Content-Type"), "application/wasm");
  const auto script = client.Get("/page.js", {{"Accept-Encoding", "gzip, br"}});
  EXPECT_EQ(script->body, "let there = 'be light';");
  EXPECT_EQ(script->get_header_value("Content-Encoding"), "") << "compressing takes longer than reading";
  EXPECT_EQ(script->get_header_value_count("Content-Type"), 1u);
  EXPECT_EQ(script->get_header_value("Content-Type"), "text/javascript");
  EXPECT_EQ(client.Get("/empty.js")->status, 200);
  EXPECT_EQ(client.Get("/nothing")->status, 404);
  for (const char* const outside : {"/../secret", "/%2e%2e/secret", "/x/../../secret"})
    EXPECT_EQ(client.Get(outside)->status, 404) << outside;
  EXPECT_EQ(client.Get("/", {{"Host", "example.org"}})->status, 403);
  EXPECT_EQ(client.Get("/", {{"Host", "localhost:" + std::to_string(served.port())}})->status, 200);
  expect_wrong_input(
      "view --no-browser --folder '" + path("viewer") + "' --port " + std::to_string(served.port()),
      {"--port: expected a port of 127.0.0.1 that is free"});
  EXPECT_EQ(served.stop(), 0);
}

/// Ranges beyond a file or a table return the whole content.
TEST_F(View, ServesWholeContentsWhateverRangeIsAskedFor) {
  const Served served(viewer(), write("walk.csv", walk));
  for (const char* const address : {"/", "/opened/tracks.json", "/opened/files.json"}) {
    const std::string whole = served.client().Get(address)->body;
    for (const char* const range :
         {"bytes=1000-4000", "bytes=0-4000", "bytes=-4000", "bytes=3-1", "bytes=0-1,9-4000"})
      EXPECT_EQ(served.client().Get(address, {{"Range", range}})->body, whole) << address << range;
  }
}

TEST_F(View, TellsThatNoFileIsOpen) {
  const Served served(viewer());
  EXPECT_TRUE(served.address().ends_with("/")) << served.address();
  EXPECT_EQ(served.json("/opened/files.json"), R"({"recording": null, "tracks": null})"_json);
  for (const char* const address :
       {"/opened", "/opened/recording", "/opened/tracks.json", "/opened/files-json"})
    EXPECT_EQ(served.status(address), 404) << address;
}

TEST_F(View, ServesARecordingByteForByte) {
  const std::string file = world_recording("a \"world\".rec");
  const std::string recording = "'" + file + "'";
  const std::string bytes = read_text(file);
  const Served served(viewer(), recording);
  EXPECT_TRUE(served.address().ends_with("/#opened")) << served.address();
  EXPECT_EQ(served.json("/opened/files.json"), R"({"recording": "a \"world\".rec", "tracks": null})"_json);
  const auto answer = served.client().Get("/opened/recording");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/octet-stream");
  EXPECT_TRUE(answer->body == bytes);
  EXPECT_EQ(served.status("/opened/tracks.json"), 404);

  ASSERT_EQ(run_shell("gzip -c " + recording + " >'" + path("packed") + "'").exit_code, 0);
  const Served unpacked(viewer(), "'" + path("packed") + "'");
  EXPECT_TRUE(unpacked.client().Get("/opened/recording")->body == bytes);
}

TEST_F(View, ServesTables) {
  const std::string file = write("crowd.txt",
                                 "# framerate: 25 fps\n# id frame x/m y/m z/m\n"
                                 "7 0 0.1 -2.5 1.8\n12 26 1.0000000000000002 4 1.7\n"
                                 "7 1 0.30000000000000004 -2.75 1.8\n12 27 -1e-17 4.5 1.7\n");
  const Served served(viewer(), file);
  EXPECT_EQ(served.json("/opened/files.json"), R"({"recording": null, "tracks": "crowd.txt"})"_json);
  EXPECT_EQ(served.json("/opened/tracks.json"), R"({
    "name": "crowd.txt", "plane": true, "unit": "m", "tracks": [
      {"id": "7", "times": [0, 0.04], "positions": [0.1, -2.5, 0, 0.30000000000000004, -2.75, 0]},
      {"id": "12", "times": [1.04, 1.08], "positions": [1.0000000000000002, 4, 0, -1e-17, 4.5, 0]}]})"_json);
  EXPECT_EQ(served.status("/opened/recording"), 404);
}

TEST_F(View, ReadsTablesAsItsOptionsSay) {
  const std::string first =
      write("first.csv", "who,frame,x,y,z\nann,0,1,2,3\nbob,0,0,0,0\nann,1,2,2,3\nbob,1,0,0,1\n");
  const std::string second = write("second.csv", "who,frame,x,y,z\nann,20,5,5,5\nann,21,5,5,6\n");
  const Served served(viewer(),
                      first + " " + second + " --columns id=who,time=frame,x=x,y=y,z=z --frame-rate 10");
  EXPECT_EQ(served.json("/opened/files.json")["tracks"], "first.csv and 1 more");
  EXPECT_EQ(served.json("/opened/tracks.json"), R"({
    "name": "first.csv and 1 more", "plane": false, "unit": null, "tracks": [
      {"id": "ann", "times": [0, 0.1], "positions": [1, 2, 3, 2, 2, 3]},
      {"id": "ann", "times": [2, 2.1], "positions": [5, 5, 5, 5, 5, 6]},
      {"id": "bob", "times": [0, 0.1], "positions": [0, 0, 0, 0, 0, 1]}]})"_json);
}

TEST_F(View, ReadsStandardInputAndWarnsOfWhatIsLeftOut) {
  const std::string file = write("t.csv", std::string(walk) + "bob,,1,1\n");
  const Served served(viewer(), "- --missing skip <'" + file + "' 2>'" + path("warnings") + "'");
  EXPECT_EQ(served.json("/opened/tracks.json")["name"], "standard input");
  EXPECT_EQ(read_text(path("warnings")),
            "kinesphere: warning: 1 of 5 rows (20 %) have no time or no position\n");
}

/// The table is longer than the pieces in which it is sent; compression would take as long as reading.
TEST_F(View, HandsOverLongTablesAsTheyAre) {
  std::string text = "id,t,x,y\n";
  for (int k = 0; k < 60'000; ++k) text += "ann," + std::to_string(k) + ",0.12345678901234568,0\n";
  const Served served(viewer(), write("long.csv", text));
  const auto answer = served.client().Get("/opened/tracks.json", {{"Accept-Encoding", "gzip, br"}});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->get_header_value("Content-Encoding"), "");
  EXPECT_GT(answer->body.size(), std::size_t{1} << 20);
  EXPECT_TRUE(answer->body == track_table(parse_tracks({{"long.csv", text}}, {}), "long.csv"));
}

TEST_F(View, ShowsOpenedFilesToNobodyElse) {
  const std::string address[] = {"/opened/files.json", "/opened/recording", "/opened/tracks.json"};
  const Served recording(viewer(), world_recording("world.rec"));
  const Served tracks(viewer(), write("walk.csv", walk));
  for (const Served* const served : {&recording, &tracks}) {
    for (const std::string& each : address) {
      const auto foreign = served->client().Get(each, {{"Host", "example.org"}});
      ASSERT_TRUE(foreign) << each;
      EXPECT_EQ(foreign->status, 403) << each;
      EXPECT_EQ(foreign->body, "") << each;
      const bool is_there = each == address[0] || each == address[served == &recording ? 1 : 2];
      EXPECT_EQ(served->status(each, {{"Host", "localhost:" + std::to_string(served->port())}}),
                is_there ? 200 : 404)
          << each;
    }
  }
}

#endif

}  // namespace
}  // namespace kinesphere::program::view_test
