// CallState names what a world waits for while user code runs inside one of its calls.
#pragma once

#include <string_view>

#include "kinesphere/result.hpp"

namespace kinesphere {

enum class CallState { idle, probing, filtering, running };

/// Returns the error of a call made while the world is not idle: probes, pair filters and callbacks of run()
/// must not make this call to the world that invoked them. Precondition: `activity` is not idle.
Error busy_error(CallState activity, std::string_view call);
inline Result<void> check_idle(CallState activity, std::string_view call) {
  if (activity == CallState::idle) return {};
  return busy_error(activity, call);
}

/// Marks this thread as being inside a pair filter for the lifetime of the object. Each thread has its own
/// stack of marks, since several threads may read one world concurrently, and the filter of one world may
/// read another.
class FilterQuestion {
 public:
  explicit FilterQuestion(const void* world) : world_(world), outer_(innermost) { innermost = this; }
  FilterQuestion(const FilterQuestion&) = delete;
  FilterQuestion& operator=(const FilterQuestion&) = delete;
  ~FilterQuestion() { innermost = outer_; }

  /// Returns true if this thread is inside the pair filter of that world.
  static bool is_asked_by(const void* world) {
    const FilterQuestion* question = innermost;
    while (question != nullptr && question->world_ != world) question = question->outer_;
    return question != nullptr;
  }

 private:
  inline static thread_local const FilterQuestion* innermost = nullptr;

  const void* world_;
  const FilterQuestion* outer_;
};

}  // namespace kinesphere
