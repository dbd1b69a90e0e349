// Reads a file or standard input as it grows, plain or gzipped.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"

namespace kinesphere::program {

class FileSource final : public ReportSource {
 public:
  /// "-" is standard input. Reading continues from the place, if the file has it; a pipe continues by itself.
  /// Throws ProgramError if the file cannot be opened, or is not the one that was read; for a gzipped file
  /// next() finds the latter.
  FileSource(const std::string& path, const StopSignals& stop, const StreamPlace* from = nullptr);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  Outcome next(std::chrono::milliseconds patience, std::string_view& text) override;
  std::uint64_t position(std::size_t without) const override { return handed_over_ - without; }
  StreamPlace place(std::size_t without) const override;
  std::optional<std::string> identity() const override;
  Nature nature() const override { return nature_; }
  std::string name() const override { return path_ == "-" ? "standard input" : path_; }

 private:
  class Inflater;
  Outcome read_some(std::chrono::milliseconds patience);
  Outcome unpacked(std::chrono::milliseconds patience, std::string_view& text);
  void go_on_from(const StreamPlace& place);
  void pass_over(std::string_view& text);
  /// Returns the checksum of a file up to a position; 0 if it is not a file.
  std::uint64_t check_before(std::uint64_t position) const;
  [[noreturn]] void fail(std::string_view reason) const;
  [[noreturn]] void fail_as_another() const;

  std::string path_;
  const StopSignals& stop_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t filled_ = 0;
  bool has_begun_ = false;
  bool is_file_ = false;  ///< which can be read again
  Nature nature_ = Nature::unknown;
  bool is_packed_ = false;  ///< such a file, and gzipped
  std::uint64_t handed_over_ = 0;
  // Set for gzipped input.
  std::unique_ptr<Inflater> inflater_;
  std::string beginning_;            ///< unpacked
  std::optional<StreamPlace> from_;  ///< until what an earlier run has read is passed over
  std::uint64_t to_pass_over_ = 0;   ///< bytes to skip
};

}  // namespace kinesphere::program
