// Feeds any bytes to the decoder of AIS, for fuzz_nmea and for a test with random bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/streams/sentence_assembler.hpp"

namespace kinesphere::program {

/// Reads lines, and checks what the decoder makes of them.
class AnySentences {
 public:
  /// Reads the lines of a text. Returns the first defect, if any: a value beyond its range, more that waits
  /// than may, a state that is not restored as it was saved.
  std::optional<std::string> complaint(std::string_view text);
  /// Number of messages that had a position or dimensions.
  std::size_t messages() const { return messages_; }

 private:
  std::optional<std::string> complaint_of_line(std::string_view line);

  SentenceAssembler assembler_;
  std::size_t lines_ = 0, messages_ = 0;
};

}  // namespace kinesphere::program
