#include "bench/bench.hpp"

#include "bench/gas.hpp"
#include "bench/paper.hpp"
#include "bench/speed/speed.hpp"

namespace kinesphere::program {

CLI::App* add_bench_command(CLI::App& program, BenchCommands& commands) {
  CLI::App* command = program.add_subcommand("bench", "Measure, and compare with what was published");
  command->require_subcommand(1);
  add_bench_paper_command(*command, commands.paper);
  add_bench_speed_command(*command, commands.speed);
  add_bench_gas_command(*command, commands.gas);
  add_bench_vessels_command(*command, commands.vessels);
  add_bench_monitoring_command(*command, commands.monitoring);
  add_bench_soak_command(*command, commands.soak);
  add_bench_satellites_command(*command, commands.satellites);
  return command;
}

int bench(const CLI::App& command, const BenchCommands& commands) {
  if (command.got_subcommand("gas")) return bench_gas(commands.gas);
  if (command.got_subcommand("vessels")) return bench_vessels(commands.vessels);
  if (command.got_subcommand("soak")) return bench_soak(commands.soak);
  if (command.got_subcommand("monitoring")) return bench_monitoring(commands.monitoring);
  if (command.got_subcommand("satellites")) return bench_satellites(commands.satellites);
  return command.got_subcommand("speed") ? bench_speed(commands.speed) : bench_paper(commands.paper);
}

}  // namespace kinesphere::program
