// A file that appears under its name only when it is complete.
#include "output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw ProgramError(fmt::format("{}: cannot write: {}", path, std::strerror(error)));
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw ProgramError(fmt::format("{}: cannot write: expected a regular file", path_));
  }
  // A link stays a link: what it points to is replaced.
  const fs::path target =
      fs::is_symlink(fs::symlink_status(path_, ignored)) ? fs::canonical(path_, ignored) : fs::path(path_);
  if (!target.empty()) path_ = target.string();
  temporary_path_ = fmt::format("{}.part-{}", path_, ::getpid());
  unfinished_.emplace(temporary_path_.c_str());
  file_.reset(std::fopen(temporary_path_.c_str(), "wbx"));
  if (!file_) fail(path_, errno);
}

OutputFile::~OutputFile() {
  file_.reset();
  if (!temporary_path_.empty()) std::remove(temporary_path_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (write_error_ != 0) return;
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) return;
  write_error_ = errno != 0 ? errno : EIO;
}

void OutputFile::commit() {
  const bool closed = std::fclose(file_.release()) == 0;
  if (write_error_ != 0) fail(path_, write_error_);
  if (!closed || std::rename(temporary_path_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  unfinished_.reset();
  temporary_path_.clear();
}

}  // namespace kinesphere::program
