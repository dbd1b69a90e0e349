// A web server that only this machine can reach.
#include "serving/local_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "serving/client_connection.hpp"

namespace kinesphere::program {
namespace {

/// Maximum open connections. A browser opens six; each costs up to 0.5 MB, mostly in the kernel.
constexpr std::size_t max_connections = 64;
/// Maximum bytes of content made for single clients. The state of 20,000 tracks has 7 MB.
constexpr std::size_t max_owned_bytes = std::size_t{64} << 20;
/// Bytes of the kernel's send buffer of a connection, which would otherwise grow to several MB.
constexpr int send_buffer = 1 << 18;
constexpr int request_buffer = 1 << 15;

/// Blocks all signals for this thread, and for threads that it starts meanwhile, until destruction.
class SignalsHeldOff {
 public:
  SignalsHeldOff() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldOff() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeldOff(const SignalsHeldOff&) = delete;
  SignalsHeldOff& operator=(const SignalsHeldOff&) = delete;

 private:
  sigset_t before_;
};

/// Returns a listening socket that does not block, or one that is not open if the port is taken.
FileDescriptor listen_on(int port) {
  FileDescriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener.is_open()) return listener;
  const int yes = 1;
  ::setsockopt(listener.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  ::setsockopt(listener.number(), SOL_SOCKET, SO_SNDBUF, &send_buffer, sizeof send_buffer);
  ::setsockopt(listener.number(), SOL_SOCKET, SO_RCVBUF, &request_buffer, sizeof request_buffer);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(listener.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.number(), SOMAXCONN) != 0)
    return FileDescriptor();
  return listener;
}

int port_of(const FileDescriptor& listener) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(listener.number(), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

const char* reason_of(HttpStatus status) {
  switch (status) {
    case HttpStatus::ok:
      return "OK";
    case HttpStatus::bad_request:
      return "Bad Request";
    case HttpStatus::forbidden:
      return "Forbidden";
    case HttpStatus::not_found:
      return "Not Found";
    case HttpStatus::method_not_allowed:
      return "Method Not Allowed";
    case HttpStatus::head_too_large:
      return "Request Header Fields Too Large";
    case HttpStatus::internal_error:
      return "Internal Server Error";
  }
  return "";
}

}  // namespace

class LocalServer::Serving {
 public:
  Serving(std::string option, const std::string& policy)
      : option_(std::move(option)),
        fields_(fmt::format("Cache-Control: no-cache\r\nX-Content-Type-Options: nosniff\r\n"
                            "Cross-Origin-Resource-Policy: same-origin\r\nContent-Security-Policy: {}\r\n"
                            "Connection: close\r\n",
                            policy)) {}
  ~Serving() {
    if (!thread_.joinable()) return;
    stop_writer_ = FileDescriptor();
    thread_.join();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  ServedContent& content() { return content_; }
  const std::string& address() const { return address_; }

  void start(int wanted) {
    listener_ = listen_on(wanted);
    int ends[2];
    if (!listener_.is_open() || ::pipe2(ends, O_CLOEXEC) != 0)
      throw ProgramError(
          fmt::format("{}: expected a port of 127.0.0.1 that is free, but {} is not", option_, wanted));
    stop_reader_ = FileDescriptor(ends[0]);
    stop_writer_ = FileDescriptor(ends[1]);
    port_ = port_of(listener_);
    address_ = fmt::format("http://127.0.0.1:{}/", port_);
    const SignalsHeldOff held_off;
    thread_ = std::thread([this] { run(); });
  }

 private:
  using Clock = ClientConnection::Clock;

  /// Serves until the other end of stop_reader_ is closed.
  void run() {
    std::vector<pollfd> polled;
    while (true) {
      polled.assign({{.fd = stop_reader_.number(), .events = POLLIN, .revents = 0},
                     {.fd = listener_.number(), .events = POLLIN, .revents = 0}});
      for (const ClientConnection& connection : connections_)
        polled.push_back({.fd = connection.socket(), .events = connection.events(), .revents = 0});
      ::poll(polled.data(), polled.size(), milliseconds_to_next_deadline());
      if (polled[0].revents != 0) return;
      advance_connections(polled);
      if (polled[1].revents != 0) accept_connections();
    }
  }

  /// Returns -1, for no limit, if there are no connections.
  int milliseconds_to_next_deadline() const {
    if (connections_.empty()) return -1;
    auto next = Clock::time_point::max();
    for (const ClientConnection& connection : connections_) next = std::min(next, connection.deadline());
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
    return static_cast<int>(std::max(left.count(), std::chrono::milliseconds::rep{0}));
  }

  /// Precondition: `polled` has the connections from its third entry on.
  void advance_connections(const std::vector<pollfd>& polled) {
    for (std::size_t k = 0; k < connections_.size(); ++k) {
      ClientConnection& connection = connections_[k];
      if (polled[k + 2].revents != 0 && connection.is_open()) advance(connection);
      if (Clock::now() >= connection.deadline()) connection.close();
      if (connection.owned_bytes() > 0) give_up_others_for(connection);
    }
    std::erase_if(connections_, [](const ClientConnection& each) { return !each.is_open(); });
  }

  void advance(ClientConnection& connection) const {
    try {
      connection.advance([this](std::string_view head) { return respond(head); });
    } catch (const std::exception&) {
      connection.close();
    }
  }

  /// Closes connections that own content, the oldest first, until all own no more than max_owned_bytes or
  /// only `kept` is left.
  void give_up_others_for(const ClientConnection& kept) {
    std::size_t owned = 0;
    for (const ClientConnection& each : connections_) owned += each.owned_bytes();
    for (ClientConnection& each : connections_) {
      if (owned <= max_owned_bytes) return;
      if (&each == &kept || each.owned_bytes() == 0) continue;
      owned -= each.owned_bytes();
      each.close();
    }
  }

  /// Accepts connections up to the maximum; more wait until all open ones have been served once.
  void accept_connections() {
    for (std::size_t k = 0; k < max_connections; ++k) {
      FileDescriptor socket(::accept4(listener_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (!socket.is_open()) {
        if (is_out_of_resources()) make_room();
        return;
      }
      if (connections_.size() == max_connections) connections_.erase(connections_.begin());
      connections_.emplace_back(std::move(socket));
    }
  }

  static bool is_out_of_resources() {
    return errno == EMFILE || errno == ENFILE || errno == ENOMEM || errno == ENOBUFS;
  }

  /// Closes the oldest connection or, if other processes hold the descriptors, waits a little.
  void make_room() {
    if (connections_.empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    else
      connections_.erase(connections_.begin());
  }

  HttpResponse respond(std::string_view head) const {
    if (head.size() > ClientConnection::max_head) return refusal(HttpStatus::head_too_large);
    const auto parsed = parse_http_request(head, port_);
    if (const auto* const status = std::get_if<HttpStatus>(&parsed)) return refusal(*status);
    const auto& request = std::get<HttpRequest>(parsed);
    try {
      auto content = content_.find(request.path);
      if (!content) return refusal(HttpStatus::not_found);
      HttpResponse response{.head = head_of(HttpStatus::ok, content->body->size(), content->type),
                            .content = std::move(*content)};
      if (request.is_head) response.content = {};
      return response;
    } catch (const std::exception&) {
      return refusal(HttpStatus::internal_error);
    }
  }

  /// Returns a response without a body.
  HttpResponse refusal(HttpStatus status) const { return {.head = head_of(status, 0, ""), .content = {}}; }

  std::string head_of(HttpStatus status, std::size_t length, const std::string& type) const {
    return fmt::format("HTTP/1.1 {} {}\r\n{}{}{}Content-Length: {}\r\n\r\n", static_cast<int>(status),
                       reason_of(status), fields_,
                       status == HttpStatus::method_not_allowed ? "Allow: GET, HEAD\r\n" : "",
                       type.empty() ? "" : fmt::format("Content-Type: {}\r\n", type), length);
  }

  std::string option_;
  std::string fields_;  ///< header fields of every response
  ServedContent content_;
  std::string address_;
  int port_ = 0;
  FileDescriptor listener_, stop_reader_, stop_writer_;
  std::vector<ClientConnection> connections_;  ///< the oldest first
  std::thread thread_;
};

void LocalServer::serve(const std::string& address, const std::string& type, const std::string& content) {
  serving_->content().add_page(address, type, content);
}

void LocalServer::serve(const std::string& address, const std::string& type,
                        std::function<std::string()> content) {
  serving_->content().add_page(address, type, std::move(content));
}

bool LocalServer::serve_folder(const std::string& address, const std::string& folder) {
  return serving_->content().add_folder(address, folder);
}

LocalServer::LocalServer(std::string option, const std::string& content_security_policy)
    : serving_(std::make_unique<Serving>(std::move(option), content_security_policy)) {}
LocalServer::~LocalServer() = default;
void LocalServer::start(int port) { serving_->start(port); }
const std::string& LocalServer::address() const { return serving_->address(); }

}  // namespace kinesphere::program
