// Words, of which all that is archived consists.
#include "archive/archive.hpp"

namespace kinesphere {
namespace {

template <class Word>
void append_word(std::vector<std::byte>& bytes, Word word) {
  const auto digits = bit_cast<std::array<std::byte, sizeof(Word)>>(detail::little_endian(word));
  bytes.insert(bytes.end(), digits.begin(), digits.end());
}

}  // namespace

void ByteWriter::write_word(std::uint8_t word) { append_word(bytes_, word); }
void ByteWriter::write_word(std::uint16_t word) { append_word(bytes_, word); }
void ByteWriter::write_word(std::uint32_t word) { append_word(bytes_, word); }
void ByteWriter::write_word(std::uint64_t word) { append_word(bytes_, word); }

template <class Word>
Word ByteReader::read_word() {
  if (failed_ || bytes_.size() < sizeof(Word)) {
    failed_ = true;
    return 0;
  }
  std::array<std::byte, sizeof(Word)> digits;
  std::copy_n(bytes_.begin(), sizeof(Word), digits.begin());
  bytes_ = bytes_.subspan(sizeof(Word));
  return detail::little_endian(bit_cast<Word>(digits));
}

template std::uint8_t ByteReader::read_word();
template std::uint16_t ByteReader::read_word();
template std::uint32_t ByteReader::read_word();
template std::uint64_t ByteReader::read_word();

}  // namespace kinesphere
