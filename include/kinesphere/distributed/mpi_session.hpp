// MpiSession initialises and finalises MPI.
#pragma once

namespace kinesphere {

/// Initialises MPI unless it is initialised already, and finalises it in the destructor if this object
/// initialised it. Create one per program, in main(), so that it outlives all distributed worlds. Not
/// thread-safe: all calls come from the thread that created it.
class MpiSession {
 public:
  /// Starts MPI with the arguments of main(), unless it has been started already.
  MpiSession(int& argc, char**& argv);
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  /// Waits for the other ranks in MPI_Finalize. If an exception destroys the session, other ranks may never
  /// arrive, so the destructor stops all ranks with exit code 1.
  ~MpiSession();

  /// Rank of this process, from 0 to ranks() - 1.
  int rank() const;
  int ranks() const;
  /// Stops all processes immediately with `exit_code`, for a rank that cannot continue while others wait for
  /// it.
  [[noreturn]] void abort(int exit_code) const;

 private:
  bool is_ours_ = false;
  int exceptions_;  ///< uncaught exceptions at construction
};

}  // namespace kinesphere
