#include "boundary.hpp"

#include "kinesphere/version.hpp"

namespace kinesphere::c {
namespace {

/// Statuses of the library's errors are those of ErrorCode from here on, in its order.
constexpr ks_status first_library_error = KS_ERROR_NOT_FINITE;
constexpr ks_status status_of(ErrorCode code) { return first_library_error + static_cast<ks_status>(code); }
static_assert(status_of(ErrorCode::probe_in_progress) == KS_ERROR_PROBE_IN_PROGRESS);
static_assert(status_of(ErrorCode::unsupported) == KS_ERROR_UNSUPPORTED);
static_assert(status_of(ErrorCode::diverged) == KS_ERROR_DIVERGED);

struct LastError {
  std::string message;
  std::string argument;
  /// The message, or a literal where there is no memory for one.
  const char* text = "";
  BodyId body = no_body;
  std::int32_t callback = 0;
};
thread_local LastError last_error;

ks_status remember_all(ks_status status, const std::string& argument, BodyId body, const std::string& message,
                       std::int32_t callback) noexcept {
  try {
    last_error.message = message;
    last_error.argument = argument;
    last_error.text = last_error.message.c_str();
    last_error.body = body;
    last_error.callback = callback;
    return status;
  } catch (...) {
    return remember(KS_ERROR_OUT_OF_MEMORY, "out of memory");
  }
}

}  // namespace

ks_status remember(const Failure& failure) noexcept {
  return remember_all(failure.status, failure.argument, no_body, failure.message, failure.callback);
}

ks_status remember(const Error& error) noexcept {
  return remember_all(status_of(error.code), error.argument, error.body, error.message, 0);
}

ks_status remember(ks_status status, const char* message) noexcept {
  last_error.argument.clear();
  last_error.text = message;
  last_error.body = no_body;
  last_error.callback = 0;
  return status;
}

void require_pointer(std::string_view call, const void* pointer, const char* argument) {
  if (pointer != nullptr) return;
  throw Failure{KS_ERROR_NULL_ARGUMENT, argument, std::string(call) + ": " + argument + " must not be NULL"};
}

void require_size(std::string_view call, std::uint32_t size, std::size_t known, const char* argument) {
  if (size == known) return;
  throw Failure{KS_ERROR_BAD_STRUCT, argument,
                std::string(call) + ": " + argument + ": struct_size must be " + std::to_string(known) +
                    ", as ks_default_...() and ks_new_...() set it, but is " + std::to_string(size)};
}

void require_success(const char* callback, std::int32_t returned) {
  if (returned == 0) return;
  throw Failure{KS_ERROR_CALLBACK_FAILED, callback,
                std::string(callback) + " returned " + std::to_string(returned) + ", and so stopped the call",
                returned};
}

void refuse_capacity(std::string_view call, std::size_t count, std::size_t capacity) {
  throw Failure{KS_ERROR_BUFFER_TOO_SMALL, "capacity",
                std::string(call) + ": capacity must be at least " + std::to_string(count) + ", but is " +
                    std::to_string(capacity)};
}

}  // namespace kinesphere::c

using namespace kinesphere;

const char* ks_last_error_message(void) { return c::last_error.text; }
const char* ks_last_error_argument(void) { return c::last_error.argument.c_str(); }
ks_body_id ks_last_error_body(void) {
  const BodyId body = c::last_error.body;
  return {body.index, body.generation, body.world};
}
int32_t ks_last_error_callback(void) { return c::last_error.callback; }

const char* ks_status_name(ks_status status) {
  constexpr const char* own[] = {
      "ok",         "invalid_handle",   "stale_handle",    "in_use",        "null_argument",
      "bad_struct", "buffer_too_small", "callback_failed", "out_of_memory", "internal"};
  if (status >= KS_OK && status <= KS_ERROR_INTERNAL) return own[status];
  if (status < c::first_library_error) return "";
  // Names are literals, which end with a zero.
  return name_of(static_cast<ErrorCode>(status - c::first_library_error)).data();
}

const char* ks_version(void) { return version.data(); }
uint32_t ks_abi_version(void) { return KS_ABI_VERSION; }
