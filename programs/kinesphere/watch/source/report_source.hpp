// Sources of the text of a stream.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

/// How far a stream has been read.
struct StreamPlace {
  std::string stream;          ///< its name
  std::uint64_t position = 0;  ///< in it: bytes, as they are when unpacked, or messages
  std::uint64_t check = 0;     ///< identifies a stream that can be read again; else 0
};

class ReportSource {
 public:
  virtual ~ReportSource() = default;

  enum class Outcome {
    text,   ///< some has come
    quiet,  ///< none has come in time
    cut,    ///< the connection is lost: what has begun does not go on in later text
    end,    ///< there is no more
  };
  /// Waits for text, at most `patience` or until the program is asked to stop. The text may end anywhere, and
  /// is valid until the next call. Throws ProgramError naming the source.
  virtual Outcome next(std::chrono::milliseconds patience, std::string_view& text) = 0;
  /// Returns how far text was returned, less `without` bytes, as StreamPlace counts; for messages the end of
  /// the last one.
  virtual std::uint64_t position(std::size_t without) const = 0;
  /// Returns the place from which a later run continues, less `without` bytes.
  virtual StreamPlace place(std::size_t without) const { return {name(), position(without), 0}; }
  /// Returns a name that all readers of this stream from its begin share, at any time; nothing if the stream
  /// cannot be read again, so that a later run continues with new text only.
  virtual std::optional<std::string> identity() const { return std::nullopt; }
  /// True if no record continues in the next text.
  virtual bool has_whole_records() const { return false; }
  /// True if the source itself gives the arrival times of texts, so that all readers have one clock.
  virtual bool has_clock() const { return false; }
  /// Arrival of the last text by the source's clock.
  virtual FileTime arrival() const { return {}; }
  enum class Nature {
    recording,  ///< it was written before, and can be read again
    live,       ///< it is read as its sender writes it
    unknown,    ///< a pipe
  };
  virtual Nature nature() const { return Nature::live; }
  /// Name of the source in messages.
  virtual std::string name() const = 0;
};

}  // namespace kinesphere::program
