// Where results are to go, looked at before hours of work are put into them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kinesphere::program {

struct OutputPath {
  std::string_view option;  ///< for messages
  std::string path;         ///< empty when the option was not given
};

/// Throws ProgramError naming the option when one of the outputs is the same file as an input or as another
/// output, whatever it is called there. (Opening an OutputFile, which is to follow at once, finds out whether
/// it can be written.)
void check_outputs(std::span<const OutputPath> outputs, std::span<const std::string> inputs);

}  // namespace kinesphere::program
