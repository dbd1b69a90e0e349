// `kinesphere watch` on a server of NATS: several watches of one stream send each alert once, also if any of
// them or the server is killed.
#ifdef KINESPHERE_WITH_NATS

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "program/watch/crossing_tracks.hpp"
#include "program/watch/live_watch.hpp"
#include "program/watch/nats_broker.hpp"

namespace kinesphere::program::nats_test {
namespace {

constexpr std::uint64_t shares = 8;
const std::string options =
    crossing_promises + crossing_errors + " --silence 3 --forget 8 --only all --quiet ";

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

  /// Publishes messages of several lines, on several subjects.
  void publish(double from = 0.0, double until = 1.0,
               std::chrono::milliseconds between = std::chrono::milliseconds(0)) {
    const NatsConnection connection = broker_->connect();
    constexpr std::size_t lines_at_once = 7;
    std::istringstream lines(text_);
    std::string line, message;
    std::size_t count = 0, number = 0;
    const auto send = [&] {
      const double done = static_cast<double>(++number * lines_at_once) / 12000.0;
      if (!message.empty() && from < done && done <= until)
        publish_surely(connection, number % 2 == 0 ? "sky.a" : "sky.b", message, std::to_string(number));
      if (between.count() > 0) std::this_thread::sleep_for(between);
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
  /// Waits until there are `count` alerts.
  void wait_for_alerts(std::size_t count) {
    for (int k = 0; k < 1200; ++k) {
      if (broker_->messages_in("ALERTS") >= count) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "only " << broker_->messages_in("ALERTS") << " of " << count;
  }
  /// Expects each alert once, in the order in which one watch that reads a file emits them.
  void expect_all_alerts() {
    wait_for_alerts(count_);
    // Superfluous alerts may still arrive.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(broker_->messages_in("ALERTS"), count_);
    for (const auto& [share, lines] : expected_)
      EXPECT_TRUE(broker_->messages("ALERTS", "alerts." + std::to_string(share + 1)) == lines)
          << "share " << share;
  }
  /// Stops all of these; expects that they end without complaints.
  template <class Watches>
  void expect_to_end_well(const Watches& all) {
    for (const auto& live : all) {
      live->signal(SIGTERM);
      EXPECT_EQ(live->wait(), 0);
    }
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
  // Four watches share the pairs, and another two watch all of them as well.
  std::vector<std::unique_ptr<LiveWatch>> all;
  for (const char* share : {"1-2/8", "3-4/8", "5-6/8", "7-8/8", "1-4/8", "5-8/8", "1-8/8"})
    all.push_back(watch(share));
  expect_all_alerts();
  expect_to_end_well(all);
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
  expect_to_end_well(std::array{first.get(), second.get()});
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
  expect_to_end_well(std::array{first.get(), second.get()});
}

/// Everything at once: four share the pairs, one watches them all as well, the server and one of them are
/// killed, and another takes over from its snapshot, all while reports come in.
TEST_F(WatchNats, WhileReportsComeInAllMayBeKilled) {
  const std::string kept = " --snapshot '" + path("state") + "' --snapshot-every 20ms";
  std::vector<std::unique_ptr<LiveWatch>> all;
  for (const char* share : {"1-2/8", "3-4/8", "5-6/8", "1-8/8"}) all.push_back(watch(share));
  auto killed = watch("7-8/8", kept);
  std::atomic<bool> is_published = false;
  std::thread publisher([&] {
    publish(0.0, 1.0, std::chrono::milliseconds(4));
    is_published = true;
  });
  wait_for_alerts(count_ / 10);
  killed->signal(SIGKILL);
  killed->wait();
  broker_->stop(SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  broker_->start();
  ASSERT_TRUE(broker_->is_running());
  const bool came_in_before = is_published;
  killed = watch("7-8/8", kept);
  wait_for_alerts(count_ / 4);
  broker_->stop(SIGTERM);
  broker_->start();
  ASSERT_TRUE(broker_->is_running());
  EXPECT_FALSE(came_in_before) << "all reports had come in before";
  publisher.join();
  expect_all_alerts();
  all.push_back(std::move(killed));
  expect_to_end_well(all);
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
  // After three seconds all are stale.
  wait_for_alerts(20);
  std::size_t stale = 0;
  for (const std::string& line : broker_->messages("ALERTS", "alerts.*"))
    stale += line.find("\"stale\"") != std::string::npos ? 1 : 0;
  EXPECT_EQ(stale, 20u);
}

TEST_F(WatchNats, OfAFileThatIsReadAgainAndAgainEachIsToldOnce) {
  const std::string arguments = path("s.jsonl") + options + " --share 1-8/8 --alerts " +
                                broker_->url("alerts") + " --snapshot '" + path("state") +
                                "' --snapshot-every 3ms";
  Random random(1);
  int killed = 0;
  for (bool has_ended = false; !has_ended;) {
    LiveWatch live(arguments, path("err"));
    const double longest = 100.0 + 50.0 * killed;
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(random.uniform(30.0, longest))));
    live.signal(SIGKILL);
    has_ended = live.wait() == 0;
    killed += has_ended ? 0 : 1;
  }
  EXPECT_GE(killed, 3) << "the stream was too short";
  expect_all_alerts();
  // A watch without a snapshot that reads in other pieces repeats no alert either.
  EXPECT_EQ(run("watch " + path("s.jsonl") + options + " --share 1-8/8 --alerts " + broker_->url("alerts"))
                .exit_code,
            0);
  expect_all_alerts();
}

/// Alerts of one stream are independent of those of another.
TEST_F(WatchNats, OtherStreamsHaveOtherAlerts) {
  const std::string reported = options + " --share 1-8/8 --alerts " + broker_->url("alerts");
  const auto tell = [&](const std::string& arguments, const std::string& before = "") {
    const std::size_t already = broker_->messages_in("ALERTS");
    EXPECT_EQ(run("watch " + arguments + reported, before).exit_code, 0);
    return broker_->messages_in("ALERTS") - already;
  };
  EXPECT_EQ(tell(path("s.jsonl")), count_);
  EXPECT_EQ(tell("-", "cat '" + path("s.jsonl") + "' | "), count_) << "through a pipe";
  EXPECT_EQ(tell("-", "cat '" + path("s.jsonl") + "' | "), count_) << "through another one";
  std::string other = text_;
  other.erase(0, other.find('\n') + 1);
  EXPECT_GT(tell(write("other.jsonl", other)), count_ / 2);
  // A watch of the stream with other settings repeats alerts, too.
  EXPECT_GT(tell(path("s.jsonl") + " --separation sphere:20"), count_ / 2);
}

TEST_F(WatchNats, AStreamThatIsMadeAnewEndsIt) {
  publish(0.0, 0.3);
  auto live = watch("1-8/8");
  wait_for_alerts(count_ / 5);
  const NatsConnection connection = broker_->connect();
  ASSERT_EQ(js_DeleteStream(connection.jetstream(), "SKY", nullptr, nullptr), NATS_OK);
  broker_->add_stream("SKY", "sky.*");
  publish(0.3, 1.0);
  EXPECT_EQ(live->wait(), 2);
  EXPECT_NE(read_text(path("err1")).find("made anew"), std::string::npos) << read_text(path("err1"));
}

/// The snapshot of one has no place in the other.
TEST_F(WatchNats, ASubjectAndAStreamOfTheSameNameAreTwo) {
  const std::string kept = " --snapshot '" + path("state") + "' --summary '" + path("sum") + "' ";
  const std::string arguments = "'" + broker_->url("plain.x") + "'" + options + kept;
  const NatsConnection connection = broker_->connect();
  const auto read_until_stopped = [&](const std::function<void()>& send) {
    LiveWatch live("--format jsonl " + arguments, path("err"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    send();
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    live.signal(SIGTERM);
    EXPECT_EQ(live.wait(), 0) << live.err();
    return nlohmann::json::parse(read_text(path("sum")))["reports"].get<int>();
  };
  std::istringstream lines(text_);
  std::string line;
  EXPECT_EQ(read_until_stopped([&] {
              for (int k = 0; k < 20 && std::getline(lines, line); ++k)
                natsConnection_PublishString(connection.get(), "plain.x", line.c_str());
              natsConnection_FlushTimeout(connection.get(), 1000);
            }),
            20);
  broker_->add_stream("PLAIN", "plain.*");
  EXPECT_EQ(read_until_stopped([&] {
              for (int k = 0; k < 10 && std::getline(lines, line); ++k)
                publish_surely(connection, "plain.x", line, std::to_string(k));
            }),
            30);
  ASSERT_EQ(js_DeleteStream(connection.jetstream(), "PLAIN", nullptr, nullptr), NATS_OK);
  expect_wrong_input("watch " + arguments, {"plain.x", "no stream"});
}

TEST_F(WatchNats, AMessageThatIsCutOffTakesNoneAlong) {
  const auto document = [](double now, const char* end) {
    return fmt::format(
        R"({{"now": {}, "aircraft": [{{"hex": "400a01", "lat": 50, "lon": 8, "alt_baro": 30000, )"
        R"("gs": 400, "track": 90, "seen_pos": 0.1, "nac_p": 9, "nac_v": 2, "rc": 100}}{})",
        now, end);
  };
  const NatsConnection connection = broker_->connect();
  publish_surely(connection, "sky.a", document(1000.0, "]}"), "0");
  publish_surely(connection, "sky.a", document(1000.5, "]}"), "1");
  publish_surely(connection, "sky.a", document(1001.0, ""), "2");
  const std::string arguments = "'" + broker_->url("sky.*") +
                                "' --separation sphere:500 --quiet --snapshot '" + path("state") +
                                "' --summary '" + path("sum") + "'";
  for (int part = 0; part < 2; ++part) {
    LiveWatch live(arguments, path("err"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    live.signal(SIGTERM);
    EXPECT_EQ(live.wait(), 0) << live.err();
    publish_surely(connection, "sky.a", document(1002.0, "]}"), "3");
  }
  const auto sum = nlohmann::json::parse(read_text(path("sum")));
  EXPECT_EQ(sum["reports"], 3) << sum;
  EXPECT_EQ(sum["malformed"], 1) << sum;
}

TEST(NatsSubjects, HoldOthersAsAWhole) {
  const auto holds = [](const char* held, const char* subject) {
    return holds_all_of(std::vector<std::string>{"else", held}, subject);
  };
  for (const auto& [held, subject] : {std::pair{"a", "a"},
                                      {"a.*", "a.b"},
                                      {"a.*", "a.*"},
                                      {"a.>", "a.*"},
                                      {"a.>", "a.b.>"},
                                      {">", "a"},
                                      {"*.b", "a.b"}})
    EXPECT_TRUE(holds(held, subject)) << held << " " << subject;
  for (const auto& [held, subject] : {std::pair{"a", "b"},
                                      {"a.b", "a.*"},
                                      {"a.*", "a.>"},
                                      {"a.*", "a"},
                                      {"a.>", "a"},
                                      {"a", "a.b"},
                                      {"a.*", "a.b.c"},
                                      {"*.b", "a.*"}})
    EXPECT_FALSE(holds(held, subject)) << held << " " << subject;
}

TEST_F(WatchNats, ReadsASubjectWithoutAStream) {
  std::string loud = options;
  loud.erase(loud.find("--quiet"), 7);
  LiveWatch live("'" + broker_->url("plain.>") + "'" + loud, path("err"));
  const NatsConnection connection = broker_->connect();
  natsConnection_FlushTimeout(connection.get(), 1000);
  // The watch may not listen yet.
  for (int k = 0; k < 1000 && live.err().find("no stream") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  // Few, so that their alerts fit into the pipe.
  natsConnection_PublishString(connection.get(), "plain.x", text_.substr(0, text_.find('\n', 2000)).c_str());
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
  // A stream that holds only some of the subjects is refused.
  expect_wrong_input("watch '" + broker_->url("sky.>") + "'" + options, {"all of 'sky.>'", "sky.*"});
  // A recreated stream is not the one that was read.
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
}  // namespace kinesphere::program::nats_test

#endif
