#include "archive/envelope.hpp"

#include "archive/archive.hpp"
#include "archive/checksum.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t header_size = 20;
constexpr std::size_t checksum_size = 8;

}  // namespace

std::vector<std::byte> Envelope::seal(std::span<const std::byte> content) const {
  ByteWriter writer;
  writer(mark, format_version, content.size());
  writer.append(content);
  writer(checksum(writer.bytes()));
  return writer.take();
}

Result<std::span<const std::byte>> Envelope::open(std::span<const std::byte> bytes) const {
  auto found_mark = mark;
  std::uint32_t version = 0;
  std::uint64_t length = 0;
  ByteReader header(bytes);
  header(found_mark);
  if (header.failed() || found_mark != mark)
    return refusal("must begin with the mark of a " + std::string(noun) + ", but does not");
  header(version);
  if (!header.failed() && version != format_version) {
    return refusal("must be of format version " + std::to_string(format_version) + ", but is of version " +
                   std::to_string(version));
  }
  header(length);
  if (header.failed() || header.remaining() < checksum_size || length != header.remaining() - checksum_size) {
    return refusal("must be whole, but its " + std::to_string(bytes.size()) +
                   " bytes are not as many as it says it has");
  }
  const auto summed = bytes.first(bytes.size() - checksum_size);
  std::uint64_t expected = 0;
  ByteReader(bytes.last(checksum_size))(expected);
  if (checksum(summed) != expected) return refusal("must be undamaged, but its checksum is wrong");
  return summed.subspan(header_size);
}

Error Envelope::refusal(const std::string& what) const {
  return {code, std::string(argument), no_body,
          std::string(call) + ": " + std::string(argument) + " " + what};
}

}  // namespace kinesphere
