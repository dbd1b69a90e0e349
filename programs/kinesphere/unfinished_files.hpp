// Files that must not stay behind when the program is stopped by a signal.
#pragma once

namespace kinesphere::program {

/// While one of these lives, the signals that people and systems stop programs with (SIGHUP, SIGINT, SIGQUIT,
/// SIGPIPE, SIGTERM and those of exceeded limits) remove the file before they stop the program as they would
/// have; signals that are ignored stay ignored.
class UnfinishedFile {
 public:
  /// `path` must stay as it is while this object lives.
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
