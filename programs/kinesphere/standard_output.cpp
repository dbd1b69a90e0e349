#include "standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

[[noreturn]] void fail(int error) {
  throw ProgramError(fmt::format("standard output: cannot write: {}", std::strerror(error)));
}

}  // namespace

void write_output(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail(errno != 0 ? errno : EIO);
}

void finish_output() {
  errno = 0;
  if (std::fflush(stdout) != 0) fail(errno != 0 ? errno : EIO);
}

}  // namespace kinesphere::program
