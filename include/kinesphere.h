// Kinesphere in C, for C and all languages that call C: worlds of moving spheres, and monitors of tracks.
//
//   ks_world_definition definition = ks_default_world_definition();
//   ks_world world;
//   if (ks_world_create(&definition, &world) != KS_OK) return fail(ks_last_error_message());
//   ks_body_definition ball = ks_default_body_definition();
//   ball.acceleration_limit = 10;
//   ks_body_id id;
//   if (ks_world_add(world, &ball, 1, &id) != KS_OK) return fail(ks_last_error_message());
//   // ... more bodies
//
//   ks_event event = ks_new_event();
//   for (;;) {
//     if (ks_world_advance(world, 60.0, my_probe, &my_game, &event) != KS_OK) return fail();
//     if (event.kind == KS_EVENT_NONE) break;
//     if (event.kind == KS_EVENT_CONTACT_BEGIN) ks_world_set_velocity(world, event.first, ...);
//   }
//   ks_world_destroy(world);
//
// The C++ headers in kinesphere/ state units, ranges and guarantees in full: world.hpp, body.hpp, event.hpp,
// certificates.hpp, queries.hpp, monitor/monitor.hpp. Calls here have the names, meanings, errors and costs
// of the calls there. docs/c.md is the guide.
//
// Errors. Every call returns a status, KS_OK or a code, and a call that fails has changed nothing, neither
// its object nor what its pointers point to, except where it says so. The functions ks_last_error_...()
// describe the last failure in the calling thread. Every call may fail with KS_ERROR_NULL_ARGUMENT,
// KS_ERROR_OUT_OF_MEMORY and, for an invalid record, KS_ERROR_BAD_STRUCT or KS_ERROR_OUT_OF_RANGE. Every call
// with a handle may fail with KS_ERROR_INVALID_HANDLE, KS_ERROR_STALE_HANDLE and KS_ERROR_IN_USE. No
// exception leaves the library.
//
// Handles. A ks_world, ks_monitor or ks_replay names an object of the library. The library recognises handles
// of destroyed objects and numbers that never were handles; it never takes one for another object.
//
// Threads. One thread at a time may change an object or advance it; several may read it while none does. A
// call that finds the object in use by another thread fails with KS_ERROR_IN_USE. Different objects are
// independent.
//
// Cost. A call takes about 50 ns more than in C++, a callback next to nothing. An error takes some
// microseconds.
//
// Records. A record that begins with struct_size may get more fields in later versions of the library. A
// function ks_default_...() or ks_new_...() sets struct_size; a size that this library does not know is
// refused, and so is a body whose filter, solid and mass are 0, as in a record filled from zeros. All other
// records stay as they are for as long as KS_ABI_VERSION does. A ks_bool is an int32_t: 0 means
// false. `default` in the comment of a field says what its function ks_default_...() sets; for others it sets
// 0.
//
// Arrays. A call that fills an array takes its capacity, sets *count to the number of elements that there
// are, and fails with KS_ERROR_BUFFER_TOO_SMALL if they do not fit; the array is then untouched. An array
// with capacity 0 may be NULL.
#ifndef KINESPHERE_H
#define KINESPHERE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/// Number of the binary interface, as in the name of the shared library. Programs continue to run, without
/// being compiled again, with all libraries that have this number.
#define KS_ABI_VERSION 0

#ifdef _WIN32
#ifdef KS_BUILDING
#define KS_API __declspec(dllexport)
#else
#define KS_API __declspec(dllimport)
#endif
#else
#define KS_API __attribute__((visibility("default")))
#endif

/// Begins functions whose failure a caller must not overlook, such as ks_world_advance(): compilers warn
/// where the status is not used.
#ifdef __GNUC__
#define KS_MUST_CHECK __attribute__((warn_unused_result))
#else
#define KS_MUST_CHECK
#endif

#ifdef __cplusplus
extern "C" {
#endif

// -----------------------------------------------------------------------------------------------------------
// Statuses and errors

/// KS_OK or the code of an error. ks_status_name() returns the names.
typedef int32_t ks_status;
enum {
  KS_OK = 0,
  // Errors of this interface.
  KS_ERROR_INVALID_HANDLE = 1,  ///< the handle never was one of such an object
  KS_ERROR_STALE_HANDLE = 2,    ///< the object has been destroyed
  KS_ERROR_IN_USE = 3,          ///< another thread uses the object, or (destroy) a call has not yet returned
  KS_ERROR_NULL_ARGUMENT = 4,   ///< a pointer is null
  KS_ERROR_BAD_STRUCT = 5,      ///< struct_size is none that this library knows
  KS_ERROR_BUFFER_TOO_SMALL = 6,  ///< *count elements do not fit
  KS_ERROR_CALLBACK_FAILED = 7,   ///< a callback returned a number other than 0; the call may be repeated
  KS_ERROR_OUT_OF_MEMORY = 8,
  KS_ERROR_INTERNAL = 9,  ///< a mistake of the library
  // Errors of the library: kinesphere/result.hpp explains each.
  KS_ERROR_NOT_FINITE = 20,
  KS_ERROR_OUT_OF_RANGE = 21,
  KS_ERROR_TIME_BACKWARDS = 22,
  KS_ERROR_UNKNOWN_BODY = 23,
  KS_ERROR_STALE_BODY = 24,
  KS_ERROR_FOREIGN_BODY = 25,
  KS_ERROR_DISABLED_BODY = 26,
  KS_ERROR_ENABLED_BODY = 27,
  KS_ERROR_STATIC_BODY = 28,
  KS_ERROR_OUTSIDE_DOMAIN = 29,
  KS_ERROR_OVERLAPPING = 30,
  KS_ERROR_PROBE_IN_PROGRESS = 31,
  KS_ERROR_FILTER_IN_PROGRESS = 32,
  KS_ERROR_RUN_IN_PROGRESS = 33,
  KS_ERROR_WORKERS_BUSY = 34,
  KS_ERROR_NO_THREADS = 35,
  KS_ERROR_NULL_PROBE = 36,
  KS_ERROR_NULL_CALLBACK = 37,
  KS_ERROR_CALLBACK_THREW = 38,
  KS_ERROR_RANK_FAILED = 39,
  KS_ERROR_MOVED_FROM = 40,
  KS_ERROR_UNSUPPORTED = 41,
  KS_ERROR_BAD_SNAPSHOT = 42,
  KS_ERROR_BAD_BYTES = 43,
  KS_ERROR_RECORDING = 44,
  KS_ERROR_NOT_RECORDING = 45,
  KS_ERROR_NOT_PROFILING = 46,
  KS_ERROR_BAD_RECORDING = 47,
  KS_ERROR_DIVERGED = 48
};

/// 0 means false; the library writes 1 for true.
typedef int32_t ks_bool;

/// Names a body until it is removed. Two ids are of one body if index and generation are equal. `world` is a
/// tag of the world that issued the id, by which others refuse it; 0 is accepted by all worlds.
typedef struct ks_body_id {
  uint32_t index;
  uint32_t generation;
  uint32_t world;
} ks_body_id;

/// Returns true for the id that names no body, such as the second one of a wall event.
static inline ks_bool ks_is_no_body(ks_body_id body) {
  return body.index == UINT32_MAX && body.generation == 0;
}
/// Returns true if both ids name one body.
static inline ks_bool ks_same_body(ks_body_id a, ks_body_id b) {
  return a.index == b.index && a.generation == b.generation;
}

/// Return what the last call of this thread that failed has to say: one line for a person, the argument and
/// the body that it names. Empty texts and no body before the first failure; a success changes nothing. The
/// texts are valid until the next failure in this thread.
KS_API const char* ks_last_error_message(void);
KS_API const char* ks_last_error_argument(void);
KS_API ks_body_id ks_last_error_body(void);
/// Returns the number that the callback returned, after KS_ERROR_CALLBACK_FAILED; else 0.
KS_API int32_t ks_last_error_callback(void);
/// Returns the name of a status, such as "stale_body"; "" for a number that is none.
KS_API const char* ks_status_name(ks_status status);

/// Returns the version of the library, such as "0.3.0".
KS_API const char* ks_version(void);
/// Returns the KS_ABI_VERSION of the library that has been loaded.
KS_API uint32_t ks_abi_version(void);

// -----------------------------------------------------------------------------------------------------------
// Geometry. Lengths, times and masses are in any consistent units.

/// A vector or a point.
typedef struct ks_vec3 {
  double x, y, z;
} ks_vec3;

/// Position (length) and velocity (length / time) at one time.
typedef struct ks_state {
  ks_vec3 position;
  ks_vec3 velocity;
} ks_state;

/// All points p with lower <= p <= upper on every axis.
typedef struct ks_box {
  ks_vec3 lower;
  ks_vec3 upper;
} ks_box;

/// One of KS_SHAPE_...
typedef int32_t ks_shape_kind;
enum {
  KS_SHAPE_BALL = 0,
  KS_SHAPE_HALF_SPACE = 1,
  KS_SHAPE_BOX = 2,
  KS_SHAPE_TRIANGLE = 3,
  KS_SHAPE_MESH = 4
};

/// Shape of a static body, a zone or a body that carries it, best made by one of the functions below.
typedef struct ks_shape {
  ks_shape_kind kind;
  ks_vec3 points[3];  ///< centre; normal; lower and upper corner; three corners
  double number;      ///< radius of a ball, offset of a half-space; of a mesh the bits of its handle
} ks_shape;

/// Radius >= 0.
static inline ks_shape ks_ball(ks_vec3 centre, double radius) {
  ks_shape shape;
  memset(&shape, 0, sizeof shape);
  shape.kind = KS_SHAPE_BALL;
  shape.points[0] = centre;
  shape.number = radius;
  return shape;
}
/// Bodies may be where dot(normal, p) >= offset. The normal has length 1.
static inline ks_shape ks_half_space(ks_vec3 normal, double offset) {
  ks_shape shape = ks_ball(normal, offset);
  shape.kind = KS_SHAPE_HALF_SPACE;
  return shape;
}
/// All points p with lower <= p <= upper on every axis.
static inline ks_shape ks_solid_box(ks_vec3 lower, ks_vec3 upper) {
  ks_shape shape = ks_ball(lower, 0.0);
  shape.kind = KS_SHAPE_BOX;
  shape.points[1] = upper;
  return shape;
}
/// A two-sided triangle without thickness.
static inline ks_shape ks_triangle(ks_vec3 a, ks_vec3 b, ks_vec3 c) {
  ks_shape shape = ks_solid_box(a, b);
  shape.kind = KS_SHAPE_TRIANGLE;
  shape.points[2] = c;
  return shape;
}

/// A surface of triangles that is one shape (Mesh of kinesphere/shape.hpp). A handle of zero never names one.
typedef struct ks_mesh {
  uint64_t value;
} ks_mesh;

/// Creates a mesh with one triangle for each three numbers of vertices in `corners`, which has 3 *
/// triangle_count of them; both arrays are copied. Events name a triangle by its place. Destroy the mesh with
/// ks_mesh_destroy() once all bodies have it. Errors: those of Mesh::create().
KS_API KS_MUST_CHECK ks_status ks_mesh_create(const ks_vec3* vertices, size_t vertex_count,
                                              const uint32_t* corners, size_t triangle_count, ks_mesh* mesh);
/// Creates a chain of segments from each point to the next, for worlds of two dimensions. Errors: those of
/// Mesh::chain().
KS_API KS_MUST_CHECK ks_status ks_mesh_create_chain(const ks_vec3* points, size_t count, ks_mesh* mesh);
/// Bodies that have the mesh keep it.
KS_API ks_status ks_mesh_destroy(ks_mesh mesh);
/// The shape, for as many bodies as you like; valid until ks_mesh_destroy().
static inline ks_shape ks_mesh_shape(ks_mesh mesh) {
  ks_shape shape;
  memset(&shape, 0, sizeof shape);
  shape.kind = KS_SHAPE_MESH;
  memcpy(&shape.number, &mesh.value, sizeof shape.number);
  return shape;
}

// -----------------------------------------------------------------------------------------------------------
// Worlds (kinesphere/world.hpp)

/// A world. A handle of zero never names one.
typedef struct ks_world {
  uint64_t value;
} ks_world;

/// Which contact events bodies ask for (kinesphere/contact_events.hpp).
typedef int32_t ks_contacts;
enum {
  KS_CONTACTS_OF_WORLD = 0,  ///< of a body: what its world says
  /// A begin whenever two touch and approach, or are put into each other, and no ends.
  KS_CONTACTS_IMPACTS = 1,
  KS_CONTACTS_BEGIN_AND_END = 2,  ///< One begin and one end for each contact.
  KS_CONTACTS_ALL = 3             ///< Begins, ends, and each further approach in between.
};

/// Sum of KS_AXIS_...
typedef uint32_t ks_axes;
enum { KS_AXIS_X = 1, KS_AXIS_Y = 2, KS_AXIS_Z = 4 };

/// Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other,
/// unless both are in one group, which decides by its sign (kinesphere/filter.hpp). A body without a filter
/// of its own, as a floor, has the category 1: a mask without that bit lets its body fall through the floor.
typedef struct ks_filter {
  uint64_t category;  ///< default 1
  uint64_t mask;      ///< default UINT64_MAX
  int32_t group;
} ks_filter;

/// Fields and ranges: kinesphere/world_definition.hpp.
typedef struct ks_world_definition {
  uint32_t struct_size;
  int32_t dimensions;  ///< 2 or 3, default 3. With 2, bodies are discs in the plane z = 0.
  /// The world has walls, or repeats, at the sides of `box`. Otherwise it is unbounded, and `box` is all 0.
  ks_bool has_box;
  ks_axes periodic;          ///< sum of KS_AXIS_...: these axes repeat, and have no walls
  ks_box box;                ///< The sides are walls, or repeat. Without a box the world is unbounded.
  double contact_tolerance;  ///< > 0 (length), default 1e-6: the largest gap of a contact
  /// > contact_tolerance (length), default NaN, which is four tolerances: the gap at which a contact ends
  double separation_distance;
  /// >= 0 (time): contacts of a body that follow each other sooner are `repeated`.
  double zeno_interval;
  double start_time;      ///< The time at which the world begins.
  ks_contacts contacts;   ///< default 3, KS_CONTACTS_ALL: what bodies ask for that do not say it themselves
  ks_bool allow_overlap;  ///< default 1. If 0, bodies that certainly overlap are refused.
  ks_bool spread_window_starts;  ///< Has no effect.
  ks_bool has_wall_filter;
  ks_filter wall_filter;  ///< The filter of all walls; without one they meet every body.
  /// default 1: a report that breaks the promise of its body raises the body's acceleration limit to what
  /// explains the report.
  ks_bool adopt_observed_limits;
  int32_t reserved;  ///< 0
  /// (1 / time): the images of bodies across y slide along x, so that a flow goes on through the borders. x
  /// and y repeat then, and all bodies are balls.
  double shear_rate;
} ks_world_definition;
KS_API ks_status ks_world_definition_init(ks_world_definition* definition, uint32_t struct_size);
static inline ks_world_definition ks_default_world_definition(void) {
  ks_world_definition definition;
  ks_world_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// Fields and ranges: kinesphere/body.hpp.
typedef struct ks_body_definition {
  uint32_t struct_size;
  ks_bool solid;         ///< default 1. If 0, the body only senses and is sensed.
  ks_contacts contacts;  ///< Which contact events it asks for; 0: those of the world.
  int32_t sensor_class;  ///< from 0 to 255; 255 is that of zones
  double radius;         ///< >= 0 (length), default 1
  /// >= 0 (length / time^2): the largest deviation from the planned acceleration
  double acceleration_limit;
  double position_error;  ///< >= 0 (length): every reported position is within this of the true one.
  /// >= 0 (length / time): every reported velocity is within this of the true one.
  double velocity_error;
  /// >= 0, or infinity, default 1: every event of the body has it, and bounces use it.
  double mass;
  ks_vec3 planned_acceleration;  ///< Known acceleration, such as gravity (length / time^2).
  ks_vec3 position;
  ks_vec3 velocity;
  ks_filter filter;    ///< Selects the bodies that it may touch.
  uint64_t user_data;  ///< Stored for the caller.
} ks_body_definition;
KS_API ks_status ks_body_definition_init(ks_body_definition* definition, uint32_t struct_size);
static inline ks_body_definition ks_default_body_definition(void) {
  ks_body_definition definition;
  ks_body_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// A body that never moves (kinesphere/shape.hpp).
typedef struct ks_static_definition {
  uint32_t struct_size;
  ks_bool solid;         ///< default 1. If 0, the body only senses and is sensed.
  int32_t sensor_class;  ///< from 0 to 255
  ks_shape shape;        ///< default: a ball of radius 1 at the origin
  ks_filter filter;      ///< Selects the bodies that it may touch.
  uint64_t user_data;    ///< Stored for the caller.
} ks_static_definition;
KS_API ks_status ks_static_definition_init(ks_static_definition* definition, uint32_t struct_size);
static inline ks_static_definition ks_default_static_definition(void) {
  ks_static_definition definition;
  ks_static_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// A rotation as a unit quaternion w + x i + y j + z k.
typedef struct ks_quaternion {
  double w, x, y, z;
} ks_quaternion;

/// Orientation and angular velocity of a rigid body at one instant.
typedef struct ks_rotation {
  ks_quaternion orientation;  ///< turns a vector of the body into one of the world
  ks_vec3 angular_velocity;   ///< in the world's axes (radians / time)
} ks_rotation;

/// A part of a rigid body: all points within `radius` of the segment from a to b, relative to the body's
/// position. A capsule, or a ball if a and b are equal.
typedef struct ks_rigid_part {
  ks_vec3 a;
  ks_vec3 b;
  double radius;  ///< >= 0 (length)
} ks_rigid_part;

/// A part of a rigid body: all points within `radius` of the convex hull of 1 to 64 points, relative to the
/// body's position.
typedef struct ks_rigid_hull {
  size_t point_count;
  const ks_vec3* points;
  double radius;  ///< >= 0 (length)
} ks_rigid_hull;

/// What a rigid body has beside its ks_body_definition. Fields and ranges: kinesphere/rigid_body.hpp.
typedef struct ks_rigid_definition {
  uint32_t struct_size;
  size_t part_count;  ///< with hull_count >= 1
  const ks_rigid_part* parts;
  ks_rotation rotation;  ///< At the world's current time; default: no rotation.
  /// >= 0 (radians / time^2). At 0 the body keeps its angular velocity, and the world knows its rotation.
  double angular_acceleration_limit;
  /// >= 0 (radians / time), default INFINITY; finite if the limit above is not 0
  double largest_angular_speed;
  ks_vec3 inertia;  ///< Moments about the axes of the body, its principal ones (mass length^2).
  size_t hull_count;
  const ks_rigid_hull* hulls;  ///< Parts whose numbers follow those of `parts`.
} ks_rigid_definition;
KS_API ks_status ks_rigid_definition_init(ks_rigid_definition* definition, uint32_t struct_size);
static inline ks_rigid_definition ks_default_rigid_definition(void) {
  ks_rigid_definition definition;
  ks_rigid_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// Gives the rotations of rigid bodies at a time: rotations[k] is that of bodies[k]. It is called directly
/// after the probe. Rules and numbers: as for ks_probe.
typedef int32_t (*ks_rotation_probe)(const ks_body_id* bodies, size_t count, double time,
                                     ks_rotation* rotations, void* user);

/// Limits within which a body moves; fields as in ks_body_definition.
typedef struct ks_motion_limits {
  double acceleration_limit;
  double position_error;
  double velocity_error;
  ks_vec3 planned_acceleration;
} ks_motion_limits;

/// Decides whether two bodies whose filters let them touch may do so: 0 means no. It must be symmetric, and
/// its answers must stay the same until ks_world_refresh_filter(). An exception of C++ that leaves it ends
/// the program. It may make the calls that only read.
typedef int32_t (*ks_pair_filter)(ks_body_id first, ks_body_id second, void* user);

/// Creates a world without bodies. Destroy it with ks_world_destroy().
KS_API KS_MUST_CHECK ks_status ks_world_create(const ks_world_definition* definition, ks_world* world);
/// Destroys a world; its handle is stale from now on. KS_ERROR_IN_USE inside its own callbacks.
KS_API ks_status ks_world_destroy(ks_world world);
/// Creates a copy that continues as the original does, with its motions and ids: for rollback.
KS_API ks_status ks_world_clone(ks_world world, ks_world* copy);
/// Writes a snapshot of the world, without its motions and pair filter. Cost: O(n), also where it does not
/// fit.
KS_API ks_status ks_world_save(ks_world world, void* bytes, size_t capacity, size_t* count);
/// Creates the world of a snapshot, which continues as the saved one did. It has no motions: a probe moves
/// its bodies. `filter` is the pair filter that the world had, or NULL if it had none. Errors:
/// KS_ERROR_BAD_SNAPSHOT for any bytes that ks_world_save() did not write, and where the filter is missing.
KS_API KS_MUST_CHECK ks_status ks_world_restore(const void* bytes, size_t count, ks_pair_filter filter,
                                                void* user, ks_world* world);

/// Adds bodies or, on an error, none, and writes their ids. Errors: those of World::add(), naming the body.
KS_API KS_MUST_CHECK ks_status ks_world_add(ks_world world, const ks_body_definition* bodies, size_t count,
                                            ks_body_id* ids);
KS_API ks_status ks_world_add_static(ks_world world, const ks_static_definition* bodies, size_t count,
                                     ks_body_id* ids);
/// Adds a body that carries a box, a triangle or a mesh (kinesphere/shape.hpp), relative to its position; the
/// radius is ignored. The probe of the world moves it. It meets all bodies, static ones and other moving
/// shapes too, but no walls of the world. Errors: those of World::add_moving_shape().
KS_API ks_status ks_world_add_moving_shape(ks_world world, const ks_body_definition* body,
                                           const ks_shape* shape, ks_body_id* id);
/// Adds a rigid body: balls, capsules and hulls that move and turn together; the radius is ignored. The probe
/// of the world moves it. Errors: those of World::add_rigid_body().
KS_API ks_status ks_world_add_rigid_body(ks_world world, const ks_body_definition* body,
                                         const ks_rigid_definition* rigid, ks_body_id* id);
/// Adds a zone, which reports who enters and leaves it, by KS_EVENT_SENSOR_ENTER and KS_EVENT_SENSOR_LEAVE.
KS_API ks_status ks_world_add_zone(ks_world world, const ks_shape* shape, uint64_t user_data, ks_body_id* id);
/// Reserves memory for this number of bodies in total.
KS_API ks_status ks_world_reserve(ks_world world, size_t bodies);
/// Removes bodies or, on an error, none. A body listed twice is KS_ERROR_STALE_BODY.
KS_API ks_status ks_world_remove(ks_world world, const ks_body_id* bodies, size_t count);

/// Informs the world, and the motion of the body if it has one, of a new velocity from the current time on.
KS_API ks_status ks_world_set_velocity(ks_world world, ks_body_id body, ks_vec3 velocity);
/// The same for many bodies or, on an error of the world, for none.
KS_API ks_status ks_world_set_velocities(ks_world world, const ks_body_id* bodies, const ks_vec3* velocities,
                                         size_t count);
/// Informs the world that a rigid body turns with this angular velocity (radians / time) from the current
/// time on. Errors: KS_ERROR_UNSUPPORTED if it is not rigid; KS_ERROR_OUT_OF_RANGE for more than its largest
/// speed.
KS_API ks_status ks_world_set_angular_velocity(ks_world world, ks_body_id body, ks_vec3 angular_velocity);
/// Turns a rigid body at once, as ks_world_teleport() moves it. Errors: as the call above.
KS_API ks_status ks_world_set_rotation(ks_world world, ks_body_id body, const ks_rotation* rotation);
/// Sets the function that gives rotations; NULL removes it. Without one, only rigid bodies that keep their
/// angular velocity can be probed. Clones call it, too, snapshots do not contain it, and `user` must outlive
/// the world and its clones. Recordings contain its answers.
KS_API ks_status ks_world_set_rotation_probe(ks_world world, ks_rotation_probe probe, void* user);
/// Puts a body elsewhere, in its motion, too.
KS_API ks_status ks_world_teleport(ks_world world, ks_body_id body, const ks_state* state);
KS_API ks_status ks_world_set_radius(ks_world world, ks_body_id body, double radius);
/// Lets the radius of a ball change at this rate (length / time) from the current time on; negative for one
/// that shrinks, which stays a point once it is one.
KS_API ks_status ks_world_set_radius_rate(ks_world world, ks_body_id body, double rate);
KS_API ks_status ks_world_set_mass(ks_world world, ks_body_id body, double mass);
KS_API ks_status ks_world_set_motion_limits(ks_world world, ks_body_id body, const ks_motion_limits* limits);
KS_API ks_status ks_world_set_shape(ks_world world, ks_body_id body, const ks_shape* shape);
KS_API ks_status ks_world_disable(ks_world world, ks_body_id body);
KS_API ks_status ks_world_enable(ks_world world, ks_body_id body, const ks_state* state);
KS_API ks_status ks_world_sleep(ks_world world, ks_body_id body);
KS_API ks_status ks_world_wake(ks_world world, ks_body_id body);
KS_API ks_status ks_world_set_user_data(ks_world world, ks_body_id body, uint64_t data);

// Filters, zones and sensors.
/// Selects the bodies that a body may touch from now on.
KS_API ks_status ks_world_set_filter(ks_world world, ks_body_id body, const ks_filter* filter);
/// A NULL filter lets all pairs touch. `user` must outlive the world and its clones.
KS_API ks_status ks_world_set_pair_filter(ks_world world, ks_pair_filter filter, void* user);
KS_API ks_status ks_world_refresh_filter(ks_world world, ks_body_id body);
KS_API ks_status ks_world_set_solid(ks_world world, ks_body_id body, ks_bool solid);
/// Sets the distances (length, >= 0) at which bodies of a class sense bodies with a category in the mask.
KS_API ks_status ks_world_set_sensor(ks_world world, int32_t sensor_class, const double* distances,
                                     size_t count, uint64_t mask);
KS_API ks_status ks_world_set_sensor_class(ks_world world, ks_body_id body, int32_t sensor_class);

// What a world knows.

/// What the world knows of a body (BodyView in kinesphere/world.hpp).
typedef struct ks_body_view {
  uint32_t struct_size;
  ks_bool enabled;
  ks_bool is_static;
  ks_bool sleeping;
  double report_time;
  ks_box box;  ///< Contains the body from now until box_end.
  double box_end;
  int64_t image[3];               ///< Boxes that it has travelled along periodic axes.
  ks_body_definition definition;  ///< Its state is that of the last report.
} ks_body_view;
static inline ks_body_view ks_new_body_view(void) {
  ks_body_view view;
  memset(&view, 0, sizeof view);
  view.struct_size = (uint32_t)sizeof view;
  return view;
}

/// A body within a sensor distance (length) of another one.
typedef struct ks_sensor_overlap {
  ks_body_id body;
  double distance;
} ks_sensor_overlap;

KS_API ks_status ks_world_time(ks_world world, double* time);
KS_API ks_status ks_world_size(ks_world world, size_t* bodies);
/// *contains is 1 if the world issued the id and the body has not been removed, else 0.
KS_API ks_status ks_world_contains(ks_world world, ks_body_id body, ks_bool* contains);
KS_API ks_status ks_world_body(ks_world world, ks_body_id body, ks_body_view* view);
/// The rotation of a rigid body at its last report. Errors: KS_ERROR_UNSUPPORTED for any other body.
KS_API ks_status ks_world_rotation(ks_world world, ks_body_id body, ks_rotation* rotation);
KS_API ks_status ks_world_bodies(ks_world world, ks_body_id* bodies, size_t capacity, size_t* count);
/// The bodies in contact with a body.
KS_API ks_status ks_world_touching(ks_world world, ks_body_id body, ks_body_id* partners, size_t capacity,
                                   size_t* count);
KS_API ks_status ks_world_sensor_overlaps(ks_world world, ks_body_id body, ks_sensor_overlap* overlaps,
                                          size_t capacity, size_t* count);
/// The number of states that the world has asked for so far.
KS_API ks_status ks_world_probe_count(ks_world world, uint64_t* probes);

// Profiling (kinesphere/inspection.hpp): where the time goes, and which bodies are asked most.

/// Wall-clock time spent (seconds) since profiling was switched on.
typedef struct ks_timings {
  uint64_t advances;  ///< Calls that advance the world.
  double advance;     ///< In these calls, including probes.
  double probes;      ///< In the caller's probes.
} ks_timings;

/// Main reason for the probes of a body (kinesphere/inspection.hpp).
typedef int32_t ks_probe_reason;
enum {
  KS_PROBE_REASON_TOUCHING = 0,
  KS_PROBE_REASON_NARROW_MISSES = 1,
  KS_PROBE_REASON_LOOSE_LIMIT = 2,
  KS_PROBE_REASON_CONTACTS = 3,
  KS_PROBE_REASON_TRAVEL = 4,
  KS_PROBE_REASON_CHANGES = 5,
  KS_PROBE_REASON_QUERIES = 6
};

/// A body that was probed while profiling was on; `probes` is the sum of the next five fields.
typedef struct ks_busy_body {
  ks_body_id body;
  ks_probe_reason reason;
  uint64_t probes;              ///< Its probed states; the sum of the next five.
  uint64_t touching;            ///< for a body or wall that it touches
  uint64_t near_others;         ///< for a body, wall or sensor distance that it may reach or leave
  uint64_t windows;             ///< as it left its safe regions
  uint64_t changes;             ///< after changes by the caller and violated bounds
  uint64_t queries;             ///< for queries and predictions with a probe
  uint64_t contacts;            ///< Its begins of contacts with bodies and walls.
  double acceleration_limit;    ///< Its limit now (length / time^2).
  double largest_acceleration;  ///< Largest deviation from the plan that reports prove (length / time^2).
} ks_busy_body;

/// Switches profiling on, from zero, or off.
KS_API ks_status ks_world_set_profiling(ks_world world, ks_bool on);
KS_API ks_status ks_world_timings(ks_world world, ks_timings* timings);
/// The bodies that were probed most often, at most `most`, the most probed first. Errors:
/// KS_ERROR_NOT_PROFILING if profiling was never on.
KS_API ks_status ks_world_busiest(ks_world world, size_t most, ks_busy_body* bodies, size_t capacity,
                                  size_t* count);
/// Return the name of a reason, such as "narrow_misses", and two sentences on what it means and what makes
/// such a body cheaper; "" for numbers that are no reason.
KS_API const char* ks_probe_reason_name(ks_probe_reason reason);
KS_API const char* ks_probe_reason_advice(ks_probe_reason reason);

// -----------------------------------------------------------------------------------------------------------
// Events (kinesphere/event.hpp)

/// Kinds of events, in the order of their delivery within one instant. One of KS_EVENT_...
typedef int32_t ks_event_kind;
enum {
  KS_EVENT_NONE = 0,  ///< nothing more happens until the time that was asked for
  /// A reported state contradicts the motion limits of its body.
  KS_EVENT_BOUND_VIOLATION = 1,
  /// Two bodies touch: their gap has come down to at most the contact tolerance.
  KS_EVENT_CONTACT_BEGIN = 2,
  /// Two bodies that touched are apart: their gap has grown to the separation distance.
  KS_EVENT_CONTACT_END = 3,
  /// A body touches a wall of the box.
  KS_EVENT_WALL_BEGIN = 4,
  /// A body that touched a wall is clear of it.
  KS_EVENT_WALL_END = 5,
  /// Time would have stopped at a contact deep within its tolerance; it goes on by its least step. The two
  /// may come to overlap by more than the tolerance. If it comes often, a response does not part its bodies,
  /// or a body reaches through a wall.
  KS_EVENT_ZENO_GUARD = 6,
  /// The gap of two bodies has come down to a sensor distance.
  KS_EVENT_SENSOR_ENTER = 7,
  /// The gap of two bodies that were within a sensor distance has grown beyond it.
  KS_EVENT_SENSOR_LEAVE = 8,
  /// A body that slept is awake again.
  KS_EVENT_WOKE = 9,
  /// A timer of the caller's own, after all other events of its time. It names no body, and its
  /// first_user_data is that of the timer.
  KS_EVENT_TIMER = 10
};

/// The walls of the box of a world. One of KS_WALL_...
typedef int32_t ks_wall;
enum {
  KS_WALL_NONE = 0,
  KS_WALL_X_LOWER = 1,
  KS_WALL_X_UPPER = 2,
  KS_WALL_Y_LOWER = 3,
  KS_WALL_Y_UPPER = 4,
  KS_WALL_Z_LOWER = 5,
  KS_WALL_Z_UPPER = 6
};

/// Properties of one body of an event. Sum of KS_TRAIT_...
typedef uint32_t ks_traits;
enum {
  KS_TRAIT_STATIC = 1,   ///< The body never moves.
  KS_TRAIT_ZONE = 2,     ///< The body is not solid: it touches no other body.
  KS_TRAIT_SLEEPING = 4  ///< The body sleeps and stays asleep: contacts wake their bodies.
};
/// Which bodies of an event sense the other one. Sum of KS_SENSES_...
typedef uint32_t ks_senses;
enum {
  KS_SENSES_FIRST = 1,  ///< The first body senses the second one.
  KS_SENSES_SECOND = 2  ///< The second body senses the first one.
};

/// Fields: struct Event in kinesphere/event.hpp.
typedef struct ks_event {
  uint32_t struct_size;
  ks_event_kind kind;
  double time;
  /// The body of the event or, for a pair, the body with the smaller id. A timer has none.
  ks_body_id first;
  /// The other body of a pair; no body for walls, bound violations, timers and bodies that woke.
  ks_body_id second;
  ks_wall wall;  ///< The wall of a wall event.
  /// One of the two touched another body less than the Zeno interval ago: a response should take no energy
  /// here.
  ks_bool repeated;
  /// Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop
  /// both.
  ks_bool jammed;
  /// Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the
  /// others.
  ks_bool already_touching;
  ks_senses senses;         ///< Of sensors: the body or bodies that sense the other one.
  ks_traits first_traits;   ///< sum of KS_TRAIT_...
  ks_traits second_traits;  ///< None for a wall.
  int32_t pair_state;       ///< The state that the two of a pair were given; 0 for all others.
  /// At `time`; of a static body one point of its shape. In periodic space the two are nearest images.
  ks_state first_state;
  ks_state second_state;
  ks_vec3 point;          ///< The middle of the gap between the two surfaces.
  ks_vec3 normal;         ///< Unit vector from `first` towards `second`, or towards the wall.
  double gap;             ///< Distance between the surfaces (length); negative when they overlap.
  double approach_speed;  ///< Speed at which the gap closes (length / time); negative when it opens.
  /// Of a bound violation: how far the reported position lies outside the bound (length).
  double position_excess;
  /// Of a bound violation: by how much the velocity changed more than promised (length / time).
  double velocity_excess;
  double distance;           ///< Of a sensor: the sensor distance that was crossed (length).
  uint64_t first_user_data;  ///< What the definition of the body gave.
  uint64_t second_user_data;
  double first_mass;   ///< Of the body; infinite for a static body.
  double second_mass;  ///< Of the body; infinite for a static body and for a wall.
  /// Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all
  /// others.
  uint32_t first_part;
  uint32_t second_part;
  ks_vec3 first_angular_velocity;  ///< Of a rigid body (radians / time); zero for all others.
  ks_vec3 second_angular_velocity;
  /// Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass
  /// length)).
  ks_vec3 first_spin_gain;
  ks_vec3 second_spin_gain;
  /// Of a bound violation: the acceleration limit that the body has from now on (length / time^2).
  double acceleration_limit;
} ks_event;
static inline ks_event ks_new_event(void) {
  ks_event event;
  memset(&event, 0, sizeof event);
  event.struct_size = (uint32_t)sizeof event;
  return event;
}

/// Returns a name such as "contact_begin"; "none" for KS_EVENT_NONE and "" for numbers that are no kind.
KS_API const char* ks_event_kind_name(ks_event_kind kind);

/// What a response does to a body, after the body has got its velocity. One of KS_ACTION_...
typedef int32_t ks_body_action;
enum {
  KS_ACTION_NONE = 0,
  KS_ACTION_REMOVE = 1,   ///< ks_world_remove()
  KS_ACTION_DISABLE = 2,  ///< ks_world_disable()
  KS_ACTION_SLEEP = 3     ///< With velocity 0 (ks_world_sleep).
};

/// What an event does to its bodies, from a response function or ks_bounce() (Response in
/// kinesphere/run.hpp). A body that is not turned continues as before. A response has no effect on a body
/// that an earlier one at the same time has removed, and none but KS_ACTION_REMOVE on one that it has
/// disabled.
typedef struct ks_response {
  uint32_t struct_size;
  ks_bool stop;  ///< the sink may change the world when it receives this event (ks_sink)
  ks_bool turns_first;
  ks_bool turns_second;
  ks_bool spins_first;  ///< the first body is rigid and gets this angular velocity (radians / time)
  ks_bool spins_second;
  ks_body_action first_action;
  ks_body_action second_action;
  ks_vec3 first_velocity;
  ks_vec3 second_velocity;
  ks_vec3 first_angular_velocity;
  ks_vec3 second_angular_velocity;
  /// Of sensors: the two have been turned back at the sensor distance (ks_world_turn_back).
  ks_bool turned_back;
  ks_bool sets_pair_state;  ///< the two get this state (ks_world_set_pair_state)
  int32_t pair_state;
  int32_t reserved;  ///< 0
} ks_response;
static inline ks_response ks_new_response(void) {
  ks_response response;
  memset(&response, 0, sizeof response);
  response.struct_size = (uint32_t)sizeof response;
  return response;
}

/// The velocities after a frictionless bounce with the masses of the bodies (kinesphere/response.hpp).
/// Restitution is in [0, 1]. With a resting_speed > 0 (length / time) bodies can settle in a heap; 0 is a
/// plain bounce. Walls, static and sleeping bodies are not turned, and events other than begins of contacts
/// turn nobody. Rigid bodies with inertia get angular velocities, too. Overwrites the whole response: choose
/// actions and `stop` afterwards.
KS_API ks_status ks_bounce(const ks_event* event, double restitution, double resting_speed,
                           ks_response* response);

/// How rough spheres or discs bounce: Walton's model (Roughness in kinesphere/response.hpp).
typedef struct ks_roughness {
  uint32_t struct_size;
  int32_t reserved;    ///< 0
  double restitution;  ///< in [0, 1], default 1: along the normal
  /// in [-1, 1], default 1: what is left of the tangential velocity of the surfaces in a contact that sticks,
  /// turned back; -1 is smooth
  double tangential_restitution;
  double friction;  ///< >= 0, default INFINITY: coefficient beyond which a contact slides
  double inertia;   ///< > 0, default 0.4: moment of inertia in units of mass and squared radius
} ks_roughness;
KS_API ks_status ks_roughness_init(ks_roughness* roughness, uint32_t struct_size);
static inline ks_roughness ks_default_roughness(void) {
  ks_roughness roughness;
  ks_roughness_init(&roughness, (uint32_t)sizeof roughness);
  return roughness;
}
/// As ks_bounce(), for balls that turn: rigid bodies of one part, a ball around the position.
KS_API ks_status ks_bounce_rough(const ks_event* event, const ks_roughness* roughness, ks_response* response);

/// A potential of steps between pairs of bodies, as a response to events (kinesphere/step_potential.hpp):
/// square wells, Lennard-Jones potentials in steps, bonds. A handle of zero never names one.
typedef struct ks_step_potential {
  uint64_t value;
} ks_step_potential;

/// The energy of a pair, as a function of its gap. Fields and ranges: kinesphere/step_potential.hpp.
typedef struct ks_step_potential_definition {
  uint32_t struct_size;
  int32_t reserved;         ///< 0
  size_t count;             ///< number of distances
  const double* distances;  ///< `count` gaps between two surfaces, ascending (length)
  const double* energies;   ///< `count` energies of pairs that are nearer, but not than the distance before
  double outside;           ///< energy beyond the last distance; infinity for a bond
  double restitution;       ///< of contacts, in [0, 1], default 1
} ks_step_potential_definition;
KS_API ks_status ks_step_potential_definition_init(ks_step_potential_definition* definition,
                                                   uint32_t struct_size);
static inline ks_step_potential_definition ks_default_step_potential_definition(void) {
  ks_step_potential_definition definition;
  ks_step_potential_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}
/// Creates a potential for worlds with the definition of this one, whose bodies need a sensor with its
/// distances (ks_world_set_sensor); the arrays are copied. Errors: those of StepPotential::create().
KS_API KS_MUST_CHECK ks_status ks_step_potential_create(ks_world world,
                                                        const ks_step_potential_definition* definition,
                                                        ks_step_potential* potential);
KS_API ks_status ks_step_potential_destroy(ks_step_potential potential);
/// Writes the response to an event, for a ks_respond or a loop: at a step of the potential the two gain or
/// lose what their energy changes by, or are turned back; at a contact they bounce. Overwrites the whole
/// response.
KS_API ks_status ks_step_potential_respond(ks_step_potential potential, const ks_event* event,
                                           ks_response* response);
/// The potential energy of a pair with this gap (length).
KS_API ks_status ks_step_potential_energy(ks_step_potential potential, double gap, double* energy);

/// Hash of a set of events (kinesphere/event_hash.hpp); all zeros at first. Equal values mean bit-identical
/// runs.
typedef struct ks_event_hash {
  uint64_t sum;
  uint64_t count;
} ks_event_hash;
/// Adds an event.
KS_API ks_status ks_event_hash_add(ks_event_hash* hash, const ks_event* event);
/// Equal sets of events have equal values.
KS_API ks_status ks_event_hash_value(const ks_event_hash* hash, uint64_t* value);

// States of pairs, and timers.
/// Gives two bodies a state, a number of the caller's own that their events have, until it is set to 0 or one
/// of the two is removed.
KS_API ks_status ks_world_set_pair_state(ks_world world, ks_body_id first, ks_body_id second, int32_t state);
/// Returns the state of two bodies; 0 if it was never set.
KS_API ks_status ks_world_pair_state(ks_world world, ks_body_id first, ks_body_id second, int32_t* state);
/// To be called at a KS_EVENT_SENSOR_ENTER or KS_EVENT_SENSOR_LEAVE: velocities of the caller have turned the
/// two back there, so they have not crossed the distance. The event comes again if they do.
KS_API ks_status ks_world_turn_back(ks_world world, const ks_event* crossing);
/// Schedules a KS_EVENT_TIMER at a time that has not passed, and, if the period (time, >= 0) is not 0, again
/// after each period.
KS_API ks_status ks_world_schedule(ks_world world, double time, uint64_t user_data, double period);
/// Removes all timers with these data. `count` may be NULL: how many there were.
KS_API ks_status ks_world_unschedule(ks_world world, uint64_t user_data, size_t* count);

// -----------------------------------------------------------------------------------------------------------
// Time

/// Gives the states of bodies at a time: states[k] is that of bodies[k]. A number other than 0 stops the call
/// that probes, which fails with KS_ERROR_CALLBACK_FAILED and may be repeated. It must not change the world
/// that calls it.
typedef int32_t (*ks_probe)(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                            void* user);

/// The probe of worlds whose bodies are all moved by motions of the world (ks_world_add_motion). `user` is
/// ignored.
KS_API int32_t ks_probe_motions(const ks_body_id* bodies, size_t count, double time, ks_state* states,
                                void* user);

/// Advances to the next event, at most to time `until`. Writes the event, with the world at its time; or one
/// with kind KS_EVENT_NONE, with the world at `until`. The probe gives the states of the bodies that no
/// motion moves. Errors: as World::advance(); KS_ERROR_CALLBACK_FAILED; KS_ERROR_UNKNOWN_BODY if the probe is
/// ks_probe_motions and a body has no motion. After a failure of the probe the world is at the time of the
/// probe, and the call may be repeated: no event is lost.
KS_API KS_MUST_CHECK ks_status ks_world_advance(ks_world world, double until, ks_probe probe, void* user,
                                                ks_event* event);

/// Chooses what an event does to its bodies; `response` is ks_new_response() at first. It is called at every
/// event, at ends too: look at ks_event::kind first, as velocities that are exchanged at each
/// KS_EVENT_CONTACT_END turn the two back to each other, for ever. It must give the same
/// answer for the same event at any time, and must not call the world. A number other than 0 stops the run.
typedef int32_t (*ks_respond)(const ks_event* event, ks_response* response, void* user);
/// Receives each event once, in order, in the thread that called ks_world_run(). It may read the world. At an
/// event whose response has `stop` the world is at the time of the event, and the sink may change it: add and
/// remove bodies, teleport them. Elsewhere such calls fail with KS_ERROR_RUN_IN_PROGRESS, as
/// ks_world_advance() and ks_world_run() always do. A number other than 0 stops the run.
typedef int32_t (*ks_sink)(const ks_event* event, void* user);

/// How ks_world_run() answers events.
typedef struct ks_run_definition {
  uint32_t struct_size;
  int32_t threads;     ///< from 1 to 256, default 1, with the calling one; the outcome is the same
  double restitution;  ///< in [0, 1], default 1: bodies bounce as by ks_bounce(); NaN: they pass through each
                       ///< other
  double resting_speed;  ///< as for ks_bounce()
  ks_respond respond;    ///< if not NULL, it answers events instead
  void* respond_user;
  ks_sink sink;  ///< may be NULL
  void* sink_user;
} ks_run_definition;
KS_API ks_status ks_run_definition_init(ks_run_definition* definition, uint32_t struct_size);
static inline ks_run_definition ks_default_run_definition(void) {
  ks_run_definition definition;
  ks_run_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// Advances to time `until`, and answers all events. Motions of the world must move all its bodies. A body
/// that a response removes leaves its motion, too, before the sink receives the event. After an error the
/// world is at a stop and can continue; no event is lost. Errors: as World::run(), where the argument of a
/// wrong response is its field; KS_ERROR_CALLBACK_FAILED.
KS_API KS_MUST_CHECK ks_status ks_world_run(ks_world world, double until,
                                            const ks_run_definition* definition);
/// From now on, so many threads, from 1 to 256 with the calling one, share what a call of the world or the
/// game does for thousands of bodies at one time, as where all velocities change; 1, as at first: the calling
/// thread alone. They call no function of yours, and the outcome is the same, bit for bit. Clones and
/// restored worlds begin with 1. Errors: KS_ERROR_OUT_OF_RANGE, KS_ERROR_NO_THREADS, as World::use_workers().
KS_API KS_MUST_CHECK ks_status ks_world_use_threads(ks_world world, int32_t threads);

// Games: worlds that move their own bodies (kinesphere/game_world.hpp). The calls of worlds do with a game
// what they do with others: a game is asked for no states, and takes no motions, runs and motion limits
// (KS_ERROR_UNSUPPORTED).

/// What a game has beside its world.
typedef struct ks_game_definition {
  uint32_t struct_size;
  int32_t reserved;    ///< 0
  ks_vec3 gravity;     ///< Acceleration of all bodies, beside planned_acceleration of each.
  double restitution;  ///< in [0, 1], default 1: bodies bounce as by ks_bounce(); NaN: they pass through each
                       ///< other
  double resting_speed;  ///< as for ks_bounce()
  /// If not NULL, it answers events instead, for the game and its clones; `stop` has no effect.
  ks_respond respond;
  void* respond_user;
} ks_game_definition;
KS_API ks_status ks_game_definition_init(ks_game_definition* definition, uint32_t struct_size);
static inline ks_game_definition ks_default_game_definition(void) {
  ks_game_definition definition;
  ks_game_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// Events of a step, in order.
typedef struct ks_event_list {
  size_t count;
  const ks_event* events;
} ks_event_list;

/// The bodies of a game that can move, disabled ones too, in dense arrays: the last body takes the place of a
/// removed one.
typedef struct ks_body_list {
  size_t count;
  const ks_body_id* ids;
  const ks_vec3* positions;
  const ks_vec3* velocities;
} ks_body_list;

/// Creates a game without bodies. Its handle is that of a world: ks_world_add(), ks_world_remove(),
/// ks_world_set_velocity() and the like change its bodies, ks_world_advance() with ks_probe_motions goes to
/// the next event, and ks_world_destroy() destroys it. Errors: as GameWorld::create().
KS_API KS_MUST_CHECK ks_status ks_game_create(const ks_world_definition* world,
                                              const ks_game_definition* definition, ks_world* game);
/// Creates the game of a snapshot that ks_world_save() made of a game; it continues bit for bit. Of the
/// definition the gravity does not count. `filter`: as for ks_world_restore(). Errors: KS_ERROR_BAD_SNAPSHOT.
KS_API KS_MUST_CHECK ks_status ks_game_restore(const void* bytes, size_t count,
                                               const ks_game_definition* definition, ks_pair_filter filter,
                                               void* user, ks_world* game);
/// Advances a game by dt > 0, answers all events by its response, and tells them. They are valid until the
/// next step or ks_world_destroy(). Errors: as GameWorld::step(); KS_ERROR_CALLBACK_FAILED. After one the
/// next step goes on from where the game stands, and tells the events of this step, too.
KS_API KS_MUST_CHECK ks_status ks_game_step(ks_world game, double dt, ks_event_list* happened);
/// Tells where the bodies of a game are now. On periodic axes positions lie in the box. The arrays are valid
/// until the next call that advances or changes the game. Cost: O(1) after a step.
KS_API ks_status ks_game_bodies(ks_world game, ks_body_list* found);
/// The place of a body in these arrays. Errors: as ks_world_body(); KS_ERROR_STATIC_BODY.
KS_API ks_status ks_game_index_of(ks_world game, ks_body_id body, size_t* index);
/// Replaces the response of a game by that of the definition, whose gravity does not count.
KS_API ks_status ks_game_set_response(ks_world game, const ks_game_definition* definition);
/// Sets the velocities of all bodies of a game, in the order of its arrays, or, on an error, of none. A body
/// that has its velocity already goes on undisturbed. Errors: as GameWorld::set_velocities().
KS_API ks_status ks_game_set_velocities(ks_world game, const ks_vec3* velocities, size_t count);
/// Sets the acceleration of a body of a game beside the gravity (length / time^2).
KS_API ks_status ks_game_set_acceleration(ks_world game, ks_body_id body, ks_vec3 acceleration);
/// Sets the gravity of a game; wakes all that sleep.
KS_API ks_status ks_game_set_gravity(ks_world game, ks_vec3 gravity);
KS_API ks_status ks_game_gravity(ks_world game, ks_vec3* gravity);

// Ready-made motions, owned by the world (kinesphere/motion/).

/// One of KS_MOTION_...
typedef int32_t ks_motion_kind;
enum {
  KS_MOTION_BALLISTIC = 0,  ///< free flight under `gravity`
  KS_MOTION_RANDOM_FORCES =
      1,  ///< random accelerations up to acceleration_limits, new at multiples of `interval`
  /// A game's frames: each body goes straight from its position in one frame to that in the next
  /// (frame_motion.hpp).
  KS_MOTION_FRAMES = 2,
  /// Each body keeps its acceleration, at first zero, until ks_world_steer() (steered_motion.hpp).
  KS_MOTION_STEERED = 3
};

/// Bodies that a ready-made motion moves.
typedef struct ks_motion_definition {
  uint32_t struct_size;
  ks_motion_kind kind;
  size_t count;            ///< number of bodies
  const ks_state* states;  ///< `count` states at the world's current time
  const double* radii;     ///< `count` radii, or NULL: the radius of `like`
  const double* masses;    ///< `count` masses, or NULL: the mass of `like`
  /// KS_MOTION_RANDOM_FORCES and KS_MOTION_STEERED: `count` limits. KS_MOTION_FRAMES: the same, or NULL for
  /// bodies without a limit.
  const double* acceleration_limits;
  ks_vec3 gravity;  ///< KS_MOTION_BALLISTIC; 0 for the others
  /// > 0 (time), default 1.0/60: of forces, or of frames without times of their own
  /// (FrameMotionDefinition::interval)
  double interval;
  double position_error;  ///< KS_MOTION_FRAMES: of the positions in frames
  uint64_t seed;          ///< default 1, for KS_MOTION_RANDOM_FORCES
  /// All that bodies have beside states and motion limits; NULL: ks_default_body_definition().
  const ks_body_definition* like;
} ks_motion_definition;
KS_API ks_status ks_motion_definition_init(ks_motion_definition* definition, uint32_t struct_size);
static inline ks_motion_definition ks_default_motion_definition(void) {
  ks_motion_definition definition;
  ks_motion_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// Adds bodies that the library moves, and writes the number of their motion in the world and their ids.
/// Their numbers in the motion are 0, 1, 2, ... `motion` may be NULL. Errors: those of the motion and of
/// World::add(), naming the body; after one of World::add() the number of the motion stays unused.
KS_API KS_MUST_CHECK ks_status ks_world_add_motion(ks_world world, const ks_motion_definition* definition,
                                                   uint32_t* motion, ks_body_id* ids);
/// Adds more bodies to a motion, such as bullets, or on an error none: those of the definition, whose kind,
/// gravity, interval, position_error and seed do not count. Writes their numbers in the motion, which are
/// their indices in frames; `numbers` may be NULL. They are the next ones, or those of removed bodies.
/// Errors: as ks_world_add_motion(); a body that the world refuses then leaves a number of a removed body in
/// frames.
KS_API KS_MUST_CHECK ks_status ks_world_add_to_motion(ks_world world, uint32_t motion,
                                                      const ks_motion_definition* definition,
                                                      uint32_t* numbers, ks_body_id* ids);
/// Sets the acceleration (length / time^2), within its limit, of a body of kind KS_MOTION_STEERED from the
/// current time on. Errors: as SteeredMotion::steer(); KS_ERROR_UNSUPPORTED for a body of another kind.
KS_API ks_status ks_world_steer(ks_world world, ks_body_id body, ks_vec3 acceleration);
/// Appends the next frame of a motion of kind KS_MOTION_FRAMES: the position of each of its bodies, NaN for a
/// removed one. It comes `interval` after the frame before; a game whose frames differ in length needs
/// ks_world_push_frame_at(). The world must be at the time of the latest frame. Errors: as
/// FrameMotion::push().
KS_API KS_MUST_CHECK ks_status ks_world_push_frame(ks_world world, uint32_t motion, const ks_vec3* positions,
                                                   size_t count);
/// Appends the next frame as ks_world_push_frame() does, at a time after that of the latest frame. Errors: as
/// FrameMotion::push().
KS_API KS_MUST_CHECK ks_status ks_world_push_frame_at(ks_world world, uint32_t motion,
                                                      const ks_vec3* positions, size_t count, double time);
/// Writes the positions in the latest frame, with the changes that events made; NaN for removed bodies.
KS_API ks_status ks_world_latest_frame(ks_world world, uint32_t motion, ks_vec3* positions, size_t capacity,
                                       size_t* count);
/// Writes the time of the latest frame: advance the world to it after each push.
KS_API ks_status ks_world_latest_frame_time(ks_world world, uint32_t motion, double* time);
/// Writes the true states at a time, not before their last changes, of bodies that motions of the world move.
KS_API ks_status ks_world_states(ks_world world, const ks_body_id* bodies, size_t count, double time,
                                 ks_state* states);

// -----------------------------------------------------------------------------------------------------------
// Certified answers at the current time (kinesphere/certificates.hpp, kinesphere/queries.hpp). A probe makes
// them as good as fresh reports allow; with NULL they follow from what the world knows.

/// When a contact or an approach may happen first. It certainly does not happen before `time`.
typedef struct ks_prediction {
  double time;         ///< In [current time, infinity].
  ks_body_id partner;  ///< No body for a wall, or if the time is infinite.
  ks_wall wall;
  ks_bool happens;  ///< The contact exists, or the partner certainly is within the distance.
  ks_bool probed;
} ks_prediction;

/// The earliest contact of the whole world; it names no partner.
KS_API ks_status ks_world_safe_until(ks_world world, ks_probe probe, void* user, ks_prediction* prediction);
KS_API ks_status ks_world_earliest_contact(ks_world world, ks_body_id body, ks_probe probe, void* user,
                                           ks_prediction* prediction);
/// The first time at which anything may be within `distance` (length, >= 0) of a body.
KS_API ks_status ks_world_earliest_approach(ks_world world, ks_body_id body, double distance, ks_probe probe,
                                            void* user, ks_prediction* prediction);
/// The first time at which two bodies may be within `distance` (length, >= 0) of each other.
KS_API ks_status ks_world_pair_safe_until(ks_world world, ks_body_id first, ks_body_id second,
                                          double distance, ks_probe probe, void* user,
                                          ks_prediction* prediction);
/// Limits of the distance between two bodies at a time from now on.
KS_API ks_status ks_world_distance_limits(ks_world world, ks_body_id first, ks_body_id second, double time,
                                          ks_probe probe, void* user, double* lower, double* upper);

/// A body that a query found. For the nearest bodies and for casts its distance is between `lower` and
/// `upper` (length); for overlaps both are 0.
typedef struct ks_hit {
  ks_body_id body;
  ks_bool certain;  ///< 0: possibly
  double lower;
  double upper;
} ks_hit;

/// The bodies that may overlap a sphere or a box, as World::overlapping() finds them.
KS_API ks_status ks_world_overlapping_sphere(ks_world world, ks_vec3 centre, double radius, ks_probe probe,
                                             void* user, ks_hit* hits, size_t capacity, size_t* count);
KS_API ks_status ks_world_overlapping_box(ks_world world, const ks_box* box, ks_probe probe, void* user,
                                          ks_hit* hits, size_t capacity, size_t* count);
/// All that may be among the `bodies` nearest to a point.
KS_API ks_status ks_world_nearest(ks_world world, ks_vec3 point, size_t bodies, ks_probe probe, void* user,
                                  ks_hit* hits, size_t capacity, size_t* count);
/// All that a ray of this length, or with a radius > 0 a moving sphere, may hit first.
KS_API ks_status ks_world_cast(ks_world world, ks_vec3 origin, ks_vec3 direction, double length,
                               double radius, ks_probe probe, void* user, ks_hit* hits, size_t capacity,
                               size_t* count);

/// A sphere in which to look for bodies (length).
typedef struct ks_sphere {
  ks_vec3 centre;
  double radius;
} ks_sphere;

/// A ray or, with a radius > 0, the way of a sphere (length). `direction` may have any length > 0.
typedef struct ks_ray {
  ks_vec3 origin;
  ks_vec3 direction;
  double length;
  double radius;
} ks_ray;

// Many queries at once, each answered as by the call for one, without its body in `except_ids` and bodies
// that a `filter` does not pass; either may be null. With a probe, one call of it serves all that are open.
// The hits of query k end before hits[ends[k]], those of the first begin at 0; `ends` has room for `queries`.

/// ks_world_overlapping_sphere(), for many spheres.
KS_API ks_status ks_world_overlapping_all(ks_world world, const ks_sphere* spheres,
                                          const ks_body_id* except_ids, size_t queries,
                                          const ks_filter* filter, ks_probe probe, void* user, size_t* ends,
                                          ks_hit* hits, size_t capacity, size_t* count);
/// ks_world_nearest(), for many points.
KS_API ks_status ks_world_nearest_all(ks_world world, const ks_vec3* points, const ks_body_id* except_ids,
                                      size_t queries, size_t bodies, const ks_filter* filter, ks_probe probe,
                                      void* user, size_t* ends, ks_hit* hits, size_t capacity, size_t* count);
/// ks_world_cast(), for many rays.
KS_API ks_status ks_world_cast_all(ks_world world, const ks_ray* rays, const ks_body_id* except_ids,
                                   size_t queries, const ks_filter* filter, ks_probe probe, void* user,
                                   size_t* ends, ks_hit* hits, size_t capacity, size_t* count);

// -----------------------------------------------------------------------------------------------------------
// Recordings (kinesphere/recording.hpp): all input and output of a world, for replay on any machine

/// Starts to record the world, in memory. Errors: KS_ERROR_RECORDING if it is already recorded.
KS_API ks_status ks_world_start_recording(ks_world world);
/// Stops recording. The world keeps the recording until the next one starts. Errors:
/// KS_ERROR_NOT_RECORDING.
KS_API ks_status ks_world_stop_recording(ks_world world);
/// Writes the last recording of the world. Errors: KS_ERROR_NOT_RECORDING if none has been stopped.
KS_API ks_status ks_world_recording(ks_world world, void* bytes, size_t capacity, size_t* count);

/// A recording that is being replayed. A handle of zero never names one.
typedef struct ks_replay {
  uint64_t value;
} ks_replay;

/// Opens a recording; the bytes are copied. Destroy the replay with ks_replay_destroy(). `filter` returns the
/// results of the pair filter that the world had, or is NULL. Errors: those of Replay::open().
KS_API KS_MUST_CHECK ks_status ks_replay_open(const void* bytes, size_t count, ks_pair_filter filter,
                                              void* user, ks_replay* replay);
KS_API ks_status ks_replay_destroy(ks_replay replay);
/// Repeats everything up to the end of the next recorded advance, or of the recording, and writes what that
/// advance returned: an event, or one of kind KS_EVENT_NONE. Errors: KS_ERROR_DIVERGED, which names the step
/// and what differs; every further call returns it again.
KS_API KS_MUST_CHECK ks_status ks_replay_advance(ks_replay replay, ks_event* event);
/// *finished is 1 if no step is left and the world has ended as the recorded one did, to the last bit.
KS_API ks_status ks_replay_finished(ks_replay replay, ks_bool* finished);
/// The numbers of steps repeated so far and in total.
KS_API ks_status ks_replay_steps(ks_replay replay, size_t* repeated, size_t* total);
/// The hash of all outcomes so far.
KS_API ks_status ks_replay_hash(ks_replay replay, uint64_t* hash);
/// Creates a copy of the world after the last repeated step, which can be read and can go on with a probe.
KS_API ks_status ks_replay_world(ks_replay replay, ks_world* copy);

// -----------------------------------------------------------------------------------------------------------
// Monitors: what is certain about tracks that report when they like (kinesphere/monitor/monitor.hpp)

/// A monitor. A handle of zero never names one.
typedef struct ks_monitor {
  uint64_t value;
} ks_monitor;

/// One of KS_BOUND_...
typedef int32_t ks_bound_kind;
enum { KS_BOUND_BALL = 0, KS_BOUND_CYLINDER = 1 };

/// Upper limit of an error: a ball of radius `horizontal`, or a limit in the plane and one along z.
typedef struct ks_error_bound {
  ks_bound_kind kind;
  double horizontal;
  double vertical;
} ks_error_bound;
static inline ks_error_bound ks_error_ball(double radius) {
  ks_error_bound bound;
  bound.kind = KS_BOUND_BALL;
  bound.horizontal = radius;
  bound.vertical = radius;
  return bound;
}
static inline ks_error_bound ks_error_cylinder(double horizontal, double vertical) {
  ks_error_bound bound;
  bound.kind = KS_BOUND_CYLINDER;
  bound.horizontal = horizontal;
  bound.vertical = vertical;
  return bound;
}

/// Limits of all tracks of a class; at least one of acceleration_limit and largest_speed is finite.
typedef struct ks_track_class {
  ks_error_bound acceleration_limit;
  ks_error_bound largest_speed;
  ks_vec3 planned_acceleration;
} ks_track_class;

/// One of KS_SEPARATION_...: kinesphere/monitor/separation.hpp explains each.
typedef int32_t ks_separation_shape;
enum { KS_SEPARATION_ELLIPSOID = 0, KS_SEPARATION_CYLINDER = 1, KS_SEPARATION_WELL_CLEAR = 2 };

/// Fields: kinesphere/monitor/separation.hpp.
typedef struct ks_separation {
  ks_separation_shape shape;
  double horizontal;    ///< > 0 (length)
  double vertical;      ///< > 0 (length)
  double look_ahead;    ///< >= 0 (time); 0: nothing is predicted
  double modified_tau;  ///< time, for KS_SEPARATION_WELL_CLEAR
} ks_separation;

/// The separation levels between two classes, the widest first.
typedef struct ks_separation_rule {
  size_t first_class;
  size_t second_class;
  const ks_separation* levels;
  size_t level_count;
} ks_separation_rule;

/// Fields: MonitorDefinition in kinesphere/monitor/monitor.hpp.
typedef struct ks_monitor_definition {
  uint32_t struct_size;
  int32_t dimensions;  ///< 2 or 3, default 3. In two dimensions, z is ignored.
  ks_bool has_start_time;
  double start_time;  ///< Without it the clock starts at the first report or the first time to advance to.
  /// Motion limits of the track classes; a report names its class by its place.
  const ks_track_class* classes;
  size_t class_count;
  const ks_separation_rule* separations;  ///< Pairs of classes that no rule names are not watched.
  size_t separation_count;
  /// > 0 (length), default 1e-3: how far outside the separation a pair still is `within`.
  double tolerance;
  double time_resolution;  ///< > 0 (time), default 1e-3: how late a verdict may be that time alone decides.
  double window;           ///< > 0 (time), default 1: about the time between two reports of a track.
  /// > 0 (time), default INFINITY: age of the latest report at which a track is stale.
  double stale_after;
  /// > 0 (time), default INFINITY: age of the latest report at which a track is dropped.
  double drop_after;
  double prediction_hold;          ///< >= 0 (time): a prediction ends once it has not held for this long.
  double prediction_confirmation;  ///< >= 0 (time): a prediction begins once it has held for this long.
  /// In [0, 1]: a prediction goes on within the separation enlarged by this part of it.
  double prediction_margin;
  /// In [0, 1]: separations are enlarged for predictions by this part of the position errors of both tracks.
  double prediction_error_part;
  /// default 1: the monitor watches shards shard_first, ..., shard_first + shard_count - 1 of all pairs, out
  /// of shard_of; a pair is in the shard that the lower of its ids modulo shard_of says.
  uint64_t shard_of;
  uint64_t shard_first;  ///< the first one that it watches
  uint64_t shard_count;  ///< default 1
} ks_monitor_definition;
KS_API ks_status ks_monitor_definition_init(ks_monitor_definition* definition, uint32_t struct_size);
static inline ks_monitor_definition ks_default_monitor_definition(void) {
  ks_monitor_definition definition;
  ks_monitor_definition_init(&definition, (uint32_t)sizeof definition);
  return definition;
}

/// A reported state of a track (kinesphere/monitor/report.hpp).
typedef struct ks_track_report {
  uint32_t struct_size;
  ks_bool has_plan;
  uint64_t track_class;    ///< Place of its class in those of the monitor.
  double timestamp;        ///< Time of the state on the monitor's clock.
  double timestamp_error;  ///< Largest difference of the timestamp from the true time.
  ks_state state;
  ks_error_bound position_error;  ///< Largest distance of the true position from the reported one (length).
  /// Largest difference of the true velocity from the reported one (length / time); infinite if none was
  /// reported.
  ks_error_bound velocity_error;
  ks_vec3 plan_acceleration;  ///< From the timestamp on, in place of what the class says.
  ks_error_bound plan_limit;  ///< Largest deviation from that acceleration.
  double plan_valid_until;    ///< default INFINITY
} ks_track_report;
KS_API ks_status ks_track_report_init(ks_track_report* report, uint32_t struct_size);
static inline ks_track_report ks_default_track_report(void) {
  ks_track_report report;
  ks_track_report_init(&report, (uint32_t)sizeof report);
  return report;
}

/// What the reports prove about two tracks and a separation. One of KS_VERDICT_...
typedef int32_t ks_verdict;
enum {
  /// The two certainly are not within the separation.
  KS_VERDICT_APART = 0,
  /// The reports prove neither of the other two.
  KS_VERDICT_UNDECIDED = 1,
  /// They certainly are within it, or outside of it by at most the tolerance.
  KS_VERDICT_WITHIN = 2
};

/// Kinds of events of a monitor (kinesphere/monitor/monitor_event.hpp). One of KS_MONITOR_...
typedef int32_t ks_monitor_event_kind;
enum {
  KS_MONITOR_NONE = 0,  ///< nothing more happens until the time that was asked for
  /// The verdict about two tracks and a separation changes.
  KS_MONITOR_VERDICT = 1,
  /// If both go straight on, two tracks come within a separation, in its look-ahead time: no guarantee.
  KS_MONITOR_PREDICTED = 2,
  /// They have passed each other, or a report shows that they will not come near.
  KS_MONITOR_PREDICTION_ENDED = 3,
  /// A report contradicts the earlier ones of its track.
  KS_MONITOR_CONTRADICTION = 4,
  /// A contradiction has ended: later reports show which one was wrong.
  KS_MONITOR_RESOLVED = 5,
  /// The latest report of a track has reached the age stale_after.
  KS_MONITOR_STALE = 6,
  /// A stale track has reported again.
  KS_MONITOR_RESUMED = 7,
  /// A track was removed, or its latest report has reached the age drop_after.
  KS_MONITOR_DROPPED = 8,
  /// A report has given the track another class; it starts anew. Comes before all others of its time.
  KS_MONITOR_RECLASSIFIED = 9
};

/// Fields: kinesphere/monitor/monitor_event.hpp.
typedef struct ks_monitor_event {
  uint32_t struct_size;
  ks_monitor_event_kind kind;
  double time;
  uint64_t first;      ///< The track of the event; for a pair, the one with the lower id.
  uint64_t second;     ///< Of a verdict or a prediction: the track with the higher id.
  uint32_t level;      ///< Of a verdict or a prediction: the separation level.
  ks_verdict verdict;  ///< Of a verdict: the new one.
  ks_verdict before;   ///< Of a verdict: the one before.
  uint32_t reserved;   ///< 0
  /// Time at which the verdict before began, -infinity for a pair that was apart at all levels; of a
  /// prediction, time at which it began.
  double since;
  /// Of a prediction: the time at which the two come within; infinity if they never do.
  double likely_time;
  double closest_time;  ///< Of a prediction: the time of the closest approach.
  /// Of a prediction: the distance then (length); for a cylinder that in the plane.
  double closest_distance;
  /// Of a contradiction: how far the position is outside of what was possible (length).
  double position_excess;
  double velocity_excess;  ///< Of a contradiction: how far the velocity is outside (length / time).
} ks_monitor_event;
static inline ks_monitor_event ks_new_monitor_event(void) {
  ks_monitor_event event;
  memset(&event, 0, sizeof event);
  event.struct_size = (uint32_t)sizeof event;
  return event;
}
/// Return names such as "verdict", and "apart"; "" for numbers that are none.
KS_API const char* ks_monitor_event_kind_name(ks_monitor_event_kind kind);
KS_API const char* ks_verdict_name(ks_verdict verdict);

/// The verdict about two tracks, with a forecast (PairAnswer in kinesphere/monitor/monitor.hpp).
typedef struct ks_pair_answer {
  uint32_t struct_size;
  ks_verdict verdict;
  ks_bool predicted;  ///< From KS_MONITOR_PREDICTED to KS_MONITOR_PREDICTION_ENDED.
  /// Time since which the verdict has held; -infinity for a pair that is apart at all levels.
  double since;
  double until;  ///< A certain verdict is true until this time, whatever is reported.
  double lower;  ///< Lower limit of the distance now (length); for a cylinder, of that in the plane.
  double upper;  ///< Upper limit of it.
  /// Estimate, if both go straight on: distance at the closest approach; for a cylinder that in the plane.
  double closest_distance;
  double closest_time;        ///< Estimate: the time of the closest approach.
  double closest_horizontal;  ///< Estimate: the horizontal part of the distance at that time.
  double closest_vertical;    ///< Estimate: the vertical part.
  double relative_speed;      ///< Estimate: speed of one relative to the other now.
  /// Estimate: time at which they first are within the separation; infinity if they never are.
  double likely_time;
  /// The pair certainly is within at some time up to this one, whatever the tracks do within their limits.
  double inevitable_by;
  /// Estimate: if both go straight on until this time, no accelerations within their limits keep them out.
  double avoidable_until;
  uint64_t ask;   ///< The track whose report would tighten the bounds most.
  double ask_by;  ///< When that report is needed for the verdict to stay certain.
} ks_pair_answer;
static inline ks_pair_answer ks_new_pair_answer(void) {
  ks_pair_answer answer;
  memset(&answer, 0, sizeof answer);
  answer.struct_size = (uint32_t)sizeof answer;
  return answer;
}

/// A pair that is not certainly apart at a level.
typedef struct ks_open_pair {
  uint64_t first;
  uint64_t second;
  uint32_t level;
  ks_verdict verdict;
  double since;
} ks_open_pair;

/// A pair that is predicted to come within a separation; times and distance as in its event, from now.
typedef struct ks_predicted_pair {
  uint64_t first;
  uint64_t second;
  uint32_t level;
  double since;  ///< time of its event KS_MONITOR_PREDICTED
  double likely_time;
  double closest_time;
  double closest_distance;
} ks_predicted_pair;

/// A report of `track` is needed by the time `by` for its verdict with `other` to stay certain.
typedef struct ks_report_request {
  uint64_t track;
  uint64_t other;
  double by;
} ks_report_request;

/// Where a track is now: within `radius` of `centre`.
typedef struct ks_track_place {
  ks_vec3 centre;
  ks_vec3 velocity;
  ks_error_bound radius;
} ks_track_place;

/// Fetches the latest reports of tracks, no later than `time`: for those that have a newer report it sets
/// reports[k] and has_report[k] = 1. Reports are defaults at first. A number other than 0 stops the call that
/// asks.
typedef int32_t (*ks_poll)(const uint64_t* tracks, size_t count, double time, ks_track_report* reports,
                           uint8_t* has_report, void* user);

/// Create and destroy a monitor; write it to bytes, and restore it from them. Errors: as in C++.
KS_API KS_MUST_CHECK ks_status ks_monitor_create(const ks_monitor_definition* definition,
                                                 ks_monitor* monitor);
KS_API ks_status ks_monitor_destroy(ks_monitor monitor);
KS_API ks_status ks_monitor_save(ks_monitor monitor, void* bytes, size_t capacity, size_t* count);
KS_API KS_MUST_CHECK ks_status ks_monitor_restore(const void* bytes, size_t count, ks_monitor* monitor);

/// Takes reports, each of the track of the same index, in this order; or, on an error, none.
KS_API KS_MUST_CHECK ks_status ks_monitor_report(ks_monitor monitor, const uint64_t* tracks,
                                                 const ks_track_report* reports, size_t count);
KS_API ks_status ks_monitor_remove(ks_monitor monitor, uint64_t track);
/// Advances to the next event, at most to time `until`, and writes it; or one of kind KS_MONITOR_NONE. `poll`
/// may be NULL: then no reports are asked for. Errors: as Monitor::advance(); KS_ERROR_CALLBACK_FAILED.
KS_API KS_MUST_CHECK ks_status ks_monitor_advance(ks_monitor monitor, double until, ks_poll poll, void* user,
                                                  ks_monitor_event* event);

KS_API ks_status ks_monitor_time(ks_monitor monitor, double* time);
/// The ids of all tracks, in ascending order.
KS_API ks_status ks_monitor_tracks(ks_monitor monitor, uint64_t* tracks, size_t capacity, size_t* count);
/// The places of a track; several only while its reports contradict each other.
KS_API ks_status ks_monitor_places(ks_monitor monitor, uint64_t track, ks_track_place* places,
                                   size_t capacity, size_t* count);
KS_API ks_status ks_monitor_answer(ks_monitor monitor, uint64_t first, uint64_t second, uint32_t level,
                                   ks_pair_answer* answer);
KS_API ks_status ks_monitor_open_pairs(ks_monitor monitor, ks_open_pair* pairs, size_t capacity,
                                       size_t* count);
KS_API ks_status ks_monitor_predicted_pairs(ks_monitor monitor, ks_predicted_pair* pairs, size_t capacity,
                                            size_t* count);
/// The reports that are needed by `until` for no verdict to turn undecided, in the order of their times.
KS_API ks_status ks_monitor_needed(ks_monitor monitor, double until, ks_report_request* requests,
                                   size_t capacity, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
