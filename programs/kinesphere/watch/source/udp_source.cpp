// Reads the datagrams that programs of this machine send to a UDP port.
#include "watch/source/udp_source.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <vector>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view udp_scheme = "udp:";
constexpr std::size_t longest_datagram = 65'536;
/// Bytes that the kernel keeps of a burst: about 40,000 sentences. It may allow less.
constexpr int receive_buffer = 1 << 23;

class UdpSource final : public ReportSource {
 public:
  UdpSource(std::uint16_t port, const StopSignals& stop, bool is_quiet)
      : stop_(stop), is_quiet_(is_quiet), port_(port), buffer_(longest_datagram + 1) {
    descriptor_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (descriptor_ < 0) fail();
    const int yes = 1;
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RXQ_OVFL, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
        ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      const int error = errno;
      ::close(descriptor_);
      errno = error;
      fail();
    }
    port_ = ntohs(address.sin_port);
    if (port == 0) print_message("kinesphere: reading {}\n", name());
  }
  ~UdpSource() override { ::close(descriptor_); }
  UdpSource(const UdpSource&) = delete;
  UdpSource& operator=(const UdpSource&) = delete;

  Outcome next(std::chrono::milliseconds patience, std::string_view& text) override {
    pollfd ready[2] = {{descriptor_, POLLIN, 0}, {stop_.descriptor(), POLLIN, 0}};
    const int count = ::poll(ready, 2, static_cast<int>(patience.count()));
    if (count < 0 && errno != EINTR) fail();
    if (count <= 0 || ready[0].revents == 0) return Outcome::quiet;
    const auto got = receive();
    if (got < 0) {
      if (errno == EINTR || errno == EAGAIN) return Outcome::quiet;
      fail();
    }
    ++datagrams_;
    auto size = static_cast<std::size_t>(got);
    if (size == 0) return Outcome::quiet;
    if (buffer_[size - 1] != '\n') buffer_[size++] = '\n';
    text = {buffer_.data(), size};
    return Outcome::text;
  }
  std::uint64_t position(std::size_t) const override { return datagrams_; }
  bool has_whole_records() const override { return true; }
  std::string name() const override { return fmt::format("udp://127.0.0.1:{}", port_); }

 private:
  /// Returns the size of the next datagram, which is then in the buffer, as recvmsg() does.
  ssize_t receive() {
    iovec place{buffer_.data(), longest_datagram};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(std::uint32_t))];
    msghdr message{};
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    const auto got = ::recvmsg(descriptor_, &message, 0);
    if (got < 0) return got;
    for (cmsghdr* field = CMSG_FIRSTHDR(&message); field != nullptr; field = CMSG_NXTHDR(&message, field)) {
      if (field->cmsg_level != SOL_SOCKET || field->cmsg_type != SO_RXQ_OVFL) continue;
      std::uint32_t lost = 0;
      std::memcpy(&lost, CMSG_DATA(field), sizeof lost);
      warn_of_lost(lost);
    }
    return got;
  }

  void warn_of_lost(std::uint32_t lost) {
    if (lost == lost_) return;
    // One warning for each doubling.
    if (!is_quiet_ && lost >= 2 * warned_)
      print_message(
          "kinesphere: warning: {}: {} datagrams are lost by now: they come faster than they are read\n",
          name(), lost);
    if (lost >= 2 * warned_) warned_ = lost;
    lost_ = lost;
  }

  [[noreturn]] void fail() const {
    throw ProgramError(fmt::format("{}: cannot read: {}", name(), std::strerror(errno)));
  }

  const StopSignals& stop_;
  bool is_quiet_;
  int descriptor_ = -1;
  std::uint16_t port_;
  std::vector<char> buffer_;
  std::uint64_t datagrams_ = 0;
  std::uint32_t lost_ = 0, warned_ = 0;
};

}  // namespace

bool is_udp_address(std::string_view text) { return text.starts_with(udp_scheme); }

std::uint16_t parse_udp_address(std::string_view text) {
  std::string_view rest = text.substr(udp_scheme.size());
  if (rest.starts_with("//")) rest.remove_prefix(2);
  const std::string_view host = rest.substr(0, rest.find(':'));
  const std::string_view digits = rest.substr(std::min(host.size() + 1, rest.size()));
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  const bool is_port = error == std::errc() && end == digits.data() + digits.size();
  if ((host != "127.0.0.1" && host != "localhost") || !is_port)
    throw ProgramError(fmt::format(
        "FILE: expected a UDP port of this machine alone, udp://127.0.0.1:PORT, but got '{}'", text));
  return port;
}

std::unique_ptr<ReportSource> make_udp_source(std::uint16_t port, const StopSignals& stop, bool is_quiet) {
  return std::make_unique<UdpSource>(port, stop, is_quiet);
}

}  // namespace kinesphere::program
