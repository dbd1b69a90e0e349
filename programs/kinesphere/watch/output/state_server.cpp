// Serves the state of a watch over HTTP, to this machine alone.
#include "watch/output/state_server.hpp"

#include <fmt/format.h>

#include "base/input_file.hpp"
#include "serving/built_pages.hpp"
#include "watch/output/watch_report.hpp"

namespace kinesphere::program {
namespace {

const char* const map_page = "map.html";
const char* const map_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

StateServer::StateServer(const WatchView& watch, int port) : watch_(watch), server_("--serve", map_policy) {
  serve_state("/state.json", "application/json", watch_state_json);
  serve_state("/metrics", "text/plain; version=0.0.4", watch_metrics);
  serve_map();
  server_.start(port);
}

void StateServer::lock() {
  std::unique_lock lock(mutex_);
  const std::uint64_t ticket = next_ticket_++;
  changed_.wait(lock, [&] { return ticket == served_ticket_; });
}

void StateServer::unlock() {
  {
    const std::lock_guard lock(mutex_);
    ++served_ticket_;
  }
  changed_.notify_all();
}

void StateServer::serve_state(const char* address, const char* type, std::string (*text)(const WatchView&)) {
  server_.serve(address, type, [this, text] {
    const std::lock_guard guard(*this);
    return text(watch_);
  });
}

/// Serves only the files of the page folder that the map needs.
void StateServer::serve_map() {
  const auto folder = folder_with_page(map_page);
  if (folder && server_.serve_folder("/assets", (*folder / "assets").string())) {
    server_.serve("/", "text/html; charset=utf-8",
                  [page = (*folder / map_page).string()] { return read_input(page); });
    return;
  }
  server_.serve("/", "text/plain; charset=utf-8", [] {
    return fmt::format(
        "kinesphere watch serves the state of a stream here: /state.json, and /metrics for Prometheus.\n"
        "The map of it in a browser has not been built. To build it, in the source tree:\n"
        "  {}\n",
        build_pages_command);
  });
}

}  // namespace kinesphere::program
