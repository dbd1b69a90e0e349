// A file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "unfinished_files.hpp"

namespace kinesphere::program {

struct OutputPlace {
  std::string path;
  /// Whether a later run of the program may go on with the file: then it is written to `<path>.unfinished`,
  /// which stays where there is no commit and no signal removes. An earlier run has written as many bytes of
  /// it, which are kept; what follows them is cut off. Where that run has committed, its file is taken.
  std::optional<std::uint64_t> resumed_at{};
};

/// Writes beside the final name (in the same folder, so that a rename is enough) and takes the final name
/// in commit(). Without a commit nothing is left behind and an older file of that name stays as it was.
/// Nor is anything left behind by a signal that stops the program. Functions throw ProgramError naming the
/// file and the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path) : OutputFile(OutputPlace{std::move(path)}) {}
  explicit OutputFile(OutputPlace place);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Throws nothing: a long run should not be lost with its file. When the disk is full this and all that
  /// follows is dropped, and commit() says so.
  void write(std::string_view text);
  /// Returns when all that has been written is on the disk: how many bytes.
  std::uint64_t sync();
  /// Ends the writing.
  void commit();

  const std::string& path() const { return path_; }
  /// In bytes, with what an earlier run has written.
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
