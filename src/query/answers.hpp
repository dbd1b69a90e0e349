// Certified answers about the future, from recorded facts and from bounds as they are.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "engine/engine.hpp"

namespace kinesphere {

/// A contact that may begin, or a distance that may be reached, and the time before which it cannot.
struct ContactBoundary {
  double time = std::numeric_limits<double>::infinity();
  std::uint32_t body = 0;
  std::optional<std::uint32_t> partner{};
  Wall wall = Wall::none;
  bool touching = false;  ///< it has begun, or the distance certainly is reached: `time` is now

  bool exists() const { return partner || wall != Wall::none; }
};

/// An answer, and whether the probe was asked for it.
struct ProbedAnswer {
  ContactBoundary boundary;
  bool probed = false;
};

/// A picture of the engine as it stands: good until the engine changes.
class World::Engine::Answers {
 public:
  explicit Answers(const Engine& engine);

  ContactBoundary of_pair(std::uint32_t a, std::uint32_t b) const;
  ContactBoundary of_body(std::uint32_t number) const;
  ContactBoundary of_world() const;
  DistanceLimits distance(std::uint32_t a, std::uint32_t b, double time) const;
  /// When the surfaces of the two may be as near as this, whatever filters say.
  ContactBoundary approach_of_pair(std::uint32_t a, std::uint32_t b, double distance) const;
  /// When a wall, or a body that it may meet, may be as near to it as this.
  ContactBoundary approach_of_body(std::uint32_t number, double distance) const;

  /// The answer of `ask(Answers)`. What limits it is probed and it is asked again, until fresh reports limit
  /// it; stopping early is safe. Where `valid` is an error there may be no engine. `refresh(numbers)` probes
  /// those of them whose reports are old, at least one in each round, and tells whether there were any.
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
  static std::vector<std::uint32_t> concerned(const ContactBoundary& onset);
  const Body& body(std::uint32_t number) const { return engine_.bodies()[number]; }
  Bound present(std::uint32_t number) const;
  Bound guarded(std::uint32_t number) const;
  double meeting(const CollisionShape& extent_of_a, const CollisionShape& extent_of_b) const;
  bool settled(std::uint32_t a, std::uint32_t b) const;
  double recorded(std::uint32_t a, std::uint32_t b, const CertificateTimes& hot) const;
  double recorded_of_walls(std::uint32_t number, const CertificateTimes& hot) const;
  void consider_touching(std::uint32_t number, ContactBoundary& first) const;
  void consider_walls(std::uint32_t number, const CertificateTimes& hot, ContactBoundary& first) const;
  void consider(std::uint32_t a, std::uint32_t b, const CertificateTimes& hot, ContactBoundary& first) const;
  void consider_approach(std::uint32_t a, std::uint32_t b, double distance, ContactBoundary& first) const;
  void consider_approach_to_walls(std::uint32_t number, double distance, ContactBoundary& first) const;
  InflatedBound until_horizon(std::uint32_t number, double horizon) const;
  void consider_all_within(const std::vector<std::uint32_t>& numbers, const CertificateTimes& hot,
                           ContactBoundary& first) const;

  const Engine& engine_;
  double now_;
  /// Pairs (a body and itself: its walls) about which an event of this instant is on its way, or has been
  /// delivered since the engine last looked: no fact is recorded of them.
  std::set<std::pair<std::uint32_t, std::uint32_t>> open_;
};

}  // namespace kinesphere
