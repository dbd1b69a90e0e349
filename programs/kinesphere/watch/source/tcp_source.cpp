// Reads what a server sends through a TCP connection.
#include "watch/source/tcp_source.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program {
namespace {

using namespace std::chrono_literals;
using SteadyTime = std::chrono::steady_clock::time_point;

constexpr std::string_view tcp_scheme = "tcp://";
constexpr auto retry_interval = 1s;
/// An address that does not answer for so long does not count.
constexpr auto connect_patience = 10s;

/// Lets the kernel find out within a minute that the other machine is gone.
void keep_alive(int descriptor) {
  const int yes = 1;
  ::setsockopt(descriptor, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof yes);
#if defined(TCP_KEEPIDLE) && defined(TCP_KEEPINTVL) && defined(TCP_KEEPCNT)
  const int idle = 30, interval = 10, probes = 3;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPCNT, &probes, sizeof probes);
#endif
}

class TcpSource final : public ReportSource {
 public:
  TcpSource(const TcpAddress& address, const StopSignals& stop, bool is_quiet, const StreamPlace* from)
      : address_(address), stop_(stop), is_quiet_(is_quiet) {
    if (from != nullptr && from->stream == name()) handed_over_ = from->position;
    for (begin_attempt(); !is_connected_ && !stop_.asked(); go_on_connecting(1000ms))
      if (descriptor_ < 0) throw ProgramError(fmt::format("{}: cannot connect: {}", name(), reason_));
  }
  ~TcpSource() override { close(); }
  TcpSource(const TcpSource&) = delete;
  TcpSource& operator=(const TcpSource&) = delete;

  Outcome next(std::chrono::milliseconds patience, std::string_view& text) override {
    if (!is_connected_) {
      connect_again(patience);
      return Outcome::quiet;
    }
    if (!wait_for(POLLIN, patience)) return Outcome::quiet;
    const auto got = ::recv(descriptor_, buffer_.data(), buffer_.size(), 0);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) return Outcome::quiet;
    if (got <= 0) {
      lose_connection(got == 0 ? "the server has ended it" : std::strerror(errno));
      return Outcome::cut;
    }
    text = {buffer_.data(), static_cast<std::size_t>(got)};
    handed_over_ += text.size();
    return Outcome::text;
  }
  std::uint64_t position(std::size_t without) const override { return handed_over_ - without; }
  std::string name() const override {
    const bool has_brackets = address_.host.find(':') != std::string::npos;
    return fmt::format("tcp://{}{}{}:{}", has_brackets ? "[" : "", address_.host, has_brackets ? "]" : "",
                       address_.port);
  }

 private:
  /// Waits until the socket is ready; false if it is not in time, or the program is asked to stop.
  bool wait_for(short events, std::chrono::milliseconds patience) const {
    pollfd ready[2] = {{descriptor_, events, 0}, {stop_.descriptor(), POLLIN, 0}};
    return ::poll(ready, 2, static_cast<int>(patience.count())) > 0 && ready[0].revents != 0;
  }

  /// Tries all addresses of the host, one after the other.
  void begin_attempt() {
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (const int error = ::getaddrinfo(address_.host.c_str(), address_.port.c_str(), &hints, &found);
        error != 0) {
      fail_attempt(::gai_strerror(error));
      return;
    }
    addresses_.reset(found);
    next_address_ = found;
    connect_to_next();
  }
  void connect_to_next() {
    for (; next_address_ != nullptr; next_address_ = next_address_->ai_next) {
      const addrinfo& to = *next_address_;
      close();
      descriptor_ = ::socket(to.ai_family, to.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, to.ai_protocol);
      if (descriptor_ >= 0 &&
          (::connect(descriptor_, to.ai_addr, to.ai_addrlen) == 0 || errno == EINPROGRESS)) {
        next_address_ = to.ai_next;
        given_up_at_ = std::chrono::steady_clock::now() + connect_patience;
        return;
      }
      reason_ = std::strerror(errno);
    }
    fail_attempt(reason_);
  }
  void fail_attempt(std::string reason) {
    close();
    reason_ = std::move(reason);
    next_attempt_ = std::chrono::steady_clock::now() + retry_interval;
  }
  void go_on_connecting(std::chrono::milliseconds patience) {
    if (!wait_for(POLLOUT, patience)) {
      if (std::chrono::steady_clock::now() < given_up_at_) return;
      reason_ = std::strerror(ETIMEDOUT);
      connect_to_next();
      return;
    }
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error, &size);
    if (error != 0) {
      reason_ = std::strerror(error);
      connect_to_next();
      return;
    }
    is_connected_ = true;
    keep_alive(descriptor_);
  }

  void lose_connection(std::string_view reason) {
    close();
    next_attempt_ = std::chrono::steady_clock::now() + retry_interval;
    if (!is_quiet_)
      print_message("kinesphere: warning: {}: the connection is lost ({}): trying again each second\n",
                    name(), reason);
  }
  void connect_again(std::chrono::milliseconds patience) {
    if (descriptor_ >= 0) {
      go_on_connecting(patience);
      if (is_connected_ && !is_quiet_) print_message("kinesphere: {}: connected again\n", name());
      return;
    }
    const auto wait =
        std::chrono::ceil<std::chrono::milliseconds>(next_attempt_ - std::chrono::steady_clock::now());
    if (wait > 0ms)
      wait_for(0, std::min(wait, patience));
    else
      begin_attempt();
  }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    is_connected_ = false;
  }

  struct Free {
    void operator()(addrinfo* addresses) const { ::freeaddrinfo(addresses); }
  };

  TcpAddress address_;
  const StopSignals& stop_;
  bool is_quiet_;
  int descriptor_ = -1;
  bool is_connected_ = false;
  std::unique_ptr<addrinfo, Free> addresses_;
  addrinfo* next_address_ = nullptr;
  std::string reason_;  ///< why the last attempt failed
  SteadyTime given_up_at_{}, next_attempt_{};
  std::array<char, 1 << 16> buffer_;
  std::uint64_t handed_over_ = 0;
};

}  // namespace

bool is_tcp_address(std::string_view text) { return text.starts_with(tcp_scheme); }

TcpAddress parse_tcp_address(std::string_view text) {
  const std::string_view rest = text.substr(tcp_scheme.size());
  const std::size_t colon = std::min(rest.rfind(':'), rest.size());
  std::string_view host = rest.substr(0, colon), port = rest.substr(std::min(colon + 1, rest.size()));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  const double number = parse_number(port).value_or(0.0);
  const bool is_port =
      port.find_first_not_of("0123456789") == port.npos && number >= 1.0 && number <= 65535.0;
  if (host.empty() || !is_port)
    throw ProgramError(fmt::format(
        "FILE: expected an address tcp://HOST:PORT, as tcp://192.168.1.7:30003, but got '{}'", text));
  return {std::string(host), std::string(port)};
}

std::unique_ptr<ReportSource> make_tcp_source(const TcpAddress& address, const StopSignals& stop,
                                              bool is_quiet, const StreamPlace* from) {
  return std::make_unique<TcpSource>(address, stop, is_quiet, from);
}

}  // namespace kinesphere::program
