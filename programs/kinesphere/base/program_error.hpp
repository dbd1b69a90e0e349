// Errors that the user can correct; they stop the program.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "kinesphere/result.hpp"

namespace kinesphere::program {

enum ExitCode : int {
  exit_fine = 0,
  exit_disagreement = 1,  ///< two answers differ that should not, or an audit found something
  exit_wrong_input = 2,
  exit_unfinished = 75,  ///< stopped as asked, to go on later: EX_TEMPFAIL of sysexits.h
};

/// The message is one line: where, what was expected and what was found. The exit code is exit_wrong_input.
class ProgramError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the message of an error of the library without the name of the call that refused, which the user
/// of a program has not made.
std::string message_of(const Error& error);

/// Returns the value of a library call, or throws its error as a ProgramError.
template <class T>
T require(Result<T> result) {
  if (!result) throw ProgramError(message_of(result.error()));
  return std::move(result).value();
}

}  // namespace kinesphere::program
