// The scene of tests/same_hash/shared_scene.cpp in C, run in three ways, and the game. Each prints its hash.
#include "check.h"

#include <inttypes.h>

enum { balls = 64 };

static double next_number(void) {
  static uint64_t state = 1;
  state = state * 16807 % 2147483647;
  return (double)state / 2147483647.0;
}

static ks_world make_world(const ks_state* start, const double* radii) {
  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = vec3(20, 20, 20);
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  const double distance = 0.5;
  CHECK_OK(ks_world_set_sensor(world, 0, &distance, 1, UINT64_MAX));

  double limits[balls];
  for (int k = 0; k < balls; ++k) limits[k] = 5.0;
  ks_motion_definition motion = ks_default_motion_definition();
  motion.kind = KS_MOTION_RANDOM_FORCES;
  motion.count = balls;
  motion.states = start;
  motion.radii = radii;
  motion.masses = radii;
  motion.acceleration_limits = limits;
  motion.interval = 0.2;
  motion.seed = 7;
  ks_body_id ids[balls], zone;
  CHECK_OK(ks_world_add_motion(world, &motion, NULL, ids));
  const ks_shape box = ks_solid_box(vec3(5, 5, 5), vec3(15, 15, 15));
  CHECK_OK(ks_world_add_zone(world, &box, 0, &zone));
  return world;
}

static void print_and_destroy(ks_world world, const ks_event_hash* hash) {
  uint64_t value;
  CHECK_OK(ks_event_hash_value(hash, &value));
  printf("%016" PRIx64 "\n", value);
  CHECK_OK(ks_world_destroy(world));
}

static void step_by_step(ks_world world) {
  ks_event_hash hash = {0, 0};
  ks_event event = ks_new_event();
  for (;;) {
    CHECK_OK(ks_world_advance(world, 5.0, ks_probe_motions, NULL, &event));
    if (event.kind == KS_EVENT_NONE) break;
    CHECK_OK(ks_event_hash_add(&hash, &event));
    ks_response after = ks_new_response();
    CHECK_OK(ks_bounce(&event, 0.9, 0.0, &after));
    if (after.turns_first) CHECK_OK(ks_world_set_velocity(world, event.first, after.first_velocity));
    if (after.turns_second) CHECK_OK(ks_world_set_velocity(world, event.second, after.second_velocity));
  }
  print_and_destroy(world, &hash);
}

static int32_t add_to_hash(const ks_event* event, void* hash) {
  return ks_event_hash_add((ks_event_hash*)hash, event);
}

static void at_once(ks_world world, int32_t threads) {
  ks_event_hash hash = {0, 0};
  ks_run_definition run = ks_default_run_definition();
  run.threads = threads;
  run.restitution = 0.9;
  run.sink = add_to_hash;
  run.sink_user = &hash;
  CHECK_OK(ks_world_run(world, 5.0, &run));
  print_and_destroy(world, &hash);
}

static ks_body_list bodies_of(ks_world game) {
  ks_body_list bodies;
  CHECK_OK(ks_game_bodies(game, &bodies));
  return bodies;
}

static void turn_all(ks_world game) {
  const ks_body_list bodies = bodies_of(game);
  ks_vec3 turned[balls];
  for (size_t k = 0; k < bodies.count; ++k)
    turned[k] = vec3(bodies.velocities[k].y, bodies.velocities[k].z, bodies.velocities[k].x);
  CHECK_OK(ks_game_set_velocities(game, turned, bodies.count));
}

static void play(void) {
  ks_world_definition room = ks_default_world_definition();
  room.has_box = 1;
  room.box.upper = vec3(10, 10, 10);
  ks_game_definition definition = ks_default_game_definition();
  definition.gravity = vec3(0, 0, -9.81);
  definition.restitution = 0.9;
  ks_world game;
  CHECK_OK(ks_game_create(&room, &definition, &game));
  ks_static_definition block = ks_default_static_definition();
  block.shape = ks_solid_box(vec3(4, 4, 0), vec3(6, 6, 1));
  ks_body_id id;
  CHECK_OK(ks_world_add_static(game, &block, 1, &id));
  for (int k = 0; k < 27; ++k) {
    ks_body_definition ball = ks_default_body_definition();
    ball.mass = ball.radius = 0.3 + 0.5 * next_number();
    ball.position = vec3(2 + k % 3 * 3.0, 2 + k / 3 % 3 * 3.0, 2 + k / 9 * 3.0);
    ball.velocity.x = 10.0 * (next_number() - 0.5);
    ball.velocity.y = 10.0 * (next_number() - 0.5);
    ball.velocity.z = 10.0 * (next_number() - 0.5);
    CHECK_OK(ks_world_add(game, &ball, 1, &id));
  }
  ks_event_hash hash = {0, 0};
  for (int frame = 0; frame < 128; ++frame) {
    if (frame % 16 == 0) turn_all(game);
    if (frame == 32) CHECK_OK(ks_world_remove(game, &bodies_of(game).ids[3], 1));
    if (frame == 64) {
      ks_body_definition ball = ks_default_body_definition();
      ball.radius = 0.25;
      ball.position = vec3(5, 5, 9.5);
      CHECK_OK(ks_world_add(game, &ball, 1, &id));
    }
    if (frame == 96) CHECK_OK(ks_game_set_acceleration(game, bodies_of(game).ids[0], vec3(0, 0, 20)));
    ks_event_list happened;
    CHECK_OK(ks_game_step(game, 0.015625, &happened));
    for (size_t k = 0; k < happened.count; ++k) CHECK_OK(ks_event_hash_add(&hash, &happened.events[k]));
  }
  print_and_destroy(game, &hash);
}

int main(void) {
  ks_state start[balls];
  double radii[balls];
  for (int k = 0; k < balls; ++k) {
    radii[k] = 0.5 + next_number();
    start[k].position = vec3(2.5 + k % 4 * 5.0, 2.5 + k / 4 % 4 * 5.0, 2.5 + k / 16 * 5.0);
    start[k].velocity.x = 20.0 * (next_number() - 0.5);
    start[k].velocity.y = 20.0 * (next_number() - 0.5);
    start[k].velocity.z = 20.0 * (next_number() - 0.5);
  }
  step_by_step(make_world(start, radii));
  at_once(make_world(start, radii), 1);
  at_once(make_world(start, radii), 2);
  play();
  return 0;
}
