// Motion along recorded tracks: straight on from sample to sample.
#pragma once

#include <memory>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// LinearTracks has an acceleration limit of zero, and each body turns suddenly at each sample. The caller
/// must call set_velocity() with each of turns() at its time, here and in the detector. Until then, and at
/// that very time, state() gives the velocity before the turn; at later times it gives the velocity after it
/// in any case. Before the first and after the last sample a body goes straight on.
class LinearTracks final : public Motion {
 public:
  /// Makes the motion with one body for each track. Errors: as RecordedTracks::create().
  static Result<LinearTracks> create(const std::vector<Track>& tracks);

  std::vector<SceneTurn> turns() const;

  std::size_t size() const override { return trajectories_.size(); }
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// Notes a turn as done. Errors: unsupported unless it is one of turns().
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit LinearTracks(std::vector<Trajectory> trajectories);
  const Segment& segment(std::uint32_t body, double t) const;
  void require_known(std::uint32_t body, double t) const;

  std::vector<Trajectory> trajectories_;  ///< by body: at least one segment each
  std::vector<double> last_turns_;        ///< by body: time of the last turn passed to set_velocity()
};

}  // namespace kinesphere
