// One connection of a web server, for one request and one response.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "serving/http_request.hpp"
#include "serving/served_content.hpp"

namespace kinesphere::program {

/// A file descriptor with unique ownership.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

/// The bytes to send: a head, then a body.
struct HttpResponse {
  std::string head;
  Content content;  ///< `body` may be null, for no body
};

/// A connection with a non-blocking socket. It reads a head of at most max_head bytes, sends one response,
/// discards further input, and closes. Memory: about max_head, the head of the response, and its content.
class ClientConnection {
 public:
  using Clock = std::chrono::steady_clock;
  /// Returns the response to the head of a request. `head` is truncated, and longer than max_head, if the
  /// client's is too long.
  using Respond = std::function<HttpResponse(std::string_view head)>;

  /// Browsers send cookies of all ports of this machine: heads of a few kB are usual.
  static constexpr std::size_t max_head = 16384;
  /// Limit from the connection's begin to the end of the request's head.
  static constexpr std::chrono::seconds head_time{5};
  /// The client must take at least one more byte of the response within this time.
  static constexpr std::chrono::seconds stall_time{10};
  /// Time for the client to read its response and close; further input is discarded.
  static constexpr std::chrono::milliseconds drain_time{500};

  explicit ClientConnection(FileDescriptor socket);

  int socket() const { return socket_.number(); }
  bool is_open() const { return socket_.is_open(); }
  /// Events for poll() to wait for.
  short events() const;
  /// Time at which the connection must be closed.
  Clock::time_point deadline() const { return deadline_; }
  /// Bytes of the content that is kept for this client alone.
  std::size_t owned_bytes() const { return response_.content.owned_bytes; }

  /// Reads and sends as far as the socket allows without waiting, at most 1 MB. Closes the connection if it
  /// is finished or broken. Throws what `respond` throws.
  void advance(const Respond& respond);
  /// Closes the socket and drops the rest of the response.
  void close();

 private:
  enum class Stage { head, response, drain };

  void read_head(const Respond& respond);
  void send_response();
  void discard();
  void start_response(HttpResponse response);
  void finish_response();

  FileDescriptor socket_;
  Stage stage_ = Stage::head;
  Clock::time_point deadline_;
  std::string head_;
  HttpResponse response_;
  std::size_t sent_ = 0;  ///< bytes of the head and the body
  std::size_t discarded_ = 0;
};

}  // namespace kinesphere::program
