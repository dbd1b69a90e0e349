// The boundary between C and the library: no exception passes it, and each failure leaves its status and
// message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "kinesphere.h"
#include "kinesphere/result.hpp"

namespace kinesphere::c {

/// A failure of a call that the library's own errors do not cover.
struct Failure {
  ks_status status;
  std::string argument;
  std::string message;
  std::int32_t callback = 0;  ///< what the callback returned
};

/// Remember why the last call of this thread failed, and return its status. None of them throws.
ks_status remember(const Failure& failure) noexcept;
ks_status remember(const Error& error) noexcept;
/// For a failure that leaves no memory for a message; `message` must be a literal.
ks_status remember(ks_status status, const char* message) noexcept;

/// Calls `body`, and returns KS_OK, or the status of what it throws. Each function of the interface consists
/// of one such call.
template <class Body>
ks_status guarded(Body&& body) noexcept {
  try {
    std::forward<Body>(body)();
    return KS_OK;
  } catch (const Failure& failure) {
    return remember(failure);
  } catch (const BadResult& bad) {
    return remember(bad.error());
  } catch (const std::bad_alloc&) {
    return remember(KS_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& exception) {
    return remember({KS_ERROR_INTERNAL, "", exception.what()});
  } catch (...) {
    return remember(KS_ERROR_INTERNAL, "a callback threw an exception");
  }
}

/// Throws a Failure unless the pointer points to something.
void require_pointer(std::string_view call, const void* pointer, const char* argument);
/// The same for an array, which may be null if it is empty.
inline void require_array(std::string_view call, const void* pointer, std::size_t count,
                          const char* argument) {
  if (count > 0) require_pointer(call, pointer, argument);
}

/// Throws a Failure unless `size` is the one that this library knows.
void require_size(std::string_view call, std::uint32_t size, std::size_t known, const char* argument);
/// Size of a record in programs that were compiled before it had all of its fields.
template <class Record>
inline constexpr std::size_t first_size = sizeof(Record);
template <>
inline constexpr std::size_t first_size<ks_event> = offsetof(ks_event, acceleration_limit);
template <>
inline constexpr std::size_t first_size<ks_world_definition> = offsetof(ks_world_definition,
                                                                        adopt_observed_limits);
template <>
inline constexpr std::size_t first_size<ks_response> = offsetof(ks_response, turned_back);
/// Throws a Failure unless `size` is one that this library knows of the record.
template <class Record>
void require_size_of(std::string_view call, std::uint32_t size, const char* argument) {
  if (size != first_size<Record>) require_size(call, size, sizeof(Record), argument);
}
/// Throws a Failure unless the record is there and has a known size.
template <class Record>
void require_record(std::string_view call, const Record* record, const char* argument) {
  require_pointer(call, record, argument);
  require_size_of<Record>(call, record->struct_size, argument);
}
/// Writes as much of `record` as the caller's record has room for, of a known size, which it keeps.
template <class Record>
void write_record(const Record& record, Record* caller, std::uint32_t struct_size) {
  Record sized = record;
  sized.struct_size = struct_size;
  std::memcpy(static_cast<void*>(caller), &sized, struct_size);
}
/// Returns the caller's record, of a known size; what it lacks is that of `rest`.
template <class Record>
Record read_record(const Record& caller, Record rest) {
  std::memcpy(static_cast<void*>(&rest), &caller, caller.struct_size);
  return rest;
}
template <class Record>
void require_records(std::string_view call, const Record* records, std::size_t count, const char* argument) {
  require_array(call, records, count, argument);
  for (std::size_t k = 0; k < count; ++k)
    require_size(call, records[k].struct_size, sizeof(Record), argument);
}

/// Throws KS_ERROR_CALLBACK_FAILED unless the callback returned 0.
void require_success(const char* callback, std::int32_t returned);

/// Writes `record` over the caller's default record; `call` is that of its initialiser.
template <class Record>
ks_status initialise(std::string_view call, Record* record, std::uint32_t struct_size,
                     const Record& defaults) {
  return guarded([&] {
    require_pointer(call, record, "record");
    require_size_of<Record>(call, struct_size, "record");
    write_record(defaults, record, struct_size);
  });
}

/// Throws KS_ERROR_BUFFER_TOO_SMALL.
[[noreturn]] void refuse_capacity(std::string_view call, std::size_t count, std::size_t capacity);

/// Sets *count to the number of elements of `found`, and writes those, converted, to the caller's array.
template <class Found, class Element, class Convert>
void write_all(std::string_view call, const Found& found, Element* elements, std::size_t capacity,
               std::size_t* count, const Convert& convert) {
  require_pointer(call, count, "count");
  *count = found.size();
  if (found.size() > capacity) refuse_capacity(call, found.size(), capacity);
  require_array(call, elements, found.size(), "array");
  for (const auto& element : found) *elements++ = convert(element);
}

}  // namespace kinesphere::c
