// A control tower in C: 30 drones report every second, each at its own time and with errors of up to a metre.
// The monitor says when two are certainly within 50 m of each other, and never wrongly. rust/examples and
// csharp/examples have the same tower.
#include <kinesphere.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { drones = 30, seconds = 60 };

static double random_number(void) {
  static uint64_t state = 5;
  state = state * 16807 % 2147483647;
  return (double)state / 2147483647.0;
}

static void require(ks_status status) {
  if (status == KS_OK) return;
  fprintf(stderr, "%s\n", ks_last_error_message());
  exit(1);
}

int main(void) {
  const double noise = 1, warning = 50;
  const ks_track_class drone = {ks_error_ball(4), ks_error_ball(INFINITY), {0, 0, 0}};
  const ks_separation level = {KS_SEPARATION_ELLIPSOID, warning, warning, 0, 0};
  const ks_separation_rule rule = {0, 0, &level, 1};
  ks_monitor_definition definition = ks_default_monitor_definition();
  definition.classes = &drone;
  definition.class_count = 1;
  definition.separations = &rule;
  definition.separation_count = 1;
  definition.tolerance = 4 * noise;
  ks_monitor tower;
  require(ks_monitor_create(&definition, &tower));

  // Hidden from the tower: the drones fly straight.
  ks_state start[drones];
  for (int k = 0; k < drones; ++k) {
    start[k].position = (ks_vec3){1000 * random_number(), 1000 * random_number(), 100};
    start[k].velocity = (ks_vec3){30 * (random_number() - 0.5), 30 * (random_number() - 0.5), 0};
  }

  int within = 0, wrong = 0;
  for (int k = 0; k < drones * seconds; ++k) {
    const int who = k % drones;
    const double time = (double)k / drones;
    // Everything that becomes certain before the next report comes in.
    ks_monitor_event event = ks_new_monitor_event();
    for (;;) {
      require(ks_monitor_advance(tower, time, NULL, NULL, &event));
      if (event.kind == KS_MONITOR_NONE) break;
      if (event.kind != KS_MONITOR_VERDICT || event.verdict != KS_VERDICT_WITHIN) continue;
      ++within;
      const ks_state a = start[event.first], b = start[event.second];
      const double x = b.position.x - a.position.x + (b.velocity.x - a.velocity.x) * event.time;
      const double y = b.position.y - a.position.y + (b.velocity.y - a.velocity.y) * event.time;
      if (sqrt(x * x + y * y) > warning + definition.tolerance) ++wrong;
      printf("%8.3f s  drones %d and %d are within %g m\n", event.time, (int)event.first, (int)event.second,
             warning);
    }
    ks_track_report report = ks_default_track_report();
    report.timestamp = time;
    report.state = start[who];
    report.state.position.x += start[who].velocity.x * time + noise * (random_number() - 0.5);
    report.state.position.y += start[who].velocity.y * time + noise * (random_number() - 0.5);
    report.position_error = ks_error_ball(noise);
    const uint64_t track = (uint64_t)who;
    require(ks_monitor_report(tower, &track, &report, 1));
  }
  require(ks_monitor_destroy(tower));
  printf("%d warnings in a minute, %d of them wrong\n", within, wrong);
  return wrong == 0 && within > 0 ? 0 : 1;
}
