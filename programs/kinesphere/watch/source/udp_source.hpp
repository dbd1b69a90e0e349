// Reads the datagrams that programs of this machine send to a UDP port.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"

namespace kinesphere::program {

/// Returns true for udp:...
bool is_udp_address(std::string_view text);
/// Returns the port of udp://127.0.0.1:PORT, udp://localhost:PORT, or either without the slashes. Port 0 is
/// any that is free. Throws ProgramError for other text: datagrams from other machines are not taken, because
/// nothing shows who sent them.
std::uint16_t parse_udp_address(std::string_view text);

/// Receives at the port of 127.0.0.1. Each datagram has whole records, and at least one. Nothing is read
/// again: what comes while the program does not run is lost; what comes faster than it is read is lost, with
/// a warning unless `is_quiet`. The port is printed if any free one was asked for. Throws ProgramError.
std::unique_ptr<ReportSource> make_udp_source(std::uint16_t port, const StopSignals& stop, bool is_quiet);

}  // namespace kinesphere::program
