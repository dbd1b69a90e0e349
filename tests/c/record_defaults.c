// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Defaults are what the comments of the header say.
// clang-format off
#include <kinesphere.h>
#include <math.h>

#include "check.h"

static void world_definition(void) {
  const ks_world_definition made = ks_default_world_definition();
  CHECK(made.dimensions == 3);
  CHECK(made.has_box == 0);
  CHECK(made.periodic == 0);
  CHECK(made.box.lower.x == 0);
  CHECK(made.box.lower.y == 0);
  CHECK(made.box.lower.z == 0);
  CHECK(made.box.upper.x == 0);
  CHECK(made.box.upper.y == 0);
  CHECK(made.box.upper.z == 0);
  CHECK(made.contact_tolerance == 1e-6);
  CHECK(made.separation_distance != made.separation_distance);
  CHECK(made.zeno_interval == 0);
  CHECK(made.start_time == 0);
  CHECK(made.contacts == 3);
  CHECK(made.allow_overlap == 1);
  CHECK(made.spread_window_starts == 0);
  CHECK(made.has_wall_filter == 0);
  CHECK(made.wall_filter.category == 1);
  CHECK(made.wall_filter.mask == UINT64_MAX);
  CHECK(made.wall_filter.group == 0);
  CHECK(made.adopt_observed_limits == 1);
  CHECK(made.reserved == 0);
  CHECK(made.shear_rate == 0);
}

static void body_definition(void) {
  const ks_body_definition made = ks_default_body_definition();
  CHECK(made.solid == 1);
  CHECK(made.contacts == 0);
  CHECK(made.sensor_class == 0);
  CHECK(made.radius == 1);
  CHECK(made.acceleration_limit == 0);
  CHECK(made.position_error == 0);
  CHECK(made.velocity_error == 0);
  CHECK(made.mass == 1);
  CHECK(made.planned_acceleration.x == 0);
  CHECK(made.planned_acceleration.y == 0);
  CHECK(made.planned_acceleration.z == 0);
  CHECK(made.position.x == 0);
  CHECK(made.position.y == 0);
  CHECK(made.position.z == 0);
  CHECK(made.velocity.x == 0);
  CHECK(made.velocity.y == 0);
  CHECK(made.velocity.z == 0);
  CHECK(made.filter.category == 1);
  CHECK(made.filter.mask == UINT64_MAX);
  CHECK(made.filter.group == 0);
  CHECK(made.user_data == 0);
}

static void static_definition(void) {
  const ks_static_definition made = ks_default_static_definition();
  CHECK(made.solid == 1);
  CHECK(made.sensor_class == 0);
  CHECK(made.filter.category == 1);
  CHECK(made.filter.mask == UINT64_MAX);
  CHECK(made.filter.group == 0);
  CHECK(made.user_data == 0);
}

static void rigid_definition(void) {
  const ks_rigid_definition made = ks_default_rigid_definition();
  CHECK(made.part_count == 0);
  CHECK(made.parts == NULL);
  CHECK(made.angular_acceleration_limit == 0);
  CHECK(made.largest_angular_speed == INFINITY);
  CHECK(made.inertia.x == 0);
  CHECK(made.inertia.y == 0);
  CHECK(made.inertia.z == 0);
  CHECK(made.hull_count == 0);
  CHECK(made.hulls == NULL);
}

static void roughness(void) {
  const ks_roughness made = ks_default_roughness();
  CHECK(made.reserved == 0);
  CHECK(made.restitution == 1);
  CHECK(made.tangential_restitution == 1);
  CHECK(made.friction == INFINITY);
  CHECK(made.inertia == 0.4);
}

static void step_potential_definition(void) {
  const ks_step_potential_definition made = ks_default_step_potential_definition();
  CHECK(made.reserved == 0);
  CHECK(made.count == 0);
  CHECK(made.distances == NULL);
  CHECK(made.energies == NULL);
  CHECK(made.outside == 0);
  CHECK(made.restitution == 1);
}

static void run_definition(void) {
  const ks_run_definition made = ks_default_run_definition();
  CHECK(made.threads == 1);
  CHECK(made.restitution == 1);
  CHECK(made.resting_speed == 0);
  CHECK(made.respond == 0);
  CHECK(made.respond_user == NULL);
  CHECK(made.sink == 0);
  CHECK(made.sink_user == NULL);
}

static void game_definition(void) {
  const ks_game_definition made = ks_default_game_definition();
  CHECK(made.reserved == 0);
  CHECK(made.gravity.x == 0);
  CHECK(made.gravity.y == 0);
  CHECK(made.gravity.z == 0);
  CHECK(made.restitution == 1);
  CHECK(made.resting_speed == 0);
  CHECK(made.respond == 0);
  CHECK(made.respond_user == NULL);
}

static void motion_definition(void) {
  const ks_motion_definition made = ks_default_motion_definition();
  CHECK(made.kind == 0);
  CHECK(made.count == 0);
  CHECK(made.states == NULL);
  CHECK(made.radii == NULL);
  CHECK(made.masses == NULL);
  CHECK(made.acceleration_limits == NULL);
  CHECK(made.gravity.x == 0);
  CHECK(made.gravity.y == 0);
  CHECK(made.gravity.z == 0);
  CHECK(made.interval == 1.0/60);
  CHECK(made.position_error == 0);
  CHECK(made.seed == 1);
  CHECK(made.like == NULL);
}

static void monitor_definition(void) {
  const ks_monitor_definition made = ks_default_monitor_definition();
  CHECK(made.dimensions == 3);
  CHECK(made.has_start_time == 0);
  CHECK(made.start_time == 0);
  CHECK(made.classes == NULL);
  CHECK(made.class_count == 0);
  CHECK(made.separations == NULL);
  CHECK(made.separation_count == 0);
  CHECK(made.tolerance == 1e-3);
  CHECK(made.time_resolution == 1e-3);
  CHECK(made.window == 1);
  CHECK(made.stale_after == INFINITY);
  CHECK(made.drop_after == INFINITY);
  CHECK(made.prediction_hold == 0);
  CHECK(made.prediction_confirmation == 0);
  CHECK(made.prediction_margin == 0);
  CHECK(made.prediction_error_part == 0);
  CHECK(made.shard_of == 1);
  CHECK(made.shard_first == 0);
  CHECK(made.shard_count == 1);
}

static void track_report(void) {
  const ks_track_report made = ks_default_track_report();
  CHECK(made.has_plan == 0);
  CHECK(made.track_class == 0);
  CHECK(made.timestamp == 0);
  CHECK(made.timestamp_error == 0);
  CHECK(made.state.position.x == 0);
  CHECK(made.state.position.y == 0);
  CHECK(made.state.position.z == 0);
  CHECK(made.state.velocity.x == 0);
  CHECK(made.state.velocity.y == 0);
  CHECK(made.state.velocity.z == 0);
  CHECK(made.position_error.kind == 0);
  CHECK(made.position_error.horizontal == 0);
  CHECK(made.position_error.vertical == 0);
  CHECK(made.velocity_error.kind == 0);
  CHECK(made.velocity_error.horizontal == 0);
  CHECK(made.velocity_error.vertical == 0);
  CHECK(made.plan_acceleration.x == 0);
  CHECK(made.plan_acceleration.y == 0);
  CHECK(made.plan_acceleration.z == 0);
  CHECK(made.plan_limit.kind == 0);
  CHECK(made.plan_limit.horizontal == 0);
  CHECK(made.plan_limit.vertical == 0);
  CHECK(made.plan_valid_until == INFINITY);
}

int main(void) {
  world_definition();
  body_definition();
  static_definition();
  rigid_definition();
  roughness();
  step_potential_definition();
  run_definition();
  game_definition();
  motion_definition();
  monitor_definition();
  track_report();
  puts("all defaults are those of the header");
  return 0;
}
