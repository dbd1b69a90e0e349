// The one question that the library asks: where are these bodies now, and how fast?
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// Any callable `void(std::span<const BodyId> ids, double time, std::span<State> states)`. It must set
/// states[k] to the state of ids[k] at `time`; times never decrease from one call to the next. It may not
/// change the world that asks it, nor ask that world anything that could probe: such calls fail with
/// probe_in_progress. It may throw; the call of the world that asked it can then be repeated.
///
/// A Probe refers to a callable that has a name (an lvalue), which must outlive it, and owns one that has
/// none (a temporary, a lambda written in place): copies of the Probe share it. So both of these are safe:
///   world.advance(60, [&](std::span<const BodyId> ids, double time, std::span<State> states) { ... });
///   Probe probe = motion.probe();  // the motion must outlive it
/// A null function pointer or an empty std::function gives an empty Probe, which every call of a world
/// refuses with null_probe. Cost: an indirect call; only temporaries larger than two pointers are allocated.
class Probe {
 public:
  using Function = void (*)(std::span<const BodyId> ids, double time, std::span<State> states);

  template <class Callable>
  requires(std::is_invocable_v<Callable&, std::span<const BodyId>, double, std::span<State>> &&
           !std::is_function_v<std::remove_reference_t<Callable>> &&
           !std::is_pointer_v<std::remove_cvref_t<Callable>> &&
           !std::is_same_v<std::remove_cvref_t<Callable>, Probe> &&
           (std::is_lvalue_reference_v<Callable> ||
            std::is_constructible_v<std::remove_cvref_t<Callable>, Callable>)) Probe(Callable&& callable) {
    using Owned = std::remove_cvref_t<Callable>;
    if (is_empty(callable)) return;
    if constexpr (std::is_lvalue_reference_v<Callable>) {
      target_.object = const_cast<void*>(static_cast<const void*>(std::addressof(callable)));
      call_ = &call_object<std::remove_reference_t<Callable>>;
    } else if constexpr (fits_inside<Owned>) {
      ::new (static_cast<void*>(target_.inside)) Owned(std::forward<Callable>(callable));
      call_ = &call_inside<Owned>;
    } else {
      const auto owned = std::make_shared<Owned>(std::forward<Callable>(callable));
      target_.object = owned.get();
      owner_ = owned;
      call_ = &call_object<Owned>;
    }
  }

  /// A plain function.
  Probe(Function function) {
    target_.function = function;
    if (function) call_ = &call_function;
  }
  Probe(std::nullptr_t) = delete;

  /// Not empty.
  explicit operator bool() const { return call_ != nullptr; }

  /// Needs a Probe that is not empty.
  void operator()(std::span<const BodyId> ids, double time, std::span<State> states) const {
    call_(target_, ids, time, states);
  }

 private:
  static constexpr std::size_t inside_size = 2 * sizeof(void*);
  union Target {
    void* object;
    Function function;
    alignas(void*) std::byte inside[inside_size];
  };
  using Call = void (*)(const Target&, std::span<const BodyId>, double, std::span<State>);

  /// Copies of what changes when it is called would not share it.
  template <class Callable>
  static constexpr bool fits_inside =
      std::is_trivially_copyable_v<Callable> && sizeof(Callable) <= inside_size &&
      alignof(Callable) <= alignof(void*) &&
      std::is_invocable_v<const Callable&, std::span<const BodyId>, double, std::span<State>>;

  template <class Callable>
  static bool is_empty(const Callable&) {
    return false;
  }
  template <class Signature>
  static bool is_empty(const std::function<Signature>& function) {
    return !function;
  }

  template <class Callable>
  static void call_object(const Target& target, std::span<const BodyId> ids, double time,
                          std::span<State> states) {
    (*static_cast<Callable*>(target.object))(ids, time, states);
  }
  template <class Callable>
  static void call_inside(const Target& target, std::span<const BodyId> ids, double time,
                          std::span<State> states) {
    (*std::launder(reinterpret_cast<const Callable*>(target.inside)))(ids, time, states);
  }
  static void call_function(const Target& target, std::span<const BodyId> ids, double time,
                            std::span<State> states) {
    target.function(ids, time, states);
  }

  Target target_{.inside = {}};
  Call call_ = nullptr;
  std::shared_ptr<void> owner_;
};

}  // namespace kinesphere
