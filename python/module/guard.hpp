// What keeps Python's threads, signals and the engine apart.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
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

  /// For an object that may be used again inside its own callbacks, which know by themselves what is allowed there.
  /// Throws kinesphere.StateError (code "in_use") in another thread.
  [[nodiscard]] Turn take(std::string_view call, std::string_view what);
  /// For an object that nobody else may look at meanwhile.
  [[nodiscard]] Turn take_alone(std::string_view call, std::string_view what);

 private:
  int depth_ = 0;
  std::thread::id owner_;
};

/// Lets Ctrl-C through while the engine works without the GIL: looks for signals at most 20 times a second, in the
/// thread that made it.
class SignalCheck {
 public:
  /// Needs no GIL. Throws what the handler of a signal has raised.
  void look();

 private:
  using Clock = std::chrono::steady_clock;
  std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + interval;
  int calls_ = 0;
  static constexpr std::chrono::milliseconds interval{50};
};

}  // namespace kinesphere::python
