// Checks the paths of results before hours of work are spent on them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kinesphere::program {

struct OutputPath {
  std::string_view option;  ///< for messages
  std::string path;         ///< empty when the option was not given
};

/// Throws ProgramError naming the option if an output is the same file as an input or another output, under
/// any name. Does not check that an output can be written; open the OutputFile at once to find out.
void check_outputs(std::span<const OutputPath> outputs, std::span<const std::string> inputs);

}  // namespace kinesphere::program
