// A file or standard input as it comes in, plain or gzipped.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "watch/report_source.hpp"
#include "watch/stop_signals.hpp"

namespace kinesphere::program {

class FileSource final : public ReportSource {
 public:
  /// "-" is standard input. A file is read on from the place, if that is in it; what comes through a pipe
  /// goes on by itself. Throws ProgramError when it cannot be opened, or is not the one that was read.
  FileSource(const std::string& path, const StopSignals& stop, const StreamPlace* from = nullptr);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  Outcome next(std::chrono::milliseconds patience, std::string_view& text) override;
  std::uint64_t position() const override { return handed_over_; }
  StreamPlace place(std::size_t without) const override;
  std::string name() const override { return path_ == "-" ? "standard input" : path_; }

 private:
  class Inflater;
  Outcome read_some(std::chrono::milliseconds patience);
  Outcome unpacked(std::chrono::milliseconds patience, std::string_view& text);
  void go_on_from(const StreamPlace& place);
  /// Of bytes of a file that end there; 0 if it is none, or packed.
  std::uint32_t check_before(std::uint64_t position) const;
  [[noreturn]] void fail(std::string_view reason) const;

  std::string path_;
  const StopSignals& stop_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t filled_ = 0;
  bool has_begun_ = false;
  bool is_file_ = false;  ///< which can be read again
  std::uint64_t handed_over_ = 0;
  std::uint64_t to_pass_over_ = 0;      ///< of what is packed: bytes that an earlier run has read
  std::unique_ptr<Inflater> inflater_;  ///< of what is gzipped
};

}  // namespace kinesphere::program
