// A web server for this machine alone.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace kinesphere::program {

/// Serves pages and files on 127.0.0.1 from one thread of its own, to requests that name this machine. It
/// knows GET and HEAD and whole contents; there are no ranges, bodies, compression or kept connections. A
/// client that is slow or hostile holds up neither others nor the program: at most 64 connections are open,
/// of which the oldest is closed for a new one; a request takes 5 s and 16 kB at most; and content made for
/// one client takes 64 MB in all, or one content if that is larger. docs/watch.md has the threat model.
///
/// Why no library: Debian's cpp-httplib 0.11 hands a thread to each connection for as long as the client
/// likes, buffers bodies before it routes, and passes unchecked ranges on.
class LocalServer {
 public:
  /// `option` is that of the command line which asks for the server; errors name it.
  LocalServer(std::string option, const std::string& content_security_policy);
  /// Closes all connections. Waits for a callback of serve() that runs, and for nothing else.
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  // To be called before start(). An address is a path, such as "/state.json".

  /// `content` must live as long as the server; it is not copied.
  void serve(const std::string& address, const std::string& type, const std::string& content);
  void serve(const std::string& address, const std::string& type, std::string&& content) = delete;
  /// `content` is called for each request, in the server's thread. What it throws is a response 500.
  void serve(const std::string& address, const std::string& type, std::function<std::string()> content);
  /// Serves the files of a folder below an address, except those with a name that begins with a dot, and its
  /// index.html at "address/". Returns false if there is no such folder.
  bool serve_folder(const std::string& address, const std::string& folder);

  /// Port 0 is any that is free. Throws ProgramError when the port is taken. Signals are for other threads.
  void start(int port);
  /// "http://127.0.0.1:PORT/", once it has started.
  const std::string& address() const;

 private:
  class Serving;
  std::unique_ptr<Serving> serving_;
};

}  // namespace kinesphere::program
