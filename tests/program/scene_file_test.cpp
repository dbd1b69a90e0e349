// Scene files: every field, and every kind of error.
#include "scenes/scene_file.hpp"

#include "support.hpp"

namespace kinesphere::program::scene_file_test {
namespace {

using SceneFileTest = FolderTest;

std::string error_in(std::string_view text) {
  return error_of([&] { parse_scene(text, "s.json"); });
}

TEST(SceneFile, ReadsEveryField) {
  const SceneParameters p = parse_scene(R"({
    "name": "all", "motion": "ballistic", "bodies": 7, "radius": [1, 2.5], "speed": [3, 4], "limit": [5, 6],
    "gravity": [0, 0, -9.81], "box": [[-1, -2, -3], [4, 5, 6]], "packing": 0.125, "walls": false,
    "periodic": true, "redraw_interval": 0.5,
    "response": "pass_through", "restitution": 0.25, "resting_speed": 0.75, "contact_tolerance": 1e-9,
    "zeno_interval": 0.125, "seconds": 3,
    "seed": 18446744073709551615 })",
                                        "s.json")
                                .parameters;
  EXPECT_EQ(p.name, "all");
  EXPECT_EQ(p.motion, SceneParameters::MotionKind::ballistic);
  EXPECT_EQ(p.bodies, 7u);
  EXPECT_EQ(p.radius_min, 1.0);
  EXPECT_EQ(p.radius_max, 2.5);
  EXPECT_EQ(p.speed_min, 3.0);
  EXPECT_EQ(p.speed_max, 4.0);
  EXPECT_EQ(p.limit_min, 5.0);
  EXPECT_EQ(p.limit_max, 6.0);
  EXPECT_EQ(p.gravity, (Vec3{0, 0, -9.81}));
  EXPECT_EQ(p.box, (Box{{-1, -2, -3}, {4, 5, 6}}));
  EXPECT_EQ(p.packing, 0.125);
  EXPECT_FALSE(p.walls);
  EXPECT_TRUE(p.periodic);
  EXPECT_EQ(p.redraw_interval, 0.5);
  EXPECT_EQ(p.response, SceneResponse::pass_through);
  EXPECT_EQ(p.restitution, 0.25);
  EXPECT_EQ(p.resting_speed, 0.75);
  EXPECT_EQ(p.zeno_interval, 0.125);
  EXPECT_EQ(p.contact_tolerance, 1e-9);
  EXPECT_EQ(p.seconds, 3.0);
  EXPECT_EQ(p.seed, 18446744073709551615u);
}

TEST(SceneFile, KeepsDefaults) {
  const SceneParameters p = parse_scene("{}", "s.json").parameters;
  EXPECT_EQ(p.bodies, SceneParameters{}.bodies);
  EXPECT_EQ(p.box, SceneParameters{}.box);
}

TEST(SceneFile, NamesFileLineAndExpectation) {
  EXPECT_EQ(error_in("{\n\"bodies\": -3 }"),
            "s.json:2: 'bodies': expected a whole number from 0 to 4294967295, but got -3");
  EXPECT_EQ(error_in("{ \"bodies\": 4294967296 }"),
            "s.json:1: 'bodies': expected a whole number from 0 to 4294967295, but got 4294967296");
  EXPECT_EQ(error_in("{ \"bodies\": 1,\n\n  \"radius\": 3 }"),
            "s.json:3: 'radius': expected two numbers [least, largest], but got 3");
  EXPECT_EQ(error_in("{\"radius\": [1,\n \"2\"\n]}"),
            "s.json:1: 'radius': expected two numbers [least, largest], but got [1,\"2\"]");
  EXPECT_EQ(error_in("{\"gravity\": [1, 2]}"),
            "s.json:1: 'gravity': expected three numbers [x, y, z], but got [1,2]");
  EXPECT_EQ(error_in("{\"box\": [[0,0,0],[1,1]]}"),
            "s.json:1: 'box': expected two corners [[x, y, z], [x, y, z]], but got [[0,0,0],[1,1]]");
  EXPECT_EQ(error_in("{\"walls\": 1}"), "s.json:1: 'walls': expected true or false, but got 1");
  EXPECT_EQ(error_in("{\"seconds\": null}"), "s.json:1: 'seconds': expected a number, but got null");
  EXPECT_EQ(error_in("{\"name\": 5}"), "s.json:1: 'name': expected a text in quotes, but got 5");
  EXPECT_EQ(error_in("{\"seed\": 1.5}").substr(0, 45), "s.json:1: 'seed': expected a whole number fro");
  EXPECT_EQ(error_in("{\"motion\": \"fast\"}"),
            "s.json:1: 'motion': expected one of random_forces, velocity_field, ballistic, but got 'fast'");
  EXPECT_EQ(error_in("{\"response\": \"stick\"}"),
            "s.json:1: 'response': expected one of pass_through, bounce, but got 'stick'");
}

TEST(SceneFile, RefusesUnknownAndRepeatedFields) {
  EXPECT_EQ(error_in("{\n\"seconds\": 3,\n\"radiuss\": [1, 2]}").substr(0, 58),
            "s.json:3: 'radiuss' is no field: expected one of name, mot");
  EXPECT_EQ(error_in("{\n\"seed\": 3,\n\"seed\": 4}"),
            "s.json:3: expected each field once, but 'seed' is in line 2 already");
}

TEST(SceneFile, RefusesWhatIsNotJson) {
  EXPECT_EQ(error_in("").substr(0, 24), "s.json:1: expected JSON:");
  EXPECT_EQ(error_in("{\n\"seed\": 3\n\"walls\": true}").substr(0, 24), "s.json:3: expected JSON:");
  EXPECT_EQ(error_in("{\n\"seed\": 03\n}").substr(0, 24), "s.json:2: expected JSON:");
  EXPECT_EQ(error_in("{\n\"seconds\": 1e999\n}").substr(0, 24), "s.json:2: expected JSON:");
  EXPECT_EQ(error_in("[1, 2]"), "s.json:1: expected a scene {...}");
}

TEST_F(SceneFileTest, FindsBuiltInScenesAndFiles) {
  ASSERT_FALSE(built_in_scenes().empty());
  const SceneParameters& first = built_in_scenes().front();
  EXPECT_EQ(find_scene(first.name).parameters.bodies, first.bodies);
  EXPECT_EQ(find_scene(write("mine.json", "{\"bodies\": 11}")).parameters.bodies, 11u);
}

TEST_F(SceneFileTest, ListsTheBuiltInScenesWhenThereIsNone) {
  const std::string message = error_of([] { find_scene("no such scene"); });
  EXPECT_NE(message.find("'no such scene'"), std::string::npos) << message;
  for (const SceneParameters& scene : built_in_scenes())
    EXPECT_NE(message.find(scene.name), std::string::npos);
}

TEST_F(SceneFileTest, PointsToTheFieldThatMakesNoScene) {
  const std::string file = write("mine.json", "{\n\"bodies\": 3,\n\"radius\": [-1, 2]}");
  const std::string message = error_of([&] { make_scene(find_scene(file)); });
  EXPECT_TRUE(message.starts_with(file + ":3: ")) << message;
}

TEST(SceneFile, ExamplesAreScenes) {
  const auto folder = std::filesystem::path(KINESPHERE_EXAMPLE_SCENES);
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    EXPECT_FALSE(make_scene(find_scene(entry.path())).bodies.empty());
    ++scenes;
  }
  EXPECT_GT(scenes, 0);
}

}  // namespace
}  // namespace kinesphere::program::scene_file_test
