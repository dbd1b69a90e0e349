// Between which samples an approach lies.
#include "tracks/sample_steps.hpp"

#include "program/support.hpp"

namespace kinesphere::program::sample_steps_test {
namespace {

TEST(SampleSteps, AreAroundATime) {
  const RecordedTrack track{.id = "a", .samples = {{1.0, {}}, {3.0, {}}, {7.0, {}}}};
  const auto expect = [&](double time, std::optional<double> before, std::optional<double> after) {
    EXPECT_EQ(step_at(track, time).before, before) << time;
    EXPECT_EQ(step_at(track, time).after, after) << time;
  };
  expect(2.0, 1.0, 3.0);
  expect(3.0, 3.0, 3.0);
  expect(6.5, 3.0, 7.0);
  expect(1.0, 1.0, 1.0);
  expect(7.0, 7.0, 7.0);
  expect(0.5, {}, 1.0);
  expect(7.5, 7.0, {});
}

class SampleStepsProgram : public ProgramTest {};

TEST_F(SampleStepsProgram, AreInTheTableAndInTheFile) {
  const std::string file = write("t.csv",
                                 "id,time,x,y\na,0,0,0\na,60,60,0\na,120,120,0\n"
                                 "b,0,90,0.5\nb,40,50,0.5\nb,80,10,0.5\nb,120,-30,0.5\n");
  const ProgramRun found =
      run("tracks " + file + " --distance 1 --interpolate linear --contacts " + path("c.csv"));
  EXPECT_NE(found.out.find("        60  a b"), std::string::npos) << found.out;
  EXPECT_NE(read_text(path("c.csv")).find(",0,60,40,80,60\n"), std::string::npos) << read_text(path("c.csv"));
  const std::string parked = write("p.csv", "id,time,x,y\nb,3,5,0.5\na,0,0,0\na,4,4,0\na,8,8,0\n");
  run("tracks " + parked + " --distance 1 --outside stay --contacts " + path("c.csv"));
  EXPECT_NE(read_text(path("c.csv")).find(",3,,4,8,\n"), std::string::npos) << read_text(path("c.csv"));
}

}  // namespace
}  // namespace kinesphere::program::sample_steps_test
