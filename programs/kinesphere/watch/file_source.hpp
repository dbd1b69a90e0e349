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
  /// "-" is standard input. Throws ProgramError when it cannot be opened.
  FileSource(const std::string& path, const StopSignals& stop);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  Outcome next(std::chrono::milliseconds patience, std::string_view& text) override;
  std::string name() const override { return path_ == "-" ? "standard input" : path_; }

 private:
  class Inflater;
  Outcome read_some(std::chrono::milliseconds patience);
  [[noreturn]] void fail(std::string_view reason) const;

  std::string path_;
  const StopSignals& stop_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t filled_ = 0;
  bool has_begun_ = false;
  std::unique_ptr<Inflater> inflater_;  ///< of what is gzipped
};

}  // namespace kinesphere::program
