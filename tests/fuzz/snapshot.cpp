// libFuzzer target: any bytes as a snapshot of a world.
#include "stream/any_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinesphere::stream::try_as_snapshot({data, size});
  return 0;
}
