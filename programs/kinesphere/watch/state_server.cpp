// The state of a watch over HTTP, on this machine alone.
#include "watch/state_server.hpp"

#include <fmt/format.h>

#include "program_error.hpp"
#include "watch/watch_report.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>

#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>
#endif

namespace kinesphere::program {

#ifdef KINESPHERE_WITH_HTTPLIB

namespace {
const char* const loopback = "127.0.0.1";
}  // namespace

class StateServer::Serving {
 public:
  Serving(const Watcher& watcher, int port) : watcher_(watcher) {
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    server_.set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
    answer("/state\\.json", "application/json", watch_state_json);
    answer("/metrics", "text/plain; version=0.0.4", watch_metrics);
    port_ = port == 0 ? server_.bind_to_any_port(loopback) : server_.bind_to_port(loopback, port) ? port : -1;
    if (port_ <= 0)
      throw ProgramError(
          fmt::format("--serve: expected a port of {} that is free, but {} is not", loopback, port));
    address_ = fmt::format("http://{}:{}/", loopback, port_);
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      // A page of somebody else's may send a browser here under another name.
      const std::string name = request.get_header_value("Host");
      if (name == fmt::format("{}:{}", loopback, port_) || name == fmt::format("localhost:{}", port_))
        return httplib::Server::HandlerResponse::Unhandled;
      response.status = 403;
      return httplib::Server::HandlerResponse::Handled;
    });
    // Signals are for the thread that watches.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~Serving() {
    while (!server_.is_running()) std::this_thread::yield();
    server_.stop();
    thread_.join();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  const std::string& address() const { return address_; }
  void lock() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_ == 0; });
    lock.release();
  }
  void unlock() { mutex_.unlock(); }

 private:
  void answer(const char* address, const char* type, std::string (*text)(const Watcher&)) {
    server_.Get(address, [this, type, text](const httplib::Request&, httplib::Response& response) {
      std::string content;
      {
        ++waiting_;
        const std::lock_guard lock(mutex_);
        content = text(watcher_);
        --waiting_;
      }
      changed_.notify_one();
      response.set_content(content, type);
    });
  }

  const Watcher& watcher_;
  httplib::Server server_;
  int port_ = 0;
  std::string address_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<int> waiting_ = 0;  ///< who wants to see the state
  std::thread thread_;
};

#else

class StateServer::Serving {
 public:
  Serving(const Watcher&, int) {
    throw ProgramError("--serve: this program was built without cpp-httplib (libcpp-httplib-dev)");
  }
  const std::string& address() const { return address_; }
  void lock() {}
  void unlock() {}

 private:
  std::string address_;
};

#endif

StateServer::StateServer(const Watcher& watcher, int port)
    : serving_(std::make_unique<Serving>(watcher, port)) {}
StateServer::~StateServer() = default;
const std::string& StateServer::address() const { return serving_->address(); }
void StateServer::lock() { serving_->lock(); }
void StateServer::unlock() { serving_->unlock(); }

}  // namespace kinesphere::program
