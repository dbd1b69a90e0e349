// A watch that is stopped or killed continues from its snapshot, and emits every alert once; several watches
// that share the pairs emit together the alerts of one.
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "program/watch/crossing_tracks.hpp"
#include "program/watch/live_watch.hpp"
#include "watch/watch_snapshot.hpp"

namespace kinesphere::program::watch_snapshot_test {
namespace {

using Json = nlohmann::json;

/// Compares long texts; a failure shows the first different line.
void expect_same_lines(const std::string& text, const std::string& expected) {
  std::istringstream lines(text), expected_lines(expected);
  std::string line, expected_line;
  for (int k = 1;; ++k) {
    const bool more = static_cast<bool>(std::getline(lines, line));
    ASSERT_EQ(more, static_cast<bool>(std::getline(expected_lines, expected_line))) << "line " << k;
    if (!more) return;
    ASSERT_EQ(line, expected_line) << "line " << k;
  }
}

class WatchRestart : public ProgramTest {
 protected:
  std::string run_whole(const std::string& stream, const std::string& options) {
    const ProgramRun result = run("watch " + stream + options + " --quiet --alerts '" + path("whole.jsonl") +
                                  "' --summary '" + path("whole.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    return read_text(path("whole.jsonl"));
  }
  Json summary(const std::string& name) const {
    Json json = Json::parse(read_text(path(name)));
    json.erase("real_seconds");
    return json;
  }
  void expect_shares_to_tell_all(const std::string& text);
  void expect_the_same_when_it_grows(const std::string& text, const std::string& options, int parts);
  /// Kills the watch again and again until it has reached the end.
  void expect_the_same_when_killed(const std::string& stream, const std::string& options, int seed) {
    SCOPED_TRACE(stream + ", seed " + std::to_string(seed));
    const std::string whole = run_whole(stream, options);
    EXPECT_GT(std::count(whole.begin(), whole.end(), '\n'), 300);
    Random random(static_cast<std::uint64_t>(seed));
    int killed = 0;
    for (bool has_ended = false; !has_ended;) {
      LiveWatch live(stream + options + " --quiet --snapshot '" + path("state") +
                         "' --snapshot-every 3ms --alerts '" + path("parts.jsonl") + "' --summary '" +
                         path("parts.json") + "'",
                     path("err"));
      // The time limit grows with each kill, so that a slow machine reaches the end, too.
      const double longest = 40.0 + 20.0 * killed;
      std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(random.uniform(10.0, longest))));
      live.signal(SIGKILL);
      has_ended = live.wait() == 0;
      killed += has_ended ? 0 : 1;
      EXPECT_EQ(live.err(), "");
    }
    EXPECT_GE(killed, 3) << "the stream was too short";
    expect_same_lines(read_text(path("parts.jsonl")), whole);
    EXPECT_EQ(summary("parts.json"), summary("whole.json"));
    EXPECT_FALSE(std::filesystem::exists(path("state.unfinished")));
    std::filesystem::remove(path("state"));
  }
};

TEST_F(WatchRestart, KilledAtAnyMomentItTellsEverythingOnce) {
  const std::string timing = " --silence 3 --forget 8 --leap 60 ";
  expect_the_same_when_killed(write("s.jsonl", stream_of(json_line, 15000)),
                              crossing_promises + crossing_errors + " --only all" + timing, 1);
  write("s.csv", "id,time,x,y,z,vx,vy,vz\n" + stream_of(csv_line, 15000));
  ASSERT_EQ(std::system(("gzip -k '" + path("s.csv") + "'").c_str()), 0);
  expect_the_same_when_killed(path("s.csv.gz"), crossing_promises + crossing_errors + timing, 3);
  expect_the_same_when_killed(write("s.sbs", stream_of(sbs_lines, 15000)),
                              " --separation sphere:500m --position-error 10:10 --clock stamps" + timing, 4);
}

/// Appends parts of the text; each time but the last the final line is incomplete.
void WatchRestart::expect_the_same_when_it_grows(const std::string& text, const std::string& options,
                                                 int parts) {
  const std::string whole = run_whole(write("s", text), options);
  const std::string kept_in =
      " --quiet --snapshot '" + path("state") + "' --alerts '" + path("parts.jsonl") + "'";
  // The last time has no new input: no alert is repeated.
  for (int part = 1; part <= parts + 1; ++part) {
    const double size = static_cast<double>(text.size()) * std::min(part, parts) / parts;
    write("s", text.substr(0, static_cast<std::size_t>(size)));
    const ProgramRun result = run("watch " + path("s") + options + kept_in);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  expect_same_lines(read_text(path("parts.jsonl")), whole);
  std::filesystem::remove(path("state"));
}

TEST_F(WatchRestart, GoesOnWithAFileThatHasGrown) {
  const std::string timing = " --silence 3 --forget 8 ";
  expect_the_same_when_it_grows(stream_of(json_line, 8000), crossing_promises + crossing_errors + timing, 5);
  // Ids that change while the program is away.
  expect_the_same_when_it_grows(
      stream_of(changing_line, 8000),
      crossing_promises + crossing_errors + " --only within,predicted,lost,tracks" + timing, 25);
  EXPECT_GT(summary("whole.json")["handovers"], 100);
  EXPECT_GT(summary("whole.json")["one_bodies"], 5);
  EXPECT_GT(summary("whole.json")["held_back_of_one_body"], 100);
  // Tracks that violate their limits: each may be at several places.
  expect_the_same_when_it_grows(stream_of(sbs_lines, 15000),
                                " --separation sphere:500m --position-error 10:10 --clock stamps" + timing,
                                40);
}

TEST_F(WatchRestart, GoesOnWithWhatComesThroughAPipe) {
  const std::string text = "id,time,x,y,z,vx,vy,vz\n" + stream_of(csv_line, 8000);
  const std::string options = crossing_promises + crossing_errors;
  const ProgramRun whole = run("watch --quiet" + options, "cat '" + write("s", text) + "' | ");
  const std::size_t middle = text.find('\n', text.size() / 2) + 1;
  std::string parts;
  for (const std::string& part : {text.substr(0, middle), text.substr(middle)}) {
    const ProgramRun result = run("watch --quiet --snapshot '" + path("state") + "'" + options,
                                  "cat '" + write("s", part) + "' | ");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    parts += result.out;
  }
  expect_same_lines(parts, whole.out);
  // Other reports from elsewhere: the tracks are known from before.
  const ProgramRun other = run("watch --quiet --snapshot '" + path("state") + "'" + options + path("s"));
  EXPECT_EQ(other.exit_code, 2);
}

TEST_F(WatchRestart, TakesTracksAlongToAnotherStream) {
  const std::string first = write("first.csv", "id,time,x,y,z,vx,vy,vz\n" + stream_of(csv_line, 2000));
  const std::string options = crossing_promises + crossing_errors + " --snapshot '" + path("state") +
                              "' --summary '" + path("sum") + "' ";
  ASSERT_EQ(run("watch " + first + options).exit_code, 0);
  const Json before = summary("sum");
  // The second run gets other columns.
  const std::string second =
      write("second.csv", "time,id,x,y,z,vx,vy,vz\n18.001,t3,1,2,0,0,0,0\n18.002,t3,1,2,0,0,0,0\n");
  const ProgramRun result = run("watch " + second + options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(summary("sum")["reports"], before["reports"].get<int>() + 2);
  EXPECT_EQ(summary("sum")["contradictions"], before["contradictions"].get<int>() + 1)
      << "t3 was elsewhere in the first";
}

TEST_F(WatchRestart, RefusesWhatItCannotGoOnFrom) {
  const std::string text = stream_of(json_line, 2000);
  const std::string stream = write("s.jsonl", text);
  const std::string kept_in = " --snapshot '" + path("state") + "' --alerts '" + path("alerts") + "' ";
  ASSERT_EQ(run("watch " + stream + crossing_promises + crossing_errors + kept_in).exit_code, 0);
  const std::string alerts = read_text(path("alerts")), state = read_text(path("state"));
  expect_wrong_input("watch " + stream +
                         " --separation sphere:12 --separation cylinder:9:2 --acceleration 5" +
                         crossing_errors + kept_in,
                     {"--separation", "cylinder:9:1", "cylinder:9:2", path("state")});
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in + "--silence 4",
                     {"--silence", "not given", "'4'"});
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in + "--format csv",
                     {"--format", "jsonl", "csv"});
  write("s.jsonl", "{" + text);
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in,
                     {stream, "are others"});
  write("s.jsonl", text.substr(0, 1000));
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in,
                     {stream, "are others"});
  write("s.jsonl", text);
  write("alerts", alerts.substr(0, 100));
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in,
                     {path("alerts"), "100"});
  write("alerts", alerts);
  Random random(3);
  for (int k = 0; k < 30; ++k) {
    std::string damaged = state;
    const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(state.size())));
    if (k % 2 == 0)
      damaged.resize(at);
    else
      damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write("state", damaged);
    expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + kept_in,
                       {path("state"), "expected a snapshot"});
  }
  EXPECT_TRUE(read_text(path("alerts")) == alerts) << "nothing was changed by any of these";
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + " --snapshot " + stream,
                     {"--snapshot"});
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + " --alerts " + stream,
                     {"--alerts"});
  expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + " --alerts /dev/full",
                     {"--alerts", "/dev/full"});
  for (const std::string& wrong : {path("."), std::string("/dev/full")})
    expect_wrong_input("watch " + stream + crossing_promises + crossing_errors + " --snapshot " + wrong,
                       {"--snapshot", wrong});
  expect_wrong_input(
      "watch " + stream + crossing_promises + crossing_errors + " --snapshot-every 0s --snapshot x",
      {"--snapshot-every"});
}

TEST_F(WatchRestart, LeavesAlertsAsTheyAreWhenItRefuses) {
  const std::string text = stream_of(json_line, 2000);
  const std::string stream = write("s.jsonl", text), options = crossing_promises + crossing_errors;
  const std::string alerts = " --alerts '" + path("alerts") + "'",
                    kept_in = " --snapshot '" + path("state") + "'";
  write("alerts", "precious\n");
  expect_wrong_input("watch " + stream + " --separation sphere:a --acceleration 5" + alerts,
                     {"--separation"});
  expect_wrong_input("watch " + stream + options + alerts + " --snapshot-every 0s", {"--snapshot-every"});
  expect_wrong_input("watch " + stream + options + alerts + " --summary /nowhere/sum", {"/nowhere/sum"});
  EXPECT_EQ(read_text(path("alerts")), "precious\n");
  // Other alerts than those of the snapshot's run.
  ASSERT_EQ(run("watch --quiet " + stream + options + kept_in + alerts).exit_code, 0);
  std::string changed = read_text(path("alerts"));
  const std::string reported = changed;
  changed[changed.size() - 5] = '#';
  write("alerts", changed);
  expect_wrong_input("watch " + stream + options + kept_in + alerts, {path("alerts"), "are others"});
  EXPECT_TRUE(read_text(path("alerts")) == changed);
  write("other", "precious\n");
  expect_wrong_input("watch " + stream + options + kept_in + " --alerts '" + path("other") + "'",
                     {"--alerts", path("other"), "something else"});
  EXPECT_EQ(read_text(path("other")), "precious\n");
  // A renamed file is recognised, and another file is begun.
  write("alerts", reported);
  ASSERT_EQ(std::system(("cp '" + path("alerts") + "' '" + path("copy") + "'").c_str()), 0);
  for (const std::string& name : {path("./alerts"), path("copy")})
    EXPECT_EQ(run("watch --quiet " + stream + options + kept_in + " --alerts '" + name + "'").exit_code, 0);
  EXPECT_TRUE(read_text(path("alerts")) == reported);
  EXPECT_TRUE(read_text(path("copy")) == reported);
  EXPECT_EQ(run("watch --quiet " + stream + options + kept_in + " --alerts '" + path("new") + "'").exit_code,
            0);
  EXPECT_EQ(read_text(path("new")), "");
}

TEST_F(WatchRestart, TwoDoNotWriteToOneFileOfAlerts) {
  const std::string options = crossing_promises + crossing_errors + " --alerts '" + path("alerts") + "'";
  LiveWatch first("--quiet --format jsonl" + options, path("err"));
  first.write(stream_of(json_line, 300));
  for (int k = 0; k < 500 && read_text(path("alerts")).empty(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  expect_wrong_input("watch " + write("s.jsonl", stream_of(json_line, 300)) + options,
                     {path("alerts"), "another program"});
  first.end_input();
  EXPECT_EQ(first.wait(), 0);
  EXPECT_NE(read_text(path("alerts")), "");
}

/// Input through a pipe does not come again, so its alerts stay.
TEST_F(WatchRestart, KeepsWhatWasToldOfAPipe) {
  const std::string text = stream_of(json_line, 4000);
  const std::size_t middle = text.find('\n', text.size() / 2) + 1;
  const std::string arguments = "--quiet" + crossing_promises + crossing_errors + " --alerts '" +
                                path("alerts") + "' --snapshot '" + path("state") + "' --snapshot-every 1h";
  LiveWatch killed(arguments, path("err"));
  std::istringstream lines(text.substr(0, middle));
  for (std::string line; std::getline(lines, line);) killed.write(line + "\n");
  std::string reported;
  const auto count = [&] { return std::count(reported.begin(), reported.end(), '\n'); };
  for (int k = 0; k < 500 && (count() < 100 || reported != read_text(path("alerts"))); ++k) {
    reported = read_text(path("alerts"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  killed.signal(SIGKILL);
  killed.wait();
  EXPECT_GT(count(), 100);
  // The run was interrupted during a write.
  write("alerts", reported + "{\"event\": \"ver");
  const ProgramRun later = run("watch " + arguments, "cat '" + write("rest", text.substr(middle)) + "' | ");
  EXPECT_EQ(later.exit_code, 0) << later.err;
  const std::string all = read_text(path("alerts"));
  EXPECT_EQ(all.substr(0, reported.size()), reported);
  EXPECT_GT(all.size(), reported.size() + 1000);
  std::istringstream alerts(all);
  for (std::string line; std::getline(alerts, line);) EXPECT_TRUE(Json::accept(line)) << line;
}

/// A watch that is stopped before any input knows no format, and needs no options of one.
TEST_F(WatchRestart, StoppedBeforeTheFirstLineItKeepsNothing) {
  for (const char* beginning : {"", "{\"id\": \"t1\", \"sta"}) {
    LiveWatch live(
        "--separation sphere:50 --snapshot '" + path("state") + "' --summary '" + path("sum") + "'",
        path("err"));
    live.write(beginning);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    live.signal(SIGTERM);
    EXPECT_EQ(live.wait(), 0) << live.err();
    EXPECT_FALSE(std::filesystem::exists(path("state")));
    EXPECT_EQ(summary("sum")["format"], "unknown");
  }
}

TEST_F(WatchRestart, RefusesAnotherPackedFile) {
  const std::string table = "id,time,x,y,z,vx,vy,vz\n" + stream_of(csv_line, 2000);
  const std::string arguments = "watch --quiet " + path("s.csv.gz") + crossing_promises + crossing_errors +
                                " --snapshot '" + path("state") + "'";
  const auto pack = [&](const std::string& text) {
    write("s.csv", text);
    ASSERT_EQ(std::system(("gzip -kf '" + path("s.csv") + "'").c_str()), 0);
  };
  pack(table);
  ASSERT_EQ(run(arguments).exit_code, 0);
  std::string other = table;
  other[100] = other[100] == '1' ? '2' : '1';
  pack(other);
  expect_wrong_input(arguments, {path("s.csv.gz"), "are others"});
  pack(table.substr(0, table.size() / 2));
  expect_wrong_input(arguments, {path("s.csv.gz"), "are others"});
  pack(table);
  EXPECT_EQ(run(arguments).exit_code, 0);
}

/// At most the bytes that were read of a file are skipped, if it is on standard input.
TEST_F(WatchRestart, ReadsAFileBehindAPipeFromItsBegin) {
  const std::string text = stream_of(json_line, 2000);
  const std::size_t middle = text.find('\n', text.size() / 2) + 1;
  const std::string arguments = "watch --quiet" + crossing_promises + crossing_errors + " --snapshot '" +
                                path("state") + "' --summary '" + path("sum") + "'";
  const std::string rest = write("rest", text.substr(middle));
  ASSERT_EQ(run(arguments, "cat '" + write("first", text.substr(0, middle)) + "' | ").exit_code, 0);
  const int first = summary("sum")["reports"];
  ASSERT_EQ(run_shell("'" KINESPHERE_PROGRAM "' " + arguments + " <'" + rest + "'").exit_code, 0);
  EXPECT_GT(summary("sum")["reports"].get<int>(), 3 * first / 2);
  // The caller may have read some of it.
  const ProgramRun behind =
      run_shell("{ read first; '" KINESPHERE_PROGRAM "' " + arguments + "; } <'" + rest + "'");
  EXPECT_EQ(behind.exit_code, 0) << behind.err;
}

TEST_F(WatchRestart, SaysAtOnceThatItCannotKeepASnapshot) {
  LiveWatch live("--quiet" + crossing_promises + crossing_errors +
                     " --snapshot-every 1h --snapshot /nowhere/state --alerts '" + path("alerts") + "'",
                 path("err"));
  live.write(stream_of(json_line, 300));
  EXPECT_EQ(live.wait(), 2);
  EXPECT_NE(live.err().find("/nowhere/state"), std::string::npos) << live.err();
}

/// Files with a correct checksum that hold no state of a watch.
TEST_F(WatchRestart, RefusesSoundFilesOfNonsense) {
  const std::string before = stream_of(changing_line, 3000), all = stream_of(changing_line, 3300);
  const std::string stream = write("s.jsonl", before);
  const std::string arguments =
      "watch " + stream + crossing_promises + crossing_errors + " --snapshot '" + path("state") + "'";
  ASSERT_EQ(run(arguments).exit_code, 0);
  const WatchSnapshot sound = read_snapshot(path("state")).value();
  const auto expect_refused = [&](const WatchSnapshot& wrong) {
    write_snapshot(path("state"), wrong);
    expect_wrong_input(arguments, {path("state"), "expected a snapshot"});
  };
  Random random(8);
  const auto size = static_cast<double>(sound.pipeline.size());
  for (int k = 0; k < 20; ++k) {
    WatchSnapshot wrong = sound;
    wrong.pipeline.resize(static_cast<std::size_t>(random.uniform(0.0, size)));
    expect_refused(wrong);
  }
  WatchSnapshot longer = sound, other_memory = sound;
  longer.pipeline.push_back({});
  expect_refused(longer);
  other_memory.reader.memory = {std::byte{0xff}};
  expect_refused(other_memory);
  // Another number changes the state, or is refused; it is never the end of the program.
  write("s.jsonl", all);
  for (int k = 0; k < 60; ++k) {
    WatchSnapshot wrong = sound;
    const auto place = static_cast<std::size_t>(random.uniform(0.0, size));
    wrong.pipeline[place] ^= std::byte{0x41};
    write_snapshot(path("state"), wrong);
    const int code = run(arguments).exit_code;
    EXPECT_TRUE(code == 0 || code == 2) << "byte " << place << ", exit code " << code;
  }
}

TEST_F(WatchRestart, RefusesSnapshotsOfOtherVersionsByName) {
  const std::string arguments = "watch " + write("s.jsonl", stream_of(json_line, 300)) + crossing_promises +
                                crossing_errors + " --snapshot '" + path("state") + "'";
  write("state", "kinesphere watch snapshot 13\n0000000000000004 00000000\nabcd");
  expect_wrong_input(arguments, {path("state"), "expected a snapshot of this version of kinesphere watch"});
  std::filesystem::remove(path("state"));
  ASSERT_EQ(run(arguments).exit_code, 0);
  std::string state = read_text(path("state"));
  ++state[8];
  write("state", state);
  expect_wrong_input(arguments,
                     {path("state"), "expected a snapshot of this version of kinesphere watch", "version"});
}

TEST_F(WatchRestart, SharesTellTogetherWhatOneTells) {
  for (const LineOf line : {json_line, changing_line}) expect_shares_to_tell_all(stream_of(line, 20000));
}

void WatchRestart::expect_shares_to_tell_all(const std::string& text) {
  const std::string stream =
      write("s.jsonl", text) + crossing_promises + crossing_errors + " --silence 3 --forget 8";
  const auto alerts_of = [&](std::initializer_list<const char*> shares) {
    AlertsByShare alerts;
    for (const std::string share : shares) {
      const ProgramRun result = run("watch --quiet " + stream + share);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      add_by_share(result.out, 8, alerts);
    }
    return alerts;
  };
  const AlertsByShare all = alerts_of({""});
  ASSERT_EQ(all.size(), 8u);
  EXPECT_TRUE(alerts_of({" --share 1-4/8", " --share 5-8/8"}) == all);
  EXPECT_TRUE(alerts_of({" --share 1-2/8", " --share 3/8", " --share 4-7/8", " --share 8/8"}) == all);
  for (const char* wrong : {"0/4", "5/4", "3-2/4", "1-5/4", "1", "1/", "/4", "a/b", "1.5/4", "1/99999"})
    expect_wrong_input("watch " + stream + " --share " + wrong, {"--share", std::string("'") + wrong + "'"});
}

}  // namespace
}  // namespace kinesphere::program::watch_snapshot_test
