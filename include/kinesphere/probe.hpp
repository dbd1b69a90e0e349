// The one question that the library asks: where are these bodies now, and how fast?
#pragma once

#include <memory>
#include <span>
#include <type_traits>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// A reference to any callable `void(std::span<const BodyId> ids, double time, std::span<State>
/// states)`. It must set states[k] to the state of ids[k] at `time`; times never decrease from one
/// call to the next. It may not call back into the world; it may throw, and the call that
/// it was passed to can then be repeated. It does not own the callable, so it is
/// meant for arguments: the callable must outlive the call that it is passed to.
class Probe {
 public:
  using Function = void (*)(std::span<const BodyId> ids, double time, std::span<State> states);

  template <class Callable>
  requires(std::is_invocable_v<Callable&, std::span<const BodyId>, double, std::span<State>> &&
           !std::is_function_v<std::remove_reference_t<Callable>> &&
           !std::is_same_v<std::remove_cvref_t<Callable>, Probe>) Probe(Callable&& callable)
      : target_{.object = const_cast<void*>(static_cast<const void*>(std::addressof(callable)))},
        call_([](Target target, std::span<const BodyId> ids, double time, std::span<State> states) {
          (*static_cast<std::remove_reference_t<Callable>*>(target.object))(ids, time, states);
        }) {}

  /// A plain function.
  Probe(Function function)
      : target_{.function = function},
        call_([](Target target, std::span<const BodyId> ids, double time, std::span<State> states) {
          target.function(ids, time, states);
        }) {}

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states) const {
    call_(target_, ids, time, states);
  }

 private:
  union Target {
    void* object;
    Function function;
  };

  Target target_;
  void (*call_)(Target, std::span<const BodyId>, double, std::span<State>);
};

}  // namespace kinesphere
