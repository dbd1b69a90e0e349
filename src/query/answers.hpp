// Certified answers about the future, from stored certificates and present bounds.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "kinesphere/certificates.hpp"

namespace kinesphere {

/// Earliest possible begin of a contact, or approach to a distance: it cannot happen before `time`.
struct ContactBoundary {
  double time = std::numeric_limits<double>::infinity();
  std::uint32_t body = 0;
  std::optional<std::uint32_t> partner{};
  Wall wall = Wall::none;
  /// Contact has begun or the distance is certainly reached; `time` is the present time.
  bool touching = false;

  bool exists() const { return partner || wall != Wall::none; }
};

/// An answer, with whether the probe was called for it.
struct ProbedAnswer {
  ContactBoundary boundary;
  bool probed = false;
};

/// Answers from the present state of the engine. Invalidated by any change of the engine.
class World::Engine::Answers {
 public:
  explicit Answers(const Engine& engine);

  ContactBoundary of_pair(std::uint32_t a, std::uint32_t b) const;
  ContactBoundary of_body(std::uint32_t number) const;
  ContactBoundary of_world() const;
  DistanceLimits distance(std::uint32_t a, std::uint32_t b, double time) const;
  /// Earliest time at which the surfaces of the two bodies may be within `distance` (length). Ignores
  /// filters.
  ContactBoundary approach_of_pair(std::uint32_t a, std::uint32_t b, double distance) const;
  /// Earliest time at which a wall, or another body that passes the filters, may be within `distance`
  /// (length) of the body.
  ContactBoundary approach_of_body(std::uint32_t number, double distance) const;

  /// Returns the answer of `ask(Answers)`. The bodies that limit the answer are probed and `ask` is repeated,
  /// until the limiting reports are fresh or after max_rounds, which is safe but less sharp.
  /// `refresh(numbers)` probes those of the bodies with old reports, at least one per round, and returns
  /// whether there were any. If `valid` is an error, it is returned, and `engine` may be null.
  template <class Refresh, class Ask>
  static Result<ProbedAnswer> answer(const Engine* engine, const Result<void>& valid, Refresh refresh,
                                     std::size_t max_rounds, Ask ask) {
    if (!valid) return valid.error();
    ProbedAnswer refined{ask(Answers(*engine))};
    for (std::size_t round = 0; round < max_rounds; ++round) {
      const auto probed = refresh(concerned(refined.boundary));
      if (!probed) return probed.error();
      if (!probed.value()) break;
      refined = {ask(Answers(*engine)), true};
    }
    return refined;
  }

 private:
  static std::vector<std::uint32_t> concerned(const ContactBoundary& boundary);
  const Body& body(std::uint32_t number) const { return engine_.bodies()[number]; }
  Bound present(std::uint32_t number) const;
  Bound guarded(std::uint32_t number) const;
  CollisionShape shape_of(std::uint32_t number, const Bound& bound) const;
  double meeting(const CollisionShape& extent_of_a, const CollisionShape& extent_of_b) const;
  bool is_certified(std::uint32_t a, std::uint32_t b) const;
  double recorded(std::uint32_t a, std::uint32_t b, const CertificateTimes& times) const;
  double recorded_of_walls(std::uint32_t number, const CertificateTimes& times) const;
  void consider_touching(std::uint32_t number, ContactBoundary& first) const;
  void consider_walls(std::uint32_t number, const CertificateTimes& times, ContactBoundary& first) const;
  void consider(std::uint32_t a, std::uint32_t b, const CertificateTimes& times,
                ContactBoundary& first) const;
  void consider_approach(std::uint32_t a, std::uint32_t b, double distance, ContactBoundary& first) const;
  void consider_approach_to_walls(std::uint32_t number, double distance, ContactBoundary& first) const;
  InflatedBound until_horizon(std::uint32_t number, double horizon) const;
  void consider_all_within(const std::vector<std::uint32_t>& numbers, const CertificateTimes& times,
                           ContactBoundary& first) const;

  const Engine& engine_;
  double now_;
  /// Pairs without a valid certificate: an event of the present time is pending, or has been delivered since
  /// the last recheck. A pair of a body with itself stands for its walls.
  std::set<std::pair<std::uint32_t, std::uint32_t>> open_;
};

}  // namespace kinesphere
