// The command line of Kinesphere on several processes, which mpirun starts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "distributed_run.hpp"
#include "kinesphere/distributed/mpi_session.hpp"
#include "kinesphere/version.hpp"
#include "ranks.hpp"
#include "shared_error.hpp"

namespace kinesphere::program {
namespace {

/// Prints the message on the first rank only.
int complain(const MpiSession& session, std::string message, int exit_code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (session.rank() == 0) fmt::print(stderr, "kinesphere-mpi: {}\n", message);
  return exit_code;
}

int main(const MpiSession& session, int argc, char** argv) {
  CLI::App app("Kinesphere on several processes: every collision among moving spheres, without time steps.",
               "kinesphere-mpi");
  app.set_version_flag("--version", std::string(version));
  app.require_subcommand(0, 1);
  DistributedRunOptions run_options;
  const CLI::App* const run_command = add_distributed_run_command(app, run_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    const int exit_code = app.exit(help, text, text);
    Ranks().on_first(exit_wrong_input, [&] {
      write_output(text.str());
      finish_output();
    });
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return complain(session, fmt::format("{} (see --help)", error.what()), exit_wrong_input);
  }
  if (!*run_command) return complain(session, "expected a command: run (see --help)", exit_wrong_input);
  return distributed_run(session, run_options);
}

}  // namespace
}  // namespace kinesphere::program

int main(int argc, char** argv) {
  using namespace kinesphere::program;
  const kinesphere::MpiSession session(argc, argv);
  try {
    return kinesphere::program::main(session, argc, argv);
  } catch (const SharedError& error) {
    return complain(session, error.what(), error.exit_code());
  }
}
