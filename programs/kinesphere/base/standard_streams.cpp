#include "base/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

bool input_is_closed = false;

/// Returns true if `descriptor` was closed. Precondition: no lower descriptor is closed.
bool reserve(int descriptor, int access) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return false;
  // open() returns the lowest free descriptor.
  if (::open("/dev/null", access) != descriptor)
    throw ProgramError(fmt::format("/dev/null: cannot open: {}", std::strerror(errno)));
  return true;
}

}  // namespace

void reserve_standard_streams() {
  // Input and output are opened for the opposite of their use, so that use fails.
  input_is_closed = reserve(STDIN_FILENO, O_WRONLY);
  reserve(STDOUT_FILENO, O_RDONLY);
  reserve(STDERR_FILENO, O_WRONLY);
}

bool standard_input_is_closed() { return input_is_closed; }

}  // namespace kinesphere::program
