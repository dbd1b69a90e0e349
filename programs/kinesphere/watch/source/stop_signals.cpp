#include "watch/source/stop_signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

volatile std::sig_atomic_t stop_was_asked = 0;
int stop_pipe[2] = {-1, -1};

/// Calls only async-signal-safe functions.
void ask_to_stop(int) {
  const int error = errno;
  stop_was_asked = 1;
  // A full pipe is readable already.
  [[maybe_unused]] const auto ignored = ::write(stop_pipe[1], "", 1);
  errno = error;
}

void handle_stops(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // Under nohup the end of the terminal does not end the program.
    if (signal == SIGHUP && ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN)
      continue;
    action.sa_handler = handler;
    // Interrupted writes continue, and poll() returns. A second signal stops the program at once, but a
    // terminal that closes may send two: one of its shell, and one of the system.
    action.sa_flags = SA_RESTART | (signal == SIGHUP ? 0 : static_cast<int>(SA_RESETHAND));
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace

StopSignals::StopSignals() {
  if (::pipe(stop_pipe) != 0)
    throw ProgramError(std::string("watch: cannot make a pipe: ") + std::strerror(errno));
  for (const int end : stop_pipe) {
    ::fcntl(end, F_SETFL, O_NONBLOCK);
    ::fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  stop_was_asked = 0;
  handle_stops(ask_to_stop);
}

StopSignals::~StopSignals() {
  handle_stops(SIG_DFL);
  for (int& end : stop_pipe) {
    ::close(end);
    end = -1;
  }
}

bool StopSignals::asked() const { return stop_was_asked != 0; }
int StopSignals::descriptor() const { return stop_pipe[0]; }

}  // namespace kinesphere::program
