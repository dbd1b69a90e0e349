// libFuzzer target: any bytes as a file of tracks. The first byte chooses the options.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "program/formats/any_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  const auto complaint = kinesphere::program::read_any_table(text, data[0]).complaint;
  if (!complaint) return 0;
  std::fprintf(stderr, "%s\n", complaint->c_str());
  std::abort();
}
