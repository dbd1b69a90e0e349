// The subcommands of the program.
#pragma once

namespace kinesphere::program {

/// The program: parses its command line, runs the subcommand, and returns its exit code.
int run_kinesphere(int argc, char** argv);

}  // namespace kinesphere::program
