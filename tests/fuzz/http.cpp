// libFuzzer target: any bytes as a request to the web server of `kinesphere watch --serve` and `kinesphere
// view`.
#include <cstdio>
#include <cstdlib>

#include "program/serving/any_request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static kinesphere::program::AttackedServer server;
  const auto complaint = server.complaint({data, size});
  if (!complaint) return 0;
  std::fprintf(stderr, "%s\n%s\n", complaint->c_str(), server.response().c_str());
  std::abort();
}
