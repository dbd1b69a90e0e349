// `kinesphere watch` that reads while the test writes.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "program/support.hpp"

namespace kinesphere::program {

/// `kinesphere watch` that reads while the test writes.
class LiveWatch {
 public:
  LiveWatch(const std::string& arguments, const std::string& err_file) : err_(err_file) {
    int in[2], out[2];
    if (::pipe(in) != 0 || ::pipe(out) != 0) std::abort();
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(in[0], 0);
      ::dup2(out[1], 1);
      for (const int end : {in[0], in[1], out[0], out[1]}) ::close(end);
      const std::string command =
          std::string("exec '") + KINESPHERE_PROGRAM + "' watch " + arguments + " 2>'" + err_ + "'";
      ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    in_ = in[1];
    out_ = ::fdopen(out[0], "r");
  }
  LiveWatch(const LiveWatch&) = delete;
  LiveWatch& operator=(const LiveWatch&) = delete;
  ~LiveWatch() {
    if (in_ >= 0) ::close(in_);
    if (process_ > 0) {
      signal(SIGKILL);
      wait();
    }
    std::fclose(out_);
  }

  void write(const std::string& text) const {
    ASSERT_EQ(::write(in_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string line() const {
    char text[4096];
    return std::fgets(text, sizeof text, out_) != nullptr ? text : "";
  }
  void end_input() {
    ::close(in_);
    in_ = -1;
  }
  void signal(int number) const { ::kill(process_, number); }
  /// Waits for the end; returns the exit code.
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string err() const { return read_text(err_); }
  /// Waits for the message with the port, and returns it.
  int port() const {
    const std::string before = "http://127.0.0.1:";
    for (int k = 0; k < 500; ++k) {
      const std::string said = err();
      const std::size_t at = said.find(before);
      if (at != std::string::npos && said.find('\n', at) != std::string::npos)
        return std::stoi(said.substr(at + before.size()));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ADD_FAILURE() << "it does not serve: " << err();
    return 0;
  }

 private:
  std::string err_;
  pid_t process_ = 0;
  int in_ = -1;
  FILE* out_ = nullptr;
};

}  // namespace kinesphere::program
