// The contacts of a scene in which all bodies pass through each other: the truth, from exact trajectories
// alone.
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

struct ContactInterval {
  double begin = 0.0;
  double end = infinity;  ///< infinite if it lasts beyond the end of the scene
  friend bool operator==(const ContactInterval&, const ContactInterval&) = default;
};

/// The exact motion of a scene.
class TrueMotion {
 public:
  /// The scene must outlive it. Cost and memory: O(pieces of all trajectories).
  explicit TrueMotion(const Scene& scene);
  TrueMotion(const TrueMotion&) = delete;
  TrueMotion& operator=(const TrueMotion&) = delete;

  /// Where each body is while it is there, if it ever is.
  const std::vector<PresentBody>& bodies() const { return present_; }
  const ContactRule& rule() const { return rule_; }
  GapCourse pair(std::uint32_t first, std::uint32_t second) const;
  GapCourse wall(std::uint32_t body, Wall wall) const;
  /// From when on and until when two bodies (or one, twice) are both there. The first is larger if never.
  double first_time(std::uint32_t a, std::uint32_t b) const;
  double last_time(std::uint32_t a, std::uint32_t b) const;

  /// The contacts with this gap of two bodies or, with a body twice, of a body and a wall. The gap is above 0
  /// outside of the spans.
  std::vector<ContactInterval> contacts(const GapCourse& gap, std::uint32_t a, std::uint32_t b,
                                        const std::vector<NearSpan>& spans) const;
  /// One span for all the time that both are there.
  NearSpan whole_span(std::uint32_t a, std::uint32_t b) const;

 private:
  const Scene& scene_;
  ContactRule rule_;
  std::vector<Trajectory> trajectories_;
  std::vector<PresentBody> present_;
};

}  // namespace kinesphere
