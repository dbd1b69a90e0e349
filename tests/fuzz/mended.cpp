// libFuzzer target: any bytes as damage to a snapshot or a recording, with corrected lengths and checksums.
#include "stream/any_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinesphere::stream::try_mended({data, size});
  return 0;
}
