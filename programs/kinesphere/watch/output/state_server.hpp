// Serves the state of a watch over HTTP, to this machine alone.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>

#include "serving/local_server.hpp"
#include "watch/output/watch_view.hpp"

namespace kinesphere::program {

/// Serves /state.json, /metrics and a page with a map of the state from a thread of its own. Precondition:
/// the watch changes only under the lock.
class StateServer {
 public:
  /// Throws ProgramError naming --serve if the port is taken. Port 0 is any free one.
  StateServer(const WatchView& watch, int port);
  StateServer(const StateServer&) = delete;
  StateServer& operator=(const StateServer&) = delete;

  const std::string& address() const { return server_.address(); }
  /// Locks the watch, for a change or to write its state for a client. The lock is fair: a client waits for
  /// one change, and the watch for one client at most.
  void lock();
  void unlock();

 private:
  void serve_state(const char* address, const char* type, std::string (*text)(const WatchView&));
  void serve_map();

  const WatchView& watch_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t next_ticket_ = 0, served_ticket_ = 0;
  LocalServer server_;  ///< goes first, with its thread
};

}  // namespace kinesphere::program
