// The three standard streams, which a caller may have closed.
#pragma once

namespace kinesphere::program {

/// Opens the null device in place of each closed standard stream, so that no later file gets its descriptor.
/// Reading a closed standard input and writing a closed standard output then fail; messages to a closed
/// standard error vanish, as the caller wants. To be called first in main(). Throws ProgramError if the null
/// device cannot be opened.
void reserve_standard_streams();
/// True if standard input was closed when reserve_standard_streams() was called.
bool standard_input_is_closed();

}  // namespace kinesphere::program
