// Each part of the C interface does what the library does.
#include "check.h"

#include <math.h>
#include <string.h>

// Balls that fly straight on, moved by this program.
enum { most_balls = 8 };
typedef struct flight {
  ks_state start[most_balls];
  double since[most_balls];
  int calls;
} flight;

static int32_t probe_flight(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                            void* user) {
  flight* const f = (flight*)user;
  ++f->calls;
  for (size_t k = 0; k < count; ++k) {
    const ks_state from = f->start[bodies[k].index];
    const double s = time - f->since[bodies[k].index];
    states[k] = from;
    states[k].position.x += from.velocity.x * s;
    states[k].position.y += from.velocity.y * s;
    states[k].position.z += from.velocity.z * s;
  }
  return 0;
}

static ks_world new_world(void) {
  ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  return world;
}

static ks_body_id add_ball(ks_world world, flight* f, ks_vec3 position, ks_vec3 velocity) {
  ks_body_definition ball = ks_default_body_definition();
  ball.position = position;
  ball.velocity = velocity;
  ks_body_id id;
  CHECK_OK(ks_world_add(world, &ball, 1, &id));
  f->start[id.index].position = position;
  f->start[id.index].velocity = velocity;
  return id;
}

static ks_event next_event(ks_world world, double until, flight* f) {
  ks_event event = ks_new_event();
  CHECK_OK(ks_world_advance(world, until, probe_flight, f, &event));
  return event;
}

static void contacts_and_velocities(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_body_id left = add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  const ks_body_id right = add_ball(world, &f, vec3(10, 0, 0), vec3(-1, 0, 0));
  CHECK_OK(ks_world_set_user_data(world, right, 77));
  ks_event event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - 4) < 1e-5 && f.calls > 0);
  CHECK(ks_same_body(event.first, left) && ks_same_body(event.second, right) && event.second_user_data == 77);
  CHECK(fabs(event.normal.x - 1) < 1e-9 && fabs(event.approach_speed - 2) < 1e-9 && event.second_mass == 1.0);
  ks_body_id partner;
  size_t count;
  CHECK_OK(ks_world_touching(world, left, &partner, 1, &count));
  CHECK(count == 1 && ks_same_body(partner, right));

  ks_response after = ks_new_response();
  CHECK_OK(ks_bounce(&event, 1.0, 0.0, &after));
  CHECK(after.turns_first && after.turns_second && fabs(after.first_velocity.x + 1) < 1e-9);
  const ks_body_id both[2] = {left, right};
  const ks_vec3 velocities[2] = {after.first_velocity, after.second_velocity};
  f.start[0] = event.first_state;
  f.start[1] = event.second_state;
  f.start[0].velocity = velocities[0];
  f.start[1].velocity = velocities[1];
  f.since[0] = f.since[1] = event.time;
  CHECK_OK(ks_world_set_velocities(world, both, velocities, 2));
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_END);
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_NONE && event.time == 20 && ks_is_no_body(event.first));
  uint64_t probes;
  CHECK_OK(ks_world_probe_count(world, &probes));
  CHECK(probes > 0);
  CHECK_OK(ks_world_destroy(world));
}

/// Two that come within a sensor distance are turned back there: they do not leave. Timers come in between.
static void timers_and_states_of_pairs(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_body_id first = add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  const ks_body_id second = add_ball(world, &f, vec3(6, 0, 0), vec3(-1, 0, 0));
  const double distance = 2;
  CHECK_OK(ks_world_set_sensor(world, 0, &distance, 1, UINT64_MAX));
  CHECK_OK(ks_world_set_pair_state(world, first, second, -5));
  int32_t state;
  CHECK_OK(ks_world_pair_state(world, second, first, &state));
  CHECK(state == -5);
  CHECK_OK(ks_world_schedule(world, 0.25, 7, 0.5));
  ks_event event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_TIMER && event.time == 0.25 && event.first_user_data == 7);
  CHECK(ks_is_no_body(event.first) && ks_is_no_body(event.second));
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_TIMER && event.time == 0.75);
  size_t count;
  CHECK_OK(ks_world_unschedule(world, 7, &count));
  CHECK(count == 1);
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_SENSOR_ENTER && fabs(event.time - 1) < 1e-5 && event.pair_state == -5);
  const ks_body_id both[2] = {first, second};
  const ks_vec3 velocities[2] = {event.second_state.velocity, event.first_state.velocity};
  f.start[0] = event.first_state;
  f.start[1] = event.second_state;
  f.start[0].velocity = velocities[0];
  f.start[1].velocity = velocities[1];
  f.since[0] = f.since[1] = event.time;
  CHECK_OK(ks_world_set_velocities(world, both, velocities, 2));
  CHECK_OK(ks_world_turn_back(world, &event));
  ks_event none = ks_new_event();
  CHECK(ks_world_turn_back(world, &none) == KS_ERROR_OUT_OF_RANGE);
  CHECK(ks_world_schedule(world, 0.5, 0, 0) == KS_ERROR_TIME_BACKWARDS);
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_NONE);
  CHECK_OK(ks_world_destroy(world));
}

static void zones_sensors_and_filters(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_body_id ball = add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  const ks_shape box = ks_solid_box(vec3(5, -1, -1), vec3(7, 1, 1));
  ks_body_id zone;
  CHECK_OK(ks_world_add_zone(world, &box, 5, &zone));
  ks_event event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_SENSOR_ENTER && fabs(event.time - 4) < 1e-5 && event.second_user_data == 5);
  CHECK((event.second_traits & KS_TRAIT_ZONE) && event.senses == KS_SENSES_SECOND);
  ks_sensor_overlap overlap;
  size_t count;
  CHECK_OK(ks_world_sensor_overlaps(world, zone, &overlap, 1, &count));
  CHECK(count == 1 && ks_same_body(overlap.body, ball) && overlap.distance == 0);
  event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_SENSOR_LEAVE && fabs(event.time - 8) < 1e-4);

  ks_static_definition wall = ks_default_static_definition();
  wall.shape = ks_half_space(vec3(-1, 0, 0), -30);
  wall.filter.category = 2;
  ks_body_id wall_id;
  CHECK_OK(ks_world_add_static(world, &wall, 1, &wall_id));
  ks_filter filter = {1, ~(uint64_t)2, 0};
  CHECK_OK(ks_world_set_filter(world, ball, &filter));
  CHECK(next_event(world, 40, &f).kind == KS_EVENT_NONE);
  CHECK_OK(ks_world_destroy(world));
}

/// A ball falls onto an edge of a floor of two triangles, one body, which is then exchanged, and then rises.
static void meshes(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_vec3 vertices[] = {vec3(-4, -4, 0), vec3(4, -4, 0), vec3(4, 4, 0), vec3(-4, 4, 0)};
  const uint32_t corners[] = {0, 1, 2, 0, 2, 3};
  ks_mesh mesh;
  CHECK_OK(ks_mesh_create(vertices, 4, corners, 2, &mesh));
  ks_static_definition ground = ks_default_static_definition();
  ground.shape = ks_mesh_shape(mesh);
  ks_body_id floor;
  CHECK_OK(ks_world_add_static(world, &ground, 1, &floor));
  const ks_body_id ball = add_ball(world, &f, vec3(1, 1, 3), vec3(0, 0, -1));
  const ks_event event = next_event(world, 5, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - 2) < 1e-5);
  CHECK(ks_same_body(event.first, floor) && ks_same_body(event.second, ball) && event.first_part == 0);
  CHECK(event.normal.x == 0 && event.normal.y == 0 && event.normal.z == 1);
  CHECK_OK(ks_world_set_shape(world, floor, &ground.shape));
  ks_body_definition lift = ks_default_body_definition();
  lift.position = vec3(0, 0, -20);
  ks_body_id moving;
  CHECK_OK(ks_world_add_moving_shape(world, &lift, &ground.shape, &moving));
  CHECK_OK(ks_mesh_destroy(mesh));
  CHECK(ks_world_set_shape(world, floor, &ground.shape) == KS_ERROR_STALE_HANDLE);
  const uint32_t beyond[] = {0, 1, 4};
  CHECK(ks_mesh_create(vertices, 4, beyond, 1, &mesh) == KS_ERROR_OUT_OF_RANGE);
  CHECK(strcmp(ks_last_error_argument(), "corners") == 0);
  CHECK(ks_mesh_create(vertices, 4, NULL, 1, &mesh) != KS_OK);
  CHECK_OK(ks_mesh_create_chain(vertices, 4, &mesh));
  CHECK_OK(ks_mesh_destroy(mesh));
  CHECK(ks_mesh_create_chain(vertices, 1, &mesh) == KS_ERROR_OUT_OF_RANGE);
  CHECK(ks_mesh_create(NULL, 0, NULL, 0, &mesh) == KS_ERROR_OUT_OF_RANGE);
  CHECK_OK(ks_world_destroy(world));
}

/// A plate rises at 2 towards a ball that falls at 1, from a gap of 2.5.
static void moving_shapes(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  ks_body_definition lift = ks_default_body_definition();
  lift.velocity = vec3(0, 0, 2);
  lift.mass = HUGE_VAL;
  const ks_shape plate = ks_solid_box(vec3(-1, -1, 0), vec3(1, 1, 0.5));
  ks_body_id id;
  CHECK_OK(ks_world_add_moving_shape(world, &lift, &plate, &id));
  f.start[id.index].velocity = lift.velocity;
  const ks_body_id ball = add_ball(world, &f, vec3(0.25, 0.5, 4), vec3(0, 0, -1));
  const ks_event event = next_event(world, 5, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - 2.5 / 3) < 1e-5);
  CHECK(ks_same_body(event.first, id) && ks_same_body(event.second, ball) && event.first_traits == 0);
  CHECK(fabs(event.approach_speed - 3) < 1e-12 && event.normal.z == 1);
  ks_response after = ks_new_response();
  CHECK_OK(ks_bounce(&event, 1.0, 0.0, &after));
  CHECK(!after.turns_first && after.turns_second && fabs(after.second_velocity.z - 5) < 1e-12);
  CHECK_OK(ks_world_destroy(world));
}

static int32_t only_even(ks_body_id first, ks_body_id second, void* user) {
  ++*(int*)user;
  return (first.index + second.index) % 2 == 0;
}

/// A ball hits one end of a dumbbell that rests, without loss: momentum, angular momentum and energy are
/// kept.
static void rigid_bodies(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_rigid_part ends[2] = {{{-1, 0, 0}, {-1, 0, 0}, 0.5}, {{1, 0, 0}, {1, 0, 0}, 0.5}};
  ks_rigid_definition dumbbell = ks_default_rigid_definition();
  dumbbell.parts = ends;
  dumbbell.part_count = 2;
  dumbbell.inertia = vec3(0, 2, 2);
  ks_body_definition heavy = ks_default_body_definition();
  heavy.mass = 2;
  ks_body_id body;
  CHECK_OK(ks_world_add_rigid_body(world, &heavy, &dumbbell, &body));
  add_ball(world, &f, vec3(1, 5, 0), vec3(0, -1, 0));
  const ks_event event = next_event(world, 10, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - 3.5) < 1e-5);
  CHECK(ks_same_body(event.first, body) && event.first_part == 1 && event.second_part == 0);
  CHECK(fabs(event.first_spin_gain.z - 0.5) < 1e-12 && event.second_spin_gain.z == 0);
  ks_response after = ks_new_response();
  CHECK_OK(ks_bounce(&event, 1.0, 0.0, &after));
  CHECK(after.turns_first && after.turns_second && after.spins_first && !after.spins_second);
  const double v = after.first_velocity.y, w = after.first_angular_velocity.z, u = after.second_velocity.y;
  CHECK(fabs(2 * v + u + 1) < 1e-12 && fabs(2 * w + u + 1) < 1e-12);
  CHECK(fabs(2 * v * v + 2 * w * w + u * u - 1) < 1e-12 && w < 0);
  CHECK_OK(ks_world_set_angular_velocity(world, body, after.first_angular_velocity));
  ks_rotation rotation;
  CHECK_OK(ks_world_rotation(world, body, &rotation));
  CHECK(rotation.orientation.w == 1 && rotation.angular_velocity.z == w);
  CHECK_OK(ks_world_destroy(world));
}

/// Turns a body about z at one radian a unit of time, and counts the calls.
static int32_t turning(const ks_body_id* bodies, size_t count, double time, ks_rotation* rotations,
                       void* user) {
  ++*(int*)user;
  for (size_t k = 0; k < count; ++k) {
    const ks_rotation now = {{cos(time / 2), 0, 0, sin(time / 2)}, {0, 0, 1}};
    CHECK(bodies[k].index == 0);
    rotations[k] = now;
  }
  return 0;
}

/// A rod that turns about one of its ends meets a ball after a quarter of a turn.
static void rotation_probes(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_rigid_part rod = {{0, 0, 0}, {4, 0, 0}, 0.1};
  ks_rigid_definition rigid = ks_default_rigid_definition();
  rigid.parts = &rod;
  rigid.part_count = 1;
  rigid.rotation.angular_velocity.z = 1;
  rigid.angular_acceleration_limit = 1;
  rigid.largest_angular_speed = 2;
  const ks_body_definition hinge = ks_default_body_definition();
  ks_body_id body;
  CHECK_OK(ks_world_add_rigid_body(world, &hinge, &rigid, &body));
  add_ball(world, &f, vec3(0, 2, 0), vec3(0, 0, 0));
  int calls = 0;
  CHECK_OK(ks_world_set_rotation_probe(world, turning, &calls));
  const ks_event event = next_event(world, 10, &f);
  const double expected = 2 * atan(1.0) - asin(1.1 / 2);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - expected) < 1e-5 && calls > 0);
  CHECK(event.first_part == 0 && event.first_angular_velocity.z == 1);
  ks_rotation back = {{1, 0, 0, 0}, {0, 0, 0.5}}, now;
  CHECK_OK(ks_world_set_rotation(world, body, &back));
  CHECK_OK(ks_world_rotation(world, body, &now));
  CHECK(now.orientation.w == 1 && now.angular_velocity.z == 0.5);
  CHECK_OK(ks_world_destroy(world));
}

/// A square that turns meets a ball with a side, and a body may have hulls alone.
static void hulls(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_vec3 corners[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const ks_rigid_hull square = {4, corners, 0};
  ks_rigid_definition rigid = ks_default_rigid_definition();
  rigid.hulls = &square;
  rigid.hull_count = 1;
  rigid.rotation.angular_velocity.z = 1;
  const ks_body_definition body = ks_default_body_definition();
  ks_body_id id;
  CHECK_OK(ks_world_add_rigid_body(world, &body, &rigid, &id));
  add_ball(world, &f, vec3(2.2, 0, 0), vec3(0, 0, 0));
  const ks_event event = next_event(world, 10, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && event.first_part == 0);
  // The ball has the radius 1, and the side is 1 from the middle of the square.
  CHECK(fabs(event.time - acos(2 / 2.2)) < 1e-5);
  CHECK_OK(ks_world_destroy(world));
}

static void pair_filters(void) {
  flight f;
  memset(&f, 0, sizeof f);
  int calls = 0;
  const ks_world world = new_world();
  CHECK_OK(ks_world_set_pair_filter(world, only_even, &calls));
  add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  add_ball(world, &f, vec3(10, 0, 0), vec3(0, 0, 0));
  const ks_body_id far_ball = add_ball(world, &f, vec3(20, 0, 0), vec3(0, 0, 0));
  const ks_event event = next_event(world, 30, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && ks_same_body(event.second, far_ball) && calls > 0);
  CHECK_OK(ks_world_destroy(world));
}

static void answers(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_body_id left = add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  const ks_body_id right = add_ball(world, &f, vec3(10, 0, 0), vec3(0, 0, 0));
  ks_prediction p;
  CHECK_OK(ks_world_earliest_contact(world, left, NULL, NULL, &p));
  CHECK(p.time > 7.9 && p.time <= 8 && ks_same_body(p.partner, right) && !p.happens && !p.probed);
  CHECK_OK(ks_world_earliest_approach(world, left, 3, probe_flight, &f, &p));
  CHECK(p.time > 4.9 && p.time <= 5 && !p.happens);
  CHECK_OK(ks_world_pair_safe_until(world, left, right, 1, NULL, NULL, &p));
  CHECK(p.time > 6.9 && p.time <= 7);
  CHECK_OK(ks_world_safe_until(world, NULL, NULL, &p));
  CHECK(p.time > 7.9 && p.time <= 8 && ks_is_no_body(p.partner));
  double lower, upper;
  CHECK_OK(ks_world_distance_limits(world, left, right, 3, NULL, NULL, &lower, &upper));
  CHECK(lower <= 5 && upper >= 5 && upper - lower < 1e-6);

  ks_hit hits[2];
  size_t count;
  CHECK_OK(ks_world_cast(world, vec3(-5, 0, 0), vec3(2, 0, 0), 100, 0, NULL, NULL, hits, 2, &count));
  CHECK(count == 1 && ks_same_body(hits[0].body, left) && hits[0].certain && fabs(hits[0].lower - 4) < 1e-6);
  CHECK_OK(ks_world_cast(world, vec3(5, 5, 0), vec3(0, -1, 0), 100, 4.5, probe_flight, &f, hits, 2, &count));
  CHECK(count == 2);  // the moving sphere meets both at once
  CHECK_OK(ks_world_overlapping_sphere(world, vec3(10, 0, 3), 2.5, NULL, NULL, hits, 2, &count));
  CHECK(count == 1 && ks_same_body(hits[0].body, right) && hits[0].certain);
  const ks_box box = {{-1, -1, -1}, {20, 1, 1}};
  CHECK_OK(ks_world_overlapping_box(world, &box, NULL, NULL, hits, 2, &count));
  CHECK(count == 2);
  CHECK_OK(ks_world_nearest(world, vec3(7, 0, 0), 1, NULL, NULL, hits, 2, &count));
  CHECK(count == 1 && ks_same_body(hits[0].body, right) && fabs(hits[0].upper - 2) < 1e-6);

  // The first ray begins inside the ball that it leaves out.
  const ks_ray rays[2] = {{vec3(0, 0, 0), vec3(1, 0, 0), 100, 0}, {vec3(0, 50, 0), vec3(1, 0, 0), 100, 0}};
  const ks_body_id casters[2] = {left, right};
  size_t ends[2];
  CHECK_OK(ks_world_cast_all(world, rays, casters, 2, NULL, probe_flight, &f, ends, hits, 2, &count));
  CHECK(count == 1 && ends[0] == 1 && ends[1] == 1 && ks_same_body(hits[0].body, right));
  const ks_sphere spheres[2] = {{vec3(10, 0, 3), 2.5}, {vec3(0, 0, 0), 20}};
  CHECK(ks_world_overlapping_all(world, spheres, NULL, 2, NULL, NULL, NULL, ends, NULL, 0, &count) ==
        KS_ERROR_BUFFER_TOO_SMALL);
  ks_hit all[3];
  CHECK_OK(ks_world_overlapping_all(world, spheres, NULL, 2, NULL, NULL, NULL, ends, all, 3, &count));
  CHECK(count == 3 && ends[0] == 1 && ends[1] == 3 && ks_same_body(all[0].body, right));
  const ks_vec3 points[2] = {vec3(7, 0, 0), vec3(7, 0, 0)};
  CHECK_OK(ks_world_nearest_all(world, points, casters, 2, 1, NULL, NULL, NULL, ends, hits, 2, &count));
  CHECK(count == 2 && ks_same_body(hits[0].body, right) && ks_same_body(hits[1].body, left));
  const ks_filter nobody = {0, 0, 0};
  CHECK_OK(ks_world_nearest_all(world, points, NULL, 2, 1, &nobody, NULL, NULL, ends, hits, 2, &count));
  CHECK(count == 0 && ends[1] == 0);
  CHECK_OK(ks_world_destroy(world));
}

static void changes_of_bodies(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  const ks_body_id ball = add_ball(world, &f, vec3(0, 0, 0), vec3(0, 0, 0));
  ks_body_view view = ks_new_body_view();
  CHECK_OK(ks_world_set_radius(world, ball, 2));
  CHECK_OK(ks_world_set_radius_rate(world, ball, 0));
  CHECK_OK(ks_world_set_mass(world, ball, 3));
  const ks_motion_limits limits = {4, 0, 0, {0, 0, -9}};
  CHECK_OK(ks_world_set_motion_limits(world, ball, &limits));
  CHECK_OK(ks_world_body(world, ball, &view));
  CHECK(view.enabled && !view.is_static && view.definition.radius == 2 && view.definition.mass == 3);
  CHECK(view.definition.acceleration_limit == 4 && view.definition.planned_acceleration.z == -9);
  CHECK_OK(ks_world_disable(world, ball));
  CHECK_OK(ks_world_body(world, ball, &view));
  CHECK(!view.enabled);
  const ks_state there = {{3, 0, 0}, {0, 0, 0}};
  CHECK_OK(ks_world_enable(world, ball, &there));
  CHECK_OK(ks_world_sleep(world, ball));
  CHECK_OK(ks_world_body(world, ball, &view));
  CHECK(view.sleeping && view.definition.position.x == 3);
  CHECK_OK(ks_world_wake(world, ball));
  CHECK_OK(ks_world_set_solid(world, ball, 0));
  CHECK_OK(ks_world_set_sensor_class(world, ball, 4));
  CHECK_OK(ks_world_teleport(world, ball, &there));
  CHECK_OK(ks_world_reserve(world, 100));
  int32_t contains;
  CHECK_OK(ks_world_contains(world, ball, &contains));
  CHECK(contains);
  CHECK_OK(ks_world_remove(world, &ball, 1));
  CHECK_OK(ks_world_contains(world, ball, &contains));
  CHECK(!contains);
  CHECK_OK(ks_world_destroy(world));
}

/// Returns the hash of the rest of a run up to a time.
static uint64_t hash_of_rest(ks_world world, double until, ks_probe probe, void* user) {
  ks_event_hash hash = {0, 0};
  ks_event event = ks_new_event();
  for (;;) {
    CHECK_OK(ks_world_advance(world, until, probe, user, &event));
    if (event.kind == KS_EVENT_NONE) break;
    CHECK_OK(ks_event_hash_add(&hash, &event));
  }
  uint64_t value;
  CHECK_OK(ks_event_hash_value(&hash, &value));
  return value;
}

static void snapshots_and_clones(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  for (int k = 0; k < 6; ++k) add_ball(world, &f, vec3(5 * k, 0, 0), vec3(3 - k, 0, 0));
  const ks_event first = next_event(world, 30, &f);
  CHECK(first.kind == KS_EVENT_CONTACT_BEGIN);
  size_t size, written;
  CHECK_STATUS(ks_world_save(world, NULL, 0, &size), KS_ERROR_BUFFER_TOO_SMALL);
  void* const bytes = malloc(size);
  CHECK_OK(ks_world_save(world, bytes, size, &written));
  CHECK(written == size);
  ks_world restored, clone;
  CHECK_OK(ks_world_restore(bytes, size, NULL, NULL, &restored));
  CHECK_OK(ks_world_clone(world, &clone));
  free(bytes);
  const uint64_t hash = hash_of_rest(world, 30, probe_flight, &f);
  CHECK(hash != 0 && hash_of_rest(restored, 30, probe_flight, &f) == hash);
  CHECK(hash_of_rest(clone, 30, probe_flight, &f) == hash);
  CHECK_OK(ks_world_destroy(world));
  CHECK_OK(ks_world_destroy(restored));
  CHECK_OK(ks_world_destroy(clone));
}

/// What happens while a world is recorded happens again in its replay, which ends as the world did.
static void recordings(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  CHECK_STATUS(ks_world_stop_recording(world), KS_ERROR_NOT_RECORDING);
  CHECK_OK(ks_world_start_recording(world));
  CHECK_STATUS(ks_world_start_recording(world), KS_ERROR_RECORDING);
  for (int k = 0; k < 6; ++k) add_ball(world, &f, vec3(5 * k, 0, 0), vec3(3 - k, 0, 0));
  size_t size;
  CHECK_STATUS(ks_world_recording(world, NULL, 0, &size), KS_ERROR_NOT_RECORDING);
  const uint64_t hash = hash_of_rest(world, 30, probe_flight, &f);
  CHECK_OK(ks_world_stop_recording(world));
  CHECK_STATUS(ks_world_recording(world, NULL, 0, &size), KS_ERROR_BUFFER_TOO_SMALL);
  char* const bytes = (char*)malloc(size);
  CHECK_OK(ks_world_recording(world, bytes, size, &size));

  ks_replay replay, damaged;
  CHECK_OK(ks_replay_open(bytes, size, NULL, NULL, &replay));
  bytes[size / 2] ^= 1;
  CHECK_STATUS(ks_replay_open(bytes, size, NULL, NULL, &damaged), KS_ERROR_BAD_RECORDING);
  free(bytes);
  size_t step, steps;
  CHECK_OK(ks_replay_steps(replay, &step, &steps));
  CHECK(step == 0 && steps > 6);
  ks_event_hash again = {0, 0};
  int32_t finished = 0;
  ks_event event = ks_new_event();
  for (;;) {
    CHECK_OK(ks_replay_finished(replay, &finished));
    if (finished) break;
    CHECK_OK(ks_replay_advance(replay, &event));
    if (event.kind != KS_EVENT_NONE) CHECK_OK(ks_event_hash_add(&again, &event));
  }
  uint64_t value, outcomes;
  CHECK_OK(ks_event_hash_value(&again, &value));
  CHECK(value == hash && hash != 0);
  CHECK_OK(ks_replay_hash(replay, &outcomes));
  CHECK_OK(ks_replay_steps(replay, &step, &steps));
  CHECK(outcomes != 0 && step == steps);

  // Its world goes on as the recorded one does.
  ks_world copy;
  CHECK_OK(ks_replay_world(replay, &copy));
  CHECK_OK(ks_replay_destroy(replay));
  CHECK_STATUS(ks_replay_advance(replay, &event), KS_ERROR_STALE_HANDLE);
  CHECK(hash_of_rest(copy, 60, probe_flight, &f) == hash_of_rest(world, 60, probe_flight, &f));
  CHECK_OK(ks_world_destroy(copy));
  CHECK_OK(ks_world_destroy(world));
}

static void profiling(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  for (int k = 0; k < 6; ++k) add_ball(world, &f, vec3(5 * k, 0, 0), vec3(3 - k, 0, 0));
  ks_busy_body busy[2];
  size_t count;
  CHECK_STATUS(ks_world_busiest(world, 2, busy, 2, &count), KS_ERROR_NOT_PROFILING);
  CHECK_OK(ks_world_set_profiling(world, 1));
  hash_of_rest(world, 30, probe_flight, &f);
  ks_timings timings;
  CHECK_OK(ks_world_timings(world, &timings));
  CHECK(timings.advances > 1 && timings.advance > timings.probes && timings.probes > 0);
  CHECK_OK(ks_world_busiest(world, 2, busy, 2, &count));
  CHECK(count == 2 && busy[0].probes >= busy[1].probes && busy[1].probes > 0);
  for (int k = 0; k < 2; ++k) {
    const ks_busy_body* const b = &busy[k];
    CHECK(b->probes == b->touching + b->near_others + b->windows + b->changes + b->queries);
    CHECK(ks_probe_reason_name(b->reason)[0] != 0 && strlen(ks_probe_reason_advice(b->reason)) > 20);
  }
  CHECK_OK(ks_world_set_profiling(world, 0));
  CHECK_OK(ks_world_destroy(world));
}

static int32_t turn_back(const ks_event* event, ks_response* response, void* user) {
  ++*(int*)user;
  if (event->kind != KS_EVENT_WALL_BEGIN) return 0;
  response->turns_first = 1;
  response->first_velocity.x = -event->first_state.velocity.x;
  return 0;
}

static int32_t count_event(const ks_event* event, void* user) {
  if (event->kind == KS_EVENT_WALL_BEGIN) ++*(int*)user;
  return 0;
}

static void motions_and_runs(void) {
  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = vec3(10, 10, 10);
  ks_world world, rolled_back;
  CHECK_OK(ks_world_create(&definition, &world));
  const ks_state start[2] = {{{5, 5, 5}, {1, 0, 0}}, {{5, 2, 5}, {1, 0, 0}}};
  ks_motion_definition ballistic = ks_default_motion_definition();
  ballistic.count = 2;
  ballistic.states = start;
  ks_body_id ids[2];
  CHECK_OK(ks_world_add_motion(world, &ballistic, NULL, ids));
  CHECK_OK(ks_world_clone(world, &rolled_back));
  int answered = 0, bounces = 0;
  ks_run_definition run = ks_default_run_definition();
  run.respond = turn_back;
  run.respond_user = &answered;
  run.sink = count_event;
  run.sink_user = &bounces;
  CHECK_OK(ks_world_run(world, 16, &run));
  CHECK(answered >= 4 && bounces == 4);  // each at x = 9 and x = 1
  double time;
  CHECK_OK(ks_world_time(world, &time));
  CHECK(time == 16);
  ks_state states[2];
  CHECK_OK(ks_world_states(world, ids, 2, 16, states));
  CHECK(fabs(states[0].position.x - 5) < 1e-4 && states[0].velocity.x == 1);
  CHECK_OK(ks_world_states(rolled_back, ids, 2, 0, states));
  CHECK(states[1].position.y == 2);
  run = ks_default_run_definition();
  run.restitution = NAN;  // nobody answers
  run.sink = count_event;
  run.sink_user = &bounces;
  CHECK_OK(ks_world_run(rolled_back, 16, &run));
  CHECK(bounces == 6);
  const ks_state away = {{5, 8, 5}, {0, 0, 0}};
  CHECK_OK(ks_world_teleport(world, ids[0], &away));
  CHECK_OK(ks_world_states(world, ids, 1, 20, states));
  CHECK(states[0].position.y == 8);
  CHECK_OK(ks_world_remove(world, ids, 2));
  size_t size;
  CHECK_OK(ks_world_size(world, &size));
  CHECK(size == 0);
  CHECK_OK(ks_world_destroy(world));
  CHECK_OK(ks_world_destroy(rolled_back));
}

/// Bodies of a motion and bodies of the caller in one world.
static void motions_and_probes(void) {
  flight f;
  memset(&f, 0, sizeof f);
  const ks_world world = new_world();
  add_ball(world, &f, vec3(0, 0, 0), vec3(1, 0, 0));
  const ks_state start = {{10, 0, 0}, {-1, 0, 0}};
  const double radius = 2;
  ks_motion_definition ballistic = ks_default_motion_definition();
  ballistic.count = 1;
  ballistic.states = &start;
  ballistic.radii = &radius;
  ks_body_id bullet;
  uint32_t motion;
  CHECK_OK(ks_world_add_motion(world, &ballistic, &motion, &bullet));
  ks_event event = next_event(world, 20, &f);
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - 3.5) < 1e-5);
  // Two more bodies of the same motion, or none of them.
  ks_state more[2] = {{{50, 0, 0}, {-1, 0, 0}}, {{NAN, 0, 0}, {0, 0, 0}}};
  ks_body_id ids[2];
  uint32_t numbers[2];
  ballistic.count = 2;
  ballistic.states = more;
  ballistic.radii = NULL;
  CHECK_STATUS(ks_world_add_to_motion(world, motion, &ballistic, numbers, ids), KS_ERROR_NOT_FINITE);
  size_t bodies;
  CHECK_OK(ks_world_size(world, &bodies));
  CHECK(bodies == 2);
  more[1].position.x = 100;
  CHECK_OK(ks_world_add_to_motion(world, motion, &ballistic, numbers, ids));
  CHECK(numbers[0] + numbers[1] == 3);  // after 0, in the order in which the motion gives them
  CHECK_OK(ks_world_states(world, ids, 2, event.time + 1, more));
  CHECK(fabs(more[0].position.x - 49) < 1e-9 && more[1].position.x == 100);
  CHECK_STATUS(ks_world_add_to_motion(world, 7, &ballistic, NULL, ids), KS_ERROR_OUT_OF_RANGE);
  CHECK_OK(ks_world_destroy(world));
}

static void names(void) {
  CHECK(strcmp(ks_event_kind_name(KS_EVENT_NONE), "none") == 0);
  CHECK(strcmp(ks_event_kind_name(KS_EVENT_BOUND_VIOLATION), "bound_violation") == 0);
  CHECK(strcmp(ks_event_kind_name(KS_EVENT_CONTACT_BEGIN), "contact_begin") == 0);
  CHECK(strcmp(ks_event_kind_name(KS_EVENT_WOKE), "woke") == 0);
  CHECK(strcmp(ks_event_kind_name(10), "timer") == 0 && strcmp(ks_event_kind_name(11), "") == 0 &&
        strcmp(ks_event_kind_name(-1), "") == 0);
  CHECK(strcmp(ks_monitor_event_kind_name(KS_MONITOR_VERDICT), "verdict") == 0);
  CHECK(strcmp(ks_monitor_event_kind_name(KS_MONITOR_RECLASSIFIED), "reclassified") == 0);
  CHECK(strcmp(ks_monitor_event_kind_name(10), "") == 0);
  CHECK(strcmp(ks_verdict_name(KS_VERDICT_WITHIN), "within") == 0 && strcmp(ks_verdict_name(3), "") == 0);
  CHECK(strcmp(ks_probe_reason_name(KS_PROBE_REASON_TOUCHING), "touching") == 0);
  CHECK(strcmp(ks_probe_reason_name(KS_PROBE_REASON_QUERIES), "queries") == 0);
  CHECK(ks_probe_reason_name(7)[0] == 0 && ks_probe_reason_advice(-1)[0] == 0);
  CHECK(ks_abi_version() == KS_ABI_VERSION && strchr(ks_version(), '.') != NULL);
}

static void status_names(void) {
  static const struct {
    ks_status status;
    const char* name;
  } each[] = {{KS_OK, "ok"},
              {KS_ERROR_STALE_HANDLE, "stale_handle"},
              {KS_ERROR_INTERNAL, "internal"},
              {10, ""},
              {19, ""},
              {-1, ""},
              {KS_ERROR_NOT_FINITE, "not_finite"},
              {KS_ERROR_OUT_OF_RANGE, "out_of_range"},
              {KS_ERROR_TIME_BACKWARDS, "time_backwards"},
              {KS_ERROR_UNKNOWN_BODY, "unknown_body"},
              {KS_ERROR_STALE_BODY, "stale_body"},
              {KS_ERROR_FOREIGN_BODY, "foreign_body"},
              {KS_ERROR_DISABLED_BODY, "disabled_body"},
              {KS_ERROR_ENABLED_BODY, "enabled_body"},
              {KS_ERROR_STATIC_BODY, "static_body"},
              {KS_ERROR_OUTSIDE_DOMAIN, "outside_domain"},
              {KS_ERROR_OVERLAPPING, "overlapping"},
              {KS_ERROR_PROBE_IN_PROGRESS, "probe_in_progress"},
              {KS_ERROR_FILTER_IN_PROGRESS, "filter_in_progress"},
              {KS_ERROR_RUN_IN_PROGRESS, "run_in_progress"},
              {KS_ERROR_WORKERS_BUSY, "workers_busy"},
              {KS_ERROR_NO_THREADS, "no_threads"},
              {KS_ERROR_NULL_PROBE, "null_probe"},
              {KS_ERROR_NULL_CALLBACK, "null_callback"},
              {KS_ERROR_CALLBACK_THREW, "callback_threw"},
              {KS_ERROR_RANK_FAILED, "rank_failed"},
              {KS_ERROR_MOVED_FROM, "moved_from"},
              {KS_ERROR_UNSUPPORTED, "unsupported"},
              {KS_ERROR_BAD_SNAPSHOT, "bad_snapshot"},
              {KS_ERROR_BAD_BYTES, "bad_bytes"},
              {KS_ERROR_RECORDING, "recording"},
              {KS_ERROR_NOT_RECORDING, "not_recording"},
              {KS_ERROR_NOT_PROFILING, "not_profiling"},
              {KS_ERROR_BAD_RECORDING, "bad_recording"},
              {KS_ERROR_DIVERGED, "diverged"},
              {KS_ERROR_DIVERGED + 1, ""}};
  for (size_t k = 0; k < sizeof each / sizeof each[0]; ++k)
    CHECK(strcmp(ks_status_name(each[k].status), each[k].name) == 0);
}

static int32_t report_where_it_is(const uint64_t* tracks, size_t count, double time, ks_track_report* reports,
                                  uint8_t* has_report, void* user) {
  *(size_t*)user += count;
  for (size_t k = 0; k < count; ++k) {
    reports[k].timestamp = time;
    reports[k].state.position.x = 1000.0 * (double)tracks[k];
    has_report[k] = 1;
  }
  return 0;
}

static int32_t hang_up(const uint64_t* tracks, size_t count, double time, ks_track_report* reports,
                       uint8_t* has_report, void* user) {
  (void)tracks, (void)count, (void)time, (void)reports, (void)has_report, (void)user;
  return 1;
}

static ks_monitor new_monitor(void) {
  const ks_track_class drone = {ks_error_ball(3.0), ks_error_cylinder(20.0, 5.0), {0, 0, 0}};
  const ks_separation levels[2] = {{KS_SEPARATION_ELLIPSOID, 50, 50, 0, 0},
                                   {KS_SEPARATION_CYLINDER, 10, 5, 0, 0}};
  const ks_separation_rule rule = {0, 0, levels, 2};
  ks_monitor_definition definition = ks_default_monitor_definition();
  definition.classes = &drone;
  definition.class_count = 1;
  definition.separations = &rule;
  definition.separation_count = 1;
  ks_monitor monitor;
  CHECK_OK(ks_monitor_create(&definition, &monitor));
  const uint64_t tracks[2] = {1, 2};
  ks_track_report reports[2] = {ks_default_track_report(), ks_default_track_report()};
  reports[0].state.position.x = 1000;
  reports[1].state.position.x = 2000;
  CHECK_OK(ks_monitor_report(monitor, tracks, reports, 2));
  return monitor;
}

static void monitors(void) {
  const ks_monitor monitor = new_monitor();
  ks_monitor_event event = ks_new_monitor_event();
  CHECK_OK(ks_monitor_advance(monitor, 1, NULL, NULL, &event));
  CHECK(event.kind == KS_MONITOR_NONE && event.time == 1);
  ks_pair_answer answer = ks_new_pair_answer();
  CHECK_OK(ks_monitor_answer(monitor, 1, 2, 0, &answer));
  CHECK(answer.verdict == KS_VERDICT_APART && answer.lower <= 1000 && answer.upper >= 1000 &&
        answer.until > 1);
  size_t size, count;
  CHECK_STATUS(ks_monitor_save(monitor, NULL, 0, &size), KS_ERROR_BUFFER_TOO_SMALL);
  void* const bytes = malloc(size);
  CHECK_OK(ks_monitor_save(monitor, bytes, size, &size));
  ks_monitor polling;
  CHECK_OK(ks_monitor_restore(bytes, size, &polling));
  free(bytes);

  // Without reports the two become undecided; with a poll they do not.
  CHECK_OK(ks_monitor_advance(monitor, 60, NULL, NULL, &event));
  CHECK(event.kind == KS_MONITOR_VERDICT && event.verdict == KS_VERDICT_UNDECIDED && event.level == 0);
  CHECK(event.before == KS_VERDICT_APART && event.first == 1 && event.second == 2);
  ks_open_pair pair;
  CHECK_OK(ks_monitor_open_pairs(monitor, &pair, 1, &count));
  CHECK(count == 1 && pair.first == 1 && pair.second == 2 && pair.since == event.time);
  ks_report_request request;
  CHECK_OK(ks_monitor_needed(polling, 2, &request, 1, &count));
  CHECK(count == 0);
  size_t asked = 0;
  CHECK_STATUS(ks_monitor_advance(polling, 60, hang_up, NULL, &event), KS_ERROR_CALLBACK_FAILED);
  CHECK_OK(ks_monitor_advance(polling, 60, report_where_it_is, &asked, &event));
  CHECK(event.kind == KS_MONITOR_NONE && event.time == 60 && asked > 0);
  ks_track_place place;
  CHECK_OK(ks_monitor_places(polling, 1, &place, 1, &count));
  CHECK(count == 1 && place.centre.x > 900 && place.centre.x < 1100);
  CHECK_OK(ks_monitor_remove(polling, 1));
  uint64_t track;
  CHECK_OK(ks_monitor_tracks(polling, &track, 1, &count));
  CHECK(count == 1 && track == 2);
  double time;
  CHECK_OK(ks_monitor_time(polling, &time));
  CHECK(time == 60);
  CHECK_OK(ks_monitor_destroy(monitor));
  CHECK_OK(ks_monitor_destroy(polling));
}

/// Two tracks fly towards each other. Of two monitors that divide the pairs, one predicts that they meet.
static void predictions_and_shards(void) {
  const ks_track_class drone = {ks_error_ball(0.5), ks_error_ball(INFINITY), {0, 0, 0}};
  const ks_separation level = {KS_SEPARATION_ELLIPSOID, 50, 50, 60, 0};
  const ks_separation_rule rule = {0, 0, &level, 1};
  ks_monitor_definition definition = ks_default_monitor_definition();
  CHECK(definition.shard_of == 1 && definition.shard_first == 0 && definition.shard_count == 1);
  definition.classes = &drone;
  definition.class_count = 1;
  definition.separations = &rule;
  definition.separation_count = 1;
  definition.shard_of = 2;
  const uint64_t tracks[2] = {1, 2};
  ks_track_report reports[2] = {ks_default_track_report(), ks_default_track_report()};
  for (int k = 0; k < 2; ++k) {
    reports[k].velocity_error = ks_error_ball(0.0);
    reports[k].state.position.x = 500 * k;
    reports[k].state.velocity.x = 10 - 20 * k;
  }
  for (int shard = 0; shard < 2; ++shard) {
    ks_monitor monitor;
    definition.shard_first = (uint64_t)shard;
    CHECK_OK(ks_monitor_create(&definition, &monitor));
    CHECK_OK(ks_monitor_report(monitor, tracks, reports, 2));
    ks_monitor_event event = ks_new_monitor_event();
    CHECK_OK(ks_monitor_advance(monitor, 1, NULL, NULL, &event));
    CHECK(event.kind == (shard == 1 ? KS_MONITOR_PREDICTED : KS_MONITOR_NONE));
    ks_predicted_pair pair;
    size_t count;
    CHECK_OK(ks_monitor_predicted_pairs(monitor, &pair, 1, &count));
    CHECK(count == (size_t)shard);  // the lower id is 1
    if (count == 1) {
      CHECK(pair.first == 1 && pair.second == 2 && pair.level == 0 && pair.since == event.time);
      CHECK(fabs(pair.likely_time - 22.5) < 1e-6 && fabs(pair.closest_time - 25) < 1e-6);
      CHECK(pair.closest_distance < 1e-6);
    }
    CHECK_OK(ks_monitor_destroy(monitor));
  }
}

/// Walls with a filter let a ball pass whose mask leaves them out.
static void walls_with_a_filter(void) {
  ks_world_definition definition = ks_default_world_definition();
  CHECK(definition.has_wall_filter == 0);
  definition.has_box = 1;
  definition.box.upper = vec3(20, 20, 20);
  definition.has_wall_filter = 1;
  definition.wall_filter.category = 2;
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  flight f;
  memset(&f, 0, sizeof f);
  const ks_body_id ball = add_ball(world, &f, vec3(10, 10, 10), vec3(1, 0, 0));
  ks_filter filter = ks_default_body_definition().filter;
  filter.mask = 1;
  CHECK_OK(ks_world_set_filter(world, ball, &filter));
  CHECK(next_event(world, 15, &f).kind == KS_EVENT_NONE);
  filter.mask = 3;
  CHECK_OK(ks_world_set_filter(world, ball, &filter));
  CHECK(next_event(world, 16, &f).kind == KS_EVENT_WALL_BEGIN);
  CHECK_OK(ks_world_destroy(world));
}

/// Falls by 10 from rest.
static int32_t falling(const ks_body_id* ids, size_t count, double time, ks_state* states, void* user) {
  (void)ids, (void)user;
  const ks_state state = {{0, 0, -5 * time * time}, {0, 0, -10 * time}};
  for (size_t k = 0; k < count; ++k) states[k] = state;
  return 0;
}

/// A limit that was forgotten: the event says the limit from then on. Records of programs that were compiled
/// before it did are shorter, and nothing is written behind them.
static void observed_limits(void) {
  for (int32_t adopts = 0; adopts < 2; ++adopts) {
    ks_world_definition definition = ks_default_world_definition();
    definition.adopt_observed_limits = adopts;
    ks_world world;
    CHECK_OK(ks_world_create(&definition, &world));
    ks_body_definition body = ks_default_body_definition();
    ks_body_id id;
    CHECK_OK(ks_world_add(world, &body, 1, &id));
    ks_event event = ks_new_event();
    CHECK_OK(ks_world_advance(world, 1, falling, NULL, &event));
    CHECK(event.kind == KS_EVENT_BOUND_VIOLATION && event.struct_size == sizeof event);
    CHECK(adopts ? event.acceleration_limit > 10 && event.acceleration_limit < 10.2
                 : event.acceleration_limit == 0);
    CHECK_OK(ks_world_destroy(world));
  }
  union {
    ks_world_definition definition;
    unsigned char bytes[sizeof(ks_world_definition)];
  } old_definition;
  memset(&old_definition, 0xa5, sizeof old_definition);
  CHECK_OK(ks_world_definition_init(&old_definition.definition, 136));
  CHECK(old_definition.definition.struct_size == 136 && old_definition.bytes[136] == 0xa5);
  ks_world world;
  CHECK_OK(ks_world_create(&old_definition.definition, &world));
  ks_body_definition body = ks_default_body_definition();
  ks_body_id id;
  CHECK_OK(ks_world_add(world, &body, 1, &id));
  union {
    ks_event event;
    unsigned char bytes[sizeof(ks_event)];
  } old_event;
  memset(&old_event, 0xa5, sizeof old_event);
  old_event.event.struct_size = 392;
  CHECK_OK(ks_world_advance(world, 1, falling, NULL, &old_event.event));
  CHECK(old_event.event.kind == KS_EVENT_BOUND_VIOLATION && old_event.event.struct_size == 392);
  for (size_t k = 392; k < sizeof old_event; ++k) CHECK(old_event.bytes[k] == 0xa5);
  ks_body_view view = ks_new_body_view();
  CHECK_OK(ks_world_body(world, id, &view));
  CHECK(view.definition.acceleration_limit > 10);
  CHECK_OK(ks_world_destroy(world));
}

/// A game moves a ball at 5 frames a unit of time, towards a wall, and takes its place back after each frame.
static void frames(void) {
  ks_world_definition definition = ks_default_world_definition();
  CHECK(definition.spread_window_starts == 0);
  CHECK(definition.adopt_observed_limits == 1);
  definition.has_box = 1;
  definition.box.upper = vec3(10, 10, 10);
  definition.spread_window_starts = 1;
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  ks_state start = {{5, 5, 5}, {0, 0, 0}};
  double velocity = 2;
  ks_motion_definition motion = ks_default_motion_definition();
  motion.kind = KS_MOTION_FRAMES;
  motion.count = 1;
  motion.states = &start;
  motion.interval = 0.2;
  uint32_t number;
  ks_body_id ball;
  CHECK_OK(ks_world_add_motion(world, &motion, &number, &ball));
  int bounces = 0;
  for (int frame = 0; frame < 45; ++frame) {
    start.position.x += velocity * motion.interval;
    CHECK_OK(ks_world_push_frame(world, number, &start.position, 1));
    double until;
    CHECK_OK(ks_world_latest_frame_time(world, number, &until));
    ks_event event = ks_new_event();
    for (;;) {
      CHECK_OK(ks_world_advance(world, until, ks_probe_motions, NULL, &event));
      if (event.kind == KS_EVENT_NONE) break;
      if (event.kind != KS_EVENT_WALL_BEGIN) continue;
      ks_response after = ks_new_response();
      CHECK_OK(ks_bounce(&event, 1.0, 0.0, &after));
      CHECK_OK(ks_world_set_velocity(world, ball, after.first_velocity));
      velocity = after.first_velocity.x;
      ++bounces;
    }
    size_t count;
    CHECK_OK(ks_world_latest_frame(world, number, &start.position, 1, &count));
    CHECK(start.position.x > 0.999 && start.position.x < 9.001);
  }
  CHECK(bounces == 2);

  // A second ball is the second one in frames from now on.
  start.position = vec3(5, 8, 5);
  uint32_t added;
  CHECK_OK(ks_world_add_to_motion(world, number, &motion, &added, &ball));
  const ks_vec3 both[2] = {vec3(4, 5, 5), vec3(5, 8, 5)};
  CHECK(added == 1);
  CHECK_STATUS(ks_world_push_frame(world, number, both, 1), KS_ERROR_OUT_OF_RANGE);
  double latest;
  CHECK_OK(ks_world_latest_frame_time(world, number, &latest));
  CHECK_STATUS(ks_world_push_frame_at(world, number, both, 2, latest), KS_ERROR_TIME_BACKWARDS);
  CHECK(strcmp(ks_last_error_argument(), "time") == 0);
  CHECK_OK(ks_world_push_frame_at(world, number, both, 2, latest + 0.375));
  double given;
  CHECK_OK(ks_world_latest_frame_time(world, number, &given));
  CHECK(given == latest + 0.375);
  CHECK_OK(ks_world_destroy(world));
}

enum { bullet = 1, rock, fragment, tired, post };  // the user data of bodies

/// A game in which a bullet and a rock vanish as they meet, a fragment appears there, which is disabled at
/// the wall, and a tired ball falls asleep at a post.
typedef struct shooting {
  ks_world world;
  uint32_t motion;
  ks_event_hash hash;
  ks_body_id fragment;
  int refused;
} shooting;

static int is_burst(const ks_event* event) {
  return event->kind == KS_EVENT_CONTACT_BEGIN && event->first_user_data == bullet;
}

static int32_t shoot(const ks_event* event, ks_response* response, void* user) {
  (void)user;
  if (is_burst(event)) {
    response->first_action = response->second_action = KS_ACTION_REMOVE;
    response->stop = 1;
  } else if (event->kind == KS_EVENT_WALL_BEGIN) {
    response->first_action = KS_ACTION_DISABLE;
  } else if (event->kind == KS_EVENT_CONTACT_BEGIN) {
    const int first_is_tired = event->first_user_data == tired;
    *(first_is_tired ? &response->first_action : &response->second_action) = KS_ACTION_SLEEP;
  }
  return 0;
}

static ks_motion_definition flight_of(const ks_state* state, ks_body_definition* like, uint64_t user_data) {
  ks_motion_definition motion = ks_default_motion_definition();
  *like = ks_default_body_definition();
  like->radius = 0.5;
  like->user_data = user_data;
  motion.count = 1;
  motion.states = state;
  motion.like = like;
  return motion;
}

static int32_t burst(const ks_event* event, void* user) {
  shooting* const game = (shooting*)user;
  CHECK_OK(ks_event_hash_add(&game->hash, event));
  const ks_state state = {event->point, {2, 0, 0}};
  ks_body_definition like;
  const ks_motion_definition more = flight_of(&state, &like, fragment);
  uint32_t number;
  const ks_status added = ks_world_add_to_motion(game->world, game->motion, &more, &number, &game->fragment);
  game->refused += added == KS_ERROR_RUN_IN_PROGRESS;
  if (!is_burst(event)) return added != KS_ERROR_RUN_IN_PROGRESS;
  CHECK(added == KS_OK && number < 2);  // that of a body that has gone
  int32_t contains;
  CHECK_OK(ks_world_contains(game->world, event->first, &contains));
  CHECK(!contains);
  ks_event next = ks_new_event();
  CHECK_STATUS(ks_world_advance(game->world, 9, ks_probe_motions, NULL, &next), KS_ERROR_RUN_IN_PROGRESS);
  return 0;
}

static uint64_t play_shooting(int32_t threads) {
  shooting game;
  memset(&game, 0, sizeof game);
  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = vec3(20, 20, 20);
  CHECK_OK(ks_world_create(&definition, &game.world));
  const ks_state start[4] = {
      {{1, 5, 5}, {4, 0, 0}}, {{8, 5, 5}, {0, 0, 0}}, {{1, 9, 9}, {1, 0, 0}}, {{8, 9, 9}, {0, 0, 0}}};
  const uint64_t kinds[4] = {bullet, rock, tired, post};
  ks_body_id ids[4];
  for (int k = 0; k < 4; ++k) {
    ks_body_definition like;
    const ks_motion_definition motion = flight_of(&start[k], &like, kinds[k]);
    CHECK_OK(k == 0 ? ks_world_add_motion(game.world, &motion, &game.motion, ids)
                    : ks_world_add_to_motion(game.world, game.motion, &motion, NULL, &ids[k]));
  }
  ks_run_definition run = ks_default_run_definition();
  run.threads = threads;
  run.respond = shoot;
  run.sink = burst;
  run.sink_user = &game;
  CHECK_OK(ks_world_run(game.world, 10, &run));

  ks_state state;
  CHECK_STATUS(ks_world_states(game.world, &ids[0], 1, 10, &state), KS_ERROR_UNKNOWN_BODY);
  ks_body_view view = ks_new_body_view();
  CHECK_STATUS(ks_world_body(game.world, ids[1], &view), KS_ERROR_STALE_BODY);
  CHECK_OK(ks_world_body(game.world, game.fragment, &view));
  CHECK(!view.enabled);
  CHECK_OK(ks_world_body(game.world, ids[2], &view));
  CHECK(view.sleeping && fabs(view.definition.position.x - 7) < 1e-4 && view.definition.velocity.x == 0);
  CHECK(game.refused > 0);
  uint64_t value;
  CHECK_OK(ks_event_hash_value(&game.hash, &value));
  CHECK_OK(ks_world_destroy(game.world));
  return value;
}

static void responses(void) {
  const uint64_t hash = play_shooting(1);
  CHECK(hash != 0 && play_shooting(2) == hash);
}

// Potentials, and rough bounces.

static int32_t respond_in_well(const ks_event* event, ks_response* response, void* user) {
  return ks_step_potential_respond(*(const ks_step_potential*)user, event, response);
}

static void wells(void) {
  const ks_world world = new_world();
  const ks_state start[2] = {{vec3(-0.6, 0, 0), vec3(0.5, 0, 0)}, {vec3(0.6, 0, 0), vec3(-0.5, 0, 0)}};
  const double radii[2] = {0.5, 0.5}, distance = 0.5, depth = -1;
  ks_body_definition like = ks_default_body_definition();
  like.contacts = KS_CONTACTS_IMPACTS;
  ks_motion_definition motion = ks_default_motion_definition();
  motion.count = 2;
  motion.states = start;
  motion.radii = radii;
  motion.like = &like;
  ks_body_id ids[2];
  CHECK_OK(ks_world_add_motion(world, &motion, NULL, ids));
  CHECK_OK(ks_world_set_sensor(world, 0, &distance, 1, UINT64_MAX));
  ks_step_potential_definition definition = ks_default_step_potential_definition();
  definition.count = 1;
  definition.distances = &distance;
  definition.energies = &depth;
  ks_step_potential well;
  CHECK_OK(ks_step_potential_create(world, &definition, &well));
  double energy;
  CHECK_OK(ks_step_potential_energy(well, 0.4, &energy));
  CHECK(energy == -1);
  ks_run_definition run = ks_default_run_definition();
  run.respond = respond_in_well;
  run.respond_user = &well;
  CHECK_OK(ks_world_run(world, 20, &run));
  // In a loop, too. They are turned back once in a unit of time.
  int turns = 0;
  ks_event event = ks_new_event();
  for (;;) {
    CHECK_OK(ks_world_advance(world, 40, ks_probe_motions, NULL, &event));
    if (event.kind == KS_EVENT_NONE) break;
    ks_response response = ks_new_response();
    CHECK_OK(ks_step_potential_respond(well, &event, &response));
    if (response.turns_first) CHECK_OK(ks_world_set_velocity(world, event.first, response.first_velocity));
    if (response.turns_second) CHECK_OK(ks_world_set_velocity(world, event.second, response.second_velocity));
    if (response.turned_back) CHECK_OK(ks_world_turn_back(world, &event));
    turns += response.turned_back;
    if (event.kind != KS_EVENT_CONTACT_BEGIN) continue;
    ks_roughness smooth = ks_default_roughness();
    smooth.tangential_restitution = -1;
    ks_response rough = ks_new_response();
    CHECK_OK(ks_bounce_rough(&event, &smooth, &rough));
    CHECK(rough.turns_first && rough.first_velocity.x == response.first_velocity.x && !rough.spins_first);
    smooth.friction = -1;
    CHECK_STATUS(ks_bounce_rough(&event, &smooth, &rough), KS_ERROR_OUT_OF_RANGE);
    // A program that was compiled earlier has a shorter record.
    ks_response earlier = ks_new_response();
    earlier.struct_size = (uint32_t)offsetof(ks_response, turned_back);
    earlier.reserved = 77;
    CHECK_OK(ks_bounce(&event, 1, 0, &earlier));
    CHECK(earlier.reserved == 77 && earlier.first_velocity.x == response.first_velocity.x);
  }
  CHECK(19 <= turns && turns <= 21);
  size_t count;
  ks_sensor_overlap overlap;
  CHECK_OK(ks_world_sensor_overlaps(world, ids[0], &overlap, 1, &count));
  CHECK(count == 1);
  definition.restitution = 2;
  ks_step_potential wrong;
  CHECK_STATUS(ks_step_potential_create(world, &definition, &wrong), KS_ERROR_OUT_OF_RANGE);
  CHECK_OK(ks_step_potential_destroy(well));
  CHECK_STATUS(ks_step_potential_energy(well, 0.4, &energy), KS_ERROR_STALE_HANDLE);
  CHECK_OK(ks_world_destroy(world));
}

// Games.

static ks_world new_game(const ks_game_definition* definition) {
  ks_world_definition room = ks_default_world_definition();
  room.has_box = 1;
  room.box.upper = vec3(10, 10, 10);
  room.contacts = KS_CONTACTS_IMPACTS;
  ks_world game;
  CHECK_OK(ks_game_create(&room, definition, &game));
  return game;
}

static ks_body_list bodies_of(ks_world game) {
  ks_body_list bodies;
  CHECK_OK(ks_game_bodies(game, &bodies));
  return bodies;
}

static void games_of_bodies(void) {
  ks_game_definition falling = ks_default_game_definition();
  falling.gravity = vec3(0, 0, -10);
  const ks_world game = new_game(&falling);
  ks_body_definition balls[3];
  ks_body_id ids[3], extra;
  for (int k = 0; k < 3; ++k) {
    balls[k] = ks_default_body_definition();
    balls[k].radius = 0.5;
    balls[k].position = vec3(2 + 3 * k, 5, 5);
  }
  CHECK_OK(ks_world_add(game, balls, 3, ids));
  ks_event_list happened;
  CHECK_OK(ks_game_step(game, 0.25, &happened));
  CHECK(happened.count == 0);
  ks_body_list bodies = bodies_of(game);
  CHECK(bodies.count == 3 && ks_same_body(bodies.ids[2], ids[2]));
  CHECK(fabs(bodies.positions[1].z - (5 - 0.3125)) < 1e-12 && fabs(bodies.velocities[1].z + 2.5) < 1e-12);
  size_t place;
  CHECK_OK(ks_world_remove(game, ids, 1));
  CHECK_OK(ks_game_index_of(game, ids[2], &place));
  CHECK(place == 0 && bodies_of(game).count == 2);
  CHECK_STATUS(ks_game_index_of(game, ids[0], &place), KS_ERROR_STALE_BODY);

  // All turn up; gravity changes; one burns against it.
  const ks_vec3 up[2] = {vec3(0, 0, 1), vec3(0, 1, 0)};
  CHECK_OK(ks_game_set_velocities(game, up, 2));
  ks_vec3 gravity;
  CHECK_OK(ks_game_set_gravity(game, vec3(0, 0, -2)));
  CHECK_OK(ks_game_gravity(game, &gravity));
  CHECK_OK(ks_game_set_acceleration(game, ids[1], vec3(0, 0, 2)));
  CHECK_OK(ks_game_step(game, 0.5, &happened));
  bodies = bodies_of(game);
  CHECK(gravity.z == -2 && bodies.velocities[0].z == 0 && bodies.velocities[1].z == 0);

  // The other calls of worlds change games, too.
  const ks_state above = {vec3(5, 5, 8), vec3(0, 0, -3)};
  CHECK_OK(ks_world_teleport(game, ids[1], &above));
  CHECK_OK(ks_world_set_velocity(game, ids[2], vec3(1, 0, 0)));
  CHECK_OK(ks_world_disable(game, ids[2]));
  CHECK_OK(ks_world_enable(game, ids[2], &above));
  CHECK_OK(ks_world_sleep(game, ids[2]));
  CHECK_OK(ks_world_set_velocities(game, &ids[1], &up[1], 1));
  bodies = bodies_of(game);
  CHECK(bodies.positions[1].z == 8 && bodies.velocities[1].y == 1 && bodies.velocities[0].z == 0);
  ks_hit hits[4];
  size_t count;
  CHECK_OK(ks_world_overlapping_sphere(game, vec3(5, 5, 8), 0.01, NULL, NULL, hits, 4, &count));
  CHECK(count == 2 && hits[0].certain);
  const ks_shape zone = ks_solid_box(vec3(0, 0, 0), vec3(10, 10, 1));
  CHECK_OK(ks_world_add_zone(game, &zone, 0, &extra));
  CHECK(bodies_of(game).count == 2);
  CHECK_OK(ks_world_destroy(game));
}

static int32_t remove_what_falls(const ks_event* event, ks_response* response, void* user) {
  ++*(int*)user;
  if (event->kind == KS_EVENT_WALL_BEGIN) response->first_action = KS_ACTION_REMOVE;
  return 0;
}

static void games_of_events(void) {
  int calls = 0;
  ks_game_definition falling = ks_default_game_definition();
  falling.gravity = vec3(0, 0, -10);
  const ks_world game = new_game(&falling);
  falling.respond = remove_what_falls;
  falling.respond_user = &calls;
  ks_body_definition ball = ks_default_body_definition();
  ball.radius = 0.5;
  ball.position = vec3(5, 5, 5);
  ks_body_id id;
  CHECK_OK(ks_world_add(game, &ball, 1, &id));
  char bytes[8192];
  size_t size;
  CHECK_OK(ks_world_save(game, bytes, sizeof bytes, &size));
  ks_world copy, saved;
  CHECK_OK(ks_world_clone(game, &copy));
  CHECK_OK(ks_game_restore(bytes, size, &falling, NULL, NULL, &saved));

  // Event by event, with the game at the event, after its response.
  ks_event event = ks_new_event();
  CHECK_OK(ks_world_advance(game, 2, ks_probe_motions, NULL, &event));
  CHECK(event.kind == KS_EVENT_WALL_BEGIN && event.wall == KS_WALL_Z_LOWER);
  CHECK(fabs(event.time - sqrt(0.9)) < 1e-5 && bodies_of(game).velocities[0].z > 0);
  CHECK_OK(ks_world_advance(game, 2, ks_probe_motions, NULL, &event));
  CHECK(event.kind == KS_EVENT_NONE && event.time == 2);
  ks_event_list happened;
  CHECK_OK(ks_game_step(copy, 2, &happened));
  CHECK(happened.count == 1 && happened.events[0].kind == KS_EVENT_WALL_BEGIN);
  CHECK(bodies_of(copy).positions[0].z == bodies_of(game).positions[0].z);
  CHECK_OK(ks_game_set_response(copy, &falling));
  CHECK_OK(ks_game_step(copy, 2, &happened));
  CHECK(calls > 0 && bodies_of(copy).count == 0);
  CHECK_OK(ks_game_step(saved, 2, &happened));
  CHECK(happened.count == 1 && calls > 0 && bodies_of(saved).count == 0);
  CHECK_OK(ks_world_destroy(copy));
  CHECK_OK(ks_world_destroy(saved));
  CHECK_OK(ks_world_destroy(game));
}

int main(void) {
  contacts_and_velocities();
  timers_and_states_of_pairs();
  zones_sensors_and_filters();
  meshes();
  moving_shapes();
  rigid_bodies();
  rotation_probes();
  hulls();
  pair_filters();
  answers();
  changes_of_bodies();
  snapshots_and_clones();
  recordings();
  profiling();
  motions_and_runs();
  motions_and_probes();
  walls_with_a_filter();
  observed_limits();
  frames();
  responses();
  names();
  status_names();
  monitors();
  predictions_and_shards();
  wells();
  games_of_bodies();
  games_of_events();
  puts("all parts of the interface work");
  return 0;
}
