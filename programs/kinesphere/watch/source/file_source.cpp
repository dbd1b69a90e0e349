// Reads a file or standard input as it grows, plain or gzipped.
#include "watch/source/file_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/program_error.hpp"
#include "base/standard_streams.hpp"
#include "watch/source/file_bytes.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t source_block = std::size_t{1} << 16;
/// Maximum bytes in the checksum that identifies a stream.
constexpr std::size_t most_checked = 4096;
constexpr std::string_view gzip_begin = "\x1f\x8b";

}  // namespace

/// Unpacks the bytes that have arrived. Several gzip files may follow each other.
class FileSource::Inflater {
 public:
  Inflater() : unpacked_(4 * source_block) { start(); }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void feed(const char* bytes, std::size_t count) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes));
    stream_.avail_in = static_cast<uInt>(count);
  }
  /// Returns the next unpacked text; empty if more bytes are needed. Sets `damaged` if the bytes cannot be
  /// unpacked.
  std::string_view next(bool& damaged) {
    while (stream_.avail_in > 0 || pending_) {
      if (is_between_) {
        if (stream_.avail_in == 0) break;
        inflateReset(&stream_);
        is_between_ = false;
      }
      stream_.next_out = reinterpret_cast<Bytef*>(unpacked_.data());
      stream_.avail_out = static_cast<uInt>(unpacked_.size());
      const int result = inflate(&stream_, Z_NO_FLUSH);
      const std::size_t count = unpacked_.size() - stream_.avail_out;
      pending_ = stream_.avail_out == 0;
      if (result == Z_STREAM_END) {
        is_between_ = true;
        pending_ = false;
      } else if (result != Z_OK && result != Z_BUF_ERROR) {
        damaged = true;
        return {};
      }
      if (count > 0) return {unpacked_.data(), count};
      if (result == Z_BUF_ERROR) break;
    }
    return {};
  }
  bool is_whole() const { return is_between_; }

 private:
  void start() {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_alone) != Z_OK) throw std::bad_alloc();
  }

  z_stream stream_{};
  std::vector<char> unpacked_;
  bool pending_ = false;
  bool is_between_ = false;  ///< one gzip file has ended, and no other has begun
};

FileSource::FileSource(const std::string& path, const StopSignals& stop, const StreamPlace* from)
    : path_(path), stop_(stop), buffer_(source_block) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("expected a file, but it is a folder");
  if (path == "-" && standard_input_is_closed()) fail("it is closed");
  descriptor_ = path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) fail(std::strerror(errno));
  struct stat status {};
  is_file_ = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (is_file_) nature_ = Nature::recording;
  // A serial port, for example.
  else if (S_ISCHR(status.st_mode))
    nature_ = Nature::live;
  // The caller may have read a part of standard input already.
  if (is_file_)
    handed_over_ = static_cast<std::uint64_t>(std::max<off_t>(0, ::lseek(descriptor_, 0, SEEK_CUR)));
  is_packed_ = is_file_ && bytes_at(descriptor_, handed_over_, 2) == gzip_begin;
  if (is_packed_) handed_over_ = 0;
  if (from != nullptr && from->stream == name()) go_on_from(*from);
}

FileSource::~FileSource() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileSource::fail(std::string_view reason) const {
  throw ProgramError(fmt::format("{}: cannot read: {}", name(), reason));
}

void FileSource::fail_as_another() const {
  throw ProgramError(
      fmt::format("{}: expected the stream that the snapshot was made of, but its first {} bytes are others",
                  name(), from_->position));
}

void FileSource::go_on_from(const StreamPlace& place) {
  if (!is_file_) {
    handed_over_ = place.position;
    return;
  }
  // A stream read through a pipe before is not in this file.
  if (place.check == 0) return;
  from_ = place;
  if (is_packed_) {
    to_pass_over_ = place.position;
    return;
  }
  if (check_before(place.position) != place.check) fail_as_another();
  handed_over_ = place.position;
  ::lseek(descriptor_, static_cast<off_t>(place.position), SEEK_SET);
}

std::uint64_t FileSource::check_before(std::uint64_t position) const {
  if (!is_file_ || position == 0) return 0;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(position, most_checked));
  const std::string bytes =
      is_packed_ ? beginning_.substr(0, count) : bytes_at(descriptor_, position - count, count);
  if (bytes.size() < count) return 0;
  // 0 stands for no checksum.
  return std::max<std::uint64_t>(1, checksum_of(bytes));
}

StreamPlace FileSource::place(std::size_t without) const {
  if (to_pass_over_ > 0) return *from_;
  const std::uint64_t position = handed_over_ - without;
  return {name(), position, check_before(position)};
}

std::optional<std::string> FileSource::identity() const {
  if (!is_file_) return std::nullopt;
  // The file may grow, and may have several names.
  constexpr std::size_t enough = 512;
  return fmt::format("file {:016x}", checksum_of(bytes_at(descriptor_, 0, enough)));
}

ReportSource::Outcome FileSource::read_some(std::chrono::milliseconds patience) {
  pollfd ready[2] = {{descriptor_, POLLIN, 0}, {stop_.descriptor(), POLLIN, 0}};
  const int count = ::poll(ready, 2, static_cast<int>(patience.count()));
  if (count < 0 && errno != EINTR) fail(std::strerror(errno));
  if (count <= 0 || ready[0].revents == 0) return Outcome::quiet;
  const auto got = ::read(descriptor_, buffer_.data() + filled_, buffer_.size() - filled_);
  if (got < 0) {
    if (errno == EINTR || errno == EAGAIN) return Outcome::quiet;
    fail(std::strerror(errno));
  }
  filled_ += static_cast<std::size_t>(got);
  return got == 0 ? Outcome::end : Outcome::text;
}

ReportSource::Outcome FileSource::next(std::chrono::milliseconds patience, std::string_view& text) {
  const Outcome outcome = unpacked(patience, text);
  if (outcome == Outcome::end && to_pass_over_ > 0) fail_as_another();
  if (outcome != Outcome::text) return outcome;
  if (is_packed_ && beginning_.size() < most_checked)
    beginning_ += text.substr(0, most_checked - beginning_.size());
  if (to_pass_over_ > 0) pass_over(text);
  handed_over_ += text.size();
  return text.empty() ? Outcome::quiet : Outcome::text;
}

void FileSource::pass_over(std::string_view& text) {
  const auto passed = std::min<std::uint64_t>(to_pass_over_, text.size());
  text.remove_prefix(passed);
  to_pass_over_ -= passed;
  handed_over_ += passed;
  if (to_pass_over_ == 0 && check_before(from_->position) != from_->check) fail_as_another();
}

ReportSource::Outcome FileSource::unpacked(std::chrono::milliseconds patience, std::string_view& text) {
  bool damaged = false;
  if (inflater_) {
    text = inflater_->next(damaged);
    if (damaged) fail("damaged gzip data");
    if (!text.empty()) return Outcome::text;
    filled_ = 0;
  }
  if (has_begun_) filled_ = 0;
  const Outcome outcome = read_some(patience);
  if (outcome == Outcome::quiet) return outcome;
  if (outcome == Outcome::end && inflater_ && !inflater_->is_whole())
    fail("damaged gzip data (it ends too early)");
  if (!has_begun_) {
    // A gzip file begins with these two bytes.
    if (outcome == Outcome::text && filled_ < 2 && buffer_[0] == '\x1f') return Outcome::quiet;
    has_begun_ = true;
    if (filled_ >= 2 && buffer_[0] == '\x1f' && buffer_[1] == '\x8b')
      inflater_ = std::make_unique<Inflater>();
  }
  if (filled_ == 0) return Outcome::end;
  if (!inflater_) {
    text = {buffer_.data(), filled_};
    return Outcome::text;
  }
  inflater_->feed(buffer_.data(), filled_);
  text = inflater_->next(damaged);
  if (damaged) fail("damaged gzip data");
  return text.empty() ? Outcome::quiet : Outcome::text;
}

}  // namespace kinesphere::program
