#include "base/unfinished_files.hpp"

#include <unistd.h>

#include <array>
#include <csignal>

namespace kinesphere::program {
namespace {

constexpr std::array stopping{SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU, SIGXFSZ};

/// Changed only while the stop signals are blocked.
UnfinishedFile* newest = nullptr;

sigset_t stopping_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : stopping) ::sigaddset(&signals, signal);
  return signals;
}

/// Blocks the stop signals until destruction.
class SignalsWait {
 public:
  SignalsWait() {
    const sigset_t signals = stopping_signals();
    ::sigprocmask(SIG_BLOCK, &signals, &before_);
  }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
  ~SignalsWait() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace

/// Calls only async-signal-safe functions.
void remove_unfinished_files(int signal) {
  for (const UnfinishedFile* file = newest; file != nullptr; file = file->next_) ::unlink(file->path_);
  // The handler is reset (SA_RESETHAND): this stops the program once the handler returns.
  ::raise(signal);
}

namespace {

void watch_for_signals() {
  for (const int signal : stopping) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = remove_unfinished_files;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    action.sa_mask = stopping_signals();
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace

UnfinishedFile::UnfinishedFile(const char* path) : path_(path) {
  const SignalsWait wait;
  next_ = newest;
  newest = this;
  watch_for_signals();
}

UnfinishedFile::~UnfinishedFile() {
  const SignalsWait wait;
  UnfinishedFile** place = &newest;
  while (*place != this) place = &(*place)->next_;
  *place = next_;
}

}  // namespace kinesphere::program
