// Sends alerts to subjects of NATS.
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <compare>
#include <thread>
#include <unordered_map>
#include <vector>

#include "base/program_error.hpp"
#include "watch/nats/nats_connection.hpp"
#include "watch/nats/nats_streams.hpp"

namespace kinesphere::program {
namespace {

constexpr const char* position_header = "Kinesphere-Told";

/// The origin of an alert: the place in the stream of reports, and its number among the alerts of its share
/// there.
struct AlertPosition {
  std::uint64_t position = 0;
  std::uint64_t number = 0;

  friend auto operator<=>(const AlertPosition&, const AlertPosition&) = default;
};

std::string text_of(const AlertPosition& of, const std::string& origin) {
  return fmt::format("{} {} {}", of.position, of.number, origin);
}

/// A message of another origin is no evidence of earlier alerts of this one.
AlertPosition position_of(natsMsg* message, const std::string& origin) {
  const char* text = nullptr;
  if (natsMsgHeader_Get(message, position_header, &text) != NATS_OK) return {};
  AlertPosition found;
  const char* const end = text + std::char_traits<char>::length(text);
  auto after = std::from_chars(text, end, found.position);
  if (after.ptr != end) after = std::from_chars(after.ptr + 1, end, found.number);
  return std::string_view(after.ptr, end) == " " + origin ? found : AlertPosition{};
}

class NatsAlerts final : public AlertOutput {
 public:
  NatsAlerts(const NatsAddress& address, const StopSignals& stop, bool is_quiet, std::string origin)
      : connection_(address, is_quiet),
        stop_(stop),
        origin_(std::move(origin)),
        stream_(connection_.stream_of(address.subject + ".*")) {
    if (!stream_)
      connection_.warn(
          "no stream of JetStream holds what is below it: alerts reach those who listen, and may reach them "
          "twice");
  }

  void write(std::uint64_t share, std::string_view line) override {
    if (line.ends_with('\n')) line.remove_suffix(1);
    waiting_.push_back({share, std::string(line)});
  }

  void flush(std::uint64_t position) override {
    for (const Waiting& alert : waiting_) {
      Share& share = share_of(alert.share);
      share.next = share.next.position == position ? AlertPosition{position, share.next.number + 1}
                                                   : AlertPosition{position, 1};
      if (stream_)
        send_once(share, alert.line);
      else
        send(share.subject, alert.line);
    }
    if (!stream_ && !waiting_.empty()) natsConnection_FlushTimeout(connection_.get(), 5000);
    waiting_.clear();
  }
  AlertsPlace sync() override { return {}; }

 private:
  struct Waiting {
    std::uint64_t share;
    std::string line;
  };
  struct Share {
    std::string subject;
    AlertPosition next{};             ///< origin of the alert being sent
    AlertPosition last{};             ///< origin of the last alert, from any sender
    std::uint64_t last_sequence = 0;  ///< its number in the stream of alerts
  };

  Share& share_of(std::uint64_t number) {
    const auto [at, is_new] = shares_.try_emplace(number);
    if (is_new) {
      at->second.subject = fmt::format("{}.{}", connection_.address().subject, number + 1);
      if (stream_) find_last(at->second);
    }
    return at->second;
  }

  /// Repeats until the server answers.
  void find_last(Share& share) {
    for (;;) {
      natsMsg* got = nullptr;
      const natsStatus status = js_GetLastMsg(&got, connection_.jetstream(), stream_->c_str(),
                                              share.subject.c_str(), nullptr, nullptr);
      const NatsMessage message(got);
      if (status == NATS_OK) {
        share.last = position_of(got, origin_);
        share.last_sequence = natsMsg_GetSequence(got);
        return;
      }
      if (status == NATS_NOT_FOUND) {
        share.last = {};
        share.last_sequence = 0;
        return;
      }
      wait_for_server(share, status);
    }
  }

  /// Publishes an alert if the share's last message is still the expected one; so the server accepts it from
  /// one sender only.
  void send_once(Share& share, const std::string& line) {
    while (share.last < share.next) {
      NatsMessage message = message_of(share.subject, line);
      natsMsgHeader_Set(message.get(), position_header, text_of(share.next, origin_).c_str());
      natsMsgHeader_Set(message.get(), "Nats-Expected-Last-Subject-Sequence",
                        fmt::to_string(share.last_sequence).c_str());
      jsPubAck* got = nullptr;
      jsErrCode code{};
      const natsStatus status = js_PublishMsg(&got, connection_.jetstream(), message.get(), nullptr, &code);
      const std::unique_ptr<jsPubAck, NatsDelete<jsPubAck_Destroy>> ack(got);
      if (status == NATS_OK) {
        share.last = share.next;
        share.last_sequence = ack->Sequence;
        failing_since_.reset();
        is_failure_told_ = false;
        return;
      }
      // Another sender has published an alert. It may be this program itself, if it missed the server's
      // answer.
      if (code != JSStreamWrongLastSequenceErr) wait_for_server(share, status);
      find_last(share);
    }
  }

  void send(const std::string& subject, const std::string& line) {
    const NatsMessage message = message_of(subject, line);
    if (const auto status = natsConnection_PublishMsg(connection_.get(), message.get()); status != NATS_OK)
      connection_.fail(status, "cannot send an alert");
  }

  NatsMessage message_of(const std::string& subject, const std::string& line) const {
    natsMsg* made = nullptr;
    const natsStatus status =
        natsMsg_Create(&made, subject.c_str(), nullptr, line.data(), static_cast<int>(line.size()));
    if (status != NATS_OK) connection_.fail(status, "cannot send an alert");
    return NatsMessage(made);
  }

  void wait_for_server(const Share& share, natsStatus status) {
    if (stop_.asked()) connection_.fail(status, "alerts cannot be sent");
    connection_.check_open();
    // A restarted server needs some time.
    constexpr std::chrono::seconds patience(2);
    const auto now = std::chrono::steady_clock::now();
    if (!failing_since_) failing_since_ = now;
    if (!is_failure_told_ && now - *failing_since_ > patience) {
      connection_.warn(
          fmt::format("{}: alerts cannot be sent, but wait: {}", share.subject, natsStatus_GetText(status)));
      is_failure_told_ = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }

  NatsConnection connection_;
  const StopSignals& stop_;
  std::string origin_;
  std::optional<std::string> stream_;
  std::optional<std::chrono::steady_clock::time_point> failing_since_;
  bool is_failure_told_ = false;
  std::unordered_map<std::uint64_t, Share> shares_;
  std::vector<Waiting> waiting_;
};

}  // namespace

std::unique_ptr<AlertOutput> make_nats_alerts(const NatsAddress& address, const StopSignals& stop,
                                              bool is_quiet, const std::string& origin) {
  if (address.subject.find_first_of("*>") != std::string::npos)
    throw ProgramError(
        fmt::format("--alerts: expected a subject without wildcards, but got '{}'", address.name));
  return std::make_unique<NatsAlerts>(address, stop, is_quiet, origin);
}

}  // namespace kinesphere::program
