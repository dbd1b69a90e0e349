// A file that appears under its name only when it is complete.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// Writes beside the final name (in the same folder, so that a rename is enough) and takes the final name
/// in commit(). Without a commit nothing is left behind and an older file of that name stays as it was.
/// Every function but the destructor throws ProgramError naming the file and the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

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
};

}  // namespace kinesphere::program
