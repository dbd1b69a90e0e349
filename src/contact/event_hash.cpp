#include "kinesphere/event_hash.hpp"

#include "number/bit_cast.hpp"

namespace kinesphere {
namespace {

/// Mixes a word so that each input bit flips about half of the output bits (finaliser of SplitMix64).
std::uint64_t scrambled(std::uint64_t word) {
  word = (word ^ word >> 30) * 0xbf58476d1ce4e5b9u;
  word = (word ^ word >> 27) * 0x94d049bb133111ebu;
  return word ^ word >> 31;
}

/// 64-bit FNV-1a over the bytes of words, least significant byte first.
class ByteHash {
 public:
  void mix(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

void EventHash::add(const Event& event) {
  ByteHash hash;
  hash.mix(bit_cast<std::uint64_t>(event.time));
  hash.mix(static_cast<std::uint64_t>(event.kind) | static_cast<std::uint64_t>(event.wall) << 8);
  hash.mix(event.first.index | std::uint64_t{event.first.generation} << 32);
  hash.mix(event.second.index | std::uint64_t{event.second.generation} << 32);
  if (is_of_sensor(event.kind)) hash.mix(bit_cast<std::uint64_t>(event.distance));
  sum_ += scrambled(hash.value());
  ++count_;
}

EventHash& EventHash::operator+=(const EventHash& other) {
  sum_ += other.sum_;
  count_ += other.count_;
  return *this;
}

std::uint64_t EventHash::value() const { return scrambled(sum_ + scrambled(count_)); }

}  // namespace kinesphere
