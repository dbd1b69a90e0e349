// A TCP connection that sends any bytes, including ones that no HTTP client would.
#pragma once

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// A connection to a port of 127.0.0.1. Closing it resets it, so that no TIME_WAIT remains and fuzzers do not
/// run out of ports.
class RawConnection {
 public:
  /// `patience` is the timeout of each send and each read, in seconds.
  explicit RawConnection(int port, int patience = 10)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval limit{.tv_sec = patience, .tv_usec = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    const linger reset{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    const int yes = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // A signal such as libFuzzer's alarm interrupts the call; another call then waits for this connection.
    int result;
    do {
      result = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    } while (result != 0 && errno == EINTR);
    is_open_ = result == 0 || errno == EISCONN;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  bool is_open() const { return is_open_; }
  /// Returns how many of the bytes went out before the server closed the connection, or the timeout.
  std::size_t send(std::string_view bytes) const {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      sent += static_cast<std::size_t>(count);
    }
    return sent;
  }
  /// Ends the stream to the server; its response can still be read.
  void end() const { ::shutdown(socket_, SHUT_WR); }
  /// Reads until the server closes the connection.
  std::string response() const {
    std::string text;
    char piece[1 << 16];
    while (true) {
      const ssize_t count = ::recv(socket_, piece, sizeof piece, 0);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      text.append(piece, static_cast<std::size_t>(count));
    }
    return text;
  }

 private:
  int socket_;
  bool is_open_ = false;
};

/// Returns the body of a response, "" if it has none.
inline std::string body_of(const std::string& response) {
  const std::size_t end = response.find("\r\n\r\n");
  return end == std::string::npos ? "" : response.substr(end + 4);
}

/// Returns the status of a response, 0 if it is none.
inline int status_of(const std::string& response) {
  return response.starts_with("HTTP/1.1 ") && response.size() > 12 ? std::atoi(response.c_str() + 9) : 0;
}

}  // namespace kinesphere::program
