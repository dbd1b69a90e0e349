// Streams of NATS: what comes in on a subject, and alerts that go out on one.
#pragma once

#include <memory>

#include "watch/alert_output.hpp"
#include "watch/nats/nats_address.hpp"
#include "watch/report_source.hpp"
#include "watch/stop_signals.hpp"

namespace kinesphere::program {

/// What comes in on a subject, which may have wildcards. Where a stream of JetStream holds it, all of that is
/// read in order from `from` on, if that is in it, or from the begin: nothing is lost as long as it is there,
/// whoever is stopped and started again meanwhile. Otherwise it is what comes while this program is
/// connected. With `keeps_time` a message without content is sent to the subject (in place of wildcards
/// stands "tick") when nothing has come for a second: then all that read it know that time has passed. Throws
/// ProgramError.
std::unique_ptr<ReportSource> make_nats_source(const NatsAddress& address, const StopSignals& stop,
                                               bool keeps_time, bool is_quiet, const StreamPlace* from);

/// Alerts of share k go to SUBJECT.k, counted from 1, a message each. Where a stream of JetStream holds that
/// subject each is there once, whoever else tells the same alerts, and however often it is told again: with
/// each goes, in the header Kinesphere-Told, at which place of the stream of reports it came, which of the
/// alerts of that place it is, and `origin`, a word for what was read and how it was judged. Alerts of one
/// origin come in the order of the other two; those of another come behind them. Throws ProgramError.
std::unique_ptr<AlertOutput> make_nats_alerts(const NatsAddress& address, const StopSignals& stop,
                                              bool is_quiet, const std::string& origin);

}  // namespace kinesphere::program
