// NATS as a source of reports, and as a destination of alerts.
#pragma once

#include <memory>

#include "watch/nats/nats_address.hpp"
#include "watch/output/alert_output.hpp"
#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"

namespace kinesphere::program {

/// Reads the messages of a subject, which may have wildcards. If a stream of JetStream holds it, all its
/// messages are read in order, from `from` if the stream has that, else from the begin: nothing is lost while
/// the stream keeps it, across restarts of any program. Otherwise only messages that arrive while connected
/// are read. With `keeps_time` an empty message is sent to the subject ("tick" in place of wildcards) after a
/// second without messages, so that all readers learn that time has passed. Throws ProgramError.
std::unique_ptr<ReportSource> make_nats_source(const NatsAddress& address, const StopSignals& stop,
                                               bool keeps_time, bool is_quiet, const StreamPlace* from);

/// Sends alerts of share k to SUBJECT.k, counted from 1, one message each. If a stream of JetStream holds
/// that subject, each alert is stored once, however many senders publish it and however often. The header
/// Kinesphere-Told identifies it: the place in the stream of reports, its number among the alerts of that
/// place, and `origin`, a word for the input and the settings. Alerts of one origin are in the order of the
/// other two; alerts of another origin follow them. Throws ProgramError.
std::unique_ptr<AlertOutput> make_nats_alerts(const NatsAddress& address, const StopSignals& stop,
                                              bool is_quiet, const std::string& origin);

}  // namespace kinesphere::program
