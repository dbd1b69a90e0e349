// Output files appear complete or not at all.
#include "base/output_file.hpp"

#include <sys/resource.h>

#include <csignal>

#include "support.hpp"

namespace kinesphere::program::output_file_test {
namespace {

using OutputFileTest = FolderTest;
using Names = std::vector<std::string>;

TEST_F(OutputFileTest, AppearsOnCommitOnly) {
  OutputFile file(path("log.csv"));
  file.write("one\n");
  EXPECT_FALSE(std::filesystem::exists(path("log.csv")));
  file.write("two\n");
  file.commit();
  EXPECT_EQ(names(), Names{"log.csv"});
  EXPECT_EQ(read_text(path("log.csv")), "one\ntwo\n");
}

TEST_F(OutputFileTest, LeavesNothingWithoutCommit) {
  { OutputFile(path("log.csv")).write("half"); }
  EXPECT_EQ(names(), Names{});
}

TEST_F(OutputFileTest, KeepsTheOldFileWithoutCommit) {
  write("log.csv", "old");
  { OutputFile(path("log.csv")).write("half"); }
  EXPECT_EQ(read_text(path("log.csv")), "old");
  EXPECT_EQ(names(), Names{"log.csv"});
}

TEST_F(OutputFileTest, ReplacesTheOldFileOnCommit) {
  write("log.csv", "old and longer");
  OutputFile file(path("log.csv"));
  file.write("new");
  file.commit();
  EXPECT_EQ(read_text(path("log.csv")), "new");
}

TEST_F(OutputFileTest, IsGoneOnWithByALaterRun) {
  {
    OutputFile file(OutputPlace{path("log.csv"), 0});
    file.write("kept");
    EXPECT_EQ(file.sync(), 4u);
    file.write(", not kept");
  }
  EXPECT_EQ(names(), Names{"log.csv.unfinished"});
  {
    OutputFile file(OutputPlace{path("log.csv"), 4});
    file.write(" and more");
    EXPECT_EQ(file.sync(), 13u);
    file.commit();
  }
  EXPECT_EQ(names(), Names{"log.csv"});
  EXPECT_EQ(read_text(path("log.csv")), "kept and more");
  // The file was complete already.
  OutputFile file(OutputPlace{path("log.csv"), 8});
  EXPECT_EQ(names(), Names{"log.csv.unfinished"});
  file.commit();
  EXPECT_EQ(read_text(path("log.csv")), "kept and");
}

TEST_F(OutputFileTest, GoesOnOnlyWithWhatIsThere) {
  write("log.csv", "short");
  const std::string message = error_of([&] { OutputFile file(OutputPlace{path("log.csv"), 9}); });
  EXPECT_EQ(message, path("log.csv") + ": expected the 9 bytes that an earlier run has written, but got 5");
  EXPECT_EQ(names(), Names{"log.csv"});
  EXPECT_NE(error_of([&] {
              OutputFile file(OutputPlace{path("other.csv"), 1});
            }).find("No such file"),
            std::string::npos);
}

TEST_F(OutputFileTest, FollowsALink) {
  write("target", "old");
  std::filesystem::create_symlink("target", path("link"));
  OutputFile file(path("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read_text(path("target")), "new");
}

TEST_F(OutputFileTest, NamesAFolderThatDoesNotExist) {
  const std::string name = path("nowhere/log.csv");
  EXPECT_EQ(error_of([&] { OutputFile file(name); }), name + ": cannot write: No such file or directory");
}

/// Acts like a disk that is full after a number of bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(OutputFileTest, NoticesAFullDiskAtTheLastByte) {
  write("log.csv", "old");
  const std::string message = error_of([&] {
    OutputFile file(path("log.csv"));
    file.write(std::string(200, 'x'));
    const FullDisk full(100);
    file.commit();
  });
  EXPECT_EQ(message, path("log.csv") + ": cannot write: File too large");
  EXPECT_EQ(read_text(path("log.csv")), "old");
  EXPECT_EQ(names(), Names{"log.csv"});
}

TEST_F(OutputFileTest, RefusesWhatIsNoRegularFile) {
  EXPECT_NE(error_of([&] { OutputFile file(path("")); }).find("expected a regular file"), std::string::npos);
  EXPECT_NE(error_of([] { OutputFile file("/dev/null"); }).find("expected a regular file"),
            std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::output_file_test
