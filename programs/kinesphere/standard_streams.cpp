#include "standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

bool input_is_closed = false;

/// True if `descriptor` was closed. Needs that no lower one is.
bool reserve(int descriptor, int access) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return false;
  // open() returns the lowest descriptor that is free.
  if (::open("/dev/null", access) != descriptor)
    throw ProgramError(fmt::format("/dev/null: cannot open: {}", std::strerror(errno)));
  return true;
}

}  // namespace

void reserve_standard_streams() {
  // Each but standard error is opened for the opposite of its use, which therefore fails.
  input_is_closed = reserve(STDIN_FILENO, O_WRONLY);
  reserve(STDOUT_FILENO, O_RDONLY);
  reserve(STDERR_FILENO, O_WRONLY);
}

bool standard_input_is_closed() { return input_is_closed; }

}  // namespace kinesphere::program
