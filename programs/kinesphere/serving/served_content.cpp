// The content of a web server: pages in memory, pages made for each request, files of folders.
#include "serving/served_content.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace kinesphere::program {
namespace {

Content owned(const std::string& type, std::string&& text) {
  const auto body = std::make_shared<const std::string>(std::move(text));
  return {.type = type, .body = body, .owned_bytes = body->capacity()};
}

std::string type_of(const std::filesystem::path& file) {
  static const std::map<std::string, std::string> types = {
      {".css", "text/css"},         {".html", "text/html"},      {".ico", "image/x-icon"},
      {".jpg", "image/jpeg"},       {".js", "text/javascript"},  {".json", "application/json"},
      {".map", "application/json"}, {".mjs", "text/javascript"}, {".png", "image/png"},
      {".svg", "image/svg+xml"},    {".txt", "text/plain"},      {".wasm", "application/wasm"},
      {".webp", "image/webp"},      {".woff", "font/woff"},      {".woff2", "font/woff2"},
  };
  const auto found = types.find(file.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

/// Returns true if the path consists of parts joined by single slashes, none empty or with a leading dot.
bool is_below_folder(const std::string& path) {
  return !path.starts_with('/') && !path.ends_with('/') && !path.starts_with('.') &&
         path.find("//") == std::string::npos && path.find("/.") == std::string::npos;
}

std::optional<Content> read_file(const std::filesystem::path& file) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  return owned(type_of(file), {std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace

void ServedContent::add_page(const std::string& address, const std::string& type,
                             const std::string& content) {
  pages_[address] = [type, &content] {
    // An aliasing pointer without an owner.
    return Content{.type = type, .body = {std::shared_ptr<void>(), &content}};
  };
}

void ServedContent::add_page(const std::string& address, const std::string& type,
                             std::function<std::string()> content) {
  pages_[address] = [type, content = std::move(content)] { return owned(type, content()); };
}

bool ServedContent::add_folder(const std::string& address, const std::string& folder) {
  std::error_code unreadable;
  if (!std::filesystem::is_directory(folder, unreadable)) return false;
  folders_[address.ends_with('/') ? address : address + '/'] = folder;
  return true;
}

std::optional<Content> ServedContent::find(const std::string& path) const {
  if (const auto page = pages_.find(path); page != pages_.end()) return page->second();
  for (const auto& [prefix, folder] : folders_) {
    if (!path.starts_with(prefix)) continue;
    std::string below = path.substr(prefix.size());
    if (below.empty()) below = "index.html";
    if (!is_below_folder(below)) continue;
    if (auto content = read_file(std::filesystem::path(folder) / below)) return content;
  }
  return std::nullopt;
}

}  // namespace kinesphere::program
