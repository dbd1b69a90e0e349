// A web server that only this machine can reach.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace kinesphere::program {

/// Serves pages and files on 127.0.0.1 from a thread of its own, to requests that name this machine. It
/// supports GET and HEAD with whole contents: no ranges, bodies, compression or kept connections. A slow or
/// hostile client delays neither other clients nor the program: at most 64 connections are open, and a new
/// one closes the oldest; a request takes 5 s and 16 kB at most; content made for single clients takes 64 MB
/// in all, or one content if that is larger. docs/watch-running.md has the threat model.
/// No library is used: Debian's cpp-httplib 0.11 gives each connection a thread for as long as the client
/// likes, buffers bodies before it routes, and passes unchecked ranges on.
class LocalServer {
 public:
  /// `option` is the command-line option that enables the server; errors name it.
  LocalServer(std::string option, const std::string& content_security_policy);
  /// Closes all connections. Waits for a running callback of serve(), and for nothing else.
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  // Precondition of serve() and serve_folder(): start() has not been called. An address is a path, such as
  // "/state.json".

  /// Serves `content`, which is not copied and must outlive the server.
  void serve(const std::string& address, const std::string& type, const std::string& content);
  void serve(const std::string& address, const std::string& type, std::string&& content) = delete;
  /// Serves the result of `content`, which the server's thread calls for each request. If it throws, the
  /// response is 500.
  void serve(const std::string& address, const std::string& type, std::function<std::string()> content);
  /// Serves the files of a folder below an address, except files with a name that begins with a dot, and its
  /// index.html at "address/". Returns false if there is no such folder.
  bool serve_folder(const std::string& address, const std::string& folder);

  /// Starts the thread, with all signals blocked. Port 0 is any free one. Throws ProgramError if the port is
  /// taken.
  void start(int port);
  /// "http://127.0.0.1:PORT/". Precondition: start() has returned.
  const std::string& address() const;

 private:
  class Serving;
  std::unique_ptr<Serving> serving_;
};

}  // namespace kinesphere::program
