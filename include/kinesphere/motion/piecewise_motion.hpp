// PiecewiseMotion: motion along given trajectories.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// Each body follows its own smooth trajectory; it can be removed, but not changed. After its last time it
/// continues with its velocity there. Before its first time it approaches on a straight line with its
/// velocity there; only in that part trajectory() and state() may differ by a rounding.
class PiecewiseMotion : public Motion {
 public:
  /// Creates one body for each trajectory. Errors, naming body and segment: out_of_range if a trajectory is
  /// empty, or a segment does not end after its begin, does not begin at the end of its predecessor, or
  /// does not continue its position and velocity there (up to a relative 1e-12); not_finite.
  static Result<PiecewiseMotion> create(std::vector<Trajectory> trajectories);

  std::size_t size() const final { return trajectories_.size(); }
  bool contains(std::uint32_t body) const final { return body < size() && !trajectories_[body].empty(); }
  /// Returns the definition; its acceleration limit is the largest acceleration of the whole trajectory,
  /// plus a relative 1e-12 for rounding. The maximum is exact and attained at an end of a segment, because
  /// the length of a linear function is convex.
  BodyDefinition definition(std::uint32_t body, double t) const final;
  /// Returns the state at time t. Cost: O(log segments).
  State state(std::uint32_t body, double t) const final;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const final;
  /// Always fails. Errors: unsupported.
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) final;
  Result<void> remove(std::uint32_t body) final;
  /// write_body() writes the whole trajectory.
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

  /// Return the first and the last time of the body's trajectory. Throw BadResult as state().
  double first_time(std::uint32_t body) const;
  double last_time(std::uint32_t body) const;

 protected:
  /// Needs trajectories that create() would accept. With `ends_with_trajectories`, a question about a time
  /// outside of a body's trajectory is an error, out_of_range.
  explicit PiecewiseMotion(std::vector<Trajectory> trajectories, bool ends_with_trajectories = false);

 private:
  Segment lead_in(std::uint32_t body, double t) const;
  const Trajectory& known_trajectory(std::uint32_t body, double t, std::string_view call,
                                     std::string_view argument) const;
  void require_within(std::uint32_t body, double t, std::string_view call, std::string_view argument) const;

  /// Trajectories, each extended by an infinite segment of constant velocity. Empty for removed bodies.
  std::vector<Trajectory> trajectories_;
  std::vector<double> limits_;
  bool ends_with_trajectories_ = false;
  std::vector<std::uint32_t> free_;  ///< numbers of removed bodies
};

}  // namespace kinesphere
