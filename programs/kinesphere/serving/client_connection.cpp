// One connection of a web server, for one request and one response.
#include "serving/client_connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace kinesphere::program {
namespace {

constexpr std::string_view head_end = "\r\n\r\n";
/// Bytes after a request, at which a client that goes on sending is reset.
constexpr std::size_t max_discarded = 1 << 20;
/// Bytes that are sent before other connections have their turn.
constexpr std::size_t max_sent_at_once = 1 << 20;

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (is_open()) ::close(number_);
}
FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

ClientConnection::ClientConnection(FileDescriptor socket)
    : socket_(std::move(socket)), deadline_(Clock::now() + head_time) {}

short ClientConnection::events() const { return stage_ == Stage::response ? POLLOUT : POLLIN; }

void ClientConnection::advance(const Respond& respond) {
  switch (stage_) {
    case Stage::head:
      return read_head(respond);
    case Stage::response:
      return send_response();
    case Stage::drain:
      return discard();
  }
}

void ClientConnection::close() {
  socket_ = FileDescriptor();
  response_ = {};
}

void ClientConnection::read_head(const Respond& respond) {
  char bytes[4096];
  const ssize_t count = ::recv(socket(), bytes, sizeof bytes, 0);
  if (count < 0 && would_block()) return;
  if (count <= 0) return close();
  // The end may have begun in earlier bytes.
  const std::size_t from = head_.size() - std::min(head_.size(), head_end.size() - 1);
  head_.append(bytes, static_cast<std::size_t>(count));
  const std::size_t end = head_.find(head_end, from);
  const std::size_t size = end == std::string::npos ? head_.size() : end + head_end.size();
  if (end == std::string::npos && size <= max_head) return;
  start_response(respond(std::string_view(head_).substr(0, size)));
  send_response();
}

void ClientConnection::start_response(HttpResponse response) {
  response_ = std::move(response);
  head_ = std::string();
  stage_ = Stage::response;
  deadline_ = Clock::now() + stall_time;
}

void ClientConnection::send_response() {
  const std::string_view body = response_.content.body ? *response_.content.body : std::string_view();
  const std::size_t head_size = response_.head.size();
  for (std::size_t left = max_sent_at_once; left > 0;) {
    // substr() throws for a position beyond the end.
    const std::string_view rest =
        sent_ < head_size ? std::string_view(response_.head).substr(sent_) : body.substr(sent_ - head_size);
    if (rest.empty()) return finish_response();
    const ssize_t count = ::send(socket(), rest.data(), std::min(rest.size(), left), MSG_NOSIGNAL);
    if (count < 0 && would_block()) return;
    if (count < 0) return close();
    sent_ += static_cast<std::size_t>(count);
    left -= static_cast<std::size_t>(count);
    deadline_ = Clock::now() + stall_time;
  }
}

void ClientConnection::finish_response() {
  // Closing a socket with unread bytes would reset the connection, and the client might lose the response.
  ::shutdown(socket(), SHUT_WR);
  response_ = {};
  stage_ = Stage::drain;
  deadline_ = Clock::now() + drain_time;
}

void ClientConnection::discard() {
  char bytes[1 << 16];
  const ssize_t count = ::recv(socket(), bytes, sizeof bytes, 0);
  if (count < 0 && would_block()) return;
  if (count <= 0) return close();
  discarded_ += static_cast<std::size_t>(count);
  if (discarded_ > max_discarded) close();
}

}  // namespace kinesphere::program
