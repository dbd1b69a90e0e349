// A server of NATS that a test starts, with a store of its own.
#pragma once

#include <gtest/gtest.h>
#include <nats/nats.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "watch/nats/nats_connection.hpp"

namespace kinesphere::program {

class NatsBroker {
 public:
  /// Starts a server in a folder of its own, on a free port.
  explicit NatsBroker(std::string folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    for (int k = 0; k < 20 && !is_running(); ++k) {
      port_ = 20000 + static_cast<int>((::getpid() * 37 + k * 101) % 30000);
      start();
    }
  }
  NatsBroker(const NatsBroker&) = delete;
  NatsBroker& operator=(const NatsBroker&) = delete;
  ~NatsBroker() { stop(SIGKILL); }

  static bool is_installed() { return std::system("command -v nats-server >/dev/null") == 0; }

  bool is_running() const { return process_ > 0; }
  std::string url(const std::string& subject) const {
    return "nats://127.0.0.1:" + std::to_string(port_) + "/" + subject;
  }
  NatsConnection connect() const { return NatsConnection(parse_nats_address(url("x"), "test")); }

  void start() {
    process_ = ::fork();
    if (process_ == 0) {
      const std::string command = "exec nats-server -a 127.0.0.1 -p " + std::to_string(port_) + " -js -sd '" +
                                  folder_ + "/store' >>'" + folder_ + "/broker.log' 2>&1";
      ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      ::_exit(127);
    }
    // Waits until the server answers, or has given up because the port is taken.
    for (int k = 0; k < 200; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
      natsConnection* connection = nullptr;
      const auto status = natsConnection_ConnectTo(&connection, url("").c_str());
      natsConnection_Destroy(connection);
      int ended = 0;
      if (::waitpid(process_, &ended, WNOHANG) == process_) {
        process_ = 0;
        return;
      }
      if (status == NATS_OK) return;
    }
  }
  void stop(int signal) {
    if (!is_running()) return;
    ::kill(process_, signal);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

  /// Adds a stream of JetStream that holds these subjects.
  void add_stream(const std::string& name, const std::string& subjects) const {
    const NatsConnection connection = connect();
    jsStreamConfig config;
    jsStreamConfig_Init(&config);
    const char* all[] = {subjects.c_str()};
    config.Name = name.c_str();
    config.Subjects = all;
    config.SubjectsLen = 1;
    ASSERT_EQ(js_AddStream(nullptr, connection.jetstream(), &config, nullptr, nullptr), NATS_OK);
  }
  std::uint64_t messages_in(const std::string& stream) const {
    const NatsConnection connection = connect();
    natsStatus status{};
    const NatsStreamInfo info = connection.stream_info(stream, status);
    return info ? info->State.Msgs : 0;
  }
  /// Returns the messages of a stream under a subject, in order.
  std::vector<std::string> messages(const std::string& stream, const std::string& subject) const {
    const NatsConnection connection = connect();
    jsSubOptions options;
    jsSubOptions_Init(&options);
    options.Stream = stream.c_str();
    options.Ordered = true;
    natsSubscription* made = nullptr;
    EXPECT_EQ(js_SubscribeSync(&made, connection.jetstream(), subject.c_str(), nullptr, &options, nullptr),
              NATS_OK);
    const NatsSubscription subscription(made);
    std::vector<std::string> texts;
    for (;;) {
      natsMsg* got = nullptr;
      if (natsSubscription_NextMsg(&got, made, 300) != NATS_OK) return texts;
      const NatsMessage message(got);
      texts.emplace_back(natsMsg_GetData(got), static_cast<std::size_t>(natsMsg_GetDataLength(got)));
    }
  }

 private:
  std::string folder_;
  int port_ = 0;
  pid_t process_ = 0;
};

/// Sends until the server confirms that it keeps the message: possibly twice, if it was stopped in between.
inline void publish_surely(const NatsConnection& connection, const std::string& subject,
                           const std::string& text, const std::string& message_id) {
  jsPubOptions options;
  jsPubOptions_Init(&options);
  options.MsgId = message_id.c_str();
  for (int k = 0; k < 300; ++k) {
    if (js_Publish(nullptr, connection.jetstream(), subject.c_str(), text.data(),
                   static_cast<int>(text.size()), &options, nullptr) == NATS_OK)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  FAIL() << "the server does not come back";
}

}  // namespace kinesphere::program
