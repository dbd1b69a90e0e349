// The content of a web server: pages in memory, pages made for each request, files of folders.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// The content of one response.
struct Content {
  std::string type;                         ///< value for the header Content-Type
  std::shared_ptr<const std::string> body;  ///< not null
  std::size_t owned_bytes = 0;              ///< memory that goes with `body`; 0 if others keep it anyway
};

/// Maps addresses to contents. find() is thread-safe unless `add_*` runs; the callbacks must be, too.
class ServedContent {
 public:
  /// `content` is not copied and must outlive the server.
  void add_page(const std::string& address, const std::string& type, const std::string& content);
  void add_page(const std::string& address, const std::string& type, std::function<std::string()> content);
  /// Adds the files of a folder below `address`, which is "/" or has no slash at its end. Returns false if
  /// there is no such folder.
  bool add_folder(const std::string& address, const std::string& folder);

  /// Returns the content at a decoded path, a page before a file. A path with a part that begins with a dot
  /// finds no file, so no file outside the folder. Links inside the folder are followed. Throws what the
  /// callbacks throw.
  std::optional<Content> find(const std::string& path) const;

 private:
  std::map<std::string, std::function<Content()>> pages_;
  std::map<std::string, std::string> folders_;
};

}  // namespace kinesphere::program
