// Exceptions for input that is not what it has to be.
#pragma once

#include <stdexcept>

namespace kinesphere::program {

/// A row, or one of its fields, is not what it has to be. The message says what was expected, in which
/// column; the caller adds file and line.
class WrongInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A record does not match its format; the message says what was expected.
class MalformedRecord : public WrongInput {
 public:
  using WrongInput::WrongInput;
};

}  // namespace kinesphere::program
