// Callback: a function that the caller passes to the library.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace kinesphere {

template <class Signature>
class Callback;

/// Any callable with this signature. Given a named callable (an lvalue), a Callback refers to it, and the
/// callable must outlive the Callback. Given a temporary, such as a lambda written in place, a Callback
/// owns it, and copies of the Callback share it. A null function pointer or an empty std::function gives an
/// empty Callback. Cost: an indirect call; only temporaries larger than two pointers are allocated.
template <class Returned, class... Arguments>
class Callback<Returned(Arguments...)> {
 public:
  /// A plain function of this signature.
  using Function = Returned (*)(Arguments...);

  /// Makes an empty Callback.
  Callback() = default;

  /// Refers to a named callable, or owns a temporary one.
  template <class Callable>
  requires(std::is_invocable_r_v<Returned, Callable&, Arguments...> &&
           !std::is_function_v<std::remove_reference_t<Callable>> &&
           !std::is_pointer_v<std::remove_cvref_t<Callable>> &&
           !std::is_same_v<std::remove_cvref_t<Callable>, Callback> &&
           (std::is_lvalue_reference_v<Callable> ||
            std::is_constructible_v<std::remove_cvref_t<Callable>, Callable>)) Callback(Callable&& callable) {
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

  /// Refers to a plain function.
  Callback(Function function) {
    target_.function = function;
    if (function) call_ = &call_function;
  }
  Callback(std::nullptr_t) = delete;

  /// True if the Callback is not empty.
  explicit operator bool() const { return call_ != nullptr; }

  /// Calls the callable. Needs a Callback that is not empty.
  Returned operator()(Arguments... arguments) const {
    return call_(target_, std::forward<Arguments>(arguments)...);
  }

 private:
  static constexpr std::size_t inside_size = 2 * sizeof(void*);
  union Target {
    void* object;
    Function function;
    alignas(void*) std::byte inside[inside_size];
  };
  using Call = Returned (*)(const Target&, Arguments...);

  /// True for callables that may be stored inside the Callback. They must be callable as const: a callable
  /// that changes when called is allocated instead, because copies stored inside would not share its
  /// changes.
  template <class Callable>
  static constexpr bool fits_inside =
      std::is_trivially_copyable_v<Callable> && sizeof(Callable) <= inside_size &&
      alignof(Callable) <= alignof(void*) && std::is_invocable_r_v<Returned, const Callable&, Arguments...>;

  template <class Callable>
  static bool is_empty(const Callable&) {
    return false;
  }
  template <class Signature>
  static bool is_empty(const std::function<Signature>& function) {
    return !function;
  }

  template <class Callable>
  static Returned call_object(const Target& target, Arguments... arguments) {
    return static_cast<Returned>(
        (*static_cast<Callable*>(target.object))(std::forward<Arguments>(arguments)...));
  }
  template <class Callable>
  static Returned call_inside(const Target& target, Arguments... arguments) {
    return static_cast<Returned>((*std::launder(reinterpret_cast<const Callable*>(target.inside)))(
        std::forward<Arguments>(arguments)...));
  }
  static Returned call_function(const Target& target, Arguments... arguments) {
    return target.function(std::forward<Arguments>(arguments)...);
  }

  Target target_{.inside = {}};
  Call call_ = nullptr;
  std::shared_ptr<void> owner_;
};

}  // namespace kinesphere
