// One body under two ids, ids of no interest, and one sender heard by two receivers.
#include "formats/ids/identities.hpp"

#include <fmt/format.h>

#include <cmath>

#include "program/support.hpp"
#include "tracks/handovers.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::identities_test {
namespace {

using IdentitiesTest = FolderTest;

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"t.csv", text}}, options);
}

/// A body that goes along x with this speed from `begin` on, a row each `interval` seconds.
std::string walk(const std::string& id, double begin, int rows, double x, double speed, double y = 0.0,
                 double interval = 0.1) {
  std::string text;
  for (int k = 0; k < rows; ++k)
    text += fmt::format("{},{:.6g},{},{}\n", id, begin + k * interval, x + speed * k * interval, y);
  return text;
}
constexpr std::string_view head = "id,time,x,y\n";

std::vector<std::string> handovers(const std::string& rows) {
  const TrackSet track_set = parse(std::string(head) + rows);
  std::vector<std::string> found;
  for (const Handover& handover : track_set.handovers)
    found.push_back(
        fmt::format("{}>{}", track_set.presences[handover.from].id, track_set.presences[handover.to].id));
  return found;
}

TEST(Handovers, AreWhereAndWhenAnotherEnds) {
  const std::vector<std::string> one{"a>b"};
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 4.5, 50, 4.5, 1, 0.01)), one) << "both for 0.4 s";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 4.8, 50, 4.8, 1, 0.01)), one)
      << "together for a while";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.0, 50, 5.0, 1)), one) << "one after the other";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.1, 50, 5.1, 1)), one) << "a row is missing";
  EXPECT_EQ(handovers(walk("b", 5.0, 50, 5.0, 1) + walk("a", 0, 50, 0, 1)), one)
      << "in any order of the file";
  EXPECT_EQ(handovers(walk("a", 0, 50, 3, 0) + walk("b", 5.0, 50, 3, 0)), one) << "at rest";
}

TEST(Handovers, AreNoneOfOthers) {
  const std::vector<std::string> none;
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 4.2, 50, 4.2, 1)), none) << "too early";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 6.0, 50, 6.0, 1)), none) << "too late";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.0, 50, 5.0, 1, 0.2)), none) << "beside it";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.0, 50, 5.0, -1)), none) << "the other way";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.0, 50, 5.0, 2)), none) << "twice as fast";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5.0, 50, 5.0, 1) + walk("c", 0, 99, 0, 1, 0.02)),
            none)
      << "a third one is there";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5, 50, 5, 1, 0.02) + walk("c", 5, 50, 5, 1)), none)
      << "two begin there";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5, 4, 5, 1)), none) << "four samples";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 0, 50, 0, 1, 0.01)), none) << "side by side";
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 4.8, 2, 4.8, 1, 0.01)), none) << "b ends first";
}

TEST(Handovers, FollowEachOther) {
  EXPECT_EQ(handovers(walk("a", 0, 50, 0, 1) + walk("b", 5, 50, 5, 1) + walk("c", 10, 50, 10, 1)),
            (std::vector<std::string>{"a>b", "b>c"}));
}

TEST(Handovers, DoNotStayOrGoOn) {
  TrackOptions options;
  options.outside = Outside::stay;
  const TrackSet track_set =
      parse(std::string(head) + walk("a", 1, 50, 0, 1) + walk("b", 6, 50, 5, 1) + walk("c", 0, 200, 0, 1, 9),
            options);
  ASSERT_EQ(track_set.handovers.size(), 1u);
  EXPECT_TRUE(track_set.tracks[0].reaches_back_to);
  EXPECT_FALSE(track_set.tracks[0].reaches_on_to);
  EXPECT_FALSE(track_set.tracks[1].reaches_back_to);
  EXPECT_TRUE(track_set.tracks[1].reaches_on_to);
  EXPECT_LT(track_set.presences[0].last, 6.0);
}

TEST(Echoes, OfASecondReceiverAreLeftOut) {
  // 16 a second; each place comes again 7.28 s later, so that the next one seems to be reached at 58.9 a
  // second.
  std::string text(head);
  for (int k = 0; k < 40; ++k)
    text += fmt::format("ship,{},{},0\nship,{},{},0\n", 10 * k, 160 * k, 10 * k + 7.28, 160 * k);
  const TrackSet track_set = parse(text);
  EXPECT_EQ(track_set.echoes.count, 40u);
  ASSERT_EQ(track_set.tracks.size(), 1u);
  EXPECT_EQ(track_set.tracks[0].samples.size(), 40u);
  const auto& samples = track_set.tracks[0].samples;
  for (std::size_t k = 1; k < samples.size(); ++k)
    EXPECT_NEAR(norm(samples[k].position - samples[k - 1].position) / (samples[k].time - samples[k - 1].time),
                16.0, 1e-9);
}

TEST(Echoes, MayComeBehindTheNextSample) {
  std::string text(head);
  for (int k = 0; k < 40; ++k)
    text += fmt::format("ship,{},{},0\nship,{},{},0\n", 10 * k, 160 * k, 10 * k + 13, 160 * k);
  EXPECT_EQ(parse(text).tracks.at(0).samples.size(), 40u);
}

TEST(Echoes, AreNotPlacesThatABodyRepeats) {
  std::string rest(head), coarse(head), stops(head);
  for (int k = 0; k < 60; ++k) {
    rest += fmt::format("ship,{},{},0\n", 10 * k + k % 3, k < 30 ? 100 * k : 3000);
    coarse += fmt::format("ship,{},{},0\n", 10 * k, k / 2);
    stops += fmt::format("car,{},{},0\n", k, 7 * (k - k / 5));
  }
  for (const std::string& text : {rest, coarse, stops}) EXPECT_EQ(parse(text).echoes.count, 0u) << text;
}

TEST(Identities, JoinAndLeaveOut) {
  TrackOptions options;
  options.identities = {.same = {"a=b", "b=c"}, .ignore = {"d"}};
  const TrackSet track_set =
      parse(std::string(head) + walk("a", 0, 20, 0, 1) + walk("b", 2, 20, 2, 1) + walk("d", 0, 20, 0, 1) +
                walk("e", 0, 20, 0, 1, 5) + walk("c", 4, 20, 4, 1),
            options);
  ASSERT_EQ(track_set.tracks.size(), 2u);
  EXPECT_EQ(track_set.tracks[0].id, "c");
  EXPECT_EQ(track_set.tracks[0].samples.size(), 60u);
  EXPECT_EQ(track_set.tracks[1].id, "e");
  EXPECT_EQ(track_set.ignored.count, 20u);
}

TEST_F(IdentitiesTest, ComeFromFilesToo) {
  TrackOptions options;
  options.identities = {.same = {"@" + write("same.csv", "# old,new\na,b\nx = y\n")},
                        .ignore = {"@" + write("ignore.txt",
                                               "\xEF\xBB\xBF"
                                               "d, a buoy\n\nnobody\n")}};
  const TrackSet track_set = parse(
      std::string(head) + walk("a", 0, 20, 0, 1) + walk("b", 2, 20, 2, 1) + walk("d", 0, 20, 0, 1), options);
  ASSERT_EQ(track_set.tracks.size(), 1u);
  EXPECT_EQ(track_set.tracks[0].id, "b");
}

TEST_F(IdentitiesTest, NameWhatIsWrong) {
  const std::string text = std::string(head) + walk("a", 0, 20, 0, 1) + walk("b", 0, 20, 0, 1, 3);
  const auto error = [&](IdentityChoice choice) {
    TrackOptions options;
    options.identities = std::move(choice);
    return error_of([&] { parse(text, options); });
  };
  EXPECT_EQ(error({.ignore = {"z"}}), "--ignore: expected an id of the recording, such as 'a', but got 'z'");
  EXPECT_EQ(error({.same = {"z=a"}}), "--same: expected an id of the recording, such as 'a', but got 'z'");
  for (const char* wrong : {"a", "a=", "=a", "a=a", "a=b=c"})
    EXPECT_EQ(error({.same = {wrong}}),
              fmt::format("--same: expected two ids as in A=B, but got '{}'", wrong));
  EXPECT_EQ(error({.same = {"a=b", "a=c"}}),
            "--same: expected 'a' to be the same as one id, but it is 'b' and 'c'");
  EXPECT_EQ(error({.same = {"a=b", "b=a"}}), "--same: expected no circle, but 'a' is the same as itself");
  EXPECT_EQ(error({.same = {"a=b"}, .ignore = {"b"}}),
            "--same: expected an id that is not ignored, but got 'b'");
  EXPECT_EQ(error({.ignore = {"a", "b"}}),
            "t.csv: expected an id that --ignore does not name, but there is none");
  EXPECT_NE(error({.same = {"@" + write("same.csv", "a;b\nq\n")}}).find("same.csv:2: expected two ids"),
            std::string::npos);
  EXPECT_NE(error({.ignore = {"@" + path("none.txt")}}).find("none.txt"), std::string::npos);
  // Both are there at the same times.
  EXPECT_NE(error({.same = {"a=b"}}).find("expected one sample of id 'b' at each time"), std::string::npos);
}

class IdentitiesProgram : public ProgramTest {};

TEST_F(IdentitiesProgram, DoesNotCountApproachesOfABodyToItself) {
  const std::string file =
      write("t.csv", std::string(head) + walk("17", 0, 100, 0, 0.5) + walk("18", 9.8, 100, 4.9, 0.5, 0.01));
  const std::string json = path("s.json");
  const ProgramRun marked =
      run("tracks " + file + " --distance 1 --contacts " + path("a.csv") + " --summary " + json);
  EXPECT_EQ(marked.exit_code, 0) << marked.err;
  EXPECT_NE(marked.out.find("approaches        0 "), std::string::npos) << marked.out;
  EXPECT_NE(marked.out.find("'17' goes on as '18' at 9.8"), std::string::npos) << marked.out;
  EXPECT_NE(marked.err.find("1 approaches are left out"), std::string::npos) << marked.err;
  EXPECT_EQ(marked.err.find("vanishes"), std::string::npos) << marked.err;
  EXPECT_EQ(read_text(path("a.csv")).find("17"), std::string::npos);
  EXPECT_NE(read_text(json).find(
                R"("handovers": [{"from": "17", "to": "18", "at": 9.8}], "left_out_by_handover": 1)"),
            std::string::npos)
      << read_text(json);
  const ProgramRun counted = run("tracks " + file + " --distance 1 --count-handovers");
  EXPECT_NE(counted.out.find("approaches        1 "), std::string::npos) << counted.out;
  const ProgramRun one = run("tracks " + file + " --distance 1 --same 17=18 --duplicates first");
  EXPECT_EQ(one.err, "");
  EXPECT_NE(one.out.find(" of 1 ids"), std::string::npos) << one.out;
}

}  // namespace
}  // namespace kinesphere::program::identities_test
