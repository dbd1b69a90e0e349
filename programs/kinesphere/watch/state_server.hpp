// The state of a watch over HTTP, on this machine alone.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>

#include "serving/local_server.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Serves /state.json, /metrics and a page with a map of the state from threads of its own. The watcher must
/// not change but under the lock.
class StateServer {
 public:
  /// Throws ProgramError naming --serve when the port is taken, or when the program was built without
  /// cpp-httplib. Port 0 is any that is free.
  StateServer(const Watcher& watcher, int port);
  StateServer(const StateServer&) = delete;
  StateServer& operator=(const StateServer&) = delete;

  const std::string& address() const { return server_.address(); }
  /// To be held while the watcher changes; who asks for the state comes first in between.
  void lock();
  void unlock() { mutex_.unlock(); }

 private:
  class Reading;
  void serve_state(const char* address, const char* type, std::string (*text)(const Watcher&));
  void serve_map();

  const Watcher& watcher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<int> waiting_ = 0;  ///< who wants to see the state
  LocalServer server_;            ///< goes first, with its threads
};

}  // namespace kinesphere::program
