// A file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/unfinished_files.hpp"

namespace kinesphere::program {

struct OutputPlace {
  std::string path;
  /// If set, a later run may continue the file: it is written to `<path>.unfinished`, which stays without a
  /// commit and which no signal removes. The value is the number of bytes that an earlier run has written;
  /// these are kept and later bytes cut off. If that run has committed, its file is continued.
  std::optional<std::uint64_t> resumed_at{};
};

/// Writes next to the final name (in the same folder, so that a rename suffices) and takes the final name in
/// commit(). Without a commit, or after a signal that stops the program, nothing is left behind and an older
/// file of that name stays unchanged. Functions throw ProgramError naming the file and the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path) : OutputFile(OutputPlace{std::move(path)}) {}
  explicit OutputFile(OutputPlace place);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Throws nothing, so that a long run is not lost with its file. After a failed write, such as on a full
  /// disk, all further output is dropped and commit() throws.
  void write(std::string_view text);
  /// Flushes all written bytes to the disk. Returns their number.
  std::uint64_t sync();
  /// Completes the file and gives it its final name.
  void commit();

  const std::string& path() const { return path_; }
  /// Bytes, including those that an earlier run has written.
  std::uint64_t length() const { return length_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void open_new();
  void open_again(std::uint64_t kept);

  std::string path_;
  std::string temporary_path_;  ///< empty once committed
  bool is_resumable_;
  std::uint64_t length_;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<UnfinishedFile> unfinished_;
  int write_error_ = 0;
};

}  // namespace kinesphere::program
