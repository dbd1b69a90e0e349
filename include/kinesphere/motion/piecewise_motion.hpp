// Motion along ready-made trajectories.
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

/// Each body follows a smooth trajectory of its own; it can be removed, but not be changed. After its last
/// time it coasts on with the velocity it had there. Before its first time it comes in on a straight line
/// with the velocity it has there; only in that part trajectory() and state() may differ by a rounding.
class PiecewiseMotion : public Motion {
 public:
  /// One trajectory for each body. Errors, naming body and segment: out_of_range when a trajectory is empty,
  /// a segment does not end after it begins, does not begin when the one before it ends, or does not go on
  /// from its position and velocity there (up to a relative 1e-12); not_finite.
  static Result<PiecewiseMotion> create(std::vector<Trajectory> trajectories);

  std::size_t size() const final { return trajectories_.size(); }
  bool contains(std::uint32_t body) const final { return body < size() && !trajectories_[body].empty(); }
  /// The limit is the largest acceleration of the whole trajectory, plus a relative 1e-12 for rounding. It is
  /// exact, and found at an end of a segment, because the length of a linear function is convex.
  BodyDefinition definition(std::uint32_t body, double t) const final;
  /// Cost: O(log segments).
  State state(std::uint32_t body, double t) const final;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const final;
  /// Errors: unsupported.
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) final;
  Result<void> remove(std::uint32_t body) final;
  /// The whole trajectory goes along.
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

  /// Throws BadResult as state() does.
  double first_time(std::uint32_t body) const;
  double last_time(std::uint32_t body) const;

 protected:
  /// Takes trajectories that create() would accept.
  explicit PiecewiseMotion(std::vector<Trajectory> trajectories);

 private:
  Segment lead_in(std::uint32_t body, double t) const;
  const Trajectory& known_trajectory(std::uint32_t body, double t, std::string_view call,
                                     std::string_view argument) const;

  /// Each with an endless segment added, for coasting. Removed bodies have none.
  std::vector<Trajectory> trajectories_;
  std::vector<double> limits_;
  std::vector<std::uint32_t> free_;  ///< numbers of removed bodies
};

}  // namespace kinesphere
