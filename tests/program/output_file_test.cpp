// Output files: all or nothing.
#include "output_file.hpp"

#include "support.hpp"

namespace kinesphere::program {
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

TEST_F(OutputFileTest, RefusesWhatIsNoRegularFile) {
  EXPECT_NE(error_of([&] { OutputFile file(path("")); }).find("expected a regular file"), std::string::npos);
  EXPECT_NE(error_of([] { OutputFile file("/dev/null"); }).find("expected a regular file"),
            std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program
