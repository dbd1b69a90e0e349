// Wrong use in a hundred ways. Nothing crashes, nothing is silently wrong: each call returns its code, and
// leaves a message that names the argument. The sanitizers have nothing to say.
#include "check.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

static int ways = 0;

static void refused(ks_status returned, ks_status expected, const char* call, int line) {
  printf("%2d  %-18s %s\n", ++ways, ks_status_name(returned), ks_last_error_message());
  check_status(returned, expected, call, __FILE__, line);
  CHECK(returned != KS_OK && ks_last_error_message()[0] != 0);
}
#define REFUSED(call, status) refused((call), KS_ERROR_##status, #call, __LINE__)

typedef struct game {
  ks_world world;
  ks_event event;
  ks_status inside;
  ks_status elsewhere;
} game;

static int32_t stand_still(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                           void* user) {
  (void)bodies, (void)time, (void)user;
  memset(states, 0, count * sizeof *states);
  for (size_t k = 0; k < count; ++k) states[k].position.x = 10.0 * bodies[k].index;
  return 0;
}

static int32_t give_up(const ks_body_id* bodies, size_t count, double time, ks_state* states, void* user) {
  (void)bodies, (void)count, (void)time, (void)states, (void)user;
  return -7;
}

static int32_t answer_nan(const ks_body_id* bodies, size_t count, double time, ks_state* states, void* user) {
  stand_still(bodies, count, time, states, user);
  states[0].position.y = NAN;
  return 0;
}

static int32_t answer_nothing(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                              void* user) {
  (void)bodies, (void)count, (void)time, (void)states, (void)user;
  return 0;
}

static int32_t change_inside(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                             void* user) {
  game* const g = (game*)user;
  g->inside = ks_world_set_radius(g->world, bodies[0], 2.0);
  return stand_still(bodies, count, time, states, user);
}

static int32_t destroy_inside(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                              void* user) {
  game* const g = (game*)user;
  g->inside = ks_world_destroy(g->world);
  return stand_still(bodies, count, time, states, user);
}

static int32_t advance_inside(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                              void* user) {
  game* const g = (game*)user;
  g->inside = ks_world_advance(g->world, 100.0, stand_still, NULL, &g->event);
  return stand_still(bodies, count, time, states, user);
}

static void* use_elsewhere(void* user) {
  game* const g = (game*)user;
  double time;
  g->elsewhere = ks_world_time(g->world, &time);
  return NULL;
}

static int32_t use_in_two_threads(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                                  void* user) {
  pthread_t thread;
  CHECK(pthread_create(&thread, NULL, use_elsewhere, user) == 0);
  CHECK(pthread_join(thread, NULL) == 0);
  return stand_still(bodies, count, time, states, user);
}

static int32_t refuse_event(const ks_event* event, void* user) {
  (void)event, (void)user;
  return 3;
}

static int32_t respond_nan(const ks_event* event, ks_response* response, void* user) {
  (void)event, (void)user;
  response->turns_first = 1;
  response->first_velocity.x = NAN;
  return 0;
}

/// Gives the response that `user` points to.
static int32_t respond_as_told(const ks_event* event, ks_response* response, void* user) {
  (void)event;
  *response = *(const ks_response*)user;
  return 0;
}

/// Advances a new world with a probe that misuses it, and returns what the misuse got.
static ks_status inside_probe(ks_probe probe, int elsewhere) {
  ks_world_definition definition = ks_default_world_definition();
  ks_body_definition ball = ks_default_body_definition();
  ks_body_id id;
  game g = {{0}, ks_new_event(), KS_OK, KS_OK};
  CHECK_OK(ks_world_create(&definition, &g.world));
  CHECK_OK(ks_world_add(g.world, &ball, 1, &id));
  ball.position.x = 10.0;
  ball.acceleration_limit = 1.0;
  CHECK_OK(ks_world_add(g.world, &ball, 1, &id));
  ks_event event = ks_new_event();
  CHECK_OK(ks_world_advance(g.world, 100.0, probe, &g, &event));
  CHECK_OK(ks_world_destroy(g.world));
  return elsewhere ? g.elsewhere : g.inside;
}

static void wrong_handles(void) {
  ks_world_definition definition = ks_default_world_definition();
  ks_monitor_definition tower = ks_default_monitor_definition();
  const ks_track_class drone = {ks_error_ball(3.0), ks_error_ball(INFINITY), {0, 0, 0}};
  tower.classes = &drone;
  tower.class_count = 1;
  ks_world world, never = {0}, garbage = {0x123456789abcdef0u}, copy;
  ks_monitor monitor;
  double time;
  CHECK_OK(ks_world_create(&definition, &world));
  CHECK_OK(ks_monitor_create(&tower, &monitor));
  const ks_world of_monitor = {monitor.value};
  const ks_world of_the_future = {world.value + ((uint64_t)1 << 32)};
  REFUSED(ks_world_time(never, &time), INVALID_HANDLE);
  REFUSED(ks_world_time(garbage, &time), INVALID_HANDLE);
  REFUSED(ks_world_time(of_monitor, &time), INVALID_HANDLE);
  REFUSED(ks_world_time(of_the_future, &time), INVALID_HANDLE);
  CHECK_OK(ks_world_destroy(world));
  CHECK_OK(ks_monitor_destroy(monitor));
  REFUSED(ks_world_time(world, &time), STALE_HANDLE);
  REFUSED(ks_world_clone(world, &copy), STALE_HANDLE);
  REFUSED(ks_world_destroy(world), STALE_HANDLE);
  REFUSED(ks_monitor_time(monitor, &time), STALE_HANDLE);
  // Another object takes the place of the destroyed one.
  CHECK_OK(ks_world_create(&definition, &copy));
  REFUSED(ks_world_time(world, &time), STALE_HANDLE);
  CHECK_OK(ks_world_destroy(copy));
}

static void wrong_records(ks_world world) {
  ks_world other;
  ks_body_id id;
  ks_world_definition definition = ks_default_world_definition();
  ks_body_definition ball = ks_default_body_definition();
  ks_event event = ks_new_event();
  REFUSED(ks_world_create(NULL, &other), NULL_ARGUMENT);
  REFUSED(ks_world_create(&definition, NULL), NULL_ARGUMENT);
  definition.struct_size = 0;
  REFUSED(ks_world_create(&definition, &other), BAD_STRUCT);
  REFUSED(ks_world_definition_init(&definition, 12), BAD_STRUCT);
  ball.struct_size += 8;
  REFUSED(ks_world_add(world, &ball, 1, &id), BAD_STRUCT);
  ball = ks_default_body_definition();
  REFUSED(ks_world_add(world, NULL, 1, &id), NULL_ARGUMENT);
  REFUSED(ks_world_add(world, &ball, 1, NULL), NULL_ARGUMENT);
  event.struct_size = 4;
  REFUSED(ks_world_advance(world, 1.0, stand_still, NULL, &event), BAD_STRUCT);
  REFUSED(ks_world_time(world, NULL), NULL_ARGUMENT);
  definition = ks_default_world_definition();
  definition.contacts = 17;
  REFUSED(ks_world_create(&definition, &other), OUT_OF_RANGE);
  definition = ks_default_world_definition();
  definition.periodic = 8;
  REFUSED(ks_world_create(&definition, &other), OUT_OF_RANGE);
  definition.periodic = KS_AXIS_X;
  REFUSED(ks_world_create(&definition, &other), OUT_OF_RANGE);  // without a box
  definition = ks_default_world_definition();
  definition.box.upper = vec3(10, 10, 10);
  REFUSED(ks_world_create(&definition, &other), OUT_OF_RANGE);  // it would have no walls
  CHECK(strcmp(ks_last_error_argument(), "has_box") == 0);
  ball.sensor_class = 300;
  REFUSED(ks_world_add(world, &ball, 1, &id), OUT_OF_RANGE);
  ball = ks_default_body_definition();
  ball.velocity.y = NAN;
  REFUSED(ks_world_add(world, &ball, 1, &id), NOT_FINITE);
  CHECK(strncmp(ks_last_error_message(), "add: velocity", 13) == 0);
  ks_body_definition two[2] = {ks_default_body_definition(), ball};
  ks_body_id both[2];
  REFUSED(ks_world_add(world, two, 2, both), NOT_FINITE);
  CHECK(strncmp(ks_last_error_message(), "add_all: bodies[1]: velocity", 28) == 0);
  // Filled from zeros: both would touch nothing.
  const ks_body_definition bare = {.struct_size = sizeof bare, .radius = 1.0};
  REFUSED(ks_world_add(world, &bare, 1, &id), BAD_STRUCT);
  CHECK(strstr(ks_last_error_message(), "ks_default_body_definition()") != NULL);
  const ks_static_definition bare_wall = {.struct_size = sizeof bare_wall,
                                          .shape = ks_ball(vec3(0, 0, 0), 1)};
  REFUSED(ks_world_add_static(world, &bare_wall, 1, &id), BAD_STRUCT);
  CHECK(strstr(ks_last_error_message(), "ks_default_static_definition()") != NULL);
  ks_shape shape = ks_ball(vec3(0, 0, 0), 1);
  shape.kind = 9;
  REFUSED(ks_world_add_zone(world, &shape, 0, &id), OUT_OF_RANGE);
  event = ks_new_event();
  ks_response response = ks_new_response();
  REFUSED(ks_bounce(&event, 0.5, 0.0, &response), OUT_OF_RANGE);  // no event
  event.kind = KS_EVENT_CONTACT_BEGIN;
  REFUSED(ks_bounce(&event, 1.5, 0.0, &response), OUT_OF_RANGE);
}

static void wrong_bodies(ks_world world) {
  ks_body_definition ball = ks_default_body_definition();
  ks_static_definition post = ks_default_static_definition();
  post.shape = ks_ball(vec3(0, 50, 0), 1);
  ks_body_id still, gone, fixed, foreign, ids[4];
  const ks_body_id nobody = {UINT32_MAX, 0, 0};
  size_t count = 0;
  CHECK_OK(ks_world_add(world, &ball, 1, &still));
  ball.position.x = 10.0;
  CHECK_OK(ks_world_add(world, &ball, 1, &gone));
  CHECK_OK(ks_world_add_static(world, &post, 1, &fixed));
  CHECK_OK(ks_world_remove(world, &gone, 1));
  ks_world_definition definition = ks_default_world_definition();
  ks_world other;
  CHECK_OK(ks_world_create(&definition, &other));
  CHECK_OK(ks_world_add(other, &ball, 1, &foreign));
  REFUSED(ks_world_set_velocity(world, nobody, vec3(0, 0, 0)), UNKNOWN_BODY);
  REFUSED(ks_world_set_radius(world, gone, 1.0), STALE_BODY);
  CHECK(ks_same_body(ks_last_error_body(), gone));
  REFUSED(ks_world_set_radius(world, foreign, 1.0), FOREIGN_BODY);
  REFUSED(ks_world_set_radius(world, still, -1.0), OUT_OF_RANGE);
  CHECK(strcmp(ks_last_error_argument(), "radius") == 0);
  CHECK(strncmp(ks_last_error_message(), "ks_world_set_radius: radius", 27) == 0);
  REFUSED(ks_world_set_velocity(world, fixed, vec3(1, 0, 0)), STATIC_BODY);
  ids[0] = ids[1] = still;
  REFUSED(ks_world_remove(world, ids, 2), STALE_BODY);
  REFUSED(ks_world_bodies(world, ids, 1, &count), BUFFER_TOO_SMALL);
  CHECK(count == 2);
  REFUSED(ks_world_bodies(world, NULL, 2, &count), NULL_ARGUMENT);
  REFUSED(ks_world_bodies(world, ids, 4, NULL), NULL_ARGUMENT);
  REFUSED(ks_world_cast(world, vec3(0, 0, 0), vec3(0, 0, 0), 1, 0, NULL, NULL, NULL, 0, &count),
          OUT_OF_RANGE);
  size_t ends[1];
  const ks_ray nowhere = {{0, 0, 0}, {0, 0, 0}, 1, 0};
  REFUSED(ks_world_cast_all(world, &nowhere, NULL, 1, NULL, NULL, NULL, ends, NULL, 0, &count), OUT_OF_RANGE);
  CHECK(strstr(ks_last_error_message(), "query 0, direction") != NULL);
  REFUSED(ks_world_cast_all(world, NULL, NULL, 1, NULL, NULL, NULL, ends, NULL, 0, &count), NULL_ARGUMENT);
  REFUSED(ks_world_cast_all(world, &nowhere, NULL, 1, NULL, NULL, NULL, NULL, NULL, 0, &count),
          NULL_ARGUMENT);
  ks_state state;
  REFUSED(ks_world_states(world, &still, 1, 0.0, &state), UNKNOWN_BODY);
  CHECK_OK(ks_world_destroy(other));
}

static void wrong_shapes(ks_world world) {
  ks_body_definition lift = ks_default_body_definition();
  const ks_shape ball = ks_ball(vec3(0, 0, 0), 1), plate = ks_solid_box(vec3(-1, -1, 0), vec3(1, 1, 0.5));
  const ks_shape inside_out = ks_solid_box(vec3(1, 1, 1), vec3(0, 0, 0));
  ks_body_id id;
  REFUSED(ks_world_add_moving_shape(world, &lift, &ball, &id), UNSUPPORTED);
  CHECK(strcmp(ks_last_error_argument(), "shape") == 0);
  REFUSED(ks_world_add_moving_shape(world, &lift, &inside_out, &id), OUT_OF_RANGE);
  REFUSED(ks_world_add_moving_shape(world, NULL, &plate, &id), NULL_ARGUMENT);
  REFUSED(ks_world_add_moving_shape(world, &lift, NULL, &id), NULL_ARGUMENT);
  REFUSED(ks_world_add_moving_shape(world, &lift, &plate, NULL), NULL_ARGUMENT);
  lift.mass = -1;
  REFUSED(ks_world_add_moving_shape(world, &lift, &plate, &id), OUT_OF_RANGE);
  lift.struct_size = 1;
  REFUSED(ks_world_add_moving_shape(world, &lift, &plate, &id), BAD_STRUCT);
}

static int32_t refuse_to_turn(const ks_body_id* bodies, size_t count, double time, ks_rotation* rotations,
                              void* user) {
  (void)bodies, (void)count, (void)time, (void)rotations, (void)user;
  return 5;
}

static void wrong_rigid_bodies(void) {
  ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  ks_body_definition body = ks_default_body_definition();
  ks_rigid_definition rigid = ks_default_rigid_definition();
  ks_rigid_part rod = {{0, 0, 0}, {4, 0, 0}, -1};
  ks_body_id id, ball;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), OUT_OF_RANGE);
  CHECK(strcmp(ks_last_error_argument(), "parts") == 0);
  rigid.part_count = 1;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), NULL_ARGUMENT);
  rigid.parts = &rod;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), OUT_OF_RANGE);
  rod.radius = 0.1;
  REFUSED(ks_world_add_rigid_body(world, &body, NULL, &id), NULL_ARGUMENT);
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, NULL), NULL_ARGUMENT);
  ks_rigid_hull hull = {2, NULL, 0};
  rigid.hulls = &hull;
  rigid.hull_count = 1;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), NULL_ARGUMENT);
  hull.point_count = 0;
  hull.points = &rod.a;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), NULL_ARGUMENT);
  rigid.hull_count = 0;
  rigid.rotation.orientation.x = 1;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), OUT_OF_RANGE);
  rigid.rotation.orientation.x = 0;
  rigid.angular_acceleration_limit = 1;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), OUT_OF_RANGE);
  rigid.largest_angular_speed = 2;
  ++rigid.struct_size;
  REFUSED(ks_world_add_rigid_body(world, &body, &rigid, &id), BAD_STRUCT);
  --rigid.struct_size;
  CHECK_OK(ks_world_add_rigid_body(world, &body, &rigid, &id));
  body.position.x = 10;
  body.acceleration_limit = 1;
  CHECK_OK(ks_world_add(world, &body, 1, &ball));
  ks_rotation rotation = rigid.rotation;
  REFUSED(ks_world_rotation(world, ball, &rotation), UNSUPPORTED);
  REFUSED(ks_world_rotation(world, id, NULL), NULL_ARGUMENT);
  REFUSED(ks_world_set_angular_velocity(world, ball, vec3(0, 0, 1)), UNSUPPORTED);
  REFUSED(ks_world_set_angular_velocity(world, id, vec3(0, 0, 3)), OUT_OF_RANGE);
  REFUSED(ks_world_set_rotation(world, id, NULL), NULL_ARGUMENT);
  rotation.angular_velocity.z = NAN;
  REFUSED(ks_world_set_rotation(world, id, &rotation), NOT_FINITE);
  ks_event event = ks_new_event();
  REFUSED(ks_world_advance(world, 100.0, stand_still, NULL, &event), NULL_PROBE);
  CHECK_OK(ks_world_set_rotation_probe(world, refuse_to_turn, NULL));
  REFUSED(ks_world_advance(world, 100.0, stand_still, NULL, &event), CALLBACK_FAILED);
  CHECK(ks_last_error_callback() == 5);
  CHECK_OK(ks_world_destroy(world));
}

static void wrong_time(ks_world world) {
  ks_event event = ks_new_event();
  REFUSED(ks_world_advance(world, NAN, stand_still, NULL, &event), NOT_FINITE);
  REFUSED(ks_world_advance(world, -1.0, stand_still, NULL, &event), TIME_BACKWARDS);
  REFUSED(ks_world_advance(world, 50.0, NULL, NULL, &event), NULL_PROBE);
  // The first advance after bodies were added knows their states; this one needs new ones.
  ks_body_definition nervous = ks_default_body_definition();
  nervous.acceleration_limit = 1.0;
  nervous.position.x = 30.0;
  ks_body_id ids[2];
  CHECK_OK(ks_world_add(world, &nervous, 1, &ids[0]));
  nervous.position.x = 40.0;
  CHECK_OK(ks_world_add(world, &nervous, 1, &ids[1]));
  REFUSED(ks_world_advance(world, 50.0, give_up, NULL, &event), CALLBACK_FAILED);
  CHECK(ks_last_error_callback() == -7);
  REFUSED(ks_world_advance(world, 50.0, answer_nan, NULL, &event), NOT_FINITE);
  REFUSED(ks_world_advance(world, 50.0, ks_probe_motions, NULL, &event), UNKNOWN_BODY);
  ks_run_definition run = ks_default_run_definition();
  REFUSED(ks_world_run(world, 50.0, &run), UNKNOWN_BODY);
  CHECK(strstr(ks_last_error_message(), "no motion of the world moves body") != NULL);
  run.threads = 1000;
  REFUSED(ks_world_run(world, 50.0, &run), OUT_OF_RANGE);
  run.threads = 1;
  run.restitution = 2.0;
  REFUSED(ks_world_run(world, 50.0, &run), OUT_OF_RANGE);
  CHECK_OK(ks_world_advance(world, 3.0, stand_still, NULL, &event));  // it goes on where it was stopped

  REFUSED(inside_probe(change_inside, 0), PROBE_IN_PROGRESS);
  REFUSED(inside_probe(advance_inside, 0), PROBE_IN_PROGRESS);
  REFUSED(inside_probe(destroy_inside, 0), IN_USE);
  REFUSED(inside_probe(use_in_two_threads, 1), IN_USE);
}

static void wrong_motions(void) {
  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = vec3(10, 10, 10);
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  ks_state state = {{5, 5, 5}, {1, 0, 0}};
  ks_body_id id;
  uint32_t motion;
  ks_motion_definition flight = ks_default_motion_definition();
  flight.count = 1;
  REFUSED(ks_world_add_motion(world, &flight, NULL, &id), NULL_ARGUMENT);
  flight.states = &state;
  flight.kind = 5;
  REFUSED(ks_world_add_motion(world, &flight, NULL, &id), OUT_OF_RANGE);
  flight.kind = KS_MOTION_RANDOM_FORCES;
  REFUSED(ks_world_add_motion(world, &flight, NULL, &id), NULL_ARGUMENT);  // without limits
  flight.kind = KS_MOTION_BALLISTIC;
  const double mass = -1.0;
  flight.masses = &mass;
  REFUSED(ks_world_add_motion(world, &flight, NULL, &id), OUT_OF_RANGE);
  flight.masses = NULL;
  CHECK_OK(ks_world_add_motion(world, &flight, &motion, &id));
  const ks_vec3 position = {5, 5, 5};
  REFUSED(ks_world_push_frame(world, motion, &position, 1), OUT_OF_RANGE);
  CHECK(strcmp(ks_last_error_message(), "ks_world_push_frame: motion 0 must be of kind KS_MOTION_FRAMES") ==
        0);
  REFUSED(ks_world_steer(world, id, vec3(0, 0, 0)), UNSUPPORTED);
  REFUSED(ks_world_push_frame(world, 99, &position, 1), OUT_OF_RANGE);
  REFUSED(ks_world_push_frame_at(world, 99, &position, 1, 1.0), OUT_OF_RANGE);
  ks_run_definition run = ks_default_run_definition();
  run.sink = refuse_event;
  REFUSED(ks_world_run(world, 50.0, &run), CALLBACK_FAILED);
  CHECK(ks_last_error_callback() == 3);
  run.sink = NULL;
  run.respond = respond_nan;
  REFUSED(ks_world_run(world, 50.0, &run), NOT_FINITE);
  CHECK_OK(ks_world_destroy(world));
}

static void wrong_steering(void) {
  ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  ks_state states[2] = {{{0, 0, 0}, {0, 0, 0}}, {{10, 0, 0}, {0, 0, 0}}};
  const double limits[2] = {2, 2};
  ks_motion_definition ships = ks_default_motion_definition();
  ships.kind = KS_MOTION_STEERED;
  ships.count = 2;
  ships.states = states;
  ks_body_id ids[2], ball;
  REFUSED(ks_world_add_motion(world, &ships, NULL, ids), NULL_ARGUMENT);  // without limits
  ships.gravity.z = -10;
  REFUSED(ks_world_add_motion(world, &ships, NULL, ids), OUT_OF_RANGE);  // it would have no effect
  ships.gravity.z = 0;
  ships.acceleration_limits = limits;
  CHECK_OK(ks_world_add_motion(world, &ships, NULL, ids));
  REFUSED(ks_world_steer(world, ids[0], vec3(3, 0, 0)), OUT_OF_RANGE);
  REFUSED(ks_world_steer(world, ids[0], vec3(NAN, 0, 0)), NOT_FINITE);
  // A body without a motion, which the probe forgets: its state is not that of a place where it might be.
  ks_body_definition other = ks_default_body_definition();
  other.position = vec3(0, 40, 0);  // far away: it is asked for together with the ships
  other.acceleration_limit = 1;
  CHECK_OK(ks_world_add(world, &other, 1, &ball));
  REFUSED(ks_world_steer(world, ball, vec3(0, 0, 0)), UNSUPPORTED);
  ks_event event = ks_new_event();
  REFUSED(ks_world_advance(world, 60, answer_nothing, NULL, &event), NOT_FINITE);
  CHECK(ks_same_body(ks_last_error_body(), ball));
  double start;
  CHECK_OK(ks_world_time(world, &start));
  CHECK_OK(ks_world_remove(world, &ball, 1));
  CHECK_OK(ks_world_steer(world, ids[0], vec3(2, 0, 0)));
  CHECK_OK(ks_world_advance(world, 60, ks_probe_motions, NULL, &event));
  CHECK(event.kind == KS_EVENT_CONTACT_BEGIN && fabs(event.time - start - sqrt(8)) < 1e-5);
  CHECK_OK(ks_world_remove(world, &ids[1], 1));
  REFUSED(ks_world_steer(world, ids[1], vec3(0, 0, 0)), STALE_BODY);
  CHECK_OK(ks_world_destroy(world));
}

/// Runs a world in which a ball hits a post, then the wall behind it.
static ks_status run_into_post(const ks_response* response) {
  ks_world_definition definition = ks_default_world_definition();
  definition.has_box = 1;
  definition.box.upper = vec3(10, 10, 10);
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  ks_body_id ids[2];
  const ks_state state = {{3, 5, 5}, {1, 0, 0}};
  ks_motion_definition flight = ks_default_motion_definition();
  flight.count = 1;
  flight.states = &state;
  CHECK_OK(ks_world_add_motion(world, &flight, NULL, &ids[0]));
  ks_static_definition fixed = ks_default_static_definition();
  fixed.shape = ks_ball(vec3(6, 5, 5), 0.5);
  CHECK_OK(ks_world_add_static(world, &fixed, 1, &ids[1]));
  ks_run_definition run = ks_default_run_definition();
  run.respond = respond_as_told;
  run.respond_user = (void*)response;
  const ks_status done = ks_world_run(world, 20, &run);
  // After a refusal the world goes on.
  run.respond = NULL;
  if (done != KS_OK) CHECK_OK(ks_world_run(world, 20, &run));
  CHECK_OK(ks_world_destroy(world));
  return done;
}

static void wrong_responses(void) {
  ks_response response = ks_new_response();
  CHECK_OK(run_into_post(&response));
  response.second_action = KS_ACTION_SLEEP;  // a static body
  REFUSED(run_into_post(&response), STATIC_BODY);
  CHECK(strcmp(ks_last_error_argument(), "second_action") == 0 && ks_last_error_body().index == 1);
  response.second_action = 17;
  REFUSED(run_into_post(&response), OUT_OF_RANGE);
  CHECK(strcmp(ks_last_error_argument(), "second_action") == 0);
  response.second_action = -1;
  REFUSED(run_into_post(&response), OUT_OF_RANGE);
  response = ks_new_response();
  response.second_action = KS_ACTION_REMOVE;  // the post, and then the wall
  REFUSED(run_into_post(&response), UNKNOWN_BODY);
  CHECK(strcmp(ks_last_error_argument(), "second_action") == 0);
  response.struct_size = 112;
  REFUSED(run_into_post(&response), BAD_STRUCT);
  CHECK(strcmp(ks_last_error_argument(), "response") == 0);
  memset(&response, 0, sizeof response);
  ks_event event = ks_new_event();
  event.kind = KS_EVENT_CONTACT_BEGIN;
  REFUSED(ks_bounce(&event, 1.0, 0.0, &response), BAD_STRUCT);
}

static int32_t no_pairs(ks_body_id first, ks_body_id second, void* user) {
  (void)first, (void)second, (void)user;
  return 0;
}

static void wrong_snapshots(ks_world world) {
  unsigned char bytes[1 << 16];
  size_t count;
  ks_world restored;
  ks_monitor monitor;
  REFUSED(ks_world_save(world, NULL, 0, &count), BUFFER_TOO_SMALL);
  CHECK(count > 100 && count <= sizeof bytes);
  CHECK_OK(ks_world_save(world, bytes, sizeof bytes, &count));
  REFUSED(ks_world_restore(bytes, count - 1, NULL, NULL, &restored), BAD_SNAPSHOT);
  bytes[count / 2] ^= 1;
  REFUSED(ks_world_restore(bytes, count, NULL, NULL, &restored), BAD_SNAPSHOT);
  REFUSED(ks_world_restore(NULL, count, NULL, NULL, &restored), NULL_ARGUMENT);
  REFUSED(ks_monitor_restore(bytes, count, &monitor), BAD_SNAPSHOT);
  CHECK_OK(ks_world_set_pair_filter(world, no_pairs, NULL));
  CHECK_OK(ks_world_save(world, bytes, sizeof bytes, &count));
  CHECK_OK(ks_world_set_pair_filter(world, NULL, NULL));
  REFUSED(ks_world_restore(bytes, count, NULL, NULL, &restored), BAD_SNAPSHOT);
  CHECK(strcmp(ks_last_error_argument(), "pair_filter") == 0);
  CHECK_OK(ks_world_restore(bytes, count, no_pairs, NULL, &restored));
  CHECK_OK(ks_world_destroy(restored));
}

static int32_t record_inside(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                             void* user) {
  game* const g = (game*)user;
  g->inside = ks_world_start_recording(g->world);
  return stand_still(bodies, count, time, states, user);
}

static int32_t profile_inside(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                              void* user) {
  game* const g = (game*)user;
  g->inside = ks_world_set_profiling(g->world, 1);
  return stand_still(bodies, count, time, states, user);
}

static void wrong_recordings(void) {
  unsigned char bytes[1 << 14];
  size_t count;
  ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  REFUSED(ks_world_stop_recording(world), NOT_RECORDING);
  CHECK_OK(ks_world_start_recording(world));
  REFUSED(ks_world_start_recording(world), RECORDING);
  REFUSED(ks_world_recording(world, bytes, sizeof bytes, &count), NOT_RECORDING);  // it is not stopped
  ks_event event = ks_new_event();
  CHECK_OK(ks_world_advance(world, 1.0, stand_still, NULL, &event));
  CHECK_OK(ks_world_stop_recording(world));
  REFUSED(ks_world_recording(world, bytes, 10, &count), BUFFER_TOO_SMALL);
  REFUSED(ks_world_recording(world, NULL, sizeof bytes, &count), NULL_ARGUMENT);
  CHECK_OK(ks_world_recording(world, bytes, sizeof bytes, &count));  // nothing is lost
  CHECK_OK(ks_world_destroy(world));

  ks_replay replay, other, never = {0};
  const ks_replay of_world = {world.value};
  REFUSED(ks_replay_open(bytes, count - 1, NULL, NULL, &replay), BAD_RECORDING);
  REFUSED(ks_replay_open(NULL, count, NULL, NULL, &replay), NULL_ARGUMENT);
  REFUSED(ks_replay_open(bytes, count, NULL, NULL, NULL), NULL_ARGUMENT);
  CHECK_OK(ks_replay_open(bytes, count, NULL, NULL, &replay));
  bytes[count / 2] ^= 1;
  REFUSED(ks_replay_open(bytes, count, NULL, NULL, &other), BAD_RECORDING);
  REFUSED(ks_replay_advance(replay, NULL), NULL_ARGUMENT);
  event.struct_size = 3;
  REFUSED(ks_replay_advance(replay, &event), BAD_STRUCT);
  event = ks_new_event();
  REFUSED(ks_replay_advance(never, &event), INVALID_HANDLE);
  REFUSED(ks_replay_advance(of_world, &event), INVALID_HANDLE);
  REFUSED(ks_replay_steps(replay, &count, NULL), NULL_ARGUMENT);
  CHECK_OK(ks_replay_destroy(replay));
  uint64_t hash;
  REFUSED(ks_replay_hash(replay, &hash), STALE_HANDLE);
  REFUSED(ks_replay_world(replay, &world), STALE_HANDLE);
  REFUSED(ks_replay_destroy(replay), STALE_HANDLE);
  REFUSED(inside_probe(record_inside, 0), PROBE_IN_PROGRESS);
}

static void wrong_profiling(ks_world world) {
  ks_busy_body busy;
  size_t count;
  REFUSED(ks_world_busiest(world, 1, &busy, 1, &count), NOT_PROFILING);
  REFUSED(ks_world_timings(world, NULL), NULL_ARGUMENT);
  REFUSED(inside_probe(profile_inside, 0), PROBE_IN_PROGRESS);
}

static void wrong_monitors(void) {
  ks_monitor_definition tower = ks_default_monitor_definition();
  ks_track_class drone = {ks_error_ball(3.0), ks_error_ball(INFINITY), {0, 0, 0}};
  ks_separation levels[1] = {{KS_SEPARATION_ELLIPSOID, 50.0, 50.0, 0.0, 0.0}};
  ks_separation_rule rule = {0, 0, levels, 1};
  ks_monitor monitor;
  tower.classes = &drone;
  tower.class_count = 1;
  tower.separations = &rule;
  tower.separation_count = 1;
  tower.tolerance = 0.0;
  REFUSED(ks_monitor_create(&tower, &monitor), OUT_OF_RANGE);
  tower.tolerance = 1e-3;
  tower.shard_first = 1;  // of one
  REFUSED(ks_monitor_create(&tower, &monitor), OUT_OF_RANGE);
  tower.shard_first = 0;
  levels[0].shape = 3;
  REFUSED(ks_monitor_create(&tower, &monitor), OUT_OF_RANGE);
  levels[0].shape = KS_SEPARATION_CYLINDER;
  CHECK_OK(ks_monitor_create(&tower, &monitor));
  ks_track_report reports[2] = {ks_default_track_report(), ks_default_track_report()};
  const uint64_t tracks[2] = {1, 2};
  size_t count;
  reports[1].track_class = 5;
  REFUSED(ks_monitor_report(monitor, tracks, reports, 2), OUT_OF_RANGE);
  CHECK_OK(ks_monitor_tracks(monitor, NULL, 0, &count));
  CHECK(count == 0);  // all or none
  reports[1] = reports[0];
  reports[1].struct_size = 1;
  REFUSED(ks_monitor_report(monitor, tracks, reports, 2), BAD_STRUCT);
  reports[1] = reports[0];
  CHECK_OK(ks_monitor_report(monitor, tracks, reports, 2));
  ks_pair_answer answer = ks_new_pair_answer();
  REFUSED(ks_monitor_answer(monitor, 1, 1, 0, &answer), OUT_OF_RANGE);
  REFUSED(ks_monitor_answer(monitor, 1, 3, 0, &answer), UNKNOWN_BODY);
  REFUSED(ks_monitor_remove(monitor, 3), UNKNOWN_BODY);
  REFUSED(ks_monitor_predicted_pairs(monitor, NULL, 0, NULL), NULL_ARGUMENT);
  ks_monitor_event event = ks_new_monitor_event();
  REFUSED(ks_monitor_advance(monitor, -1.0, NULL, NULL, &event), TIME_BACKWARDS);
  CHECK_OK(ks_monitor_destroy(monitor));
}

static int32_t step_inside(const ks_event* event, ks_response* response, void* user) {
  (void)event, (void)response;
  game* const g = (game*)user;
  ks_event_list happened;
  g->inside = ks_game_step(g->world, 1.0, &happened);
  g->elsewhere = ks_world_destroy(g->world);
  return -5;
}

static void wrong_games(ks_world world) {
  game g;
  ks_world_definition room = ks_default_world_definition();
  room.has_box = 1;
  room.box.upper = vec3(10, 10, 10);
  ks_game_definition falling = ks_default_game_definition();
  falling.gravity.z = NAN;
  REFUSED(ks_game_create(&room, &falling, &g.world), NOT_FINITE);
  falling.gravity.z = -10;
  falling.restitution = 2;
  REFUSED(ks_game_create(&room, &falling, &g.world), OUT_OF_RANGE);
  falling.restitution = 1;
  falling.struct_size = 5;
  REFUSED(ks_game_create(&room, &falling, &g.world), BAD_STRUCT);
  falling = ks_default_game_definition();
  falling.gravity.z = -10;
  falling.respond = step_inside;
  falling.respond_user = &g;
  REFUSED(ks_game_create(&room, NULL, &g.world), NULL_ARGUMENT);
  CHECK_OK(ks_game_create(&room, &falling, &g.world));
  ks_body_definition ball = ks_default_body_definition();
  ball.position = vec3(5, 5, 5);
  ks_body_id id;
  CHECK_OK(ks_world_add(g.world, &ball, 1, &id));

  ks_event_list happened;
  ks_body_list bodies;
  REFUSED(ks_game_step(g.world, 0.0, &happened), OUT_OF_RANGE);
  REFUSED(ks_game_step(g.world, NAN, &happened), NOT_FINITE);
  REFUSED(ks_game_step(g.world, 1.0, NULL), NULL_ARGUMENT);
  const ks_vec3 wrong[2] = {vec3(0, NAN, 0), vec3(0, 0, 0)};
  REFUSED(ks_game_set_velocities(g.world, wrong, 1), NOT_FINITE);
  CHECK(ks_same_body(ks_last_error_body(), id));
  REFUSED(ks_game_set_velocities(g.world, wrong, 2), OUT_OF_RANGE);
  REFUSED(ks_game_set_gravity(g.world, wrong[0]), NOT_FINITE);
  REFUSED(ks_game_set_acceleration(g.world, id, wrong[0]), NOT_FINITE);
  ks_body_id never = {77, 1, 0};
  size_t index;
  REFUSED(ks_game_set_acceleration(g.world, never, vec3(0, 0, 0)), UNKNOWN_BODY);
  REFUSED(ks_game_index_of(g.world, never, &index), UNKNOWN_BODY);
  REFUSED(ks_world_set_velocity(g.world, never, vec3(0, 0, 0)), UNKNOWN_BODY);

  // What games lack, and what other worlds lack.
  ks_event event = ks_new_event();
  const ks_run_definition run = ks_default_run_definition();
  const ks_motion_limits limits = {1, 0, 0, {0, 0, 0}};
  REFUSED(ks_world_advance(g.world, 1.0, stand_still, NULL, &event), UNSUPPORTED);
  REFUSED(ks_world_advance(g.world, -1.0, ks_probe_motions, NULL, &event), TIME_BACKWARDS);
  REFUSED(ks_world_run(g.world, 1.0, &run), UNSUPPORTED);
  REFUSED(ks_world_set_motion_limits(g.world, id, &limits), UNSUPPORTED);
  REFUSED(ks_game_step(world, 1.0, &happened), UNSUPPORTED);
  REFUSED(ks_game_bodies(world, &bodies), UNSUPPORTED);

  // Nothing has changed; a response may not call its game.
  CHECK_OK(ks_game_bodies(g.world, &bodies));
  CHECK(bodies.count == 1 && bodies.positions[0].z == 5 && bodies.velocities[0].y == 0);
  REFUSED(ks_game_step(g.world, 2.0, &happened), CALLBACK_FAILED);
  CHECK(ks_last_error_callback() == -5);
  CHECK(g.inside == KS_ERROR_RUN_IN_PROGRESS && g.elsewhere == KS_ERROR_IN_USE);

  char bytes[1 << 14];
  size_t count;
  ks_world restored;
  REFUSED(ks_world_save(g.world, bytes, sizeof bytes, &count), RUN_IN_PROGRESS);
  CHECK_OK(ks_world_destroy(g.world));
  CHECK_OK(ks_game_create(&room, &falling, &g.world));
  CHECK_OK(ks_world_save(g.world, bytes, sizeof bytes, &count));
  REFUSED(ks_world_restore(bytes, count, NULL, NULL, &restored), BAD_SNAPSHOT);
  REFUSED(ks_game_restore(bytes, count - 1, &falling, NULL, NULL, &restored), BAD_SNAPSHOT);
  CHECK_OK(ks_world_destroy(g.world));
  REFUSED(ks_game_step(g.world, 1.0, &happened), STALE_HANDLE);
  REFUSED(ks_game_bodies(g.world, &bodies), STALE_HANDLE);
}

int main(void) {
  ks_world_definition definition = ks_default_world_definition();
  ks_world world;
  CHECK_OK(ks_world_create(&definition, &world));
  wrong_handles();
  wrong_records(world);
  wrong_bodies(world);
  wrong_shapes(world);
  wrong_rigid_bodies();
  wrong_time(world);
  wrong_motions();
  wrong_steering();
  wrong_responses();
  wrong_snapshots(world);
  wrong_recordings();
  wrong_profiling(world);
  wrong_monitors();
  wrong_games(world);
  CHECK_OK(ks_world_destroy(world));
  printf("%d ways, each noticed\n", ways);
  return ways >= 45 ? 0 : 1;
}
