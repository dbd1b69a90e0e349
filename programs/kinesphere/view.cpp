// `kinesphere view`: serves the files of the viewer, and what it is to show, on this machine alone, and opens
// them in a browser.
#include "view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "program_error.hpp"
#include "standard_output.hpp"
#include "tracks/reading_options.hpp"
#include "view/opened_files.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>

#include <csignal>
#include <thread>
#endif

namespace kinesphere::program {
namespace {

const char* const page = "index.html";

/// Where the viewer may be, the first choice first.
std::vector<std::filesystem::path> viewer_folders() {
  std::vector<std::filesystem::path> folders;
  if (const char* const set = std::getenv("KINESPHERE_VIEWER")) folders.emplace_back(set);
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) folders.push_back(program.parent_path().parent_path() / "share/kinesphere/viewer");
  folders.emplace_back(KINESPHERE_BUILT_VIEWER);
  return folders;
}

std::string viewer_folder(const std::string& chosen) {
  const auto has_page = [](const std::filesystem::path& folder) {
    std::error_code unreadable;
    return std::filesystem::is_regular_file(folder / page, unreadable);
  };
  if (!chosen.empty()) {
    if (has_page(chosen)) return chosen;
    throw ProgramError(fmt::format("--folder: expected a folder with {}, but {} has none", page, chosen));
  }
  std::vector<std::string> tried;
  for (const auto& folder : viewer_folders()) {
    if (has_page(folder)) return folder.string();
    tried.push_back(folder.string());
  }
  throw ProgramError(
      fmt::format("view: expected the viewer in one of {}; to build it: scripts/setup.sh browser && cmake "
                  "--preset browser && cmake --build --preset browser",
                  fmt::join(tried, ", ")));
}

}  // namespace

CLI::App* add_view_command(CLI::App& program, ViewOptions& options) {
  CLI::App* command =
      program.add_subcommand("view", "Show scenes and recordings in a browser, on this machine alone");
  add_reading_options(*command, options.files, options.reading)
      ->required(false)
      ->description(
          "A recording of `kinesphere run --record`, or text tables of positions as `kinesphere tracks` "
          "reads them; plain or gzipped, - for standard input");
  command->parse_complete_callback(
      [command, &options] { options.reading_option = given_reading_option(*command); });
  command->add_option("--folder", options.folder, "The viewer, if it is another one than was built here");
  command->add_option("--port", options.port, "Port of 127.0.0.1; any that is free when not given")
      ->check(CLI::Range(0, 65535));
  command->add_flag("--no-browser", options.no_browser, "Print the address, and open no browser");
  return command;
}

#ifdef KINESPHERE_WITH_HTTPLIB

namespace {

const char* const host = "127.0.0.1";

/// A page of somebody else's may send a browser here under another name: it is shown nothing.
httplib::Server::HandlerResponse refuse_other_names(const httplib::Request& request,
                                                    httplib::Response& response, int port) {
  const std::string name = request.get_header_value("Host");
  if (name == fmt::format("{}:{}", host, port) || name == fmt::format("localhost:{}", port))
    return httplib::Server::HandlerResponse::Unhandled;
  response.status = 403;
  return httplib::Server::HandlerResponse::Handled;
}

/// The library compresses what it has read as a whole, with brotli's slowest setting: a second for the page's
/// program. What is handed over in pieces stays as it is.
void leave_uncompressed(const httplib::Request&, httplib::Response& response) {
  if (response.body.empty()) return;
  const std::string type = response.get_header_value("Content-Type");
  const std::size_t size = response.body.size();
  response.headers.erase("Content-Type");
  response.set_content_provider(
      size, type,
      [body = std::move(response.body)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(body.data() + offset, length);
      });
}

void prepare(httplib::Server& server, const std::string& folder) {
  // Without this two programs could have the same port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  server.set_default_headers(
      {{"Cache-Control", "no-cache"},
       {"X-Content-Type-Options", "nosniff"},
       {"Content-Security-Policy",
        "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
        "img-src 'self' data: blob:; font-src 'self' data:; worker-src 'self' blob:; frame-ancestors "
        "'none'"}});
  server.set_file_extension_and_mimetype_mapping("js", "text/javascript");
  server.set_file_extension_and_mimetype_mapping("mjs", "text/javascript");
  server.set_file_extension_and_mimetype_mapping("wasm", "application/wasm");
  if (!server.set_mount_point("/", folder))
    throw ProgramError(fmt::format("--folder: {} cannot be read", folder));
  server.set_file_request_handler(leave_uncompressed);
}

/// `content` must live as long as the server. It may be large: it is handed over in pieces, neither copied
/// nor compressed.
void serve(httplib::Server& server, const char* address, const char* type, const std::string& content) {
  const auto hand_over = [&content](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    constexpr std::size_t piece = 1 << 20;
    return sink.write(content.data() + offset, std::min(length, piece));
  };
  server.Get(address, [&content, type, hand_over](const httplib::Request&, httplib::Response& response) {
    response.set_content_provider(content.size(), type, hand_over);
  });
}

/// Addresses are regular expressions. `opened` must live as long as the server.
void serve(httplib::Server& server, const OpenedFiles& opened) {
  server.Get("/opened/files\\.json",
             [index = opened.index()](const httplib::Request&, httplib::Response& response) {
               response.set_content(index, "application/json");
             });
  if (opened.recording)
    serve(server, "/opened/recording", "application/octet-stream", opened.recording->content);
  if (opened.tracks) serve(server, "/opened/tracks\\.json", "application/json", opened.tracks->content);
}

int bound_port(httplib::Server& server, int wanted) {
  if (wanted == 0) {
    const int port = server.bind_to_any_port(host);
    if (port > 0) return port;
    throw ProgramError(fmt::format("view: no port of {} is free", host));
  }
  if (server.bind_to_port(host, wanted)) return wanted;
  throw ProgramError(fmt::format("--port: expected a port of {} that is free, but {} is not", host, wanted));
}

void open_browser(const std::string& address) {
  const std::string command = fmt::format("xdg-open {} >/dev/null 2>&1", address);
  if (std::system(command.c_str()) != 0)
    fmt::print(stderr, "kinesphere: no browser could be opened: open {} in one\n", address);
}

}  // namespace

int view(const ViewOptions& options) {
  const std::string folder = viewer_folder(options.folder);
  const OpenedFiles opened = open_files(options.files, options.reading, options.reading_option);
  httplib::Server server;
  prepare(server, folder);
  serve(server, opened);
  const int port = bound_port(server, options.port);
  server.set_pre_routing_handler([port](const httplib::Request& request, httplib::Response& response) {
    return refuse_other_names(request, response, port);
  });
  // No thread takes these but the one that waits for them.
  sigset_t stops;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &stops, nullptr);
  std::thread serving([&server] { server.listen_after_bind(); });
  // The page asks for files only where its address says that there are any: another server has none.
  const std::string address =
      fmt::format("http://{}:{}/{}", host, port, options.files.empty() ? "" : "#opened");
  print("{}\n", address);
  finish_output();
  if (!options.no_browser) open_browser(address);
  int signal = 0;
  sigwait(&stops, &signal);
  while (!server.is_running()) std::this_thread::yield();
  server.stop();
  serving.join();
  return exit_fine;
}

#else

int view(const ViewOptions& options) {
  throw ProgramError(
      fmt::format("view: this program was built without cpp-httplib (libcpp-httplib-dev); any web server "
                  "shows {}",
                  viewer_folder(options.folder)));
}

#endif

}  // namespace kinesphere::program
