// Replaces NATS if its library is not installed.
#include <fmt/format.h>

#include "base/program_error.hpp"
#include "watch/nats/nats_streams.hpp"

namespace kinesphere::program {
namespace {

[[noreturn]] void refuse(const NatsAddress& address) {
  throw ProgramError(
      fmt::format("{}: this program was built without the library of NATS (libnats-dev)", address.name));
}

}  // namespace

std::unique_ptr<ReportSource> make_nats_source(const NatsAddress& address, const StopSignals&, bool, bool,
                                               const StreamPlace*) {
  refuse(address);
}
std::unique_ptr<AlertOutput> make_nats_alerts(const NatsAddress& address, const StopSignals&, bool,
                                              const std::string&) {
  refuse(address);
}

}  // namespace kinesphere::program
