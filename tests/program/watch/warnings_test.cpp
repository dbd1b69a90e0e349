// Warnings of a watch: a table, each once.
#include "watch/output/warnings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/watch/stages.hpp"
#include "watch/watch_pipeline.hpp"

namespace kinesphere::program::warnings_test {
namespace {

/// A watch, and what has been printed so far.
class Warned {
 public:
  explicit Warned(const WatchSettings& settings = plane_settings(), bool is_recording = true)
      : pipeline(settings, [](std::uint64_t, std::string_view) {}),
        warnings(pipeline.view(), is_recording, false) {}

  Warned& take(const SourceReport& report) {
    pipeline.begin_record(++line_);
    pipeline.take(report);
    pipeline.end_record();
    testing::internal::CaptureStderr();
    warnings.look();
    printed += testing::internal::GetCapturedStderr();
    return *this;
  }
  void end(bool has_ended = true) {
    pipeline.finish();
    testing::internal::CaptureStderr();
    warnings.look_at_end(has_ended);
    printed += testing::internal::GetCapturedStderr();
  }
  /// Returns "what:times " of all warnings.
  std::string table() {
    std::string text;
    for (const Warning& warning : warnings.all()) text += fmt::format("{}:{} ", warning.what, warning.times);
    return text;
  }

  WatchPipeline pipeline;
  Warnings warnings;
  std::string printed;

 private:
  std::size_t line_ = 0;
};

TEST(Warnings, EachIsGivenOnceAndCounted) {
  WatchSettings settings = plane_settings();
  settings.dimensions.reset();
  Warned watch(settings);
  SourceReport high = report_at("b", 0, 1000, 1);
  high.has_height = true;
  for (int t = 0; t < 10; ++t) {
    watch.take(report_at("a", t, t, 1));
    high.stamp = time_of(t);
    high.position.x = 1000 + t;
    watch.take(high);
  }
  EXPECT_EQ(watch.table(), "ignored_heights:10 ");
  EXPECT_EQ(watch.printed,
            "kinesphere: warning: test: heights do not count, because the first report had none: say "
            "--dimensions 3, or 2\n");
  EXPECT_EQ(watch.warnings.all()[0].first, "1") << "when times had confirmed each other";
}

TEST(Warnings, OfTheOwnTrackAtTheEndOfAShortStream) {
  WatchSettings settings = plane_settings();
  settings.own = settings.own_as_given = "own";
  Warned watch(settings), stopped(settings), right(settings);
  for (int t = 0; t < 5; ++t)
    for (Warned* const each : {&watch, &stopped})
      each->take(report_at("a", t, t, 1)).take(report_at("b", t, 500 + t, 1));
  EXPECT_EQ(watch.table(), "");
  watch.end();
  stopped.end(false);
  EXPECT_EQ(watch.table(), "no_own:1 ");
  EXPECT_EQ(stopped.table(), "no_own:1 ");
  for (int t = 0; t < 5; ++t) right.take(report_at("own", t, t, 1)).take(report_at("b", t, 500 + t, 1));
  right.end();
  EXPECT_EQ(right.table(), "");
}

TEST(Warnings, OfReportsThatAreTooOld) {
  Warned watch;
  for (int t = 0; t < 200; ++t)
    watch.take(report_at("a", 1000 + t, t, 1)).take(report_at("b", 1000 + t, 900, 1));
  for (int t = 0; t < 99; ++t) watch.take(report_at("a", 0.1 * t, t, 1));
  EXPECT_EQ(watch.table(), "");
  watch.take(report_at("a", 1201, 201, 1));
  for (int t = 0; t < 99; ++t) watch.take(report_at("a", 0.1 * t, t, 1));
  EXPECT_EQ(watch.table(), "") << "not a hundred in a row";
  watch.take(report_at("a", 90, 0, 1));
  EXPECT_EQ(watch.table(), "too_old:199 ");
}

TEST(Warnings, OfContradictions) {
  Warned watch;
  for (int t = 0; t < 20; ++t)
    watch.take(report_at("a", t, t % 2 == 0 ? 0 : 900, 1)).take(report_at("b", t, 5000 + t, 1));
  EXPECT_TRUE(watch.table().starts_with("contradictions:")) << watch.table();
}

TEST(Warnings, OfOneTrackAndOneMoment) {
  Warned one;
  for (int t = 0; t < 5; ++t) one.take(report_at("a", t, t, 1));
  one.end();
  EXPECT_EQ(one.table(), "one_track:5 ");
  Warned moment, pipe(plane_settings(), false);
  for (int k = 0; k < 5; ++k)
    for (Warned* const each : {&moment, &pipe})
      each->take(report_at(std::string(1, char('a' + k)), 0, 500 * k, 1));
  moment.end();
  pipe.end();
  EXPECT_EQ(moment.table(), "one_moment:5 ");
  EXPECT_EQ(pipe.table(), "");
}

TEST(Warnings, OfMalformedLinesAndOfTheFormat) {
  Warned watch;
  watch.pipeline.begin_record(7);
  watch.pipeline.refuse("expected a number");
  testing::internal::CaptureStderr();
  watch.warnings.look();
  watch.warnings.add("test: read as a whole");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "kinesphere: warning: test:7: expected a number\nkinesphere: warning: test: read as a whole\n");
  EXPECT_EQ(watch.table(), "format:1 ");
}

TEST(Warnings, NoneIsPrintedWhereItIsQuiet) {
  WatchPipeline pipeline(plane_settings(), [](std::uint64_t, std::string_view) {});
  Warnings warnings(pipeline.view(), true, true);
  pipeline.take(report_at("a", 0, 0, 1));
  pipeline.finish();
  testing::internal::CaptureStderr();
  warnings.look_at_end(true);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(warnings.all().size(), 1u);
}

}  // namespace
}  // namespace kinesphere::program::warnings_test
