// A file that appears under its name only when it is complete.
#include "base/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw ProgramError(fmt::format("{}: cannot write: {}", path, std::strerror(error)));
}

}  // namespace

OutputFile::OutputFile(OutputPlace place)
    : path_(std::move(place.path)),
      is_resumable_(place.resumed_at.has_value()),
      length_(place.resumed_at.value_or(0)) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw ProgramError(fmt::format("{}: cannot write: expected a regular file", path_));
  }
  // The target of a link is replaced, not the link.
  const fs::path target =
      fs::is_symlink(fs::symlink_status(path_, ignored)) ? fs::canonical(path_, ignored) : fs::path(path_);
  if (!target.empty()) path_ = target.string();
  if (is_resumable_) {
    open_again(length_);
  } else {
    open_new();
  }
  if (!file_) fail(path_, errno);
}

void OutputFile::open_new() {
  temporary_path_ = fmt::format("{}.part-{}", path_, ::getpid());
  unfinished_.emplace(temporary_path_.c_str());
  file_.reset(std::fopen(temporary_path_.c_str(), "wbx"));
}

void OutputFile::open_again(std::uint64_t kept) {
  namespace fs = std::filesystem;
  temporary_path_ = path_ + ".unfinished";
  std::error_code error;
  if (kept > 0) {
    const std::string before = fs::exists(temporary_path_, error) ? temporary_path_ : path_;
    const std::uintmax_t there = fs::file_size(before, error);
    if (error || there < kept)
      throw ProgramError(fmt::format("{}: expected the {} bytes that an earlier run has written, but got {}",
                                     before, kept, error ? error.message() : std::to_string(there)));
    if (before != temporary_path_) fs::rename(before, temporary_path_, error);
    if (error) fail(path_, error.value());
    fs::resize_file(temporary_path_, kept, error);
    if (error) fail(temporary_path_, error.value());
  }
  file_.reset(std::fopen(temporary_path_.c_str(), kept > 0 ? "ab" : "wb"));
}

OutputFile::~OutputFile() {
  file_.reset();
  if (!temporary_path_.empty() && !is_resumable_) std::remove(temporary_path_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (write_error_ != 0) return;
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) {
    length_ += text.size();
    return;
  }
  write_error_ = errno != 0 ? errno : EIO;
}

std::uint64_t OutputFile::sync() {
  if (write_error_ != 0) fail(path_, write_error_);
  if (std::fflush(file_.get()) != 0 || ::fsync(::fileno(file_.get())) != 0) fail(path_, errno);
  return length_;
}

void OutputFile::commit() {
  const bool closed = std::fclose(file_.release()) == 0;
  if (write_error_ != 0) fail(path_, write_error_);
  if (!closed || std::rename(temporary_path_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  unfinished_.reset();
  temporary_path_.clear();
}

}  // namespace kinesphere::program
