#include "base/output_paths.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// Returns true if two paths lead to one file, also through other folders or a link.
bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (a == b) return true;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  if (fs::exists(a, error) && fs::exists(b, error)) return false;
  const fs::path place_of_a = fs::weakly_canonical(a, error);
  if (error) return false;
  const fs::path place_of_b = fs::weakly_canonical(b, error);
  return !error && place_of_a == place_of_b;
}

}  // namespace

void check_outputs(std::span<const OutputPath> outputs, std::span<const std::string> inputs) {
  for (const OutputPath& output : outputs) {
    if (output.path.empty()) continue;
    for (const std::string& input : inputs) {
      if (!input.empty() && same_file(output.path, input))
        throw ProgramError(fmt::format("{}: expected another file than the input {}, but got {}",
                                       output.option, input, output.path));
    }
    for (const OutputPath& other : outputs) {
      if (&other == &output) break;
      if (!other.path.empty() && same_file(output.path, other.path))
        throw ProgramError(fmt::format("{}: expected another file than that of {}, but got {}", output.option,
                                       other.option, output.path));
    }
  }
}

}  // namespace kinesphere::program
