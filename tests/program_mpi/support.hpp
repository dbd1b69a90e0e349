// Runs kinesphere-mpi, and kinesphere for comparison.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program {

inline bool is_mpich() { return std::string_view(KINESPHERE_MPIRUN).find("mpich") != std::string_view::npos; }

class MpiProgramTest : public ProgramTest {
 protected:
  /// Returns how many ranks are started where so many are wanted: those of MPICH wait busily, so no more than
  /// there are processors.
  static int started(int ranks) {
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return is_mpich() ? std::min(ranks, processors) : ranks;
  }
  /// Returns the text that starts a program on so many ranks.
  static std::string mpirun(int ranks) {
    return std::string("'") + KINESPHERE_MPIRUN + "' " + KINESPHERE_MPIRUN_RANKS + " " +
           std::to_string(started(ranks)) + " ";
  }
  /// Returns the names of the files of so many ranks.
  static std::vector<std::string> files_of(int ranks) {
    std::vector<std::string> files;
    for (int rank = 0; rank < started(ranks); ++rank) files.push_back("all.csv." + std::to_string(rank));
    return files;
  }
  /// `before` is shell text that precedes mpirun.
  ProgramRun run_mpi(int ranks, const std::string& arguments, const std::string& before = "") const {
    return run_shell(before + mpirun(ranks) + "'" + KINESPHERE_MPI_PROGRAM + "' " + arguments);
  }

  /// The output of kinesphere for a scene.
  struct Expected {
    std::string hash;
    std::string contacts;
  };
  Expected expected(const std::string& scene, const std::string& ending = "csv") const {
    const std::string file = path("expected." + ending);
    const ProgramRun one = run_mpi(1, "run " + scene + " --hash-only --contacts '" + file + "'");
    EXPECT_EQ(one.exit_code, 0) << one.err;
    Expected found{one.out, read_text(file)};
    std::filesystem::remove(file);
    return found;
  }
};

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// mpirun's exit code where a rank was killed: 128 more than the signal by Open MPI, the signal itself by
/// MPICH.
inline bool was_killed(const ProgramRun& run) { return run.exit_code == 137 || run.exit_code == 9; }

/// Returns the lines that the program itself has printed, without those of mpirun.
inline std::vector<std::string> messages_in(const std::string& err) {
  std::vector<std::string> lines = lines_of(err);
  std::erase_if(lines, [](const std::string& line) { return !line.starts_with("kinesphere-mpi: "); });
  return lines;
}

}  // namespace kinesphere::program
