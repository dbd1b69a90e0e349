// Motion along recorded tracks: straight on from sample to sample, for some bodies or for all.
#pragma once

#include <memory>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// A body that goes straight has an acceleration limit of zero, and turns suddenly at each sample. The caller
/// must call set_velocity() with each of turns() at its time, here and in the detector. Until then, and at
/// that very time, state() gives the velocity before the turn; at later times it gives the velocity after it
/// in any case. Before the first and after the last sample a body goes straight on. Other bodies follow a
/// smooth curve, with its acceleration limit and without turns.
class LinearTracks final : public Motion {
 public:
  /// Makes the motion with one body for each track. Errors: as RecordedTracks::create().
  static Result<LinearTracks> create(const std::vector<Track>& tracks);
  /// Makes the motion of these curves, but with the bodies of which `is_straight` is true straight on along
  /// their track. Precondition: there are as many of each. Errors: as create().
  static Result<LinearTracks> create_among(const RecordedTracks& curves, const std::vector<Track>& tracks,
                                           const std::vector<bool>& is_straight);

  std::vector<SceneTurn> turns() const;

  std::size_t size() const override { return paths_.size(); }
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// Notes a turn as done. Errors: unsupported unless it is one of turns().
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  /// A path of one body, and the largest acceleration on it: 0 on straight lines.
  struct Path {
    Trajectory trajectory;  ///< at least one segment; the first and the last one are straight
    double acceleration_limit = 0.0;
    bool has_turns = true;
  };

  explicit LinearTracks(std::vector<Path> paths);
  const Segment& segment(std::uint32_t body, double t) const;
  void require_known(std::uint32_t body, double t) const;

  std::vector<Path> paths_;         ///< by body
  std::vector<double> last_turns_;  ///< by body: time of the last turn passed to set_velocity()
};

}  // namespace kinesphere
