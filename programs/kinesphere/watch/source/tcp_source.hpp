// Reads what a server sends through a TCP connection, such as port 30003 of a receiver of ADS-B.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"

namespace kinesphere::program {

struct TcpAddress {
  std::string host;
  std::string port;
};

/// Returns true for tcp://...
bool is_tcp_address(std::string_view text);
/// Returns the parts of tcp://HOST:PORT; an address of IPv6 is in brackets. Throws ProgramError for other
/// text.
TcpAddress parse_tcp_address(std::string_view text);

/// Connects to the server, and connects again, each second, whenever the connection ends: with a warning
/// unless `is_quiet`. A record that is cut off by that does not count. Nothing is read again: what the
/// server sends meanwhile is lost. `from` is where an earlier run was, or null. Throws ProgramError if the
/// first attempt fails.
std::unique_ptr<ReportSource> make_tcp_source(const TcpAddress& address, const StopSignals& stop,
                                              bool is_quiet, const StreamPlace* from);

}  // namespace kinesphere::program
