// Support for tests of the program: temporary folders, errors of one line, runs of the real program.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_error.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Continues with the state of another format, as a later run does from its bytes.
inline void take_state(const ReportFormat& from, ReportFormat& to) {
  ByteWriter written;
  from.save(written);
  ByteReader state(written.bytes());
  to.restore(state);
  EXPECT_FALSE(state.failed());
  EXPECT_EQ(state.remaining(), 0u);
}

/// Gives each test a folder of its own, and removes it afterwards.
class FolderTest : public ::testing::Test {
 protected:
  FolderTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kinesphere-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) std::abort();
    folder_ = pattern;
  }
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  std::filesystem::path folder_;
};

/// Returns the message of the ProgramError that `action` must throw; expects one line.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const ProgramError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "expected a ProgramError";
  return {};
}

struct ProgramRun {
  int exit_code;
  std::string out, err;
};

/// Tests that run the program as a user would.
class ProgramTest : public FolderTest {
 protected:
  /// `before` is shell text that precedes the program.
  ProgramRun run(const std::string& arguments, const std::string& before = "") const {
    return run_shell(before + "'" + KINESPHERE_PROGRAM + "' " + arguments);
  }
  ProgramRun run_shell(const std::string& text) const {
    const std::string command = "(" + text + ") >'" + path("out") + "' 2>'" + path("err") + "'";
    const int status = std::system(command.c_str());
    ProgramRun result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(path("out")),
                      read_text(path("err"))};
    std::filesystem::remove(path("out"));
    std::filesystem::remove(path("err"));
    return result;
  }
  /// Expects exit code 2, nothing on stdout, and one line on stderr that has all of `parts`. `before` as for
  /// run().
  void expect_wrong_input(const std::string& arguments, std::initializer_list<std::string_view> parts,
                          const std::string& before = "") const {
    SCOPED_TRACE(arguments);
    const ProgramRun result = run(arguments, before);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n'));
    for (std::string_view part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << "\n" << result.err;
  }
};

/// Returns the path of a file of recorded tracks outside the project; empty if it does not exist.
inline std::string recorded_file(const std::string& name) {
  const char* folder = std::getenv("KINESPHERE_DATA");
  const auto path = std::filesystem::path(folder != nullptr ? folder : KINESPHERE_DEFAULT_DATA) / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

}  // namespace kinesphere::program
