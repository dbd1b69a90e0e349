// Sends any bytes as a request to a real server, for fuzz_http and the replay of its corpus.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "serving/local_server.hpp"

namespace kinesphere::program {

/// A running LocalServer with every kind of content: fixed, made for each request, empty, long, dropped, and
/// files. Removes its folder at destruction.
class AttackedServer {
 public:
  AttackedServer();
  ~AttackedServer();
  AttackedServer(const AttackedServer&) = delete;
  AttackedServer& operator=(const AttackedServer&) = delete;

  /// Sends bytes over one connection and checks the response. The first byte is the number of bytes after
  /// which the rest is sent separately; "$PORT" in the rest stands for the port. Returns the defect of the
  /// response, if any.
  std::optional<std::string> complaint(std::span<const unsigned char> bytes);
  /// Returns the response to the latest input.
  const std::string& response() const { return response_; }

 private:
  std::filesystem::path folder_;
  /// Each is a memory block of exactly its size, so that the address sanitizer detects reads beyond it.
  std::unique_ptr<const std::string> page_, empty_, long_page_;
  std::unique_ptr<LocalServer> server_;
  int port_ = 0;
  std::string response_;
};

}  // namespace kinesphere::program
