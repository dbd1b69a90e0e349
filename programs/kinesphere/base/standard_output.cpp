#include "base/standard_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// errno of the first message that could not be written; 0 if there was none.
int message_error = 0;

/// Returns errno of the failed call, or EIO if it is 0.
int last_error() { return errno != 0 ? errno : EIO; }

[[noreturn]] void fail(const char* stream, int error) {
  throw ProgramError(fmt::format("{}: cannot write: {}", stream, std::strerror(error)));
}

}  // namespace

void write_output(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail("standard output", last_error());
}

void finish_output() {
  errno = 0;
  if (std::fflush(stdout) != 0) fail("standard output", last_error());
}

void write_message(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stderr) == text.size() && std::fflush(stderr) == 0) return;
  if (message_error == 0) message_error = last_error();
}

void check_messages() {
  if (message_error != 0) fail("standard error", message_error);
}

bool output_has_colour() {
  return has_colour(::isatty(STDOUT_FILENO) != 0, std::getenv("NO_COLOR"), std::getenv("TERM"));
}

bool has_colour(bool is_terminal, const char* no_color, const char* term) {
  const bool forbidden = no_color != nullptr && *no_color != '\0';
  return is_terminal && !forbidden && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace kinesphere::program
