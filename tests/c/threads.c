// Several threads create, use and destroy worlds of their own, and race for one that they share. The threads
// of a world share its work, with the same outcome.
// For barriers, which C11 does not know.
#define _POSIX_C_SOURCE 200809L

#include "check.h"

#include <pthread.h>

enum { threads = 4, rounds = 100 };

static int32_t stand_still(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                           void* user) {
  (void)bodies, (void)time, (void)user;
  for (size_t k = 0; k < count; ++k) {
    states[k].position = vec3(0, 0, 0);
    states[k].velocity = vec3(0, 0, 0);
  }
  return 0;
}

static ks_world new_world(void) {
  const ks_world_definition definition = ks_default_world_definition();
  const ks_body_definition ball = ks_default_body_definition();
  ks_world world;
  ks_body_id id;
  CHECK_OK(ks_world_create(&definition, &world));
  CHECK_OK(ks_world_add(world, &ball, 1, &id));
  return world;
}

/// What a call of a shared world may get.
static void check_shared(ks_status status) {
  CHECK(status == KS_OK || status == KS_ERROR_IN_USE || status == KS_ERROR_STALE_HANDLE);
}

static ks_world shared[rounds];
static pthread_barrier_t barrier;

/// Returns how many of the shared worlds this thread has destroyed.
static void* race(void* destroyed) {
  for (int round = 0; round < rounds; ++round) {
    pthread_barrier_wait(&barrier);
    const ks_world own = new_world();
    ks_event event = ks_new_event();
    CHECK_OK(ks_world_advance(own, 1, stand_still, NULL, &event));
    double time;
    check_shared(ks_world_time(shared[round], &time));
    check_shared(ks_world_advance(shared[round], 1, stand_still, NULL, &event));
    const ks_status ended = ks_world_destroy(shared[round]);
    check_shared(ended);
    if (ended == KS_OK) ++*(int*)destroyed;
    CHECK_OK(ks_world_destroy(own));
    CHECK_STATUS(ks_world_destroy(own), KS_ERROR_STALE_HANDLE);
  }
  return NULL;
}

enum { steered = 5000 };
static ks_vec3 positions[steered], velocities[steered];
static double began;

static int32_t go_straight_on(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                              void* user) {
  (void)user;
  for (size_t k = 0; k < count; ++k) {
    const ks_vec3 p = positions[bodies[k].index], v = velocities[bodies[k].index];
    const double s = time - began;
    states[k].position = vec3(p.x + v.x * s, p.y + v.y * s, p.z + v.z * s);
    states[k].velocity = v;
  }
  return 0;
}

/// Gives all bodies another velocity in each of some frames. Returns the hash of the events.
static uint64_t steer(int32_t use) {
  static ks_body_definition balls[steered];
  static ks_body_id ids[steered];
  const ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  ks_event_hash hash = {0, 0};
  CHECK_OK(ks_world_create(&definition, &world));
  CHECK_OK(ks_world_use_threads(world, use));
  CHECK_STATUS(ks_world_use_threads(world, 0), KS_ERROR_OUT_OF_RANGE);
  for (int k = 0; k < steered; ++k) {
    balls[k] = ks_default_body_definition();
    balls[k].radius = 0.4;
    positions[k] = balls[k].position = vec3(k % 17, k / 17 % 17, k / 289);
  }
  began = 0;
  CHECK_OK(ks_world_add(world, balls, steered, ids));
  int events = 0;
  for (int frame = 1; frame <= 4; ++frame) {
    for (int k = 0; k < steered; ++k) {
      velocities[k] = vec3((k * 7 + frame * 13) % 11 - 5, (k * 5 + frame * 3) % 11 - 5, k % 7 - 3);
    }
    CHECK_OK(ks_world_set_velocities(world, ids, velocities, steered));
    ks_event event = ks_new_event();
    for (;;) {
      CHECK_OK(ks_world_advance(world, frame / 60.0, go_straight_on, NULL, &event));
      if (event.kind == KS_EVENT_NONE) break;
      CHECK_OK(ks_event_hash_add(&hash, &event));
      ++events;
    }
    for (int k = 0; k < steered; ++k) {
      positions[k].x += velocities[k].x * (frame / 60.0 - began);
      positions[k].y += velocities[k].y * (frame / 60.0 - began);
      positions[k].z += velocities[k].z * (frame / 60.0 - began);
    }
    began = frame / 60.0;
  }
  CHECK(events > 100);
  uint64_t value;
  CHECK_OK(ks_event_hash_value(&hash, &value));
  CHECK_OK(ks_world_destroy(world));
  return value;
}

int main(void) {
  CHECK(steer(1) == steer(2) && steer(1) == steer(3));
  pthread_t running[threads];
  int destroyed[threads] = {0}, sum = 0, left = 0;
  for (int k = 0; k < rounds; ++k) shared[k] = new_world();
  CHECK(pthread_barrier_init(&barrier, NULL, threads) == 0);
  for (int k = 0; k < threads; ++k) CHECK(pthread_create(&running[k], NULL, race, &destroyed[k]) == 0);
  for (int k = 0; k < threads; ++k) {
    CHECK(pthread_join(running[k], NULL) == 0);
    sum += destroyed[k];
  }
  // A world stays if the last thread that tried to destroy it met another one's call.
  for (int k = 0; k < rounds; ++k) left += ks_world_destroy(shared[k]) == KS_OK;
  printf("%d of %d shared worlds were destroyed in the race, %d after it\n", sum, rounds, left);
  CHECK(sum + left == rounds);
  return 0;
}
