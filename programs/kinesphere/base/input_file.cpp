// Whole files as text, plain or gzipped.
#include "base/input_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/program_error.hpp"
#include "base/standard_streams.hpp"

namespace kinesphere::program {
namespace {

struct Close {
  void operator()(gzFile file) const { gzclose(file); }
};

[[noreturn]] void fail(const std::string& path, std::string_view reason) {
  throw ProgramError(fmt::format("{}: cannot read: {}", path, reason));
}

}  // namespace

void require_input(const std::string& path) {
  std::error_code ignored;
  if (path == "-") return;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "expected a file, but it is a folder");
  if (!std::filesystem::exists(path, ignored)) fail(path, std::strerror(ENOENT));
}

std::string read_input(const std::string& path) {
  require_input(path);
  if (path == "-" && standard_input_is_closed()) fail("standard input", "it is closed");
  errno = 0;
  // zlib passes an uncompressed file through unchanged.
  const std::unique_ptr<std::remove_pointer_t<gzFile>, Close> file(
      path == "-" ? gzdopen(dup(STDIN_FILENO), "rb") : gzopen(path.c_str(), "rb"));
  if (!file) fail(path, std::strerror(errno != 0 ? errno : ENOMEM));
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (const int got = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) {
    if (got < 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  int error = Z_OK;
  const char* const reason = gzerror(file.get(), &error);
  if (error == Z_ERRNO) fail(path, std::strerror(errno));
  if (error != Z_OK) fail(path, fmt::format("damaged gzip data ({})", reason));
  return text;
}

}  // namespace kinesphere::program
