// Finds the built pages of browser/viewer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kinesphere::program {

/// The command that builds the pages, for messages.
extern const char* const build_pages_command;

/// Returns the folders to search, the first choice first: the folder in the environment variable
/// KINESPHERE_VIEWER or, if that is not set, the install folder next to this program and its build tree.
std::vector<std::filesystem::path> page_folders();
/// Returns the first of page_folders() that has this page; nothing if there is none.
std::optional<std::filesystem::path> folder_with_page(const std::string& page);
bool has_page(const std::filesystem::path& folder, const std::string& page);

}  // namespace kinesphere::program
