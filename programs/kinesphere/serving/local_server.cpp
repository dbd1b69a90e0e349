// A web server for this machine alone.
#include "serving/local_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "program_error.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>

#include <csignal>
#include <thread>
#endif

namespace kinesphere::program {

#ifdef KINESPHERE_WITH_HTTPLIB

namespace {

const char* const loopback = "127.0.0.1";

/// Hands over in pieces what `content` points to. The library compresses what it is given as a whole, with
/// brotli's slowest setting.
template <class Content>
void hand_over(httplib::Response& response, const std::string& type, Content content) {
  if (content->empty()) return response.set_content("", type);
  const std::size_t size = content->size();
  response.set_content_provider(
      size, type,
      [content = std::move(content)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        constexpr std::size_t piece = 1 << 20;
        return sink.write(content->data() + offset, std::min(length, piece));
      });
}

/// Of a file that the library has read as a whole.
void leave_uncompressed(const httplib::Request&, httplib::Response& response) {
  if (response.body.empty()) return;
  const std::string type = response.get_header_value("Content-Type");
  response.headers.erase("Content-Type");
  hand_over(response, type, std::make_shared<const std::string>(std::move(response.body)));
}

}  // namespace

class LocalServer::Serving {
 public:
  Serving(std::string option, const std::string& policy) : option_(std::move(option)) {
    // Without this two programs could have the same port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    // Whoever keeps a connection open keeps the server from stopping, so each is for one request, made at
    // once.
    server_.set_keep_alive_max_count(1);
    server_.set_keep_alive_timeout(1);
    server_.set_default_headers({{"Cache-Control", "no-cache"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Content-Security-Policy", policy}});
    server_.set_file_extension_and_mimetype_mapping("js", "text/javascript");
    server_.set_file_extension_and_mimetype_mapping("mjs", "text/javascript");
    server_.set_file_extension_and_mimetype_mapping("wasm", "application/wasm");
    server_.set_file_request_handler(leave_uncompressed);
  }
  ~Serving() {
    if (!thread_.joinable()) return;
    while (!server_.is_running()) std::this_thread::yield();
    server_.stop();
    thread_.join();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  httplib::Server& server() { return server_; }
  const std::string& address() const { return address_; }

  void start(int wanted) {
    const int port = wanted == 0                              ? server_.bind_to_any_port(loopback)
                     : server_.bind_to_port(loopback, wanted) ? wanted
                                                              : -1;
    if (port <= 0)
      throw ProgramError(
          fmt::format("{}: expected a port of {} that is free, but {} is not", option_, loopback, wanted));
    address_ = fmt::format("http://{}:{}/", loopback, port);
    server_.set_pre_routing_handler([port](const httplib::Request& request, httplib::Response& response) {
      // A page of somebody else's may send a browser here under another name: it is shown nothing.
      const std::string name = request.get_header_value("Host");
      if (name == fmt::format("{}:{}", loopback, port) || name == fmt::format("localhost:{}", port))
        return httplib::Server::HandlerResponse::Unhandled;
      response.status = 403;
      return httplib::Server::HandlerResponse::Handled;
    });
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

 private:
  std::string option_;
  httplib::Server server_;
  std::string address_;
  std::thread thread_;
};

void LocalServer::serve(const std::string& address, const std::string& type, const std::string& content) {
  serving_->server().Get(address, [type, &content](const httplib::Request&, httplib::Response& response) {
    hand_over(response, type, &content);
  });
}

void LocalServer::serve(const std::string& address, const std::string& type,
                        std::function<std::string()> content) {
  serving_->server().Get(
      address, [type, content = std::move(content)](const httplib::Request&, httplib::Response& response) {
        hand_over(response, type, std::make_shared<const std::string>(content()));
      });
}

bool LocalServer::serve_folder(const std::string& address, const std::string& folder) {
  return serving_->server().set_mount_point(address, folder);
}

#else

class LocalServer::Serving {
 public:
  Serving(const std::string& option, const std::string&) {
    throw ProgramError(
        fmt::format("{}: this program was built without cpp-httplib (libcpp-httplib-dev)", option));
  }
  const std::string& address() const { return address_; }
  void start(int) {}

 private:
  std::string address_;
};

void LocalServer::serve(const std::string&, const std::string&, const std::string&) {}
void LocalServer::serve(const std::string&, const std::string&, std::function<std::string()>) {}
bool LocalServer::serve_folder(const std::string&, const std::string&) { return false; }

#endif

LocalServer::LocalServer(std::string option, const std::string& content_security_policy)
    : serving_(std::make_unique<Serving>(std::move(option), content_security_policy)) {}
LocalServer::~LocalServer() = default;
void LocalServer::start(int port) { serving_->start(port); }
const std::string& LocalServer::address() const { return serving_->address(); }

}  // namespace kinesphere::program
