// ScopedFlag marks that an operation is in progress.
#pragma once

namespace kinesphere {

/// Sets the flag to true, and to false when its scope is left, also by an exception.
class ScopedFlag {
 public:
  explicit ScopedFlag(bool& flag) : flag_(flag) { flag_ = true; }
  ScopedFlag(const ScopedFlag&) = delete;
  ScopedFlag& operator=(const ScopedFlag&) = delete;
  ~ScopedFlag() { flag_ = false; }

 private:
  bool& flag_;
};

}  // namespace kinesphere
