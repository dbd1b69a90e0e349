#pragma once

#include "archive/archive.hpp"

namespace kinesphere {

/// Writes a value to bytes and reads `back` from them. Returns true if that succeeds and no bytes are left.
template <class T>
bool read_back(const T& value, T& back) {
  ByteWriter writer;
  writer(value);
  ByteReader reader(writer.bytes());
  reader(back);
  return !reader.failed() && reader.remaining() == 0;
}

}  // namespace kinesphere
