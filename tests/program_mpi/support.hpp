// Runs kinesphere-mpi, and kinesphere for comparison.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program {

class MpiProgramTest : public ProgramTest {
 protected:
  /// `before` is shell text that precedes mpirun.
  ProgramRun run_mpi(int ranks, const std::string& arguments, const std::string& before = "") const {
    const std::string mpirun =
        std::string("'") + KINESPHERE_MPIRUN + "' " + KINESPHERE_MPIRUN_RANKS + " " + std::to_string(ranks);
    return run_shell(before + mpirun + " '" + KINESPHERE_MPI_PROGRAM + "' " + arguments);
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

/// Returns the lines that the program itself has printed, without those of mpirun.
inline std::vector<std::string> messages_in(const std::string& err) {
  std::vector<std::string> lines = lines_of(err);
  std::erase_if(lines, [](const std::string& line) { return !line.starts_with("kinesphere-mpi: "); });
  return lines;
}

}  // namespace kinesphere::program
