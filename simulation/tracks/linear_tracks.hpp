// Motion along recorded tracks: straight on from sample to sample.
#pragma once

#include <memory>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Each body promises an acceleration of zero and turns suddenly at each sample: whoever watches must be told
/// so by set_velocity, with each of turns() at its time. Until then, and at that very time, state() gives the
/// velocity before the turn; later it gives the one after it in any case. Before the first and after the last
/// sample a body goes straight on.
class LinearTracks final : public Motion {
 public:
  /// One track for each body. Errors: as RecordedTracks::create().
  static Result<LinearTracks> create(const std::vector<Track>& tracks);

  std::vector<SceneTurn> turns() const;

  std::size_t size() const override { return trajectories_.size(); }
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// Errors: unsupported, unless it is one of turns().
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit LinearTracks(std::vector<Trajectory> trajectories);
  const Segment& segment(std::uint32_t body, double t) const;
  void require_known(std::uint32_t body, double t) const;

  std::vector<Trajectory> trajectories_;  ///< at least one segment each
  std::vector<double> last_turns_;        ///< of each body: the time of the last turn that was told
};

}  // namespace kinesphere
