// Where the alerts of a watch go.
#include "watch/alert_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "program_error.hpp"
#include "standard_output.hpp"

namespace kinesphere::program {
namespace {

class AlertLines final : public AlertOutput {
 public:
  void write(std::uint64_t, std::string_view line) override {
    write_output(line);
    is_open_ = true;
  }
  void flush(std::uint64_t) override {
    if (is_open_) finish_output();
    is_open_ = false;
  }
  std::uint64_t sync() override { return 0; }

 private:
  bool is_open_ = false;
};

class AlertFile final : public AlertOutput {
 public:
  AlertFile(const std::string& path, std::uint64_t kept)
      : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)), length_(kept) {
    if (descriptor_ < 0) fail();
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail();
    if (!S_ISREG(status.st_mode)) {
      close();
      throw ProgramError(
          fmt::format("--alerts: expected a file to write to, but {} is something else", path));
    }
    if (static_cast<std::uint64_t>(status.st_size) < kept) {
      close();
      throw ProgramError(
          fmt::format("{}: expected the {} bytes of alerts that an earlier run has written, but it has {}",
                      path, kept, status.st_size));
    }
    if (::ftruncate(descriptor_, static_cast<off_t>(kept)) != 0 ||
        ::lseek(descriptor_, static_cast<off_t>(kept), SEEK_SET) < 0)
      fail();
  }
  ~AlertFile() override { close(); }
  AlertFile(const AlertFile&) = delete;
  AlertFile& operator=(const AlertFile&) = delete;

  void write(std::uint64_t, std::string_view line) override { waiting_ += line; }
  void flush(std::uint64_t) override {
    std::string_view rest = waiting_;
    while (!rest.empty()) {
      const auto written = ::write(descriptor_, rest.data(), rest.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      rest.remove_prefix(static_cast<std::size_t>(written));
      length_ += static_cast<std::uint64_t>(written);
    }
    waiting_.clear();
  }
  std::uint64_t sync() override {
    if (::fdatasync(descriptor_) != 0) fail();
    return length_;
  }

 private:
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  [[noreturn]] void fail() {
    const int error = errno;
    close();
    throw ProgramError(fmt::format("{}: cannot write: {}", path_, std::strerror(error)));
  }

  std::string path_;
  int descriptor_;
  std::uint64_t length_;
  std::string waiting_;
};

}  // namespace

std::unique_ptr<AlertOutput> make_alert_lines() { return std::make_unique<AlertLines>(); }
std::unique_ptr<AlertOutput> make_alert_file(const std::string& path, std::uint64_t kept) {
  return std::make_unique<AlertFile>(path, kept);
}

}  // namespace kinesphere::program
