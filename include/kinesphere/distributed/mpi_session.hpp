// MPI for as long as a program runs.
#pragma once

namespace kinesphere {

/// Initialises MPI, if nobody has, and finalises it again if it has been this that did. One for a program, in
/// main(), around all that is distributed. It is called from the thread that made it alone.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  /// Waits for the other ranks. If an exception destroys the session, they may never come: then this stops
  /// all ranks, with exit code 1.
  ~MpiSession();

  /// Of this process: from 0 to ranks() - 1.
  int rank() const;
  int ranks() const;
  /// The end of all processes, at once, with this exit code: for a rank that cannot go on while others wait
  /// for it.
  [[noreturn]] void abort(int exit_code) const;

 private:
  bool is_ours_ = false;
  int exceptions_;  ///< uncaught when it was made
};

}  // namespace kinesphere
