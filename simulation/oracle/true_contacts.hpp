// The true contacts of a scene in which all bodies pass through each other, from exact trajectories alone.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_rule.hpp"
#include "kinesphere/event.hpp"
#include "number/infinity.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/oracle/near_spans.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Begin and end of a contact.
struct ContactInterval {
  double begin = 0.0;
  double end = infinity;  ///< infinite if the contact lasts beyond the end of the scene
  friend bool operator==(const ContactInterval&, const ContactInterval&) = default;
};

/// TrueMotion has the exact trajectories of a scene.
class TrueMotion {
 public:
  /// Computes all trajectories. The scene must outlive this object. Cost and memory: O(pieces of all
  /// trajectories).
  explicit TrueMotion(const Scene& scene);
  TrueMotion(const TrueMotion&) = delete;
  TrueMotion& operator=(const TrueMotion&) = delete;

  /// Returns each body with its trajectory while it is there; a body that never is there has no trajectory.
  const std::vector<PresentBody>& bodies() const { return present_; }
  const ContactRule& rule() const { return rule_; }
  GapCourse pair(std::uint32_t first, std::uint32_t second) const;
  GapCourse wall(std::uint32_t body, Wall wall) const;
  /// Return the first and the last time at which two bodies (or one, twice) are there together. If they never
  /// are, the first is larger.
  double first_time(std::uint32_t a, std::uint32_t b) const;
  double last_time(std::uint32_t a, std::uint32_t b) const;

  /// Returns the contacts of two bodies, or of a body (twice) and a wall, from the course of their gap.
  /// Precondition: the gap is above 0 outside of the spans.
  std::vector<ContactInterval> contacts(const GapCourse& gap, std::uint32_t a, std::uint32_t b,
                                        const std::vector<NearSpan>& spans) const;
  /// Returns one span for all the time that the two are there together.
  NearSpan whole_span(std::uint32_t a, std::uint32_t b) const;

 private:
  const Scene& scene_;
  ContactRule rule_;
  std::vector<Trajectory> trajectories_;
  std::vector<PresentBody> present_;
};

}  // namespace kinesphere
