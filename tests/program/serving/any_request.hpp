// Any bytes as a request to a real server: what fuzz_http and the replay of its corpus have in common.
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

/// A running LocalServer with every kind of content: fixed, made for each request, empty, long, thrown away,
/// and files. Its folder goes with it.
class AttackedServer {
 public:
  AttackedServer();
  ~AttackedServer();
  AttackedServer(const AttackedServer&) = delete;
  AttackedServer& operator=(const AttackedServer&) = delete;

  /// Sends bytes over one connection and looks at all that comes back. The first byte says after how many the
  /// rest is sent apart; "$PORT" in the rest stands for the port. Returns what is wrong with the response, if
  /// anything.
  std::optional<std::string> complaint(std::span<const unsigned char> bytes);
  /// The response to the latest input.
  const std::string& response() const { return response_; }

 private:
  std::filesystem::path folder_;
  /// Each is a block of memory of exactly its size, so that the address sanitizer sees what is read beyond
  /// it.
  std::unique_ptr<const std::string> page_, empty_, long_page_;
  std::unique_ptr<LocalServer> server_;
  int port_ = 0;
  std::string response_;
};

}  // namespace kinesphere::program
