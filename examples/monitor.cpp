// A control tower watches 200 drones that report with errors of a metre. It gets a warning when two may be
// within 50 m of each other, an alarm at 10 m, and knows for each drone how long no other can come that near.
#include <kinesphere/kinesphere.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const double warning = 50, alarm = 10, agility = 4, noise = 1;
  const SensorClass airspace = 1;

  // Hidden from the tower: the true states of the drones and their destinations.
  std::vector<State> start(200);
  Random random(200);
  for (std::uint32_t k = 0; k < start.size(); ++k) {
    const std::uint32_t row = k / 20, column = k % 20;
    start[k] = {{120.0 * column, 120.0 * row, 100}, 12 * random.point_in_ball()};
  }
  RandomForces drones =
      RandomForces::create(
          {.start = start, .acceleration_limits = std::vector(start.size(), agility), .interval = 3})
          .value();
  const auto report = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      states[k] = drones.state(ids[k].index, time);
      states[k].position += 0.9 * noise * random.point_in_ball();
    }
  };

  World tower = World::create({.contact_tolerance = 1e-3, .separation_distance = 5 * noise}).value();
  tower.set_sensor(airspace, {.distances = {warning, alarm}}).value();
  for (std::uint32_t k = 0; k < drones.size(); ++k) {
    BodyDefinition drone = drones.definition(k, 0.0);
    drone.radius = 0.5;
    drone.position_error = noise;
    drone.sensor_class = airspace;
    drone.user_data = 1000 + k;  // its registration
    tower.add(drone).value();
  }

  int warnings = 0, alarms = 0, collisions = 0, late = 0;
  for (const Event& event : tower.events(60.0, report)) {
    if (event.kind == EventKind::contact_begin) ++collisions;
    if (event.kind != EventKind::sensor_enter) continue;
    ++(event.distance == alarm ? alarms : warnings);
    const double apart = norm(drones.state(event.first.index, event.time).position -
                              drones.state(event.second.index, event.time).position) -
                         2 * 0.5;
    if (apart < event.distance - 1e-3) ++late;
    if (event.distance == alarm)
      std::printf("%8.3f s  drones %llu and %llu may be within %g m\n", event.time,
                  (unsigned long long)event.first_user_data, (unsigned long long)event.second_user_data,
                  alarm);
  }
  std::printf(
      "%d warnings, %d alarms (%d of them late), %d collisions in a minute; %.2f reports per drone and "
      "second\n",
      warnings, alarms, late, collisions, double(tower.counters().probes) / (60.0 * 200));

  int quiet = 0;
  for (const BodyId id : tower.bodies())
    if (tower.certificates(report).earliest_approach(id, warning).value().time > 62.0) ++quiet;
  std::printf("for the next two seconds %d drones are certain to stay %g m from all others\n", quiet,
              warning);
  return late == 0 ? 0 : 1;
}
