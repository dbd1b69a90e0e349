// Whole files as text, plain or gzipped.
#pragma once

#include <string>

namespace kinesphere::program {

/// Throws ProgramError naming the file if there is none, or if it is a folder; "-" is standard input.
void require_input(const std::string& path);

/// Returns the text of a file; "-" is standard input. Throws ProgramError naming the file if it cannot be
/// read, is a folder, or is a damaged gzip file.
std::string read_input(const std::string& path);

}  // namespace kinesphere::program
