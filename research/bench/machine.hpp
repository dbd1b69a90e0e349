// Description of the machine of a benchmark: hardware, compiler, version, date.
#pragma once

#include <string>

namespace kinesphere::program {

/// Returns labelled lines. Facts that the system does not provide are given as unknown.
std::string machine_description();

}  // namespace kinesphere::program
