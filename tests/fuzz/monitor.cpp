// libFuzzer target: any bytes as reports to a monitor (first byte even), or as damage to the snapshot of one.
#include <cstdio>
#include <cstdlib>

#include "stream/any_bytes.hpp"
#include "stream/any_reports.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span bytes(data + 1, size - 1);
  if (data[0] % 2 == 1) {
    kinesphere::any_monitor::try_as_monitor(bytes);
    return 0;
  }
  const auto watched = kinesphere::watched_sky::watch_sky(bytes);
  if (!watched.failure) return 0;
  std::puts(watched.failure->c_str());
  std::abort();
}
