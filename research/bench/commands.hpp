// The commands of `kinesphere-bench`. Each function adds one to the program.
#pragma once

#include <CLI/App.hpp>

#include "command_line.hpp"
#include "scenes/named_detector.hpp"

namespace kinesphere::program {

/// The evaluation of the paper, repeated on this machine.
Command add_paper(CLI::App& app);
/// The cost of missing nothing, compared with the cost of looking now and then.
Command add_speed(CLI::App& app);
/// Collision rate and pressure of hard spheres, compared with theory.
Command add_gas(CLI::App& app);
/// How evenly the cost of a game is spread over its frames.
Command add_frames(CLI::App& app);
/// First contacts of capsules, clusters of balls and boxes that turn, beside FCL.
Command add_shapes(CLI::App& app);
/// A long run of a monitor on faulty reports, compared with the truth. The exit code says if anything was
/// missed or wrong.
Command add_soak(CLI::App& app);
/// The cost of the search for approaches of bodies on known paths, on one thread and on two. The exit code
/// says if both found the same.
Command add_paths(CLI::App& app);
/// Scenes under any detector, and their comparison with the oracle.
Command add_run(CLI::App& app);
Command add_verify(CLI::App& app);

}  // namespace kinesphere::program
