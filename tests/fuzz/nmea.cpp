// libFuzzer target: any bytes as lines with sentences of AIS.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "program/formats/ais/any_sentences.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinesphere::program::AnySentences sentences;
  const auto complaint = sentences.complaint({reinterpret_cast<const char*>(data), size});
  if (!complaint) return 0;
  std::fprintf(stderr, "%s\n", complaint->c_str());
  std::abort();
}
