// Plays the engine for extension.c: hands out its functions by name, makes an object of the class that the
// extension registers, and calls its methods through a game loop of 60 frames a second. The scene is that of
// tests/same_hash/shared_scene.cpp; its hash is printed.
// Usage: example_c_gdextension <shared library of the extension>
#include <dlfcn.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "godot.h"

enum { balls = 64, frames = 300, most_methods = 16 };

static void require(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "host: %s\n", what);
  exit(1);
}

// -----------------------------------------------------------------------------------------------------------
// The engine. A name or string is a pointer to its characters, a variant has a type and a value.

typedef struct {
  GDExtensionVariantType type;
  double value[2];
} variant;

typedef struct {
  const char* class_name;
  void* instance;
} object;

static struct {
  char name[32];
  GDExtensionClassCreationInfo functions;
  char method_names[most_methods][32];
  GDExtensionClassMethodInfo methods[most_methods];
  int method_count;
} registered;
static int errors = 0, texts = 0;

static const char* text_of(const void* name) { return *(char* const*)name; }

static void string_new(GDExtensionStringPtr made, const char* text) {
  char* const copy = malloc(strlen(text) + 1);
  *(char**)made = strcpy(copy, text);
  ++texts;
}
static void string_name_new(GDExtensionStringNamePtr made, const char* text, GDExtensionBool is_static) {
  (void)is_static;
  string_new(made, text);
}
static void destroy_text(GDExtensionTypePtr text) {
  free(*(char**)text);
  --texts;
}
static GDExtensionPtrDestructor get_destructor(GDExtensionVariantType type) {
  (void)type;
  return destroy_text;
}

static void int_variant(GDExtensionVariantPtr made, GDExtensionTypePtr value) {
  ((variant*)made)->type = GDEXTENSION_VARIANT_TYPE_INT;
  memcpy(((variant*)made)->value, value, sizeof(int64_t));
}
static void vector_variant(GDExtensionVariantPtr made, GDExtensionTypePtr value) {
  ((variant*)made)->type = GDEXTENSION_VARIANT_TYPE_VECTOR3;
  memcpy(((variant*)made)->value, value, 3 * sizeof(float));
}
static GDExtensionVariantFromTypeConstructorFunc get_from_type(GDExtensionVariantType type) {
  return type == GDEXTENSION_VARIANT_TYPE_VECTOR3 ? vector_variant : int_variant;
}
static void value_of_variant(GDExtensionTypePtr made, GDExtensionVariantPtr value) {
  memcpy(made, ((variant*)value)->value, sizeof(double));
}
static GDExtensionTypeFromVariantConstructorFunc get_to_type(GDExtensionVariantType type) {
  (void)type;
  return value_of_variant;
}

static void register_class(GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr name,
                           GDExtensionConstStringNamePtr parent,
                           const GDExtensionClassCreationInfo* functions) {
  require(library == &registered && strcmp(text_of(parent), "Node") == 0,
          "the class is a node of this library");
  snprintf(registered.name, sizeof registered.name, "%s", text_of(name));
  registered.functions = *functions;
}
static void register_method(GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr class_name,
                            const GDExtensionClassMethodInfo* method) {
  (void)library;
  require(strcmp(text_of(class_name), registered.name) == 0, "the class of a method is registered before it");
  require(registered.method_count < most_methods, "there are too many methods");
  snprintf(registered.method_names[registered.method_count], 32, "%s", text_of(method->name));
  registered.methods[registered.method_count++] = *method;
}
static void unregister_class(GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr name) {
  (void)library;
  require(strcmp(text_of(name), registered.name) == 0, "only the own class is unregistered");
  registered.method_count = 0;
}
static GDExtensionObjectPtr construct_object(GDExtensionConstStringNamePtr name) {
  object* const made = calloc(1, sizeof(object));
  require(strcmp(text_of(name), "Node") == 0, "an object of the engine's own class");
  return made;
}
static void object_set_instance(GDExtensionObjectPtr of, GDExtensionConstStringNamePtr name,
                                GDExtensionClassInstancePtr instance) {
  require(strcmp(text_of(name), registered.name) == 0, "the class of an instance is registered");
  ((object*)of)->class_name = registered.name;
  ((object*)of)->instance = instance;
}
static void print_error(const char* description, const char* function, const char* file, int32_t line,
                        GDExtensionBool editor_notify) {
  (void)line, (void)editor_notify;
  fprintf(stderr, "ERROR: %s (%s.%s)\n", description, file, function);
  ++errors;
}

static GDExtensionInterfaceFunctionPtr get_proc_address(const char* name) {
#define FUNCTION(entry, function) \
  if (strcmp(name, entry) == 0) return (GDExtensionInterfaceFunctionPtr)function
  FUNCTION("string_new_with_latin1_chars", string_new);
  FUNCTION("string_name_new_with_latin1_chars", string_name_new);
  FUNCTION("variant_get_ptr_destructor", get_destructor);
  FUNCTION("get_variant_from_type_constructor", get_from_type);
  FUNCTION("get_variant_to_type_constructor", get_to_type);
  FUNCTION("classdb_register_extension_class", register_class);
  FUNCTION("classdb_register_extension_class_method", register_method);
  FUNCTION("classdb_unregister_extension_class", unregister_class);
  FUNCTION("classdb_construct_object", construct_object);
  FUNCTION("object_set_instance", object_set_instance);
  FUNCTION("print_error", print_error);
#undef FUNCTION
  fprintf(stderr, "host: %s is asked for\n", name);
  exit(1);
}

// -----------------------------------------------------------------------------------------------------------
// Scripts of the game

static const GDExtensionClassMethodInfo* find(const char* name, uint32_t count) {
  for (int k = 0; k < registered.method_count; ++k) {
    if (strcmp(registered.method_names[k], name) != 0) continue;
    require(registered.methods[k].argument_count == count, name);
    return &registered.methods[k];
  }
  require(0, name);
  return NULL;
}

/// A typed script passes bare values, which are floats here.
static int64_t call(const object* self, const char* name, const double* numbers, uint32_t count) {
  const GDExtensionClassMethodInfo* const method = find(name, count);
  const void* arguments[8];
  for (uint32_t k = 0; k < count; ++k) arguments[k] = &numbers[k];
  int64_t returned = 0;
  method->ptrcall_func(method->method_userdata, self->instance, arguments, &returned);
  return returned;
}

/// A script without types passes variants.
static variant call_untyped(const object* self, const char* name, const variant* given, uint32_t count) {
  const GDExtensionClassMethodInfo* const method = find(name, count);
  const void* arguments[8];
  for (uint32_t k = 0; k < count; ++k) arguments[k] = &given[k];
  variant returned = {GDEXTENSION_VARIANT_TYPE_NIL, {0, 0}};
  GDExtensionCallError error = {0, 0, 0};
  method->call_func(method->method_userdata, self->instance, arguments, count, &returned, &error);
  require(error.error == 0, name);
  method->call_func(method->method_userdata, self->instance, arguments, count + 1, &returned, &error);
  require(error.error == GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS, "an argument too many is noticed");
  return returned;
}

static variant int_of(int64_t value) {
  variant made = {GDEXTENSION_VARIANT_TYPE_INT, {0, 0}};
  memcpy(made.value, &value, sizeof value);
  return made;
}

static double next_number(void) {
  static uint64_t state = 1;
  state = state * 16807 % 2147483647;
  return (double)state / 2147483647.0;
}

static void make_scene(const object* world) {
  const double side = 20, distance = 0.5, zone[6] = {5, 5, 5, 15, 15, 15};
  call(world, "create", &side, 1);
  call(world, "sense", &distance, 1);
  for (int k = 0; k < balls; ++k) {
    double ball[7] = {2.5 + k % 4 * 5.0, 2.5 + k / 4 % 4 * 5.0, 2.5 + k / 16 * 5.0, 0, 0, 0, 0};
    ball[6] = 0.5 + next_number();
    for (int axis = 3; axis < 6; ++axis) ball[axis] = 20.0 * (next_number() - 0.5);
    require(call(world, "add_ball", ball, 7) == k, "balls are numbered from 0");
  }
  variant forces[3] = {
      {GDEXTENSION_VARIANT_TYPE_FLOAT, {5, 0}}, {GDEXTENSION_VARIANT_TYPE_FLOAT, {0.2, 0}}, int_of(7)};
  call_untyped(world, "fly", forces, 3);
  call(world, "add_zone", zone, 6);
}

static void play(const object* world) {
  int64_t events = 0;
  for (int frame = 1; frame <= frames; ++frame) {
    const double time = frame / 60.0;
    events += call(world, "advance", &time, 1);
    for (int k = 0; k < balls; ++k) {  // here the game draws them
      const variant number = int_of(k), place = call_untyped(world, "position", &number, 1);
      float position[3];
      memcpy(position, place.value, sizeof position);
      for (int axis = 0; axis < 3; ++axis)
        require(position[axis] > 0.49f && position[axis] < 19.51f, "balls stay in the box");
    }
  }
  require(events > 100 && errors == 0, "balls meet, without an error");
  const double past = 1;
  call(world, "advance", &past, 1);
  require(errors == 1, "a time in the past is an error that the engine shows");
}

int main(int argc, char** argv) {
  require(argc == 2, "usage: example_c_gdextension <shared library of the extension>");
  void* const extension = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (extension == NULL) fprintf(stderr, "%s\n", dlerror());
  require(extension != NULL, "the extension is a shared library");
  GDExtensionInitializationFunction entry;
  *(void**)&entry = dlsym(extension, "kinesphere_init");
  require(entry != NULL, "the extension has its entry");
  GDExtensionInitialization initialization;
  require(entry(get_proc_address, &registered, &initialization) == 1, "the extension starts");
  for (int level = initialization.minimum_initialization_level; level <= GDEXTENSION_INITIALIZATION_EDITOR;
       ++level)
    initialization.initialize(initialization.userdata, (GDExtensionInitializationLevel)level);

  object* const world = registered.functions.create_instance_func(registered.functions.class_userdata);
  make_scene(world);
  play(world);
  const int64_t hash = call(world, "event_hash", NULL, 0);
  printf("%016" PRIx64 "\n", (uint64_t)hash);

  registered.functions.free_instance_func(registered.functions.class_userdata, world->instance);
  free(world);
  for (int level = GDEXTENSION_INITIALIZATION_EDITOR;
       level >= (int)initialization.minimum_initialization_level; --level)
    initialization.deinitialize(initialization.userdata, (GDExtensionInitializationLevel)level);
  require(texts == 0 && registered.method_count == 0, "the extension leaves nothing behind");
  dlclose(extension);
  return 0;
}
