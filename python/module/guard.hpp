// Protects the engine against Python's threads and signals.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <string_view>
#include <thread>
#include <utility>

namespace kinesphere::python {

namespace py = pybind11;

/// Records which thread uses an object. Precondition: all members require the GIL, which the engine
/// does not hold while it works; so another thread may reach an object in use, and gets an error.
class InUse {
 public:
  /// Marks the object as used by this thread until destruction.
  class Use {
   public:
    explicit Use(InUse& use) : use_(&use) { ++use_->depth_; }
    Use(Use&& other) noexcept : use_(std::exchange(other.use_, nullptr)) {}
    Use& operator=(Use&&) = delete;
    ~Use() {
      if (use_ != nullptr) --use_->depth_;
    }

   private:
    InUse* use_;
  };

  /// For an object that its own callbacks may use again; the callbacks know what is allowed. Throws
  /// kinesphere.StateError (code "in_use") in another thread.
  [[nodiscard]] Use take(std::string_view call, std::string_view what);
  /// For an object that no other call may use meanwhile.
  [[nodiscard]] Use take_alone(std::string_view call, std::string_view what);
  /// Returns true while another thread uses the object.
  bool is_taken_elsewhere() const { return depth_ > 0 && owner_ != std::this_thread::get_id(); }

 private:
  int depth_ = 0;
  std::thread::id owner_;
};

/// Exceptions of the callbacks of one call of a world, including Ctrl-C. With several threads the
/// engine repeats failed work, to find the first failure: so an exception is raised again until the
/// call ends.
class Interruptions {
 public:
  /// Lets Ctrl-C through while the engine works without the GIL: checks for signals at most 20
  /// times a second, in the thread that made this object. Throws what a signal handler has raised, and
  /// what the function of at_each_look() throws. Reads the clock in one of `calls_between_looks` calls.
  /// Needs no GIL.
  void look(int calls_between_looks = 64);
  /// Makes each check for signals call this function, under the GIL.
  void at_each_look(std::function<void()> function) { at_each_look_ = std::move(function); }

  /// Calls a Python function under the GIL.
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
  std::function<void()> at_each_look_;
  std::exception_ptr raised_;  ///< read and written under the GIL
  std::atomic<bool> has_raised_ = false;
};

}  // namespace kinesphere::python
