// A file that appears under its name only when it is complete.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "unfinished_files.hpp"

namespace kinesphere::program {

/// Writes beside the final name (in the same folder, so that a rename is enough) and takes the final name
/// in commit(). Without a commit nothing is left behind and an older file of that name stays as it was.
/// Nor is anything left behind by a signal that stops the program. Functions throw ProgramError naming the
/// file and the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Throws nothing: a long run should not be lost with its file. When the disk is full this and all that
  /// follows is dropped, and commit() says so.
  void write(std::string_view text);
  /// Ends the writing.
  void commit();

  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::string temporary_path_;  ///< empty once committed
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<UnfinishedFile> unfinished_;
  int write_error_ = 0;
};

}  // namespace kinesphere::program
