// A flag that is up while something goes on.
#pragma once

namespace kinesphere {

/// Raises the flag, and lowers it when its scope is left, also by an exception.
class WhileTrue {
 public:
  explicit WhileTrue(bool& flag) : flag_(flag) { flag_ = true; }
  WhileTrue(const WhileTrue&) = delete;
  WhileTrue& operator=(const WhileTrue&) = delete;
  ~WhileTrue() { flag_ = false; }

 private:
  bool& flag_;
};

}  // namespace kinesphere
