// The state of a watch over HTTP, on this machine alone.
#pragma once

#include <memory>
#include <string>

#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Serves /state.json and /metrics from threads of its own. The watcher must not be used but between pause()
/// and go_on(), nor before the first or after the last.
class StateServer {
 public:
  /// Throws ProgramError naming --serve when the port is taken, or when the program was built without
  /// cpp-httplib. Port 0 is any that is free.
  StateServer(const Watcher& watcher, int port);
  ~StateServer();
  StateServer(const StateServer&) = delete;
  StateServer& operator=(const StateServer&) = delete;

  const std::string& address() const;
  /// To be held while the watcher changes; who asks for the state comes first in between.
  void lock();
  void unlock();

 private:
  class Serving;
  std::unique_ptr<Serving> serving_;
};

}  // namespace kinesphere::program
