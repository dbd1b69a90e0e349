// The part of Godot 4's extension interface that the example needs, declared after the engine's public
// documentation. Names and layouts are those of Godot's own gdextension_interface.h, which an extension of a
// real game includes instead.
#ifndef KINESPHERE_EXAMPLES_GODOT_H
#define KINESPHERE_EXAMPLES_GODOT_H

#include <stdint.h>

typedef uint8_t GDExtensionBool;
typedef int64_t GDExtensionInt;
typedef void* GDExtensionObjectPtr;
typedef void* GDExtensionClassInstancePtr;
typedef void* GDExtensionClassLibraryPtr;
typedef void* GDExtensionStringPtr;
typedef void* GDExtensionStringNamePtr;
typedef const void* GDExtensionConstStringNamePtr;
typedef void* GDExtensionTypePtr;
typedef const void* GDExtensionConstTypePtr;
typedef void* GDExtensionVariantPtr;
typedef const void* GDExtensionConstVariantPtr;

/// Types of values; an int is 64 bits wide, a float is a double, a Vector3 has three floats of C.
typedef enum {
  GDEXTENSION_VARIANT_TYPE_NIL = 0,
  GDEXTENSION_VARIANT_TYPE_INT = 2,
  GDEXTENSION_VARIANT_TYPE_FLOAT = 3,
  GDEXTENSION_VARIANT_TYPE_STRING = 4,
  GDEXTENSION_VARIANT_TYPE_VECTOR3 = 9,
  GDEXTENSION_VARIANT_TYPE_STRING_NAME = 21
} GDExtensionVariantType;

// The entry of an extension: the engine hands out its functions by name, and learns whom to call later.

typedef void (*GDExtensionInterfaceFunctionPtr)(void);
typedef GDExtensionInterfaceFunctionPtr (*GDExtensionInterfaceGetProcAddress)(const char* name);

typedef enum {
  GDEXTENSION_INITIALIZATION_CORE,
  GDEXTENSION_INITIALIZATION_SERVERS,
  GDEXTENSION_INITIALIZATION_SCENE,
  GDEXTENSION_INITIALIZATION_EDITOR
} GDExtensionInitializationLevel;

typedef struct {
  GDExtensionInitializationLevel minimum_initialization_level;
  void* userdata;
  void (*initialize)(void* userdata, GDExtensionInitializationLevel level);
  void (*deinitialize)(void* userdata, GDExtensionInitializationLevel level);
} GDExtensionInitialization;

typedef GDExtensionBool (*GDExtensionInitializationFunction)(
    GDExtensionInterfaceGetProcAddress get_proc_address, GDExtensionClassLibraryPtr library,
    GDExtensionInitialization* initialization);

// Classes

/// The functions of a class; those that are void* here may be null.
typedef struct {
  GDExtensionBool is_virtual;
  GDExtensionBool is_abstract;
  void *set_func, *get_func, *get_property_list_func, *free_property_list_func, *property_can_revert_func;
  void *property_get_revert_func, *notification_func, *to_string_func, *reference_func, *unreference_func;
  GDExtensionObjectPtr (*create_instance_func)(void* class_userdata);
  void (*free_instance_func)(void* class_userdata, GDExtensionClassInstancePtr instance);
  void *get_virtual_func, *get_rid_func;
  void* class_userdata;
} GDExtensionClassCreationInfo;

typedef struct {
  GDExtensionVariantType type;
  GDExtensionStringNamePtr name;
  GDExtensionStringNamePtr class_name;
  uint32_t hint;
  GDExtensionStringPtr hint_string;
  uint32_t usage;
} GDExtensionPropertyInfo;
enum { PROPERTY_USAGE_DEFAULT = 6, METHOD_FLAG_NORMAL = 1 };

typedef struct {
  int32_t error;  ///< 0: none
  int32_t argument;
  int32_t expected;
} GDExtensionCallError;
enum { GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS = 3, GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS = 4 };

/// A call with variants, as of a script without types, and one with bare values.
typedef void (*GDExtensionClassMethodCall)(void* userdata, GDExtensionClassInstancePtr instance,
                                           const GDExtensionConstVariantPtr* arguments, GDExtensionInt count,
                                           GDExtensionVariantPtr returned, GDExtensionCallError* error);
typedef void (*GDExtensionClassMethodPtrCall)(void* userdata, GDExtensionClassInstancePtr instance,
                                              const GDExtensionConstTypePtr* arguments,
                                              GDExtensionTypePtr returned);

typedef struct {
  GDExtensionStringNamePtr name;
  void* method_userdata;
  GDExtensionClassMethodCall call_func;
  GDExtensionClassMethodPtrCall ptrcall_func;
  uint32_t method_flags;
  GDExtensionBool has_return_value;
  GDExtensionPropertyInfo* return_value_info;
  int32_t return_value_metadata;
  uint32_t argument_count;
  GDExtensionPropertyInfo* arguments_info;
  int32_t* arguments_metadata;
  uint32_t default_argument_count;
  GDExtensionVariantPtr* default_arguments;
} GDExtensionClassMethodInfo;

// Functions of the engine, with the names that get_proc_address() knows as comments.

/// string_name_new_with_latin1_chars
typedef void (*GDExtensionInterfaceStringNameNewWithLatin1Chars)(GDExtensionStringNamePtr made,
                                                                 const char* text, GDExtensionBool is_static);
/// string_new_with_latin1_chars
typedef void (*GDExtensionInterfaceStringNewWithLatin1Chars)(GDExtensionStringPtr made, const char* text);
/// variant_get_ptr_destructor
typedef void (*GDExtensionPtrDestructor)(GDExtensionTypePtr value);
typedef GDExtensionPtrDestructor (*GDExtensionInterfaceVariantGetPtrDestructor)(GDExtensionVariantType type);
/// get_variant_from_type_constructor
typedef void (*GDExtensionVariantFromTypeConstructorFunc)(GDExtensionVariantPtr made,
                                                          GDExtensionTypePtr value);
typedef GDExtensionVariantFromTypeConstructorFunc (*GDExtensionInterfaceGetVariantFromTypeConstructor)(
    GDExtensionVariantType type);
/// get_variant_to_type_constructor
typedef void (*GDExtensionTypeFromVariantConstructorFunc)(GDExtensionTypePtr made,
                                                          GDExtensionVariantPtr value);
typedef GDExtensionTypeFromVariantConstructorFunc (*GDExtensionInterfaceGetVariantToTypeConstructor)(
    GDExtensionVariantType type);
/// classdb_register_extension_class
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClass)(
    GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr name,
    GDExtensionConstStringNamePtr parent, const GDExtensionClassCreationInfo* functions);
/// classdb_register_extension_class_method
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClassMethod)(
    GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr class_name,
    const GDExtensionClassMethodInfo* method);
/// classdb_unregister_extension_class
typedef void (*GDExtensionInterfaceClassdbUnregisterExtensionClass)(GDExtensionClassLibraryPtr library,
                                                                    GDExtensionConstStringNamePtr name);
/// classdb_construct_object
typedef GDExtensionObjectPtr (*GDExtensionInterfaceClassdbConstructObject)(
    GDExtensionConstStringNamePtr name);
/// object_set_instance
typedef void (*GDExtensionInterfaceObjectSetInstance)(GDExtensionObjectPtr object,
                                                      GDExtensionConstStringNamePtr name,
                                                      GDExtensionClassInstancePtr instance);
/// print_error
typedef void (*GDExtensionInterfacePrintError)(const char* description, const char* function,
                                               const char* file, int32_t line, GDExtensionBool editor_notify);

#endif
