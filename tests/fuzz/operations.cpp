// libFuzzer target: any bytes as a stream of operations on a world.
#include <cstdio>
#include <cstdlib>

#include "stream/player.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  if (!kinesphere::stream::play(bytes).failure) return 0;
  std::puts(kinesphere::stream::story_of(bytes).c_str());
  std::abort();
}
