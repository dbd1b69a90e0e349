// Reads the messages of a subject of NATS.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/program_error.hpp"
#include "watch/nats/nats_connection.hpp"
#include "watch/nats/nats_streams.hpp"

namespace kinesphere::program {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Interval of checks for a request to stop.
constexpr milliseconds glance(50);

/// The text of one message with a line end added, so that no record continues in the next.
class MessageText {
 public:
  std::string_view take(natsMsg* message) {
    text_.assign(natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message)));
    if (!text_.empty() && text_.back() != '\n') text_ += '\n';
    return text_;
  }

 private:
  std::string text_;
};

/// Reads messages of a subscription as they arrive.
class NatsSubjectSource final : public ReportSource {
 public:
  NatsSubjectSource(NatsConnection connection, const StopSignals& stop)
      : connection_(std::move(connection)), stop_(stop) {
    natsSubscription* subscription = nullptr;
    if (const auto status = natsConnection_SubscribeSync(&subscription, connection_.get(),
                                                         connection_.address().subject.c_str());
        status != NATS_OK)
      connection_.fail(status, "cannot subscribe");
    subscription_.reset(subscription);
    natsConnection_FlushTimeout(connection_.get(), 5000);
  }

  Outcome next(milliseconds patience, std::string_view& text) override {
    const auto until = Clock::now() + patience;
    do {
      natsMsg* got = nullptr;
      const natsStatus status = natsSubscription_NextMsg(&got, subscription_.get(), glance.count());
      const NatsMessage message(got);
      if (status == NATS_OK) {
        ++position_;
        text = text_.take(got);
        return text.empty() ? Outcome::quiet : Outcome::text;
      }
      if (status == NATS_SLOW_CONSUMER)
        warn_of_lost();
      else if (status != NATS_TIMEOUT)
        connection_.fail(status, "cannot read");
    } while (Clock::now() < until && !stop_.asked());
    return Outcome::quiet;
  }
  std::uint64_t position(std::size_t) const override { return position_; }
  bool has_whole_records() const override { return true; }
  std::string name() const override { return connection_.address().name; }

 private:
  /// Too many messages waited and some were dropped; later ones arrive.
  void warn_of_lost() const {
    std::int64_t lost = 0;
    natsSubscription_GetDropped(subscription_.get(), &lost);
    connection_.warn(fmt::format("{} messages are lost by now: they come faster than they are read", lost));
  }

  NatsConnection connection_;
  const StopSignals& stop_;
  NatsSubscription subscription_;
  MessageText text_;
  std::uint64_t position_ = 0;
};

/// Reads a stream of JetStream, message by message. The consumer lives in the server's memory and is lost
/// with it: after a missed message, or a pause although there are more, a new consumer begins behind the last
/// message.
class NatsStreamSource final : public ReportSource {
 public:
  NatsStreamSource(NatsConnection connection, std::string stream, const StopSignals& stop, bool keeps_time,
                   const StreamPlace* from)
      : connection_(std::move(connection)), stream_(std::move(stream)), stop_(stop), keeps_time_(keeps_time) {
    natsStatus status{};
    const NatsStreamInfo info = connection_.stream_info(stream_, status);
    if (!info) connection_.fail(status, "cannot ask for its stream");
    created_ = info->Created;
    // Messages from a time when no stream held the subject are not in this one.
    if (from != nullptr && from->stream == name() && from->check != 0) {
      position_ = from->position;
      if (from->check != check())
        throw ProgramError(fmt::format(
            "{}: expected the stream that the snapshot was made of, but it has been made anew since",
            name()));
      check_stream(*info);
      if (info->State.FirstSeq > position_ + 1)
        connection_.warn(fmt::format("{} messages since the snapshot are not in its stream any more",
                                     info->State.FirstSeq - position_ - 1));
    }
    subscribe();
  }
  ~NatsStreamSource() override { drop(); }
  NatsStreamSource(const NatsStreamSource&) = delete;
  NatsStreamSource& operator=(const NatsStreamSource&) = delete;

  Outcome next(milliseconds patience, std::string_view& text) override {
    const auto until = Clock::now() + patience;
    do {
      if (!subscription_) std::this_thread::sleep_for(glance);
      if (subscription_ && take(text)) {
        last_message_ = last_look_ = Clock::now();
        return Outcome::text;
      }
      if (Clock::now() - last_look_ > std::chrono::seconds(1)) look_after_it();
    } while (Clock::now() < until && !stop_.asked());
    return Outcome::quiet;
  }
  std::uint64_t position(std::size_t) const override { return position_; }
  StreamPlace place(std::size_t) const override { return {name(), position_, check()}; }
  std::optional<std::string> identity() const override {
    return fmt::format("stream {} of {}", stream_, created_);
  }
  bool has_whole_records() const override { return true; }
  bool has_clock() const override { return true; }
  FileTime arrival() const override { return arrival_; }
  std::string name() const override { return connection_.address().name; }

 private:
  /// Returns true if the next message has arrived.
  bool take(std::string_view& text) {
    if (taken_ == static_cast<std::size_t>(fetched_.Count)) fetch();
    if (!subscription_ || taken_ == static_cast<std::size_t>(fetched_.Count)) return false;
    natsMsg* const message = fetched_.Msgs[taken_++];
    jsMsgMetaData* raw = nullptr;
    const natsStatus status = natsMsg_GetMetaData(&raw, message);
    const std::unique_ptr<jsMsgMetaData, NatsDelete<jsMsgMetaData_Destroy>> meta(raw);
    // Messages of a consumer are numbered: a gap is a message lost on the way.
    if (status != NATS_OK || meta->Sequence.Consumer != ++delivered_ || meta->Sequence.Stream <= position_) {
      drop();
      return false;
    }
    position_ = meta->Sequence.Stream;
    constexpr std::int64_t second = 1'000'000'000;
    arrival_ = {meta->Timestamp / second, static_cast<double>(meta->Timestamp % second) * 1e-9};
    text = text_.take(message);
    return true;
  }

  /// Requests the next messages, and waits for the first.
  void fetch() {
    natsMsgList_Destroy(&fetched_);
    fetched_ = {};
    taken_ = 0;
    constexpr int at_once = 64;
    const natsStatus status =
        natsSubscription_Fetch(&fetched_, subscription_.get(), at_once, glance.count(), nullptr);
    if (status != NATS_OK && status != NATS_TIMEOUT) drop();
  }

  /// Called after a second without a message.
  void look_after_it() {
    last_look_ = Clock::now();
    connection_.check_open();
    natsStatus status = NATS_NOT_YET_CONNECTED;
    NatsStreamInfo info;
    if (connection_.is_connected()) info = connection_.stream_info(stream_, status);
    if (!info) {
      warn_once(status == NATS_NOT_FOUND ? fmt::format("its stream {} is gone: waiting for it", stream_)
                                         : "the server does not answer: waiting for it");
      return;
    }
    waits_for_.clear();
    if (info->Created != created_)
      throw ProgramError(
          fmt::format("{}: expected the stream that was read so far, but it has been made anew", name()));
    check_stream(*info);
    if (!subscription_ || !has_all()) return subscribe();
    if (keeps_time_ && last_look_ - last_message_ > std::chrono::seconds(1)) tick();
  }

  void warn_once(const std::string& what) {
    if (waits_for_ != what) connection_.warn(what);
    waits_for_ = what;
  }

  /// Throws if the stream no longer has messages that were read, since others will get their numbers.
  void check_stream(const jsStreamInfo& info) const {
    if (info.State.LastSeq < position_)
      throw ProgramError(
          fmt::format("{}: expected the stream that was read so far, but of its {} messages it has {}",
                      name(), position_, info.State.LastSeq));
  }

  /// Returns true if the consumer exists, all its messages were taken, and it has no more to send.
  bool has_all() const {
    jsConsumerInfo* got = nullptr;
    const natsStatus status = natsSubscription_GetConsumerInfo(&got, subscription_.get(), nullptr, nullptr);
    const std::unique_ptr<jsConsumerInfo, NatsDelete<jsConsumerInfo_Destroy>> info(got);
    return status == NATS_OK && info->NumPending == 0 && info->Delivered.Consumer == delivered_;
  }

  /// Returns a number that identifies the stream.
  std::uint64_t check() const {
    // 0 stands for no stream.
    return static_cast<std::uint64_t>(created_) | 1;
  }

  void drop() {
    natsMsgList_Destroy(&fetched_);
    fetched_ = {};
    taken_ = 0;
    subscription_.reset();
  }

  void subscribe() {
    drop();
    delivered_ = 0;
    jsSubOptions options;
    jsSubOptions_Init(&options);
    options.Stream = stream_.c_str();
    jsConsumerConfig& config = options.Config;
    config.DeliverPolicy = js_DeliverByStartSequence;
    config.OptStartSeq = position_ + 1;
    config.AckPolicy = js_AckNone;
    config.MemoryStorage = true;
    config.Replicas = 1;
    natsSubscription* subscription = nullptr;
    const natsStatus status =
        js_PullSubscribe(&subscription, connection_.jetstream(), connection_.address().subject.c_str(),
                         nullptr, nullptr, &options, nullptr);
    // On failure the subscription is tried again.
    if (status == NATS_OK) subscription_.reset(subscription);
  }

  void tick() const {
    std::string subject = connection_.address().subject;
    for (const char wildcard : {'*', '>'})
      for (std::size_t at; (at = subject.find(wildcard)) != std::string::npos;)
        subject.replace(at, 1, "tick");
    natsConnection_Publish(connection_.get(), subject.c_str(), nullptr, 0);
  }

  NatsConnection connection_;
  std::string stream_;
  const StopSignals& stop_;
  bool keeps_time_;
  NatsSubscription subscription_;
  natsMsgList fetched_{};
  std::size_t taken_ = 0;  ///< number of fetched messages already taken
  MessageText text_;
  FileTime arrival_{};
  std::int64_t created_ = 0;     ///< creation time of the stream
  std::string waits_for_;        ///< last warning shown; empty after a message
  std::uint64_t position_ = 0;   ///< sequence number of the last message
  std::uint64_t delivered_ = 0;  ///< messages delivered by this consumer
  Clock::time_point last_message_ = Clock::now(), last_look_ = Clock::now();
};

}  // namespace

std::unique_ptr<ReportSource> make_nats_source(const NatsAddress& address, const StopSignals& stop,
                                               bool keeps_time, bool is_quiet, const StreamPlace* from) {
  NatsConnection connection(address, is_quiet);
  if (auto stream = connection.stream_of(address.subject))
    return std::make_unique<NatsStreamSource>(std::move(connection), std::move(*stream), stop, keeps_time,
                                              from);
  if (from != nullptr && from->stream == address.name && from->check != 0)
    throw ProgramError(fmt::format(
        "{}: expected the stream that the snapshot was made of, but no stream of JetStream holds it",
        address.name));
  connection.warn(
      "no stream of JetStream holds it: what is sent while this program is not connected is lost");
  return std::make_unique<NatsSubjectSource>(std::move(connection), stop);
}

}  // namespace kinesphere::program
