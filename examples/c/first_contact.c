// Two drones, one circling and one hovering in its way. The world gets their limits, but not their paths.
#include <kinesphere.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void require(ks_status status) {
  if (status == KS_OK) return;
  fprintf(stderr, "%s\n", ks_last_error_message());
  exit(1);
}

// Called only when it can matter; gives the true positions and velocities of bodies.
static int probe(const ks_body_id* ids, size_t count, double time, ks_state* states, void* user) {
  const ks_body_id circling = *(const ks_body_id*)user;
  const double c = cos(time / 2), s = sin(time / 2);
  for (size_t k = 0; k < count; ++k) {
    if (ids[k].index == circling.index) {
      states[k].position = (ks_vec3){20 * c, 20 * s, 0};
      states[k].velocity = (ks_vec3){-10 * s, 10 * c, 0};
    } else {
      states[k].position = (ks_vec3){-20, 1.5, 0};
      states[k].velocity = (ks_vec3){0, 0, 0};
    }
  }
  return 0;
}

int main(void) {
  const ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  require(ks_world_create(&definition, &world));

  ks_body_definition drone = ks_default_body_definition();
  ks_body_id circling, hovering;
  drone.radius = 1;
  drone.acceleration_limit = 5.001;  // a circle of radius 20 flown at speed 10 takes 5
  drone.position = (ks_vec3){20, 0, 0};
  drone.velocity = (ks_vec3){0, 10, 0};
  require(ks_world_add(world, &drone, 1, &circling));
  drone.acceleration_limit = 0.5;
  drone.position = (ks_vec3){-20, 1.5, 0};
  drone.velocity = (ks_vec3){0, 0, 0};
  require(ks_world_add(world, &drone, 1, &hovering));

  int contacts = 0;
  ks_event event = ks_new_event();
  for (;;) {
    require(ks_world_advance(world, 30.0, probe, &circling, &event));
    if (event.kind == KS_EVENT_NONE) break;
    if (event.kind == KS_EVENT_BOUND_VIOLATION) printf("A drone accelerates more than promised.\n");
    if (event.kind != KS_EVENT_CONTACT_BEGIN) continue;
    printf("%9.6f s  contact, closing at %.3f\n", event.time, event.approach_speed);
    ++contacts;
  }
  require(ks_world_destroy(world));
  return contacts == 2 ? 0 : 1;
}
