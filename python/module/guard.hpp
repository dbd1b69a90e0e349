// What keeps Python's threads, signals and the engine apart.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <string_view>
#include <thread>
#include <utility>

namespace kinesphere::python {

namespace py = pybind11;

/// Who uses an object now. All of it is read and written by those who hold the GIL, which the engine does not
/// while it works: so another thread may come to an object in use, and is refused.
class InUse {
 public:
  /// For as long as it lives the object is used by this thread.
  class Turn {
   public:
    explicit Turn(InUse& use) : use_(&use) { ++use_->depth_; }
    Turn(Turn&& other) noexcept : use_(std::exchange(other.use_, nullptr)) {}
    Turn& operator=(Turn&&) = delete;
    ~Turn() {
      if (use_ != nullptr) --use_->depth_;
    }

   private:
    InUse* use_;
  };

  /// For an object that may be used again inside its own callbacks, which know by themselves what is allowed
  /// there. Throws kinesphere.StateError (code "in_use") in another thread.
  [[nodiscard]] Turn take(std::string_view call, std::string_view what);
  /// For an object that nobody else may look at meanwhile.
  [[nodiscard]] Turn take_alone(std::string_view call, std::string_view what);

 private:
  int depth_ = 0;
  std::thread::id owner_;
};

/// What the callbacks of one call of a world raise, Ctrl-C among it. With several threads the engine repeats
/// what has failed, to come to the first failure by itself: so what has been raised once is raised again,
/// until the call ends.
class Interruptions {
 public:
  /// Lets Ctrl-C through while the engine works without the GIL, which this does not need: looks for signals
  /// at most 20 times a second, in the thread that made it. Throws what the handler of a signal has raised.
  void look();

  /// Calls a function of Python's under the GIL.
  template <class Function>
  auto call(const Function& function) {
    const py::gil_scoped_acquire gil;
    if (raised_) std::rethrow_exception(raised_);
    try {
      return function();
    } catch (...) {
      keep();
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{50};

  void keep() {
    raised_ = std::current_exception();
    has_raised_ = true;
  }

  std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + interval;
  int calls_ = 0;
  std::exception_ptr raised_;  ///< read and written under the GIL
  std::atomic<bool> has_raised_ = false;
};

}  // namespace kinesphere::python
