// `kinesphere watch` on a server of NATS: several that watch one stream tell each alert once, whoever is
// killed, the server as well.
#ifdef KINESPHERE_WITH_NATS

#include <memory>
#include <thread>

#include "program/support.hpp"
#include "program/watch/crossing_tracks.hpp"
#include "program/watch/live_watch.hpp"
#include "program/watch/nats_broker.hpp"

namespace kinesphere::program {
namespace {

constexpr std::uint64_t shares = 8;
const std::string options = crossing_promises + crossing_errors + " --silence 3 --forget 8 --quiet ";

class WatchNats : public ProgramTest {
 protected:
  void SetUp() override {
    if (!NatsBroker::is_installed()) GTEST_SKIP() << "nats-server is not installed";
    broker_.emplace(path("broker"));
    ASSERT_TRUE(broker_->is_running());
    broker_->add_stream("SKY", "sky.*");
    broker_->add_stream("ALERTS", "alerts.*");
    text_ = stream_of(json_line, 12000);
    const ProgramRun whole = run("watch " + write("s.jsonl", text_) + options);
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    add_by_share(whole.out, shares, expected_);
    for (const auto& [share, lines] : expected_) count_ += lines.size();
    ASSERT_EQ(expected_.size(), shares);
  }

  /// As messages of several lines, on several subjects.
  void publish(double from = 0.0, double until = 1.0) {
    const NatsConnection connection = broker_->connect();
    constexpr std::size_t lines_at_once = 7;
    std::istringstream lines(text_);
    std::string line, message;
    std::size_t count = 0, number = 0;
    const auto send = [&] {
      const double done = static_cast<double>(++number * lines_at_once) / 12000.0;
      if (!message.empty() && from < done && done <= until)
        publish_surely(connection, number % 2 == 0 ? "sky.a" : "sky.b", message, std::to_string(number));
      message.clear();
    };
    while (std::getline(lines, line)) {
      message += line + (++count % lines_at_once == 0 ? "" : "\n");
      if (count % lines_at_once == 0) send();
    }
    send();
  }
  std::unique_ptr<LiveWatch> watch(const std::string& share, const std::string& more = "") {
    return std::make_unique<LiveWatch>(
        broker_->url("sky.*") + options + more + " --share " + share + " --alerts " + broker_->url("alerts"),
        path("err" + std::to_string(++watches_)));
  }
  /// Waits until so many alerts have been told.
  void wait_for_alerts(std::size_t count) {
    for (int k = 0; k < 1200; ++k) {
      if (broker_->messages_in("ALERTS") >= count) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "only " << broker_->messages_in("ALERTS") << " of " << count;
  }
  /// Each was told once, in the order in which one watch that reads a file tells them.
  void expect_all_alerts() {
    wait_for_alerts(count_);
    // What would be too much may still come.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(broker_->messages_in("ALERTS"), count_);
    for (const auto& [share, lines] : expected_)
      EXPECT_TRUE(broker_->messages("ALERTS", "alerts." + std::to_string(share + 1)) == lines)
          << "share " << share;
  }
  void expect_no_complaints() {
    for (int k = 1; k <= watches_; ++k) EXPECT_EQ(read_text(path("err" + std::to_string(k))), "");
  }

  std::optional<NatsBroker> broker_;
  std::string text_;
  AlertsByShare expected_;
  std::size_t count_ = 0;
  int watches_ = 0;
};

TEST_F(WatchNats, OneTwoAndFourTellTheSame) {
  publish();
  // Four share the pairs, and all of them are watched by another two as well.
  std::vector<std::unique_ptr<LiveWatch>> all;
  for (const char* share : {"1-2/8", "3-4/8", "5-6/8", "7-8/8", "1-4/8", "5-8/8", "1-8/8"})
    all.push_back(watch(share));
  expect_all_alerts();
  for (const auto& live : all) {
    live->signal(SIGTERM);
    EXPECT_EQ(live->wait(), 0);
  }
  expect_no_complaints();
}

TEST_F(WatchNats, WhoIsKilledIsTakenOverFrom) {
  const std::string kept = " --snapshot '" + path("state") + "' --snapshot-every 20ms";
  auto first = watch("1-4/8"), second = watch("5-8/8", kept);
  std::thread publisher([this] { publish(); });
  wait_for_alerts(count_ / 4);
  first->signal(SIGKILL);
  first->wait();
  wait_for_alerts(count_ / 3);
  second->signal(SIGKILL);
  second->wait();
  // One begins at the begin, the other at the snapshot.
  first = watch("1-4/8");
  second = watch("5-8/8", kept);
  publisher.join();
  expect_all_alerts();
  for (const auto& live : {first.get(), second.get()}) {
    live->signal(SIGTERM);
    EXPECT_EQ(live->wait(), 0);
  }
  expect_no_complaints();
}

TEST_F(WatchNats, TheServerMayBeStartedAgain) {
  auto first = watch("1-4/8"), second = watch("5-8/8");
  std::thread publisher([this] { publish(); });
  wait_for_alerts(count_ / 4);
  for (const int signal : {SIGKILL, SIGTERM}) {
    broker_->stop(signal);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    broker_->start();
    ASSERT_TRUE(broker_->is_running());
    wait_for_alerts(count_ / 2);
  }
  publisher.join();
  expect_all_alerts();
  for (const auto& live : {first.get(), second.get()}) {
    live->signal(SIGTERM);
    EXPECT_EQ(live->wait(), 0);
  }
  expect_no_complaints();
}

TEST_F(WatchNats, TimePassesForAllByTheClockOfTheServer) {
  using namespace std::chrono;
  auto one = watch("1-4/8", "--clock arrival"), other = watch("5-8/8", "--clock arrival");
  const NatsConnection connection = broker_->connect();
  const double now = duration<double>(system_clock::now().time_since_epoch()).count();
  for (int k = 0; k < 20; ++k)
    publish_surely(
        connection, "sky.x",
        fmt::format(R"({{"id": "t{}", "stamp": {:.3f}, "position": [{}, 0, 0], "velocity": [0, 0, 0]}})", k,
                    now, 1000 * k),
        "t" + std::to_string(k));
  // After three seconds all are silent.
  wait_for_alerts(20);
  std::size_t silent = 0;
  for (const std::string& line : broker_->messages("ALERTS", "alerts.*"))
    silent += line.find("\"silent\"") != std::string::npos ? 1 : 0;
  EXPECT_EQ(silent, 20u);
}

TEST_F(WatchNats, ReadsASubjectWithoutAStream) {
  LiveWatch live("'" + broker_->url("plain.>") + "'" + options, path("err"));
  const NatsConnection connection = broker_->connect();
  natsConnection_FlushTimeout(connection.get(), 1000);
  // It may not listen yet.
  for (int k = 0; k < 1000 && live.err().find("no stream") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  natsConnection_PublishString(connection.get(), "plain.x", text_.substr(0, text_.find('\n', 5000)).c_str());
  natsConnection_FlushTimeout(connection.get(), 1000);
  EXPECT_TRUE(nlohmann::json::parse(live.line()).contains("verdict"));
  live.signal(SIGTERM);
  EXPECT_EQ(live.wait(), 0);
}

TEST_F(WatchNats, RefusesWhatCannotBe) {
  expect_wrong_input("watch nats://127.0.0.1:1/x" + options, {"nats://127.0.0.1:1/x", "cannot connect"});
  expect_wrong_input("watch nats://someone:secret@127.0.0.1:1/x" + options, {"nats://127.0.0.1:1/x"});
  for (const char* wrong : {"nats://", "nats://host", "nats://host/", "nats:///subject", "nats://host/a..b"})
    expect_wrong_input("watch " + std::string(wrong) + options, {"FILE", "nats://HOST:PORT/SUBJECT"});
  expect_wrong_input("watch " + path("s.jsonl") + options + " --alerts " + "'" + broker_->url("a.*") + "'",
                     {"--alerts", "without wildcards"});
  // A stream that was made anew is not the one that was read.
  publish(0.0, 0.2);
  const std::string kept = " --snapshot '" + path("state") + "' --snapshot-every 20ms";
  auto live = watch("1-8/8", kept);
  wait_for_alerts(10);
  live->signal(SIGTERM);
  EXPECT_EQ(live->wait(), 0);
  const NatsConnection connection = broker_->connect();
  ASSERT_EQ(js_DeleteStream(connection.jetstream(), "SKY", nullptr, nullptr), NATS_OK);
  broker_->add_stream("SKY", "sky.*");
  expect_wrong_input("watch '" + broker_->url("sky.*") + "'" + options + kept + " --share 1-8/8",
                     {"sky.*", "snapshot"});
}

}  // namespace
}  // namespace kinesphere::program

#endif
