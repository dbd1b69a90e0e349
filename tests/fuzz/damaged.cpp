// libFuzzer targets: any bytes as a snapshot of a world (TRIED = try_as_snapshot), or as damage to a snapshot
// or a recording, with corrected lengths and checksums (try_mended).
#include "stream/any_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinesphere::stream::TRIED({data, size});
  return 0;
}
