// Where the pages of browser/viewer are, once they have been built.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kinesphere::program {

/// The command that builds them.
extern const char* const build_pages_command;

/// Where they may be, the first choice first: in the folder that the environment variable KINESPHERE_VIEWER
/// names or, where it is not set, where they are installed beside this program, or in its build tree.
std::vector<std::filesystem::path> page_folders();
/// The first of these that has this page.
std::optional<std::filesystem::path> folder_with_page(const std::string& page);
bool has_page(const std::filesystem::path& folder, const std::string& page);

}  // namespace kinesphere::program
