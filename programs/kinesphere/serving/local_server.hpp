// A web server for this machine alone.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace kinesphere::program {

/// Answers on 127.0.0.1 from threads of its own, to requests that name this machine, with what it was given.
/// Nothing is compressed: that would take longer than to read it. Addresses are regular expressions.
class LocalServer {
 public:
  /// `option` is that of the command line which asks for the server; errors name it. Throws ProgramError
  /// where the program was built without cpp-httplib.
  LocalServer(std::string option, const std::string& content_security_policy);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  // To be called before start().

  /// `content` must live as long as the server; it is not copied.
  void serve(const std::string& address, const std::string& type, const std::string& content);
  void serve(const std::string& address, const std::string& type, std::string&& content) = delete;
  /// `content` is called for each request, in one of the server's threads.
  void serve(const std::string& address, const std::string& type, std::function<std::string()> content);
  /// The files of a folder, below an address that is a plain path. False where there is no such folder.
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
