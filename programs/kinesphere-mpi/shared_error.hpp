// An error that ends the program on all ranks.
#pragma once

#include <stdexcept>
#include <string>

namespace kinesphere::program {

/// Ends the program with this exit code. It is thrown on all ranks at the same point, with the same message
/// of one line, which the first rank prints. Any other exception is one rank's alone.
class SharedError : public std::runtime_error {
 public:
  SharedError(const std::string& message, int exit_code)
      : std::runtime_error(message), exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

}  // namespace kinesphere::program
