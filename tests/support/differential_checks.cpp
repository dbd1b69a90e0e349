#include "support/differential_checks.hpp"

#include <optional>
#include <vector>

#include "contact/contact_event.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/run/flight.hpp"
#include "support/detector_runs.hpp"

namespace kinesphere::scene_tests {
namespace {

/// Returns the first time at which the gap is deeper than the tolerance, after it was first not negative.
std::optional<double> first_overlap(const GapCourse& gap, const Scene& scene) {
  const double from = scene.world.start_time;
  const auto apart = gap.first_time(LevelCrossing::rises_to, 0.0, from, scene.end_time);
  if (!apart) return std::nullopt;
  const double tolerance = scene.world.contact_tolerance;
  return gap.first_time(LevelCrossing::falls_to, -tolerance * (1.0 + 1.0 / 16.0), *apart, scene.end_time);
}

}  // namespace

void expect_agreement_with_oracle(const Scene& scene, const DetectorMaker& make) {
  const std::vector<Event> events = events_of(scene, make, 1000000, 7);
  for (const Event& event : events) ASSERT_NE(event.kind, EventKind::bound_violation) << scene.name;
  const ContactComparison comparison = compare_with_oracle(scene, events).value();
  EXPECT_TRUE(comparison.agrees()) << scene.name << ": " << comparison.late << " late, " << comparison.missed
                                   << " missed, " << comparison.invented << " invented; "
                                   << comparison.first_difference.value_or("");
  testing::Test::RecordProperty("matched", static_cast<int>(comparison.matched));
  testing::Test::RecordProperty("grazing", static_cast<int>(comparison.grazing));
}

void expect_no_overlaps(Scene scene, const DetectorMaker& make) {
  scene.response = SceneResponse::bounce;
  scene.world.contacts = ContactEvents::impacts;
  const Flight flight = record_flight(scene, make).value();
  ASSERT_EQ(flight.result.counters.count(EventKind::zeno_guard), 0u);
  for (std::uint32_t a = 0; a < scene.bodies.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const GapCourse gap(flight.paths[a], flight.paths[b], scene.bodies[a].radius + scene.bodies[b].radius);
      const auto overlap = first_overlap(gap, scene);
      ASSERT_FALSE(overlap) << "bodies " << a << " and " << b << " at time " << *overlap;
    }
    if (!scene.world.box) continue;
    for (const Wall wall : walls) {
      const HalfSpace inside = half_space(*scene.world.box, wall);
      const auto overlap = first_overlap({flight.paths[a], inside, scene.bodies[a].radius}, scene);
      ASSERT_FALSE(overlap) << "body " << a << " and wall " << name_of(wall) << " at time " << *overlap;
    }
  }
}

}  // namespace kinesphere::scene_tests
