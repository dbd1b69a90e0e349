// What a file does not say is asked at once.
#include "tracks/questions.hpp"

#include <fmt/format.h>

#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::questions_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}
std::size_t place_of(const std::string& text, std::string_view part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  return text.find(part);
}

TEST(Questions, AreAskedAtOnce) {
  const std::string text =
      "icao24,time,lon,lat,altitude,speed,lost\na,03/04/2025 10:00:00,8,47,1000,9,0\n"
      "a,03/04/2025 10:00:10,8,47.01,1000,9,1\nb,03/04/2025 10:00:00,0,0,1000,9,0\n";
  const std::string error = error_in(text);
  EXPECT_TRUE(error.starts_with("f: 4 questions: (1) column 'altitude' does not say its unit")) << error;
  EXPECT_LT(place_of(error, "(2) f:2: expected a date whose order"), place_of(error, "(3) f:3: '1' as lost"));
  EXPECT_LT(place_of(error, "(3) f:3: '1' as lost"), place_of(error, "(4) f:4: 0 as longitude and latitude"));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  // The answers that it proposes.
  TrackOptions options;
  options.hints = {.columns = "id=icao24,time=time,z=altitude:ft,lon=lon,lat=lat",
                   .where = "lost != 1 and (lon != 0 or lat != 0)",
                   .dates = DateOrder::day_first};
  EXPECT_EQ(parse(text + "a,03/04/2025 10:00:20,8,47.02,1000,9,0\n", options).samples, 2u);
}

TEST(Questions, OfTheLastRowsAreAskedWithTheFirst) {
  EXPECT_TRUE(
      error_in("frame,id,x,y\n1,1,8.2,47.1\n2,1,8.3,47.1\n")
          .starts_with(
              "f: 2 questions: (1) expected --frame-rate, because column 'frame' counts frames; (2) x (8.2"));
  EXPECT_TRUE(error_in("id,frame,lon,lat,h\na,1,8,47,3\na,2,8,47,3\n")
                  .starts_with("f: 2 questions: (1) column 'h' may be a height"));
}

TEST(Questions, ThatAreAloneAndErrorsThatProposeNothingStayAsTheyAre) {
  EXPECT_EQ(error_in("id,frame,x,y\na,1,8,47\na,2,8,48\n"),
            "f: expected --frame-rate, because column 'frame' counts frames");
  EXPECT_EQ(error_in("id,time,x,y\na,1,8,47\na,2,east,48\n"),
            "f:3: expected a number as x (column 3), but got 'east'");
  // An error with what is assumed may be none with the right answers.
  EXPECT_EQ(error_in("id,frame,x,y\na,1,8,47\na,2,east,48\n"),
            "f: expected --frame-rate, because column 'frame' counts frames");
}

TEST(Questions, OfDayAndMonthAreNoneWhereOneOrderAloneIsPossible) {
  const auto dated = [](const char* first, const char* second) {
    return parse(fmt::format("id,time,x,y\na,{} 10:00:00,0,0\na,{} 10:00:10,1,0\n", first, second), [] {
      TrackOptions options;
      options.is_plan = true;
      return options;
    }());
  };
  const auto first_time = [](const TrackSet& track_set) {
    return track_set.times.text(track_set.tracks[0].samples[0].time);
  };
  EXPECT_EQ(first_time(dated("20/03/2021", "20/03/2021")), "2021-03-20T10:00:00");
  EXPECT_EQ(dated("20/03/2021", "21/03/2021").format, "table, dates day first");
  EXPECT_EQ(first_time(dated("03/20/2021", "03/20/2021")), "2021-03-20T10:00:00");
  EXPECT_EQ(first_time(dated("03/04/2021", "20/04/2021")), "2021-04-03T10:00:00") << "a later row tells";
  EXPECT_EQ(first_time(dated("03/04/2021", "03/20/2021")), "2021-03-04T10:00:00");
  for (const auto& [first, second] : {std::pair("03/04/2021", "05/04/2021"), {"20/03/2021", "03/20/2021"}})
    EXPECT_NE(error_of([&, &one = first, &two = second] { dated(one, two); }).find("say --dates day-first"),
              std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::questions_test
