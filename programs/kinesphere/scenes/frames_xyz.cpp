// Snapshots of a scene as extended XYZ, which OVITO opens with the radii of the spheres.
#include "scenes/frames_xyz.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <vector>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

std::vector<std::uint32_t> bodies_at(const Scene& scene, double time) {
  std::vector<std::uint32_t> present;
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    if (scene.bodies[body].appears <= time && time < scene.bodies[body].vanishes) present.push_back(body);
  }
  return present;
}

std::string comment_line(const Scene& scene, double time) {
  std::string line;
  if (const auto& box = scene.world.box) {
    const Vec3 size = box->upper - box->lower;
    line += fmt::format("Lattice=\"{} 0 0 0 {} 0 0 0 {}\" ", size.x, size.y, size.z);
    line += fmt::format("Origin=\"{} {} {}\" ", box->lower.x, box->lower.y, box->lower.z);
    const auto flag = [](bool repeats) { return repeats ? 'T' : 'F'; };
    const Axes& periodic = scene.world.periodic;
    line += fmt::format("pbc=\"{} {} {}\" ", flag(periodic.x), flag(periodic.y), flag(periodic.z));
  }
  line += "Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1:bound_radius:R:1 ";
  return line + fmt::format("Time={}\n", time);
}

}  // namespace

FramesXyz::FramesXyz(const std::string& path, const Scene& scene) : scene_(scene), file_(path) {}

void FramesXyz::write(const Detector& detector, const Motion& motion, double time) {
  const std::vector<std::uint32_t> present = bodies_at(scene_, time);
  std::string frame = fmt::format("{}\n", present.size()) + comment_line(scene_, time);
  for (std::uint32_t body : present) {
    const State state = motion.state(body, time);
    fmt::format_to(std::back_inserter(frame), "S {} {} {} {} {} {} {} {} {}\n", body, state.position.x,
                   state.position.y, state.position.z, state.velocity.x, state.velocity.y, state.velocity.z,
                   scene_.bodies[body].radius, require(detector.bound(body)).radius_at(time));
  }
  file_.write(frame);
}

}  // namespace kinesphere::program
