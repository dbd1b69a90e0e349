// Destinations of the alerts of a watch.
#include "watch/output/alert_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "watch/source/file_bytes.hpp"

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
  AlertsPlace sync() override { return {}; }

 private:
  bool is_open_ = false;
};

class AlertFile final : public AlertOutput {
 public:
  AlertFile(const std::string& path, const std::optional<ToldBefore>& before)
      : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail();
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail();
    if (!S_ISREG(status.st_mode))
      refuse(fmt::format("--alerts: expected a file to write to, but {} is something else", path));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      refuse(fmt::format("{}: another program writes alerts to it", path));
    if (before) length_ = kept_of(*before, static_cast<std::uint64_t>(status.st_size));
    const auto end = static_cast<off_t>(length_);
    if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) < 0) fail();
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
  AlertsPlace sync() override {
    if (::fdatasync(descriptor_) != 0) fail();
    return {length_, check_before(length_)};
  }

 private:
  /// Returns how many of `size` bytes to keep.
  std::uint64_t kept_of(const ToldBefore& before, std::uint64_t size) {
    const auto& [bytes, check] = before.place;
    if (bytes > 0 && before.was_here && size < bytes)
      refuse(fmt::format("{}: expected the {} bytes of alerts that an earlier run has written, but it has {}",
                         path_, bytes, size));
    const bool goes_on = bytes > 0 ? size >= bytes && check_before(bytes) == check : before.was_here;
    if (goes_on) return before.is_told_again ? bytes : end_of_lines(bytes, size);
    if (before.was_here)
      refuse(
          fmt::format("{}: expected the alerts that an earlier run has written, but its first {} bytes are "
                      "others",
                      path_, bytes));
    if (size > 0)
      refuse(
          fmt::format("--alerts: expected a file that is new, or has what the run before has written, but "
                      "{} has something else",
                      path_));
    return 0;
  }

  /// Returns the end of the last whole line in these bytes.
  std::uint64_t end_of_lines(std::uint64_t begin, std::uint64_t end) const {
    for (std::uint64_t at = end; at > begin; --at)
      if (bytes_at(descriptor_, at - 1, 1) == "\n") return at;
    return begin;
  }

  std::uint64_t check_before(std::uint64_t end) const {
    constexpr std::uint64_t most_checked = 4096;
    const std::uint64_t count = std::min(end, most_checked);
    return checksum_of(bytes_at(descriptor_, end - count, count));
  }

  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  [[noreturn]] void fail() { refuse(fmt::format("{}: cannot write: {}", path_, std::strerror(errno))); }
  [[noreturn]] void refuse(const std::string& why) {
    close();
    throw ProgramError(why);
  }

  std::string path_;
  int descriptor_;
  std::uint64_t length_ = 0;
  std::string waiting_;
};

}  // namespace

std::unique_ptr<AlertOutput> make_alert_lines() { return std::make_unique<AlertLines>(); }
std::unique_ptr<AlertOutput> make_alert_file(const std::string& path,
                                             const std::optional<ToldBefore>& before) {
  return std::make_unique<AlertFile>(path, before);
}

}  // namespace kinesphere::program
