// Removes files when a signal stops the program.
#pragma once

namespace kinesphere::program {

/// While an object lives, the signals that stop programs (SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM and those
/// of exceeded limits) remove the file before they stop the program; ignored signals stay ignored.
class UnfinishedFile {
 public:
  /// `path` must not change while this object lives.
  explicit UnfinishedFile(const char* path);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

 private:
  friend void remove_unfinished_files(int signal);

  const char* path_;
  UnfinishedFile* next_;
};

}  // namespace kinesphere::program
