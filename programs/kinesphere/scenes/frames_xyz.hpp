// Snapshots of a scene as extended XYZ, which OVITO opens with the radii of the spheres.
#pragma once

#include <string>

#include "base/output_file.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// Each frame has the number of bodies, a line with Lattice and Origin (if the scene has a box), Properties
/// and Time, and then for each present body: species, number, position, velocity, radius, and the radius of
/// its time-varying bound.
class FramesXyz {
 public:
  /// `scene` must outlive it.
  FramesXyz(const std::string& path, const Scene& scene);
  void write(const Detector& detector, const Motion& motion, double time);
  void commit() { file_.commit(); }

 private:
  const Scene& scene_;
  OutputFile file_;
};

}  // namespace kinesphere::program
