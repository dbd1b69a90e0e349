// What of a recording was not looked at: pairs and times by a plain count, and what the program says of it.
#include "tracks/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "program/support.hpp"
#include "tracks/coverage_summary.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::coverage_test {
namespace {

constexpr std::string_view two_plans =
    "id,time,x,y\na,0,0,0\na,10,10,0\na,20,20,0\na,80,80,0\na,90,90,0\n"
    "b,0,50,-50\nb,10,50,-40\nb,20,50,-30\nb,80,50,30\nb,90,50,40\n";

TrackSet parse(std::string_view text, const TrackOptions& options = {}) {
  return parse_tracks({{"t.csv", std::string(text)}}, options);
}

Coverage coverage_in(const TrackSet& track_set, const ApproachChoice& choice = {}) {
  return coverage_of(track_set, ApproachFilter(choice, track_set));
}

TEST(Coverage, CountsALegOverTheLimitForBoth) {
  const Coverage coverage = coverage_in(parse(two_plans));
  EXPECT_DOUBLE_EQ(coverage.together, 90.0);
  EXPECT_DOUBLE_EQ(coverage.not_looked_at(), 60.0);
  EXPECT_EQ(coverage.pairs, 1u);
  EXPECT_EQ(coverage.pairs_never_looked_at, 0u);
  EXPECT_EQ(coverage.largest.id, "a");
  EXPECT_EQ(coverage.largest.from, 20.0);
  EXPECT_EQ(coverage.largest.until, 80.0);
}

TEST(Coverage, APlanIsLookedAtWhole) {
  TrackOptions plan;
  plan.is_plan = true;
  EXPECT_TRUE(coverage_in(parse(two_plans, plan)).is_complete());
  EXPECT_EQ(plan.chosen_interpolation(), Interpolation::linear);
  plan.max_gap = 5.0;
  EXPECT_NE(error_of([&] { parse(two_plans, plan); }).find("--max-gap: expected none with --plan"),
            std::string::npos);
}

TEST(Coverage, NamesIdsThatLostAllOrMuch) {
  // c has a lone sample, d one that is alone after three that are not, and e has never a position.
  TrackOptions options;
  options.missing = MissingPolicy::split;
  const TrackSet track_set = parse(
      std::string(two_plans) + "c,40,0,0\nd,0,9,9\nd,10,9,9\nd,20,9,9\nd,70,9,9\ne,5,,\ne,60,,\n", options);
  const Coverage coverage = coverage_in(track_set);
  ASSERT_EQ(coverage.without_track.size(), 2u);
  EXPECT_EQ(coverage.without_track[0].id, "c");
  EXPECT_EQ(coverage.without_track[1].id, "e");
  EXPECT_EQ(coverage.without_track[1].lost, 2u);
  ASSERT_EQ(coverage.thinned.size(), 1u);
  EXPECT_EQ(coverage.thinned[0].id, "d");
  EXPECT_EQ(coverage.thinned[0].samples, 4u);
  EXPECT_EQ(coverage.pairs, 10u);
  EXPECT_EQ(coverage.pairs_never_looked_at, 7u) << "those of c and those of e";
  const auto warnings = warnings_of(coverage, track_set, false);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0], "2 of 5 ids have no track, as all of their samples are left out: 'c', 'e'");
  EXPECT_EQ(warnings[1].find("7 of 10 pairs that are there together were never looked at: "), 0u)
      << warnings[1];
  EXPECT_TRUE(warnings[1].ends_with(" and 4 more")) << warnings[1];
}

TEST(Coverage, SaysNoneOnlyWithWhatWasNotLookedAt) {
  std::string text = "id,time,x,y\n";
  for (int k = 0; k < 400; ++k)
    for (const std::string id : {"a", "b"})
      if (id == "a" || k < 200 || k > 203) text += fmt::format("{},{},{},0\n", id, k, id == "a" ? 0 : 9);
  const TrackSet track_set = parse(text);
  const Coverage coverage = coverage_in(track_set);
  EXPECT_DOUBLE_EQ(coverage.not_looked_at(), 5.0);
  EXPECT_TRUE(warnings_of(coverage, track_set, false).empty()) << "a small part";
  const auto warnings = warnings_of(coverage, track_set, true);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("5 s of the 399 s"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("id 'b' from 199 to 204"), std::string::npos) << warnings[0];
}

TEST(Coverage, CountsWithinTheChoiceAlone) {
  const TrackSet track_set = parse(std::string(two_plans) + "c,0,9,9\nc,10,9,9\nc,20,9,9\n");
  EXPECT_DOUBLE_EQ(coverage_in(track_set, {.from = "70"}).not_looked_at(), 10.0);
  EXPECT_TRUE(coverage_in(track_set, {.until = "20"}).is_complete());
  EXPECT_EQ(coverage_in(track_set, {.from = "20"}).pairs, 1u) << "c has gone";
  EXPECT_DOUBLE_EQ(coverage_in(track_set).together, 90.0 + 20.0 + 20.0);
  const Coverage only = coverage_in(track_set, {.only = {"c"}});
  EXPECT_DOUBLE_EQ(only.together, 40.0);
  EXPECT_EQ(only.pairs, 2u);
  EXPECT_TRUE(only.is_complete());
}

/// Spans of one id, as a test sees them.
struct Spans {
  double first, last;
  std::vector<std::pair<double, double>> tracks;
};

Spans spans_of(const TrackSet& track_set, const Presence& presence) {
  Spans spans{presence.first, presence.last, {}};
  for (std::size_t k = 0; k < presence.tracks; ++k) {
    const auto& samples = track_set.tracks[presence.first_track + k].samples;
    spans.tracks.emplace_back(samples.front().time, samples.back().time);
  }
  return spans;
}

TEST(Coverage, IsThatOfAPlainCount) {
  std::mt19937 random(71);
  for (int round = 0; round < 200; ++round) {
    std::string text = "id,time,x,y\nz,0,0,0\nz,1,0,0\nz,2,0,0\nz,3,0,0\n";
    for (char id = 'a'; id < 'a' + 7; ++id) {
      int time = static_cast<int>(random() % 10);
      for (auto left = 1 + random() % 6; left > 0; --left) {
        text += fmt::format("{},{},0,0\n", id, time);
        time += random() % 4 == 0 ? 9 : 1;
      }
    }
    const TrackSet track_set = parse(text);
    const Coverage coverage = coverage_in(track_set);
    std::vector<Spans> all;
    for (const Presence& presence : track_set.presences) all.push_back(spans_of(track_set, presence));
    double together = 0.0, looked_at = 0.0;
    std::uint64_t pairs = 0, never = 0;
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double shared = std::min(all[a].last, all[b].last) - std::max(all[a].first, all[b].first);
        const bool has_instant = all[a].first == all[a].last || all[b].first == all[b].last;
        if (shared < 0 || (shared == 0 && !has_instant)) continue;
        together += shared;
        ++pairs;
        bool is_looked_at = false;
        for (const auto& [from, until] : all[a].tracks)
          for (const auto& [begin, end] : all[b].tracks)
            if (std::max(from, begin) < std::min(until, end)) {
              looked_at += std::min(until, end) - std::max(from, begin);
              is_looked_at = true;
            }
        never += is_looked_at ? 0 : 1;
      }
    }
    EXPECT_EQ(coverage.pairs, pairs) << text;
    EXPECT_EQ(coverage.pairs_never_looked_at, never) << text;
    EXPECT_NEAR(coverage.together, together, 1e-9) << text;
    EXPECT_NEAR(coverage.not_looked_at(), together - looked_at, 1e-9) << text;
  }
}

class CoverageProgram : public ProgramTest {};

TEST_F(CoverageProgram, SaysItInSummaryWarningAndJson) {
  const std::string file = write("plan.csv", two_plans), json = path("summary.json");
  const ProgramRun found_none = run("tracks " + file + " --distance 5 --summary " + json);
  EXPECT_EQ(found_none.exit_code, 0);
  EXPECT_NE(found_none.err.find("warning: approaches were not looked for in 60 s of the 90 s"),
            std::string::npos)
      << found_none.err;
  EXPECT_NE(found_none.out.find("\nnot looked at "), std::string::npos) << found_none.out;
  const std::string summary = read_text(json);
  for (const char* member : {R"("approaches": 0,)", R"("not_looked_at_s": 60,)", R"("together_s": 90,)",
                             R"("largest_hole": {"id": "a", "from": 20, "until": 80})"})
    EXPECT_NE(summary.find(member), std::string::npos) << member << "\n" << summary;
  const ProgramRun plan = run("tracks " + file + " --distance 5 --plan --verify --summary " + json);
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(plan.err, "");
  EXPECT_NE(plan.out.find("of 2 ids, not cut at gaps"), std::string::npos) << plan.out;
  EXPECT_NE(plan.out.find("\n                      50 "), std::string::npos) << plan.out;
  EXPECT_NE(read_text(json).find(R"("not_looked_at_s": 0, "largest_hole": null)"), std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::coverage_test
