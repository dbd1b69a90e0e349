// Kinesphere as an extension of Godot 4, in C: a node of the class KinesphereWorld that scripts use.
//
//   var world := KinesphereWorld.new()
//   world.create(20.0)                                    # a box from 0 to 20
//   world.add_ball(2.5, 2.5, 2.5, 4.0, 0.0, 1.0, 0.5)     # position, velocity, radius
//   world.fly(5.0, 0.2, 7)                                # random forces up to 5, new each 0.2 s
//   func _physics_process(delta): time += delta; world.advance(time); mesh.position = world.position(0)
//
// host.c plays the engine, so that the example is built and tested without one.
#include <kinesphere.h>

#include <stdlib.h>

#include "godot.h"

enum { most_arguments = 7, most_balls = 256 };

// What the engine hands out.
static GDExtensionClassLibraryPtr library;
static GDExtensionInterfaceStringNameNewWithLatin1Chars new_name;
static GDExtensionInterfaceStringNewWithLatin1Chars new_string;
static GDExtensionInterfaceGetVariantFromTypeConstructor variant_of;
static GDExtensionInterfaceGetVariantToTypeConstructor value_of;
static GDExtensionInterfaceClassdbRegisterExtensionClass register_class;
static GDExtensionInterfaceClassdbRegisterExtensionClassMethod register_method;
static GDExtensionInterfaceClassdbUnregisterExtensionClass unregister_class;
static GDExtensionInterfaceClassdbConstructObject construct_object;
static GDExtensionInterfaceObjectSetInstance set_instance;
static GDExtensionInterfacePrintError print_error;
static GDExtensionPtrDestructor destroy_name, destroy_string;

// Memory of a name or a string of the engine.
typedef struct {
  void* pointer;
} text;
static text class_name, parent_name;

// -----------------------------------------------------------------------------------------------------------
// The node

typedef struct {
  ks_world world;
  int created;
  ks_state starts[most_balls];
  double radii[most_balls];
  int64_t balls;
  ks_body_id ids[most_balls];
  ks_event_hash hash;
  int64_t events;
} node;

/// Returns true for success; otherwise the engine shows what the library has to say.
static int succeeds(ks_status status, const char* method) {
  if (status == KS_OK) return 1;
  print_error(ks_last_error_message(), method, "KinesphereWorld", 0, 0);
  return 0;
}

static double number(const void* argument) { return *(const double*)argument; }
static ks_vec3 vector(const void* const* arguments) {
  const ks_vec3 v = {number(arguments[0]), number(arguments[1]), number(arguments[2])};
  return v;
}

static void create(node* self, const void* const* arguments, void* returned) {
  (void)returned;
  ks_world_definition definition = ks_default_world_definition();
  const double side = number(arguments[0]);
  definition.has_box = 1;
  definition.box.upper = (ks_vec3){side, side, side};
  if (self->created) ks_world_destroy(self->world);
  self->balls = self->events = 0;
  self->hash = (ks_event_hash){0, 0};
  self->created = succeeds(ks_world_create(&definition, &self->world), "create");
}

static void sense(node* self, const void* const* arguments, void* returned) {
  (void)returned;
  const double distance = number(arguments[0]);
  succeeds(ks_world_set_sensor(self->world, 0, &distance, 1, UINT64_MAX), "sense");
}

static void add_ball(node* self, const void* const* arguments, void* returned) {
  *(int64_t*)returned = -1;
  if (self->balls == most_balls) {
    print_error("there are too many balls", "add_ball", "KinesphereWorld", 0, 0);
    return;
  }
  self->starts[self->balls].position = vector(arguments);
  self->starts[self->balls].velocity = vector(arguments + 3);
  self->radii[self->balls] = number(arguments[6]);
  *(int64_t*)returned = self->balls++;
}

static void fly(node* self, const void* const* arguments, void* returned) {
  (void)returned;
  double limits[most_balls];
  for (int64_t k = 0; k < self->balls; ++k) limits[k] = number(arguments[0]);
  ks_motion_definition motion = ks_default_motion_definition();
  motion.kind = KS_MOTION_RANDOM_FORCES;
  motion.count = (size_t)self->balls;
  motion.states = self->starts;
  motion.radii = self->radii;
  motion.masses = self->radii;
  motion.acceleration_limits = limits;
  motion.interval = number(arguments[1]);
  motion.seed = (uint64_t) * (const int64_t*)arguments[2];
  succeeds(ks_world_add_motion(self->world, &motion, NULL, self->ids), "fly");
}

static void add_zone(node* self, const void* const* arguments, void* returned) {
  (void)returned;
  ks_body_id zone;
  const ks_shape box = ks_solid_box(vector(arguments), vector(arguments + 3));
  succeeds(ks_world_add_zone(self->world, &box, 0, &zone), "add_zone");
}

static int32_t receive(const ks_event* event, void* user) {
  node* const self = (node*)user;
  ++self->events;
  return ks_event_hash_add(&self->hash, event);
}

/// Returns the number of events since the last frame.
static void advance(node* self, const void* const* arguments, void* returned) {
  const int64_t before = self->events;
  ks_run_definition run = ks_default_run_definition();
  run.restitution = 0.9;
  run.sink = receive;
  run.sink_user = self;
  succeeds(ks_world_run(self->world, number(arguments[0]), &run), "advance");
  *(int64_t*)returned = self->events - before;
}

static void position(node* self, const void* const* arguments, void* returned) {
  const int64_t ball = *(const int64_t*)arguments[0];
  float* const vector3 = (float*)returned;
  ks_state state = {{0, 0, 0}, {0, 0, 0}};
  double now;
  if (ball < 0 || ball >= self->balls) {
    print_error("there is no such ball", "position", "KinesphereWorld", 0, 0);
  } else if (succeeds(ks_world_time(self->world, &now), "position")) {
    succeeds(ks_world_states(self->world, &self->ids[ball], 1, now, &state), "position");
  }
  vector3[0] = (float)state.position.x;
  vector3[1] = (float)state.position.y;
  vector3[2] = (float)state.position.z;
}

static void event_hash(node* self, const void* const* arguments, void* returned) {
  (void)arguments;
  uint64_t value = 0;
  succeeds(ks_event_hash_value(&self->hash, &value), "event_hash");
  *(int64_t*)returned = (int64_t)value;
}

// -----------------------------------------------------------------------------------------------------------
// Its class

typedef struct {
  const char* name;
  void (*function)(node* self, const void* const* arguments, void* returned);
  GDExtensionVariantType returns;
  uint32_t count;
  GDExtensionVariantType takes[most_arguments];
} method;

#define NIL GDEXTENSION_VARIANT_TYPE_NIL
#define INT GDEXTENSION_VARIANT_TYPE_INT
#define FLOAT GDEXTENSION_VARIANT_TYPE_FLOAT
#define VECTOR3 GDEXTENSION_VARIANT_TYPE_VECTOR3
static const method methods[] = {
    {"create", create, NIL, 1, {FLOAT}},
    {"sense", sense, NIL, 1, {FLOAT}},
    {"add_ball", add_ball, INT, 7, {FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT}},
    {"fly", fly, NIL, 3, {FLOAT, FLOAT, INT}},
    {"add_zone", add_zone, NIL, 6, {FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT}},
    {"advance", advance, INT, 1, {FLOAT}},
    {"position", position, VECTOR3, 1, {INT}},
    {"event_hash", event_hash, INT, 0, {NIL}},
};

static void call_with_values(void* userdata, GDExtensionClassInstancePtr instance,
                             const GDExtensionConstTypePtr* arguments, GDExtensionTypePtr returned) {
  ((const method*)userdata)->function((node*)instance, arguments, returned);
}

static void call_with_variants(void* userdata, GDExtensionClassInstancePtr instance,
                               const GDExtensionConstVariantPtr* variants, GDExtensionInt count,
                               GDExtensionVariantPtr returned, GDExtensionCallError* error) {
  const method* const called = (const method*)userdata;
  error->error = count < called->count   ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                 : count > called->count ? GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS
                                         : 0;
  error->expected = (int32_t)called->count;
  if (error->error != 0) return;
  // Each value of the types above fits into two doubles.
  double values[most_arguments][2], result[2] = {0, 0};
  const void* arguments[most_arguments];
  for (uint32_t k = 0; k < called->count; ++k) {
    value_of(called->takes[k])(values[k], (GDExtensionVariantPtr)variants[k]);
    arguments[k] = values[k];
  }
  called->function((node*)instance, arguments, result);
  if (called->returns != NIL) variant_of(called->returns)(returned, result);
}

static GDExtensionObjectPtr create_instance(void* userdata) {
  (void)userdata;
  node* const self = calloc(1, sizeof(node));
  const GDExtensionObjectPtr object = construct_object(&parent_name);
  set_instance(object, &class_name, self);
  return object;
}

static void free_instance(void* userdata, GDExtensionClassInstancePtr instance) {
  (void)userdata;
  node* const self = (node*)instance;
  if (self->created) ks_world_destroy(self->world);
  free(self);
}

static void register_one(const method* added) {
  text name, none, hint;
  new_name(&name, added->name, 1);
  new_name(&none, "", 1);
  new_string(&hint, "");
  GDExtensionPropertyInfo takes[most_arguments], returns;
  int32_t metadata[most_arguments] = {0};
  for (uint32_t k = 0; k <= added->count; ++k) {
    GDExtensionPropertyInfo* const one = k < added->count ? &takes[k] : &returns;
    one->type = k < added->count ? added->takes[k] : added->returns;
    one->name = one->class_name = &none;
    one->hint = 0;
    one->hint_string = &hint;
    one->usage = PROPERTY_USAGE_DEFAULT;
  }
  GDExtensionClassMethodInfo info = {0};
  info.name = &name;
  info.method_userdata = (void*)added;
  info.call_func = call_with_variants;
  info.ptrcall_func = call_with_values;
  info.method_flags = METHOD_FLAG_NORMAL;
  info.has_return_value = added->returns != NIL;
  info.return_value_info = &returns;
  info.argument_count = added->count;
  info.arguments_info = takes;
  info.arguments_metadata = metadata;
  register_method(library, &class_name, &info);
  destroy_name(&name);
  destroy_name(&none);
  destroy_string(&hint);
}

static void initialize(void* userdata, GDExtensionInitializationLevel level) {
  (void)userdata;
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  new_name(&class_name, "KinesphereWorld", 1);
  new_name(&parent_name, "Node", 1);
  GDExtensionClassCreationInfo functions = {0};
  functions.create_instance_func = create_instance;
  functions.free_instance_func = free_instance;
  register_class(library, &class_name, &parent_name, &functions);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) register_one(&methods[k]);
}

static void deinitialize(void* userdata, GDExtensionInitializationLevel level) {
  (void)userdata;
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  unregister_class(library, &class_name);
  destroy_name(&class_name);
  destroy_name(&parent_name);
}

/// The entry, which kinesphere.gdextension names.
KS_API GDExtensionBool kinesphere_init(GDExtensionInterfaceGetProcAddress get,
                                       GDExtensionClassLibraryPtr given,
                                       GDExtensionInitialization* initialization);
GDExtensionBool kinesphere_init(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr given,
                                GDExtensionInitialization* initialization) {
  library = given;
  new_name = (GDExtensionInterfaceStringNameNewWithLatin1Chars)get("string_name_new_with_latin1_chars");
  new_string = (GDExtensionInterfaceStringNewWithLatin1Chars)get("string_new_with_latin1_chars");
  variant_of = (GDExtensionInterfaceGetVariantFromTypeConstructor)get("get_variant_from_type_constructor");
  value_of = (GDExtensionInterfaceGetVariantToTypeConstructor)get("get_variant_to_type_constructor");
  register_class = (GDExtensionInterfaceClassdbRegisterExtensionClass)get("classdb_register_extension_class");
  register_method =
      (GDExtensionInterfaceClassdbRegisterExtensionClassMethod)get("classdb_register_extension_class_method");
  unregister_class =
      (GDExtensionInterfaceClassdbUnregisterExtensionClass)get("classdb_unregister_extension_class");
  construct_object = (GDExtensionInterfaceClassdbConstructObject)get("classdb_construct_object");
  set_instance = (GDExtensionInterfaceObjectSetInstance)get("object_set_instance");
  print_error = (GDExtensionInterfacePrintError)get("print_error");
  const GDExtensionInterfaceVariantGetPtrDestructor destructor =
      (GDExtensionInterfaceVariantGetPtrDestructor)get("variant_get_ptr_destructor");
  destroy_name = destructor(GDEXTENSION_VARIANT_TYPE_STRING_NAME);
  destroy_string = destructor(GDEXTENSION_VARIANT_TYPE_STRING);
  initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
  initialization->userdata = NULL;
  initialization->initialize = initialize;
  initialization->deinitialize = deinitialize;
  return 1;
}
