#include "guard.hpp"

#include <string>

#include "errors.hpp"

namespace kinesphere::python {

InUse::Use InUse::take(std::string_view call, std::string_view what) {
  if (depth_ > 0 && owner_ != std::this_thread::get_id()) {
    throw_state_error("in_use", what,
                      std::string(call) + ": " + std::string(what) +
                          " must be used by one thread at a time, but is in use by another");
  }
  owner_ = std::this_thread::get_id();
  return Use(*this);
}

InUse::Use InUse::take_alone(std::string_view call, std::string_view what) {
  if (depth_ > 0) {
    throw_state_error("in_use", what,
                      std::string(call) + ": " + std::string(what) +
                          " must not be at work, but a run or query asks it now");
  }
  owner_ = std::this_thread::get_id();
  return Use(*this);
}

void Interruptions::look(int calls_between_looks) {
  // Reading the clock takes longer than most states.
  if (std::this_thread::get_id() != thread_) return;
  if (!has_raised_) {
    if (++calls_ < calls_between_looks) return;
    calls_ = 0;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + interval;
  }
  call([this] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (at_each_look_) at_each_look_();
  });
}

}  // namespace kinesphere::python
