// Frames in extended XYZ.
#include "scenes/frames_xyz.hpp"

#include "kinesphere/motion/recorded_tracks.hpp"
#include "support.hpp"

namespace kinesphere::program::frames_xyz_test {
namespace {

using FramesXyzTest = FolderTest;

/// A detector with bounds and nothing else.
class StillDetector : public Detector {
 public:
  std::string_view name() const override { return "still"; }
  Result<void> add(std::uint32_t, const BodyDefinition&) override { return {}; }
  Result<void> remove(std::uint32_t) override { return {}; }
  Result<void> set_velocity(std::uint32_t, const Vec3&) override { return {}; }
  Result<std::optional<Event>> advance(double) override { return std::optional<Event>{}; }
  double time() const override { return 0; }
  DetectorCounters counters() const override { return {}; }
  Result<Bound> bound(std::uint32_t body) const override { return Bound{.radius = 10.0 + body}; }
};

/// Body 0 is present during [0, 4], body 1 during [0, 2] only.
Scene two_bodies() {
  Scene scene;
  scene.bodies = {{.radius = 0.5}, {.radius = 1.5, .vanishes = 2}};
  scene.motion = std::make_unique<RecordedTracks>(
      RecordedTracks::create({{{0, {0, 0, 0}}, {4, {4, 0, 0}}}, {{0, {1, 2, 3}}, {2, {1, 2, 5}}}}).value());
  scene.end_time = 4;
  return scene;
}

TEST_F(FramesXyzTest, HasRadiiAndBoundRadii) {
  Scene scene = two_bodies();
  scene.world.box = Box{{-1, -2, -3}, {9, 18, 27}};
  FramesXyz frames(path("f.xyz"), scene);
  frames.write(StillDetector(), *scene.motion, 1);
  frames.commit();
  EXPECT_EQ(read_text(path("f.xyz")),
            "2\n"
            "Lattice=\"10 0 0 0 20 0 0 0 30\" Origin=\"-1 -2 -3\" pbc=\"F F F\" "
            "Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1:bound_radius:R:1 Time=1\n"
            "S 0 1 0 0 1 0 0 0.5 10\n"
            "S 1 1 2 4 0 0 1 1.5 11\n");
}

TEST_F(FramesXyzTest, TellsWhereSpaceRepeats) {
  Scene scene = two_bodies();
  scene.world.box = Box{{0, 0, 0}, {9, 9, 9}};
  scene.world.periodic = {.y = true};
  FramesXyz frames(path("f.xyz"), scene);
  frames.write(StillDetector(), *scene.motion, 1);
  frames.commit();
  EXPECT_NE(read_text(path("f.xyz")).find("pbc=\"F T F\""), std::string::npos);
}

TEST_F(FramesXyzTest, LeavesOutWhatIsNotThereAndALatticeWithoutBox) {
  const Scene scene = two_bodies();
  FramesXyz frames(path("f.xyz"), scene);
  frames.write(StillDetector(), *scene.motion, 2);
  frames.commit();
  EXPECT_EQ(read_text(path("f.xyz")),
            "1\n"
            "Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1:bound_radius:R:1 Time=2\n"
            "S 0 2 0 0 1 0 0 0.5 10\n");
}

}  // namespace
}  // namespace kinesphere::program::frames_xyz_test
