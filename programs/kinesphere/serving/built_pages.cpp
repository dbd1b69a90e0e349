// Finds the built pages of browser/viewer.
#include "serving/built_pages.hpp"

#include <cstdlib>
#include <system_error>

namespace kinesphere::program {

const char* const build_pages_command =
    "scripts/setup.sh browser && cmake --preset browser && cmake --build --preset browser";

std::vector<std::filesystem::path> page_folders() {
  if (const char* const set = std::getenv("KINESPHERE_VIEWER")) return {set};
  std::vector<std::filesystem::path> folders;
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) folders.push_back(program.parent_path().parent_path() / "share/kinesphere/viewer");
  folders.emplace_back(KINESPHERE_BUILT_VIEWER);
  return folders;
}

std::optional<std::filesystem::path> folder_with_page(const std::string& page) {
  for (const auto& folder : page_folders())
    if (has_page(folder, page)) return folder;
  return std::nullopt;
}

bool has_page(const std::filesystem::path& folder, const std::string& page) {
  std::error_code unreadable;
  return std::filesystem::is_regular_file(folder / page, unreadable);
}

}  // namespace kinesphere::program
