// Sends any bytes as a request to a real server, for fuzz_http and the replay of its corpus.
#include "program/serving/any_request.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "program/serving/raw_connection.hpp"

namespace kinesphere::program {
namespace {

/// Text that occurs nowhere else in this process.
const char* const script = "export const page = 'script';";
const char* const made = "made for each";
const char* const index_page = "<p>index</p>";

std::string with_port(std::string_view bytes, int port) {
  constexpr std::string_view name = "$PORT";
  std::string text;
  for (std::size_t at; (at = bytes.find(name)) != std::string_view::npos;
       bytes.remove_prefix(at + name.size()))
    text.append(bytes.substr(0, at)).append(std::to_string(port));
  return text.append(bytes);
}

bool has_field(const std::string& text, std::string name) {
  const auto is_same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), name.begin(), name.end(), is_same) != text.end();
}

/// Returns the number behind "Content-Length: ", or nothing.
std::optional<std::size_t> length_of(const std::string& head) {
  constexpr std::string_view name = "\r\nContent-Length: ";
  const std::size_t at = head.find(name);
  if (at == std::string::npos) return std::nullopt;
  return std::strtoull(head.c_str() + at + name.size(), nullptr, 10);
}

}  // namespace

AttackedServer::AttackedServer()
    : page_(std::make_unique<const std::string>(100, 'p')),
      empty_(std::make_unique<const std::string>()),
      long_page_(std::make_unique<const std::string>(70'000, 'l')),
      server_(std::make_unique<LocalServer>("--port", "default-src 'none'")) {
  std::string pattern = (std::filesystem::temp_directory_path() / "kinesphere-http-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for pages");
  folder_ = pattern;
  std::filesystem::create_directories(folder_ / "pages/inner");
  const std::pair<const char*, const char*> files[] = {{"pages/index.html", index_page},
                                                       {"pages/inner/page.js", script},
                                                       {"pages/empty.css", ""},
                                                       {"pages/.hidden", "secret"},
                                                       {"secret", "secret"}};
  for (const auto& [name, content] : files) std::ofstream(folder_ / name, std::ios::binary) << content;
  server_->serve("/page", "text/plain", *page_);
  server_->serve("/empty", "text/plain", *empty_);
  server_->serve("/long", "text/plain", *long_page_);
  server_->serve("/made", "text/plain", [] { return std::string(made); });
  server_->serve("/throws", "text/plain", []() -> std::string { throw std::runtime_error("secret"); });
  server_->serve_folder("/", (folder_ / "pages").string());
  server_->serve_folder("/more", (folder_ / "pages/inner").string());
  server_->start(0);
  const std::string address = server_->address();
  port_ = std::stoi(address.substr(address.rfind(':') + 1));
}

AttackedServer::~AttackedServer() {
  server_.reset();
  std::filesystem::remove_all(folder_);
}

std::optional<std::string> AttackedServer::complaint(std::span<const unsigned char> bytes) {
  response_.clear();
  if (bytes.empty()) return std::nullopt;
  const std::size_t split = bytes[0];
  const std::string request =
      with_port({reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1}, port_);
  const RawConnection connection(port_, 15);
  if (!connection.is_open()) return "the server accepts no connection";
  connection.send(std::string_view(request).substr(0, split));
  if (split < request.size()) connection.send(std::string_view(request).substr(split));
  connection.end();
  response_ = connection.response();

  const std::size_t request_end = request.find("\r\n\r\n");
  if (response_.empty()) {
    // Bytes after a head of the largest size may have reset the connection before the response was read.
    return request_end < 16'000 && request.size() < 60'000 ? std::optional("no response to a whole request")
                                                           : std::nullopt;
  }
  if (request_end == std::string::npos && request.size() <= 16384) return "a response to half a request";
  const std::size_t head_end = response_.find("\r\n\r\n");
  if (head_end == std::string::npos) return "the response has no end of its head";
  const std::string head = response_.substr(0, head_end + 2), body = response_.substr(head_end + 4);
  const int status = status_of(response_);
  const std::array statuses = {200, 400, 403, 404, 405, 431, 500};
  if (std::ranges::find(statuses, status) == statuses.end()) return "an unknown status";
  const auto length = length_of(head);
  if (!length) return "no Content-Length";
  if (head.find("\r\nX-Content-Type-Options: nosniff\r\n") == std::string::npos) return "no nosniff";
  if (head.find("secret") != std::string::npos) return "the head tells a secret";
  const bool is_head = request.starts_with("HEAD ");
  if (body.size() != (is_head ? 0 : *length)) return "the body is not as long as the head says";
  if (status != 200) return *length == 0 ? std::nullopt : std::optional("an error has a body");
  if (!is_head && !request.starts_with("GET ")) return "content for another method than GET and HEAD";
  if (!has_field(request, "host:")) return "content without a Host";
  if (request.find("127.0.0.1:" + std::to_string(port_)) == std::string::npos &&
      request.find("localhost:" + std::to_string(port_)) == std::string::npos)
    return "content under another name";
  const std::array<std::string_view, 6> contents = {*page_, *empty_, *long_page_, made, script, index_page};
  const bool is_known = std::ranges::any_of(contents, [&](std::string_view content) {
    return is_head ? content.size() == *length : content == body;
  });
  return is_known ? std::nullopt : std::optional("a body that is none of the contents");
}

}  // namespace kinesphere::program
