// ScopeGuard calls a function when a scope is left.
#pragma once

#include <utility>

namespace kinesphere {

/// Calls a function when its scope is left, also by an exception, unless dismissed before.
template <class Function>
class ScopeGuard {
 public:
  explicit ScopeGuard(Function leave) : leave_(std::move(leave)) {}
  ScopeGuard(const ScopeGuard&) = delete;
  ScopeGuard& operator=(const ScopeGuard&) = delete;
  ~ScopeGuard() {
    if (!dismissed_) leave_();
  }
  void dismiss() { dismissed_ = true; }

 private:
  Function leave_;
  bool dismissed_ = false;
};

}  // namespace kinesphere
