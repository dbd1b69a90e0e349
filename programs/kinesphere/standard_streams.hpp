// The three streams that a program starts with, also where the caller has closed some of them.
#pragma once

namespace kinesphere::program {

/// Opens the null device in place of each standard stream that is closed, so that no file that is opened
/// later becomes one. A closed standard input or output then fails when it is read or written; messages to a
/// closed standard error vanish, as the caller wants it. To be called first in main(). Throws ProgramError
/// when the null device cannot be opened.
void reserve_standard_streams();
/// True if standard input was closed when reserve_standard_streams() was called.
bool standard_input_is_closed();

}  // namespace kinesphere::program
