// Where the figures of a benchmark come from: machine, compiler, version, date.
#pragma once

#include <string>

namespace kinesphere::program {

/// Labelled lines. What the system does not tell is given as unknown.
std::string machine_description();

}  // namespace kinesphere::program
