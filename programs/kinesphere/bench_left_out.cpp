// `kinesphere bench` in a program that was built without its benchmarks (KINESPHERE_BUILD_BENCH).
#include "bench/bench.hpp"
#include "program_error.hpp"

namespace kinesphere::program {

CLI::App* add_bench_command(CLI::App& program, BenchCommands&) {
  return program.add_subcommand("bench", "Left out of this program")->allow_extras();
}

int bench(const CLI::App&, const BenchCommands&) {
  throw ProgramError("bench: expected a program that was built with -DKINESPHERE_BUILD_BENCH=ON");
}

}  // namespace kinesphere::program
