// A game at 60 frames a second, in C. It moves its balls as games do, v += g dt, x += v dt, and hands each
// frame over. Contacts come with their exact times between the last two frames and are answered there: fast
// balls never pass through each other or the walls. rust/examples and csharp/examples have the same game.
#include <kinesphere.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { balls = 216, frames = 600 };

static double random_number(void) {
  static uint64_t state = 7;
  state = state * 16807 % 2147483647;
  return (double)state / 2147483647.0;
}

static void require(ks_status status) {
  if (status == KS_OK) return;
  fprintf(stderr, "%s\n", ks_last_error_message());
  exit(1);
}

int main(void) {
  const double dt = 1.0 / 60, radius = 0.2, edge = 10;

  // The game's own bodies.
  ks_state game[balls];
  for (int k = 0; k < balls; ++k) {
    const ks_vec3 position = {0.5 + 1.8 * (k % 6), 0.5 + 1.8 * (k / 6 % 6), 1.0 + 1.5 * (k / 36)};
    game[k].position = position;
    game[k].velocity.x = 60 * (random_number() - 0.5);
    game[k].velocity.y = 60 * (random_number() - 0.5);
    game[k].velocity.z = 60 * (random_number() - 0.5);
  }

  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = (ks_vec3){edge, edge, edge};
  definition.contact_tolerance = 1e-3;
  definition.contacts = KS_CONTACTS_IMPACTS;
  ks_world world;
  require(ks_world_create(&definition, &world));
  ks_body_definition like = ks_default_body_definition();
  like.radius = radius;
  ks_motion_definition motion = ks_default_motion_definition();
  motion.kind = KS_MOTION_FRAMES;
  motion.count = balls;
  motion.states = game;
  motion.interval = dt;
  motion.like = &like;
  uint32_t number;
  ks_body_id ids[balls];
  require(ks_world_add_motion(world, &motion, &number, ids));

  int between_balls = 0, off_walls = 0;
  double deepest = 0;
  for (int frame = 1; frame <= frames; ++frame) {
    ks_vec3 positions[balls];
    for (int k = 0; k < balls; ++k) {
      game[k].velocity.z += -9.81 * dt;
      positions[k].x = game[k].position.x + game[k].velocity.x * dt;
      positions[k].y = game[k].position.y + game[k].velocity.y * dt;
      positions[k].z = game[k].position.z + game[k].velocity.z * dt;
    }
    require(ks_world_push_frame(world, number, positions, balls));
    double now;
    require(ks_world_latest_frame_time(world, number, &now));
    ks_event event = ks_new_event();
    for (;;) {
      require(ks_world_advance(world, now, ks_probe_motions, NULL, &event));
      if (event.kind == KS_EVENT_NONE) break;
      if (event.kind == KS_EVENT_CONTACT_BEGIN) ++between_balls;
      if (event.kind == KS_EVENT_WALL_BEGIN) ++off_walls;
      ks_response after = ks_new_response();
      require(ks_bounce(&event, 0.8, 0.0, &after));
      if (after.turns_first) {
        game[event.first.index].velocity = after.first_velocity;
        require(ks_world_set_velocity(world, event.first, after.first_velocity));
      }
      if (after.turns_second) {
        game[event.second.index].velocity = after.second_velocity;
        require(ks_world_set_velocity(world, event.second, after.second_velocity));
      }
    }
    size_t count;
    require(ks_world_latest_frame(world, number, positions, balls, &count));
    for (int k = 0; k < balls; ++k) {  // here the game draws them
      const ks_vec3 p = game[k].position = positions[k];
      const double margins[6] = {p.x, p.y, p.z, edge - p.x, edge - p.y, edge - p.z};
      for (int side = 0; side < 6; ++side)
        if (radius - margins[side] > deepest) deepest = radius - margins[side];
    }
  }
  require(ks_world_destroy(world));
  printf("%d bounces between balls, %d off walls, in %d frames\n", between_balls, off_walls, frames);
  printf("no ball was ever deeper in a wall than %.4f\n", deepest);
  return deepest <= 1e-3 ? 0 : 1;
}
