// `kinesphere-bench`: measurements that anyone can repeat, and scenes under the algorithms of other papers.
#include <vector>

#include "research/bench/commands.hpp"

int main(int argc, char** argv) {
  using namespace kinesphere::program;
  const auto add_commands = [](CLI::App& app) -> std::vector<Command> {
    return {add_paper(app), add_speed(app), add_gas(app), add_frames(app), add_shapes(app),
            add_soak(app),  add_paths(app), add_run(app), add_verify(app)};
  };
  return run_program({.name = "kinesphere-bench",
                      .description = "Measurements of Kinesphere, and comparisons with what was published.",
                      .footer = {},
                      .add_commands = {add_commands}},
                     argc, argv);
}
