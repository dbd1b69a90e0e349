// What a world may be waiting for while the caller's own code runs in the middle of one of its calls.
#pragma once

#include <string_view>

#include "kinesphere/filter.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

enum class CallState { idle, probing, filtering, running };

/// An error unless the world is idle: neither a probe, nor a pair filter, nor what a run() calls may make
/// this call to the world that asked it.
Error busy_error(CallState activity, std::string_view call);
inline Result<void> check_idle(CallState activity, std::string_view call) {
  if (activity == CallState::idle) return {};
  return busy_error(activity, call);
}

/// A question to a pair filter, for as long as this object lives. Each thread has its own, as several may
/// read one world at the same time; and they are nested, as the filter of one world may read another.
class FilterQuestion {
 public:
  explicit FilterQuestion(const void* world) : world_(world), outer_(innermost) { innermost = this; }
  FilterQuestion(const FilterQuestion&) = delete;
  FilterQuestion& operator=(const FilterQuestion&) = delete;
  ~FilterQuestion() { innermost = outer_; }

  /// Whether this thread is in the pair filter of that world.
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
