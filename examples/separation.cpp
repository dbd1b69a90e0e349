// Two aircraft and a drone report at irregular times, with errors, late, and one of them stops reporting.
// What is certain about their separation, what is predicted a minute ahead, and which report is needed?
#include <kinesphere/kinesphere.hpp>

#include <cstdio>

using namespace kinesphere;

int main() {
  // Units: metres and seconds. Aircraft turn with at most 0.5 g, and keep 1000 m apart or 100 m in height. A
  // closest approach that breaks this is predicted 60 s ahead.
  Monitor sky = Monitor::create({.classes = {{.acceleration_limit = 5.0, .largest_speed = 80.0}},
                                 .separations = {{0, 0, {Separation::cylinder(1000.0, 100.0, 60.0)}}},
                                 .stale_after = 10.0})
                    .value();
  const auto tell = [&](double until) {
    for (const MonitorEvent& event : sky.events(until)) {
      if (event.kind == MonitorEventKind::verdict)
        std::printf("%6.2f s  %llu and %llu: %s\n", event.time, (unsigned long long)event.first,
                    (unsigned long long)event.second, name_of(event.verdict).data());
      else if (event.kind == MonitorEventKind::predicted)
        std::printf("%6.2f s  %llu and %llu: if they go on, %.0f m at %.1f s\n", event.time,
                    (unsigned long long)event.first, (unsigned long long)event.second, event.closest_distance,
                    event.closest_time);
      else if (is_of_pair(event.kind))
        std::printf("%6.2f s  %llu and %llu: %s\n", event.time, (unsigned long long)event.first,
                    (unsigned long long)event.second, name_of(event.kind).data());
      else
        std::printf("%6.2f s  %llu: %s\n", event.time, (unsigned long long)event.first,
                    name_of(event.kind).data());
    }
  };
  const auto report = [&](TrackId id, double stamp, const Vec3& position, const Vec3& velocity) {
    TrackReport it{.timestamp = stamp, .state = {position, velocity}};
    it.position_error = ErrorBound::cylinder(30.0, 10.0);
    it.velocity_error = 1.0;
    sky.report(id, it).value();
  };

  report(1, 0.0, {0, 0, 500}, {60, 0, 0});
  report(2, 0.0, {4000, 50, 510}, {-60, 0, 0});
  report(3, 0.0, {9000, 9000, 120}, {0, 0, 0});
  tell(1.0);
  const PairAnswer answer = sky.answer(1, 2).value();
  std::printf(
      "1 and 2 are %s until %.2f s at least, between %.0f and %.0f m apart now; if they go on, %.0f m at "
      "%.1f s\n",
      name_of(answer.verdict).data(), answer.until, answer.lower, answer.upper, answer.closest_distance,
      answer.closest_time);

  // Reports come in a second late, and 2 does not report any more.
  for (double now = 2.0; now <= 40.0; now += 1.0) {
    tell(now);
    const double stamp = now - 1.0;
    report(1, stamp, {60 * stamp, 0, 500}, {60, 0, 0});
    report(3, stamp, {9000, 9000, 120}, {0, 0, 0});
    if (now <= 20.0) report(2, stamp, {4000 - 60 * stamp, 50, 510 + 2 * stamp}, {-60, 0, 2});
  }
  for (const ReportRequest& need : sky.needed(50.0))
    std::printf("a report of %llu is needed by %.2f s, for %llu\n", (unsigned long long)need.track, need.by,
                (unsigned long long)need.other);
}
